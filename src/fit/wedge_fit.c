#include "fit/wedge_fit.h"

#include <math.h>
#include <stdlib.h>

#include "math/rational_cell.h"

/* Rows by y. At most a few hundred are used often, so a plain hash table is enough. */
enum { BUCKETS = 1024 };

typedef struct entry {
    vndf_row row;
    struct entry *next;
} entry;

struct vndf_row_cache {
    entry *bucket[BUCKETS];
};

static const double UNIFORM = 1e-7; /* the even part of each row, so that no cell is empty */

/* ---- the azimuth density ---- */

typedef struct direction {
    double s, c, k;
} direction;

static direction direction_at(const vndf_wedge_fit *fit, double y)
{
    double at = y > 1e-6 ? y : 1e-6, up = fit->side.below ? 1 - at : at, across = fit->side.below ? at : 1 - at;
    direction d = {across, up, across > 0 ? up / across : HUGE_VAL};
    return d;
}

/* Mass per radian at the azimuth whose cosine is cos_phi, over s (below) or c (above). */
static double wedge_density(const vndf_wedge_fit *fit, direction d, double cos_phi)
{
    double rho = cos_phi > 0 ? d.k / cos_phi : HUGE_VAL;
    if (fit->side.below)
        return cos_phi * vndf_strip_at(fit->strip, rho);
    return d.k < HUGE_VAL ? vndf_strip_at(fit->strip, rho) : fit->side.profile->f0;
}

/* tan of the azimuth that halves the mass, by a sum over a logarithmic grid. */
static double median_tangent(const vndf_wedge_fit *fit, direction d)
{
    enum { STEPS = 96 };
    double sum[STEPS + 1], from = log(1e-9), step = (log(1e9) - from) / STEPS;
    sum[0] = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double t = exp(from + (i + 0.5) * step), q = 1 + t * t;
        sum[i + 1] = sum[i] + wedge_density(fit, d, 1 / sqrt(q)) * t / q;
    }
    for (int i = 0; i < STEPS; i++)
        if (sum[i + 1] >= sum[STEPS] / 2 && sum[STEPS] > 0)
            return exp(from + (i + (sum[STEPS] / 2 - sum[i]) / (sum[i + 1] - sum[i])) * step);
    return 1.0;
}

/* Mass per unit of q for the aspect (p, r); azimuth.h has the formulas. */
static double density_in_q(const vndf_wedge_fit *fit, direction d, double p, double r, double q)
{
    double c = p * (1 - q * q), s = r * 2 * q, n2 = c * c + s * s;
    return wedge_density(fit, d, c / sqrt(n2)) * 2 * p * r * (1 + q * q) / n2;
}

/* Mass of each cell and density at each node, scaled to total 1. */
static void fill_row(const vndf_wedge_fit *fit, vndf_row *row)
{
    direction d = direction_at(fit, row->y);
    double mass[VNDF_WEDGE_CELLS_MAX], total = 0.0;
    for (uint32_t j = 0; j < fit->cells; j++) {
        double from = fit->node[j], width = fit->node[j + 1] - from;
        mass[j] = 0.0;
        for (int i = 0; i < VNDF_GAUSS; i++)
            mass[j] += vndf_gauss_weight[i] * width *
                       density_in_q(fit, d, row->p, row->r, from + vndf_gauss_node[i] * width);
        total += mass[j];
    }
    for (uint32_t j = 0; j <= fit->cells; j++) {
        double density = density_in_q(fit, d, row->p, row->r, fit->node[j]);
        row->density[j] = (float)((1 - UNIFORM) * density / total + UNIFORM);
        if (j < fit->cells)
            row->mass[j] = (float)((1 - UNIFORM) * mass[j] / total + UNIFORM / fit->cells);
    }
}

static void set_aspect(const vndf_wedge_fit *fit, vndf_row *row)
{
    double t = median_tangent(fit, direction_at(fit, row->y)), n = sqrt(1 + t * t);
    row->p = (float)(1 / n);
    row->r = (float)(t / n);
}

/* ---- cells of q ---- */

/* The number of directions, even in y, that judge cells. */
enum { JUDGE_COUNT = 40 };

typedef struct judge {
    direction d;
    double p, r, scale; /* aspect; the factor that turns the mass into a share of everything visible */
} judge;

typedef struct bench {
    const vndf_wedge_fit *fit;
    judge judges[JUDGE_COUNT];
} bench;

