/* Integrates the visible normals from one direction over half a turn of azimuth (both halves are
 * alike) and over slope, on Gauss points of the cells of either stage, so that every integrand is smooth
 * between the points. A cell that holds a jump of the mask, c + s cos(a) R = 0, ends there. Where the profile has
 * panels far narrower than a radial cell, the points follow the panels: a feature that the table cannot hold is
 * missed by the table, not by the measurement. The slopes of the points do not depend on the direction, so P22 is
 * evaluated there once. */
#include "fit/certificate/validate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/inline.h"
#include "sampler/tabulated/exact.h"
#include "sampler/surface.h"
#include "sampler/tabulated/wedge.h"

static const double PI = 3.14159265358979323846;

const vndf_validation_rule vndf_validation_close = {128, VNDF_GAUSS, 20, 12, 512, 100};
const vndf_validation_rule vndf_validation_coarse = {1, VNDF_GAUSS_COARSE, 6, 6, 32, 64};

enum { FRONT_PANELS_MOST = 12 };

/* Panels together are a feature of their own if they are narrower than this part of a stretch and hold more than
 * that part of the cell's mass. */
static const double NARROW = 0.25, HEAVY = 0.02;

/* A cell with a smaller part of the mass of an azimuth is not integrated. */
static const double CELL_LEAST = 1e-9;

static uint32_t parts_for(uint32_t cells, uint32_t least)
{
    return (least + cells - 1) / cells;
}

/* In double at the knots too: the visible part beyond a cut may be so narrow that rounding of its end shows. */
double vndf_validation_slope(const vndf_distribution *d, uint32_t cell, uint32_t part, uint32_t parts)
{
    double xi = (double)part / parts, x0 = d->knots.at[cell].x, z0 = d->knots.at[cell].z;
    double x = part < parts ? x0 + xi * (d->knots.at[cell + 1].x - x0) : d->knots.at[cell + 1].x;
    double z = part < parts ? z0 + xi * (d->knots.at[cell + 1].z - z0) : d->knots.at[cell + 1].z;
    return z > 0 ? x / z : HUGE_VAL;
}

/* The view of the unit problem: isotropic, so that it may be made from s and c alone. */
static vndf_view view_of(const vndf_distribution *table, double s, double c)
{
    vndf_vec3 wi = {(float)s, 0.0f, (float)c};
    return vndf_view_scaled(table, 1.0, 1.0, wi);
}

/* ---- slopes ---- */

typedef struct knots {
    double x0, x1, z0, z1;
} knots;

static knots knots_of(const vndf_distribution *d, uint32_t j)
{
    vndf_knot from = d->knots.at[j], to = d->knots.at[j + 1];
    knots k = {from.x, to.x, from.z, to.z};
    return k;
}

/* xi of a slope in a cell. */
static double place_of(knots k, double r)
{
    double inner = r * k.z0 - k.x0, outer = k.x1 - r * k.z1;
    return inner / (inner + outer);
}

/* The mean relative change of a normal's slope by rounding of the normal to float; and the part of a stretch from
 * which it shows: at the edge of a compact support the visible part is only thousands of floats wide. */
static const double FLOAT_ROUNDING = 2.8e-8, ROUNDING_LEAST = 1e-5;

/* Whether f changes so much in a cell that the cell needs the finer rule. */
static int is_steep(const vndf_radial_cell *cell)
{
    const float steep = 1.3f;
    return cell->f0 > steep * cell->f1 || cell->f1 > steep * cell->f0;
}

static uint32_t points_in(const vndf_validation *v, uint32_t j, double width)
{
    return width < 1.0 || is_steep(&v->table->cells[j]) ? VNDF_GAUSS : VNDF_GAUSS_COARSE;
}

/* Gauss point i of a stretch without P22 in its mass: X and Z are linear in xi, dR = width/Z^2 dxi. */
static vndf_validation_node place_in(const vndf_validation *v, uint32_t j, double from, double to, uint32_t count,
                                     uint32_t i)
{
    int fine = count == VNDF_GAUSS;
    knots k = knots_of(v->table, j);
    double xi = from + (to - from) * (fine ? vndf_gauss_node[i] : vndf_gauss_coarse_node[i]);
    double weight = (to - from) * (fine ? vndf_gauss_weight[i] : vndf_gauss_coarse_weight[i]);
    double x = (1 - xi) * k.x0 + xi * k.x1, z = (1 - xi) * k.z0 + xi * k.z1, width = k.x1 * k.z0 - k.x0 * k.z1;
    double rounding = FLOAT_ROUNDING * x * z / width;
    vndf_validation_node node = {xi, weight, x / z, weight * width * (x / z) / (z * z), 0.0};
    node.rounding = rounding > ROUNDING_LEAST * (to - from) ? rounding : 0.0;
    return node;
}

