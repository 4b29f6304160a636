#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* ---- points ---- */

static const double POINTS_MANY = 8000;

/* Puts `group` points together to one, from index `first` on: rough distributions have more than sums need. */
static void thin(vndf_points *points, size_t first, size_t group)
{
    size_t n = first;
    for (size_t i = first; group > 1 && i < points->count; i += group) {
        vndf_point sum = {0, 0, 0, 0};
        for (size_t k = i; k < i + group && k < points->count; k++) {
            const vndf_point *p = &points->at[k];
            sum.r += p->mass * p->r;
            sum.mass += p->mass;
            sum.xi += p->width * p->xi;
            sum.width += p->width;
        }
        points->at[n++] = (vndf_point){sum.r / sum.mass, sum.mass, sum.xi / sum.width, sum.width};
    }
    points->count = group > 1 ? n : points->count;
}

static double end_of(const vndf_laws *laws, unsigned i)
{
    return i < laws->cells ? laws->span[i + 1].r : HUGE_VAL;
}

int vndf_sight_from(vndf_sight *sight, const vndf_profile *profile, const vndf_laws *laws)
{
    enum { GROUP_MOST = 5, FEW = 4 * VNDF_GAUSS };
    size_t group = 1 + (size_t)((double)(profile->count * VNDF_GAUSS) / POINTS_MANY);
    *sight = (vndf_sight){{NULL, 0, 0, 0}, malloc((laws->cells + 2) * sizeof *sight->first)};
    for (unsigned i = 0; sight->first && i <= laws->cells; i++) {
        size_t first = sight->first[i] = sight->points.count;
        vndf_points_add(&sight->points, profile, &laws->span[i], end_of(laws, i));
        if (sight->points.count > first + FEW)
            thin(&sight->points, first, group < GROUP_MOST ? group : GROUP_MOST);
        sight->first[i + 1] = sight->points.count;
    }
    return sight->first && !sight->points.starved;
}

void vndf_sight_free(vndf_sight *sight)
{
    vndf_points_free(&sight->points);
    free(sight->first);
    sight->first = NULL;
}

/* ---- cells and areas ---- */

/* Eleven arrays in one block. */
static int allocate(vndf_table_draft *t)
{
    size_t n = t->cells + 1;
    float *block = calloc(11 * n, sizeof *block),
          **array[] = {&t->knot, &t->g0, &t->g1, &t->m0,   &t->m1,   &t->m2,
                       &t->m4,   &t->b0, &t->b1, &t->area, &t->slope};
    for (int i = 0; block && i < 11; i++)
        *array[i] = block + (size_t)i * n;
    return block != NULL;
}

static void put_cell(vndf_draft *draft, const vndf_profile *profile, unsigned i)
{
    vndf_table_draft *t = &draft->table;
    const vndf_sight *sight = &draft->sight;
    vndf_cell cell = vndf_cell_measure(profile, &draft->laws.span[i], end_of(&draft->laws, i),
                                       sight->points.at + sight->first[i], sight->first[i + 1] - sight->first[i]);
    t->g0[i] = (float)cell.g0;
    t->g1[i] = (float)cell.g1;
    t->m0[i] = (float)cell.m0;
    t->m1[i] = (float)cell.m1;
    t->m2[i] = (float)cell.m2;
    t->m4[i] = (float)cell.m4;
}

/* ---- shares below the horizon ---- */

/* A point that is seen from below: its f dR, the true kernel, and the two of which shares are drawn. */
typedef struct ray {
    double mass, k, near, far;
} ray;

typedef struct shares {
    double b0, b1;
} shares;

static ray ray_at(const vndf_point *p, double rho)
{
    double y = p->r / rho;
    return (ray){p->mass, vndf_profile_kernel(y), y - 1, (y - 1) * ((y - 1) / y)};
}

/* What is seen from rho in `cell` and beyond; returns how many rays. Far out, where next to nothing is added, they
 * end. */
static size_t look(const vndf_sight *sight, unsigned cells, unsigned cell, double rho, const double *grazing,
                   ray *out)
{
    const double little = 1e-7;
    double seen = 0;
    size_t n = 0;
    for (unsigned i = cell; i <= cells && !(grazing[i] < little * seen * rho); i++)
        for (size_t k = sight->first[i]; k < sight->first[i + 1]; k++)
            if (sight->points.at[k].r > rho) {
                out[n] = ray_at(&sight->points.at[k], rho);
                seen += out[n].mass * out[n].k;
                n++;
            }
    return n;
}

/* The shares with the least variance of k/k~, by Newton's method along the line of the right area. Where that decides
 * nothing, as for a needle, a small term prefers the first, which changes less with rho. */