static judge judge_at(const vndf_wedge_fit *fit, double y)
{
    direction d = direction_at(fit, y);
    double t = median_tangent(fit, d), n = sqrt(1 + t * t);
    double all = vndf_side_mass(&fit->side, y), mass = all / (fit->side.below ? d.s : d.c);
    judge made = {d, 1 / n, t / n, mass > 0 ? vndf_side_share(&fit->side, y, all) / mass : 0.0};
    return made;
}

/* Half the integral of |drawn - true| in one cell of one row. */
static double cell_miss(const vndf_wedge_fit *fit, const judge *j, double a, double b)
{
    double f[VNDF_GAUSS], mass = 0.0, miss = 0.0, h = b - a;
    for (int i = 0; i < VNDF_GAUSS; i++) {
        f[i] = density_in_q(fit, j->d, j->p, j->r, a + h * vndf_gauss_node[i]);
        mass += vndf_gauss_weight[i] * h * f[i];
    }
    vndf_rational_cell cell = {(float)(density_in_q(fit, j->d, j->p, j->r, a) * h),
                               (float)(density_in_q(fit, j->d, j->p, j->r, b) * h), (float)mass};
    for (int i = 0; i < VNDF_GAUSS; i++)
        miss += vndf_gauss_weight[i] *
                fabs((double)vndf_rational_density(&cell, (float)vndf_gauss_node[i]) / h - f[i]);
    return miss * h / 2 * j->scale;
}

static vndf_interval_miss worst_miss(double a, double b, void *user)
{
    const bench *judges = user;
    vndf_interval_miss found = {0.0, 0.0};
    for (int i = 0; i < JUDGE_COUNT; i++)
        found.share = fmax(found.share, cell_miss(judges->fit, &judges->judges[i], a, b));
    return found;
}

static int place_cells(vndf_wedge_fit *fit, uint32_t most_cells, double enough)
{
    static const double start[] = {0.0, 0.25, 0.5, 0.75, 1.0};
    enum { START = sizeof start / sizeof *start };
    bench judges = {fit, {{{0, 0, 0}, 0, 0, 0}}};
    for (int i = 0; i < JUDGE_COUNT; i++)
        judges.judges[i] = judge_at(fit, (i + 0.5) / JUDGE_COUNT);
    if (!vndf_refine_begin(&fit->q, start, START, most_cells + 1 - START, NULL, worst_miss, &judges))
        return 0;
    vndf_refine_to(&fit->q, enough);
    fit->q.user = NULL; /* the judges end here */
    return 1;
}

static void forget_rows(vndf_wedge_fit *fit)
{
    for (int i = 0; i < BUCKETS; i++) {
        for (entry *e = fit->cache->bucket[i], *next; e; e = next) {
            next = e->next;
            free(e);
        }
        fit->cache->bucket[i] = NULL;
    }
}

uint32_t vndf_wedge_fit_cells(const vndf_wedge_fit *fit, double error)
{
    return vndf_refinement_needed(&fit->q, error) - 1;
}

void vndf_wedge_fit_use(vndf_wedge_fit *fit, uint32_t cells)
{
    double knots[VNDF_WEDGE_CELLS_MAX + 1];
    if (cells == fit->cells)
        return;
    vndf_refinement_knots(&fit->q, cells + 1, knots);
    for (uint32_t j = 0; j <= cells; j++)
        fit->node[j] = (float)knots[j];
    fit->cells = cells;
    forget_rows(fit);
}

/* ---- rows ---- */

int vndf_wedge_fit_from(vndf_wedge_fit *fit, vndf_side side, uint32_t most_cells, double enough)
{
    fit->side = side;
    fit->least = vndf_side_least(&side);
    fit->cells = 0;
    fit->cache = calloc(1, sizeof *fit->cache);
    fit->strip = vndf_strip_from(side.profile, side.below);
    if (!fit->cache || !fit->strip || !place_cells(fit, most_cells, enough))
        return 0;
    vndf_wedge_fit_use(fit, vndf_wedge_fit_cells(fit, enough));
    return 1;
}

void vndf_wedge_fit_free(vndf_wedge_fit *fit)
{
    if (fit->cache)
        forget_rows(fit);
    free(fit->cache);
    fit->cache = NULL;
    vndf_strip_free(fit->strip);
    fit->strip = NULL;
    vndf_refinement_free(&fit->q);
}

static unsigned hash(double y)
{
    return (unsigned)fmod(y * 1048573.0, BUCKETS);
}