/* The Gauss points of a stretch. */
static void nodes_in(const vndf_validation *v, uint32_t j, double from, double to, uint32_t count,
                     vndf_validation_node *node)
{
    double r[VNDF_GAUSS] = {0}, p22[VNDF_GAUSS];
    for (uint32_t i = 0; i < count; i++) {
        node[i] = place_in(v, j, from, to, count, i);
        r[i] = node[i].r;
    }
    vndf_profile_p22_many(v->profile, r, count, p22);
    for (uint32_t i = 0; i < count; i++)
        node[i].mass *= p22[i];
}

static int add_stretch(vndf_validation *v, uint32_t j, double from, double to)
{
    uint32_t count = points_in(v, j, to - from);
    if ((v->stretch_count & (v->stretch_count - 1)) == 0) { /* a power of two: full */
        size_t room = v->stretch_count ? 2 * v->stretch_count : 1;
        vndf_validation_stretch *stretch = realloc(v->stretch, room * sizeof *stretch);
        vndf_validation_node *node = realloc(v->node, room * VNDF_GAUSS * sizeof *node);
        v->stretch = stretch ? stretch : v->stretch;
        v->node = node ? node : v->node;
        if (!stretch || !node)
            return 0;
    }
    vndf_validation_stretch made = {from, to, j, (uint32_t)v->node_count, count};
    v->stretch[v->stretch_count++] = made;
    nodes_in(v, j, from, to, count, v->node + v->node_count);
    v->node_count += count;
    return 1;
}

/* Panels next to each other in a part of a cell. */
typedef struct panels {
    double begin, end, mass;
} panels;

static panels with_panel(panels p, double begin, double end, double mass, double widest)
{
    panels alone = {begin, end, mass}, more = {p.begin, end, p.mass + mass};
    return p.end == begin && end - p.begin < widest ? more : alone;
}

/* A part of a cell, divided at the panels in it that are features of their own; *panel is the first panel that
 * ends in it or beyond. */
static int add_part(vndf_validation *v, uint32_t j, double from, double to, size_t *panel)
{
    const vndf_profile *p = v->profile;
    knots k = knots_of(v->table, j);
    double heavy = HEAVY * vndf_profile_moments(p, vndf_validation_slope(v->table, j, 0, 1),
                                                vndf_validation_slope(v->table, j, 1, 1))
                               .m0;
    double at = from, widest = NARROW * (to - from);
    panels few = {-1, -1, 0};
    int good = 1;
    for (; *panel < p->count && good; ++*panel) {
        double begin = place_of(k, p->panel[*panel].r), end = place_of(k, p->panel[*panel + 1].r);
        if (!(end < to))
            break;
        few = with_panel(few, begin, end, p->panel[*panel].m0, widest);
        if (!(end > at && end - few.begin < widest && few.mass > heavy))
            continue;
        if (few.begin > at)
            good = add_stretch(v, j, at, few.begin);
        good = good && add_stretch(v, j, few.begin > at ? few.begin : at, end);
        at = few.begin = few.end = end;
        few.mass = 0;
    }
    return good && add_stretch(v, j, at, to);
}

/* The last cell has no end. A light tail ends next to its beginning; a heavy tail holds some mass as far out as
 * doubles reach, where the table draws it with a density that has a limit. */
static int add_last(vndf_validation *v, size_t *panel)
{
    static const double ends[] = {0,      1.0 / 256, 1.0 / 64, 1.0 / 16, 0.25,     0.5,       0.75,
                                  0.9375, 1 - 1e-3,  1 - 1e-5, 1 - 1e-7, 1 - 1e-9, 1 - 1e-12, 1};
    int good = 1;
    for (size_t i = 0; i + 1 < sizeof ends / sizeof *ends && good; i++)
        good = add_part(v, v->table->radial_count - 1, ends[i], ends[i + 1], panel);
    return good;
}