static shares best_shares(const ray *at, size_t count, shares before)
{
    const double least = 0.02, little = 1e-5, mostly = 0.9;
    double area = 0, near = 0, far = 0;
    for (size_t i = 0; i < count; i++) {
        area += at[i].mass * at[i].k;
        near += at[i].mass * at[i].near;
        far += at[i].mass * at[i].far;
    }
    if (!(area > 1e-30 && far > 1e-9 * near))
        return before;
    double low = fmin(least, 0.5 * area / near), high = area / near, b0 = fmin(fmax(before.b0, low), 0.9 * high);
    for (int step = 0; step < 8 && high - low > 1e-4 * high; step++) {
        double b1 = (area - b0 * near) / far, slope = little * near * (b0 * near / area - mostly);
        double curve = little * near * near / area;
        for (size_t i = 0; i < count; i++) {
            double drawn = b0 * at[i].near + b1 * at[i].far, ratio = at[i].k / drawn;
            double change = at[i].near - near / far * at[i].far, part = at[i].mass * ratio * ratio * change;
            slope -= part;
            curve += 2 * part * change / drawn;
        }
        if (slope > 0)
            high = b0;
        else
            low = b0;
        double next = b0 - slope / curve;
        b0 = next > low && next < high ? next : (low + high) / 2;
    }
    return (shares){b0, fmax((area - b0 * near) / far, least)};
}

/* Puts the shares of knot i; `area`: what is true there, for s = 1. */
static void put_shares(vndf_table_draft *t, unsigned i, shares b, double area, const vndf_laws *laws)
{
    double drawn = 0, rho = t->knot[i];
    for (unsigned k = i; k <= t->cells; k++)
        drawn += vndf_drawn_below(&laws->span[k], &laws->cell[k], rho, b.b0, b.b1).mass / PI;
    double factor = i > 0 && drawn > 0 && area > 1e-30 ? fmin(fmax(area / drawn, 0.5), 2) : 1;
    t->b0[i] = (float)(factor * b.b0);
    t->b1[i] = (float)(factor * b.b1);
}

/* grazing[i]: the integral of R f from cell i on. */
static void sum_grazing(const vndf_sight *sight, unsigned cells, double *grazing)
{
    double sum = 0;
    for (unsigned i = cells + 1; i-- > 0;) {
        for (size_t k = sight->first[i]; k < sight->first[i + 1]; k++)
            sum += sight->points.at[k].mass * sight->points.at[k].r;
        grazing[i] = sum;
    }
}

static void put_all_shares(vndf_draft *draft, const vndf_knot *knot, const double *grazing, ray *room)
{
    vndf_table_draft *t = &draft->table;
    shares b = {0.43, 0.57};
    for (unsigned i = 0; i <= t->cells; i++) {
        double rho = i ? t->knot[i] : 0.1 * (t->cells ? t->knot[1] : 1);
        b = best_shares(room, look(&draft->sight, t->cells, i, rho, grazing, room), b);
        put_shares(t, i, b, knot[i].area.below * (1 + rho), &draft->laws);
    }
}

/* ---- the whole ---- */

static void put_knots(vndf_table_draft *t, const vndf_knot *knot)
{
    for (unsigned i = 0; i <= t->cells; i++) {
        double rho = t->knot[i] = knot[i].r;
        t->area[i] = (float)(knot[i].area.below + rho / (1 + rho));
        t->slope[i] = (float)(1 - knot[i].area.turned - knot[i].area.along);
    }
}

/* What follows from the knots. */
static int fill(vndf_draft *draft, const vndf_profile *profile, const vndf_knot *knot)
{
    vndf_table_draft *t = &draft->table;
    if (!vndf_laws_from(&draft->laws, t) || !vndf_sight_from(&draft->sight, profile, &draft->laws))
        return 0;
    for (unsigned i = 0; i <= t->cells; i++)
        put_cell(draft, profile, i);
    vndf_laws_read(&draft->laws);
    double *grazing = malloc((t->cells + 1) * sizeof *grazing);
    ray *room = malloc((draft->sight.points.count + 1) * sizeof *room);
    int good = grazing && room;
    if (good) {
        sum_grazing(&draft->sight, t->cells, grazing);
        put_all_shares(draft, knot, grazing, room);
        vndf_laws_read(&draft->laws);
    }
    free(grazing);
    free(room);
    return good;
}

int vndf_draft_from(vndf_draft *draft, const vndf_radial *radial, unsigned count, unsigned moments)
{
    const vndf_profile *profile = radial->profile;
    vndf_knot *knot = malloc(count * sizeof *knot);
    *draft = (vndf_draft){.table = {.cells = count - 1,
                                    .moments = moments,
                                    .squarings = radial->squarings,
                                    .normalization = profile->normalization,
                                    .scale = profile->scale,
                                    .source = profile->description}};
    int good = knot && allocate(&draft->table);
    if (good) {
        vndf_radial_knots(radial, count, knot);
        put_knots(&draft->table, knot);
        good = fill(draft, profile, knot);
    }
    free(knot);
    return good;
}

void vndf_draft_free(vndf_draft *draft)
{
    free(draft->table.knot);
    vndf_laws_free(&draft->laws);
    vndf_sight_free(&draft->sight);
}