const vndf_row *vndf_wedge_fit_row(vndf_wedge_fit *fit, double y)
{
    entry **bucket = &fit->cache->bucket[hash(y)];
    for (entry *e = *bucket; e; e = e->next)
        if (e->row.y == y)
            return &e->row;
    entry *e = calloc(1, sizeof *e);
    if (!e) {
        fit->side.profile->guard->starved = 1;
        return NULL;
    }
    e->row.y = y;
    set_aspect(fit, &e->row);
    fill_row(fit, &e->row);
    e->next = *bucket;
    *bucket = e;
    return &e->row;
}

/* The middle control point of a quadratic Bezier curve from a to b that passes through `halfway`, kept
 * positive. */
static double control(double a, double halfway, double b, double least)
{
    return fmax(2 * halfway - (a + b) / 2, least);
}

void vndf_wedge_fit_middle(const vndf_wedge_fit *fit, const vndf_row *a, const vndf_row *b, vndf_row *middle)
{
    vndf_row reference;
    double total = 0.0;
    middle->y = reference.y = a->y + (b->y - a->y) / 2;
    set_aspect(fit, &reference);
    middle->p = (float)control(a->p, reference.p, b->p, reference.p / 8);
    middle->r = (float)control(a->r, reference.r, b->r, reference.r / 8);
    reference.p = (a->p + 2 * middle->p + b->p) / 4;
    reference.r = (a->r + 2 * middle->r + b->r) / 4;
    fill_row(fit, &reference);
    for (uint32_t j = 0; j < fit->cells; j++) {
        middle->mass[j] = (float)control(a->mass[j], reference.mass[j], b->mass[j], UNIFORM / fit->cells);
        total += middle->mass[j];
    }
    for (uint32_t j = 0; j <= fit->cells; j++) {
        middle->density[j] = (float)(control(a->density[j], reference.density[j], b->density[j], UNIFORM) / total);
        if (j < fit->cells)
            middle->mass[j] = (float)(middle->mass[j] / total);
    }
}

/* ---- errors ---- */

typedef struct rows {
    const vndf_row *first, *middle, *last;
} rows;

static double blend(double a, double b, double c, double mix)
{
    return (1 - mix) * (1 - mix) * a + 2 * mix * (1 - mix) * b + mix * mix * c;
}

/* Total variation between the mixed row and the true one for the same aspect, cell by cell: by the masses of
 * cells, and by the densities at their ends for differences that masses do not show. Errors inside a cell do not
 * count, since more rows do not reduce them. */
static double row_miss(const vndf_wedge_fit *fit, rows r, double mix)
{
    const vndf_row *a = r.first, *b = r.middle, *c = r.last;
    vndf_row reference;
    double by_mass = 0.0, by_density = 0.0;
    reference.y = a->y + mix * (c->y - a->y);
    reference.p = blend(a->p, b->p, c->p, mix);
    reference.r = blend(a->r, b->r, c->r, mix);
    fill_row(fit, &reference);
    for (uint32_t j = 0; j <= fit->cells; j++) {
        double width = (double)fit->node[j < fit->cells ? j + 1 : j] - fit->node[j ? j - 1 : 0];
        by_mass += j < fit->cells ? fabs(blend(a->mass[j], b->mass[j], c->mass[j], mix) - reference.mass[j]) : 0.0;
        by_density +=
            width / 2 * fabs(blend(a->density[j], b->density[j], c->density[j], mix) - reference.density[j]);
    }
    return fmax(by_mass, by_density) / 2;
}

/* Where a quadratic through both ends and the middle misses most, and on either side of these places. */
static const double PROBES[] = {0.1, 0.22, 0.35, 0.65, 0.78, 0.9};
enum { PROBE_COUNT = sizeof PROBES / sizeof *PROBES };

vndf_interval_miss vndf_wedge_row_error(double a, double b, void *user)
{
    vndf_wedge_fit *fit = user;
    const vndf_row *first = vndf_wedge_fit_row(fit, a), *second = vndf_wedge_fit_row(fit, b);
    vndf_interval_miss found = {0.0, 0.0};
    if (!first || !second || b - a < 1e-6)
        return found;
    vndf_row middle;
    vndf_wedge_fit_middle(fit, first, second, &middle);
    rows three = {first, &middle, second};
    double y[PROBE_COUNT], miss[PROBE_COUNT];
    for (unsigned i = 0; i < PROBE_COUNT; i++) {
        y[i] = a + PROBES[i] * (b - a);
        miss[i] = row_miss(fit, three, PROBES[i]);
    }
    found.alone = vndf_side_largest(&fit->side, y, miss, PROBE_COUNT);
    return found;
}