static int add_stretches(vndf_validation *v)
{
    uint32_t parts = parts_for(v->table->radial_count, v->rule.radial_parts);
    size_t panel = 0;
    int good = 1;
    for (uint32_t i = 0; i < (v->table->radial_count - 1) * parts && good; i++) {
        double part = i % parts;
        good = add_part(v, i / parts, part / parts, (part + 1) / parts, &panel);
    }
    return good && add_last(v, &panel);
}

/* ---- one azimuth ---- */

/* One azimuth of a direction, with its weight in the sum. */
typedef struct slice {
    vndf_azimuth_slice drawn;
    double weight;
} slice;

VNDF_INLINE void add_total(vndf_validation_total *total, double drawn, double reference)
{
    total->drawn += drawn;
    total->reference += reference;
    total->miss += fabs(drawn - reference);
}

static void add_node(vndf_validation *v, const slice *at, const vndf_engine_piece *piece, uint32_t j,
                     const vndf_validation_node *n)
{
    vndf_points *to = &v->samples;
    double mask = at->drawn.c + at->drawn.k * n->r;
    if (mask > 0 && to->count < to->capacity) {
        double drawn = vndf_engine_piece_density(&at->drawn, piece, j, n->xi, 1 - n->xi);
        double reference = n->mass * mask * (at->weight / v->area), mass = at->weight * n->weight * drawn;
        add_total(&v->total, mass, reference);
        to->reference[to->count] = reference;
        to->drawn[to->count++] = mass;
        if (n->rounding > 0) {
            double xi = fmax(fmin(n->xi + (to->count % 2 ? 1 : -1) * n->rounding, 1), 0);
            double moved = vndf_engine_piece_density(&at->drawn, piece, j, xi, 1 - xi);
            v->blur += at->weight * n->weight * fabs(moved - drawn);
        }
    }
}

/* The visible part of a stretch in the cell of the cut. */
static void add_cut(vndf_validation *v, const slice *at, const vndf_engine_piece *piece,
                    const vndf_validation_stretch *s)
{
    double from = fmax(s->from, piece->begin), to = fmin(s->to, piece->begin + piece->length);
    vndf_validation_node node[VNDF_GAUSS];
    if (!(to > from))
        return;
    nodes_in(v, s->cell, from, to, v->rule.cut_points, node);
    for (uint32_t i = 0; i < v->rule.cut_points; i++)
        add_node(v, at, piece, s->cell, &node[i]);
}

static int is_visible(const slice *at, double r)
{
    return at->drawn.c + at->drawn.k * r > 0;
}

static vndf_engine_places places_of(const vndf_validation_places *p, const vndf_validation_cell *cell)
{
    vndf_engine_places places = {p->xi + cell->first, p->eta + cell->first, cell->count};
    return places;
}

/* What rounding of normals changes in a cell whose densities are known. */
static void add_blur(vndf_validation *v, const slice *at, const vndf_engine_piece *piece,
                     const vndf_validation_cell *cell, const double *density)
{
    const double *weight = v->lines.weight + cell->first;
    vndf_engine_places moved = places_of(&v->lines.moved[v->samples.count % 2], cell);
    vndf_engine_piece_densities(&at->drawn, piece, (uint32_t)(cell - v->cells), &moved, v->beside);
    for (uint32_t i = 0; i < cell->count; i++)
        v->blur += at->weight * weight[i] * fabs(v->beside[i] - density[i]);
}

/* Samples of successive cells that hold densities so far, and the points that they belong to. */
typedef struct run {
    size_t point, sample, count;
} run;

/* Turns the densities of a run into masses, and adds them up in their order while they are at hand. */
static void end_run(vndf_validation *v, const slice *at, run *of)
{
    const vndf_validation_lines *lines = &v->lines;
    const double *restrict weight = lines->weight + of->point, *restrict mass = lines->mass + of->point;
    const double *restrict r = lines->r + of->point;
    double *restrict drawn = v->samples.drawn + of->sample, *restrict reference =
                                                                v->samples.reference + of->sample;
    double c = at->drawn.c, k = at->drawn.k, part = at->weight, per_area = at->weight / v->area;
    vndf_validation_total total = v->total;
    for (size_t i = 0; i < of->count; i++) {
        drawn[i] = part * weight[i] * drawn[i];
        reference[i] = mass[i] * (c + k * r[i]) * per_area;
        add_total(&total, drawn[i], reference[i]);
    }
    v->total = total;
    of->count = 0;
}

/* All points of a cell at once, which are visible. */
static void add_nodes(vndf_validation *v, const slice *at, const vndf_engine_piece *piece,
                      const vndf_validation_cell *cell, run *of)
{
    vndf_engine_places places = places_of(&v->lines.at, cell);
    double *drawn = v->samples.drawn + v->samples.count;
    if (of->count == 0) {
        of->point = cell->first;
        of->sample = v->samples.count;
    }
    vndf_engine_piece_densities(&at->drawn, piece, (uint32_t)(cell - v->cells), &places, drawn);
    if (cell->rounded)
        add_blur(v, at, piece, cell, drawn);
    of->count += cell->count;
    v->samples.count += cell->count;
}

/* All points of a cell that are seen, one by one. */
static void add_cell_slowly(vndf_validation *v, const slice *at, const vndf_engine_piece *piece, uint32_t j)
{
    const vndf_validation_cell *cell = v->cells + j;
    if (j == at->drawn.cut)
        for (uint32_t n = 0; n < cell->stretches; n++)
            add_cut(v, at, piece, v->stretch + cell->first_stretch + n);
    else
        for (uint32_t i = 0; i < cell->count; i++)
            add_node(v, at, piece, j, v->node + cell->first + i);
}

static void add_cell(vndf_validation *v, const slice *at, uint32_t j, run *of)
{
    const vndf_validation_cell *cell = v->cells + j;
    const vndf_validation_node *node = v->node + cell->first;
    vndf_engine_piece piece = vndf_engine_piece_of(&at->drawn, j);
    int empty = !(piece.mass > CELL_LEAST * at->drawn.mass);
    int whole = j != at->drawn.cut && is_visible(at, node->r) && is_visible(at, node[cell->count - 1].r) &&
                v->samples.count + cell->count <= v->samples.capacity;
    if (!empty && whole) {
        add_nodes(v, at, &piece, cell, of);
        return;
    }
    end_run(v, at, of);
    if (empty)
        v->lack += at->weight * at->drawn.azimuth * (at->drawn.mass > 0 ? piece.mass / at->drawn.mass : 0);
    else
        add_cell_slowly(v, at, &piece, j);
}

static const double POINT_OPERATIONS = 2; /* of a density at a point */

/* Every visible radial cell; the cell at the cut up to the cut. */
static void add_azimuth(vndf_validation *v, const slice *at)
{
    const vndf_azimuth_slice *r = &at->drawn;
    int inside = r->c > 0, beyond = r->c < 0;
    if (!vndf_guard_spend(v->profile->guard, POINT_OPERATIONS * (double)v->node_count))
        return;
    uint32_t from = beyond ? r->cut : 0,
             end = inside && r->cut < v->table->radial_count ? r->cut + 1 : v->table->radial_count;
    run of = {0, 0, 0};
    for (uint32_t j = from; r->mass > 0 && j < end; j++)
        add_cell(v, at, j, &of);
    end_run(v, at, &of);
}

/* A quarter turn on the cells of a row with an aspect. */
typedef struct quarter {
    const float *node;
    uint32_t cells;
    double p, r;
    int away; /* from wi */
} quarter;

/* Gauss point g of a part of a cell. */
static slice ray_in(const vndf_azimuth_fan *fan, const quarter *turn, uint32_t cell, uint32_t part, uint32_t parts,
                    uint32_t g)
{
    double width = ((double)turn->node[cell + 1] - turn->node[cell]) / parts;
    double q = turn->node[cell] + width * (part + vndf_gauss_coarse_node[g]), p = turn->p, r = turn->r;
    double x = p * (1 - q * q), y = r * 2 * q, n2 = x * x + y * y, n = sqrt(n2);
    double weight = 2 * vndf_gauss_coarse_weight[g] * width * 2 * p * r * (1 + q * q) / n2;
    slice at = {vndf_azimuth_slice_in(fan, (turn->away ? -x : x) / n, y / n), weight};
    return at;
}

/* Adds an azimuth to the sums: its normals together, so that no radius has to be looked at. */
static void add_sum(vndf_validation *v, const slice *at)
{
    vndf_points *to = &v->sums;
    if (to->count < to->capacity) {
        to->reference[to->count] = at->weight * at->drawn.mass / v->area;
        to->drawn[to->count++] = at->weight * at->drawn.azimuth;
    }
}

/* Adds an azimuth to the samples. */
static void add_slice_of(vndf_validation *v, const slice *at)
{
    size_t first = v->samples.count;
    add_azimuth(v, at);
    vndf_validation_slice made = {first, v->samples.count - first, 0, 0};
    if (v->slice_count < v->slice_capacity)
        v->slices[v->slice_count++] = made;
}

typedef void add_slice(vndf_validation *v, const slice *at);

/* Adds the azimuths of a quarter turn, on at least `least` cells; their drawn mass. */
static double add_azimuths(vndf_validation *v, const vndf_azimuth_fan *fan, const quarter *turn, uint32_t least,
                           add_slice *add)
{
    uint32_t parts = parts_for(turn->cells, least);
    double drawn = 0.0;
    for (uint32_t i = 0; i < turn->cells * parts * VNDF_GAUSS_COARSE; i++) {
        uint32_t part = i / VNDF_GAUSS_COARSE;
        slice at = ray_in(fan, turn, part / parts, part % parts, parts, i % VNDF_GAUSS_COARSE);
        drawn += at.weight * at.drawn.azimuth;
        add(v, &at);
    }
    return drawn;
}

/* Where a part of a cell ends that one of its Gauss points stands for. */
static const double SHARE_ENDS[VNDF_GAUSS_COARSE] = {0.17392742256872693, 0.5, 0.82607257743127307, 1};

/* Gives every slice of a quarter turn its sums: those that are nearer to it than to others. */
static void share_sums(vndf_validation *v, const quarter *turn, size_t first_slice, size_t first_sum)
{
    uint32_t parts = parts_for(turn->cells, v->rule.azimuth_parts), fine = parts_for(turn->cells, v->rule.sums);
    size_t n = 0, sums = v->sums.count - first_sum;
    for (size_t i = 0; first_slice + i < v->slice_count; i++) {
        vndf_validation_slice *part = v->slices + first_slice + i;
        double end = ((double)(i / VNDF_GAUSS_COARSE) + SHARE_ENDS[i % VNDF_GAUSS_COARSE]) / parts;
        part->first_sum = first_sum + n;
        while (n < sums &&
               ((double)(n / VNDF_GAUSS_COARSE) + vndf_gauss_coarse_node[n % VNDF_GAUSS_COARSE]) / fine < end)
            n++;
        part->sums = first_sum + n - part->first_sum;
    }
}

/* The few azimuths that are looked at along the radius underestimate the mass of all: cells at the azimuth of a jump
 * are steep. Without the radius many more cost little. */
static void add_quarter(vndf_validation *v, const vndf_azimuth_fan *fan, const quarter *turn)
{
    size_t first_slice = v->slice_count, first_sum = v->sums.count;
    double taken = add_azimuths(v, fan, turn, v->rule.azimuth_parts, add_slice_of);
    v->lack += add_azimuths(v, fan, turn, v->rule.sums, add_sum) - taken;
    share_sums(v, turn, first_slice, first_sum);
}

static void add_sums(vndf_validation *v, const vndf_azimuth_fan *fan, const quarter *turn)
{
    add_azimuths(v, fan, turn, v->rule.foreseen, add_sum);
}

typedef void add_turn(vndf_validation *v, const vndf_azimuth_fan *fan, const quarter *turn);

/* The quarter turn towards wi, in panels that are closer towards 90 degrees, where cos a vanishes. */
static void add_front(vndf_validation *v, const vndf_azimuth_fan *fan, add_turn *add)
{
    uint32_t cells = v->rule.front_panels;
    float node[FRONT_PANELS_MOST + 1];
    quarter turn = {node, cells, 1, 1, 0};
    for (uint32_t i = 0; i <= cells; i++) {
        double w = (double)i / cells;
        node[i] = (float)tan(PI / 4 * w * (1.5 - 0.5 * w));
    }
    add(v, fan, &turn);
}

/* Both quarter turns of the direction (s, 0, c), after those of the last direction are forgotten. */
static void add_turns(vndf_validation *v, double s, double c, double area, add_turn *add)
{
    vndf_view view = view_of(v->table, s, c);
    vndf_stretched w = vndf_stretched_of(&view);
    vndf_azimuth_fan fan = vndf_azimuth_fan_of(v->table, w.s, w.c, 1);
    v->area = area / (s + fabs(c)); /* as the view has it: s + |c| = 1 */
    v->samples.count = v->sums.count = v->slice_count = 0;
    v->lack = v->blur = 0.0;
    v->total = (vndf_validation_total){0.0, 0.0, 0.0};
    if (c >= 0)
        add_front(v, &fan, add);
    const vndf_wedge *side = vndf_wedge_of(v->table, c);
    vndf_azimuth_row row = vndf_wedge_row(side, (float)vndf_wedge_y(view.of.table.s, view.of.table.c));
    quarter wedge = {side->q, side->cell_count, row.p, row.r, c >= 0};
    if (view.of.table.wedge > 0 && row.p > 0)
        add(v, &fan, &wedge);
}

/* ---- the largest weight ---- */

/* Whether a slice stands for little mass of which the weight changes. Where the azimuths end that see anything, one
 * Gauss point would hold about VNDF_VALIDATION_LEFT_OUT, and chance would decide the largest weight. */
static int is_uneven(const vndf_validation *v, const vndf_validation_slice *part)
{
    const double uneven = 1.02, little = 100 * VNDF_VALIDATION_LEFT_OUT;
    double least = HUGE_VAL, most = 0.0, mass = 0.0;
    for (size_t i = 0; i < part->sums && mass < little; i++) {
        double reference = v->sums.reference[part->first_sum + i], drawn = v->sums.drawn[part->first_sum + i];
        least = reference + drawn > 0 ? fmin(least, vndf_weight_ratio(reference, drawn)) : least;
        most = fmax(most, vndf_weight_ratio(reference, drawn));
        mass += reference;
    }
    return mass < little && most > uneven * least;
}

/* Replaces the samples of a slice by its sums: beside them the radius matters little there. */
static void take_sums(vndf_validation *v, const vndf_validation_slice *part)
{
    vndf_points *to = &v->samples;
    memset(to->reference + part->first, 0, part->count * sizeof *to->reference);
    memset(to->drawn + part->first, 0, part->count * sizeof *to->drawn);
    for (size_t i = 0; i < part->sums && to->count < to->capacity; i++) {
        to->reference[to->count] = v->sums.reference[part->first_sum + i];
        to->drawn[to->count++] = v->sums.drawn[part->first_sum + i];
    }
}

static double largest_weight(vndf_validation *v)
{
    for (size_t i = 0; i < v->slice_count; i++)
        if (is_uneven(v, v->slices + i))
            take_sums(v, v->slices + i);
    return vndf_largest_weight(&v->weights, &v->samples, &v->profile->guard->starved);
}

/* ---- directions ---- */

double vndf_validation_claimed(const vndf_validation *v, double s, double c)
{
    const vndf_profile *p = v->profile;
    double area = vndf_profile_area(p, s, c), seen = area / (2 * p->f1 * hypot(s, c));
    return seen > vndf_profile_claimed(p) && !vndf_guard_stopped(p->guard) ? area : 0.0;
}

vndf_finding vndf_validation_direction(vndf_validation *v, double s, double c)
{
    vndf_finding f = {0, 0, 0, 0, 0};
    s = (float)s; /* the direction as the run time receives it */
    c = (float)c;
    double area = vndf_validation_claimed(v, s, c);
    if (!(area > 0))
        return f;
    f.measured = 1;
    f.area_error = fabs(vndf_unit_area(v->table, s, c) / area - 1);
    add_turns(v, s, c, area, add_quarter);
    double miss = v->total.miss, reference = v->total.reference;
    f.tv = fmin((miss + fabs(reference - 1) + v->blur) / 2, 1); /* mass that no point meets is missed, too */
    f.consistency = fabs(v->total.drawn + v->lack - 1);
    f.max_weight = largest_weight(v);
    return f;
}

double vndf_validation_foreseen(vndf_validation *v, double s, double c)
{
    s = (float)s;
    c = (float)c;
    double area = vndf_validation_claimed(v, s, c);
    if (!(area > 0))
        return 0.0;
    add_turns(v, s, c, area, add_sums);
    vndf_guard_spend(v->profile->guard, POINT_OPERATIONS * (double)v->sums.count);
    return vndf_largest_weight(&v->weights, &v->sums, &v->profile->guard->starved);
}

/* ---- memory ---- */

static int room_for(vndf_points *points, size_t capacity)
{
    points->capacity = capacity;
    points->reference = malloc(2 * capacity * sizeof *points->reference);
    points->drawn = points->reference ? points->reference + capacity : NULL;
    return points->reference != NULL;
}

static int places_for(vndf_validation_places *p, size_t n)
{
    p->xi = malloc(2 * n * sizeof *p->xi);
    p->eta = p->xi ? p->xi + n : NULL;
    return p->xi != NULL;
}

static void put_place(const vndf_validation_places *p, size_t i, double xi)
{
    p->xi[i] = xi;
    p->eta[i] = 1 - xi;
}

/* Point i, which belongs to a cell. */
static void put_point(vndf_validation *v, vndf_validation_cell *cell, size_t i)
{
    const vndf_validation_lines *lines = &v->lines;
    const vndf_validation_node *node = v->node + i;
    put_place(&lines->at, i, node->xi);
    for (size_t n = 0; n < 2; n++) {
        double way = (i - cell->first + n) % 2 ? -node->rounding : node->rounding;
        put_place(&lines->moved[n], i, fmax(fmin(node->xi + way, 1), 0));
    }
    lines->weight[i] = node->weight;
    lines->mass[i] = node->mass;
    lines->r[i] = node->r;
    cell->rounded |= node->rounding > 0;
}

/* The points once more, number by number, and where each cell has its own. */
static int add_lines(vndf_validation *v)
{
    vndf_validation_lines *lines = &v->lines;
    size_t n = v->node_count;
    v->cells = calloc(v->table->radial_count, sizeof *v->cells);
    v->beside = malloc(n * sizeof *v->beside);
    lines->weight = malloc(3 * n * sizeof *lines->weight);
    if (!places_for(&lines->at, n) || !places_for(&lines->moved[0], n) || !places_for(&lines->moved[1], n) ||
        !v->cells || !v->beside || !lines->weight)
        return 0;
    lines->mass = lines->weight + n;
    lines->r = lines->mass + n;
    for (size_t i = 0; i < v->stretch_count; i++) {
        const vndf_validation_stretch *s = v->stretch + i;
        vndf_validation_cell *cell = v->cells + s->cell;
        cell->first_stretch = cell->stretches++ ? cell->first_stretch : (uint32_t)i;
        cell->first = cell->count ? cell->first : s->first;
        cell->count += s->count;
        for (size_t k = s->first; k < s->first + s->count; k++)
            put_point(v, cell, k);
    }
    return 1;
}

int vndf_validation_from(vndf_validation *v, const vndf_distribution *table, const vndf_profile *profile,
                         vndf_validation_rule rule)
{
    size_t cells = table->above.cell_count + table->below.cell_count + rule.front_panels;
    size_t parts = cells + 3 * (size_t)rule.azimuth_parts;
    vndf_validation made = {.table = table, .profile = profile, .rule = rule, .weights.beyond = 1e-3};
    *v = made;
    if (!add_stretches(v) || !add_lines(v))
        return 0;
    size_t samples = parts * VNDF_GAUSS_COARSE * (v->node_count + VNDF_GAUSS);
    size_t sums =
        (cells + 3 * (size_t)(rule.sums > rule.foreseen ? rule.sums : rule.foreseen)) * VNDF_GAUSS_COARSE;
    v->slice_capacity = parts * VNDF_GAUSS_COARSE;
    v->slices = malloc(v->slice_capacity * sizeof *v->slices);
    return room_for(&v->samples, samples) && room_for(&v->sums, sums) && v->slices;
}

void vndf_validation_free(vndf_validation *v)
{
    free(v->stretch);
    free(v->node);
    free(v->cells);
    free(v->lines.at.xi);
    free(v->lines.moved[0].xi);
    free(v->lines.moved[1].xi);
    free(v->lines.weight);
    free(v->beside);
    free(v->samples.reference);
    free(v->sums.reference);
    free(v->slices);
    free(v->weights.that_count);
}
