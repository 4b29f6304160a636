#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* ---- cells ---- */

/* Puts `group` points together to one, from index `first` on: rough distributions have more than sums need. */
static void thin(vndf_points *points, size_t first, size_t group)
{
    size_t n = first;
    for (size_t i = first; i < points->count; i += group) {
        vndf_point sum = {0, 0, 0, 0};
        for (size_t k = i; k < i + group && k < points->count; k++) {
            const vndf_point *p = &points->at[k];
            sum.r += p->mass * p->r;
            sum.mass += p->mass;
            sum.xi += p->width * p->xi;
            sum.width += p->width;
        }
        sum.r = sum.mass > 0 ? sum.r / sum.mass : points->at[i].r;
        sum.xi = sum.width > 0 ? sum.xi / sum.width : points->at[i].xi;
        points->at[n++] = sum;
    }
    points->count = n;
}

/* Far out, where less than this lies beyond, f/R^4 counts for nothing: products with it would be denormal, and slow. */
static const double FOURTH_LEAST = 1e-20;

static void drop_far_cubes(vndf_table_draft *t)
{
    double beyond = 0;
    for (unsigned i = t->cells; i > 0; i--) {
        beyond += (double)t->cubes[i] * t->m0[i];
        if (beyond > FOURTH_LEAST)
            return;
        t->cubes[i] = 0;
    }
}

/* Measures all cells between the knots of the table; writes their numbers if `put`. 0 if there is no memory. */
static int measure_cells(vndf_draft *draft, const vndf_profile *profile, int put)
{
    enum { MANY = 8000, GROUP_MOST = 5, FEW = 4 * VNDF_GAUSS };
    vndf_table_draft *t = &draft->table;
    size_t group = 1 + profile->count * VNDF_GAUSS / MANY;
    draft->first = malloc((t->cells + 2) * sizeof *draft->first);
    for (unsigned i = 0; draft->first && i <= t->cells; i++) {
        size_t first = draft->first[i] = draft->points.count;
        double end = i < t->cells ? (double)t->knot[i + 1] : HUGE_VAL;
        vndf_cell c = vndf_cell_measure(profile, t->knot[i], end, t->squarings, &draft->points, first);
        if (group > 1 && draft->points.count > first + FEW)
            thin(&draft->points, first, group < GROUP_MOST ? group : GROUP_MOST);
        draft->first[i + 1] = draft->points.count;
        if (!put)
            continue;
        t->g0[i] = (float)c.g0;
        t->g1[i] = (float)c.g1;
        t->m0[i] = (float)c.m0;
        t->m1[i] = (float)c.m1;
        t->m2[i] = (float)c.m2;
        t->cubes[i] = (float)c.cube;
    }
    if (put)
        drop_far_cubes(t);
    return draft->first && !draft->points.starved && vndf_laws_from(&draft->laws, t);
}

/* ---- shares below the horizon ---- */

/* A point that is seen from below: its f dR, the true kernel, and the two of which shares are drawn. */
typedef struct ray {
    double mass, k, near, far;
} ray;

typedef struct shares {
    double b0, b1;
} shares;

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

/* What is seen from rho in `cell` and beyond; returns how many rays. Far out, where next to nothing is added, they end.
 * grazing[i]: the integral of R f from cell i on. */
static size_t look(const vndf_draft *draft, unsigned cell, double rho, const double *grazing, ray *out)
{
    const double little = 1e-7;
    double seen = 0;
    size_t n = 0;
    for (unsigned i = cell; i <= draft->table.cells && !(grazing[i] < little * seen * rho); i++)
        for (size_t k = draft->first[i]; k < draft->first[i + 1]; k++) {
            double mass = draft->points.at[k].mass, y = draft->points.at[k].r / rho;
            if (!(y > 1))
                continue;
            out[n] = (ray){mass, vndf_profile_kernel(y), y - 1, (y - 1) * ((y - 1) / y)};
            seen += out[n].mass * out[n].k;
            n++;
        }
    return n;
}

/* Puts the shares of all knots, scaled so that the area that is drawn from there is the true one, knot[i].area. */
static void put_shares(vndf_draft *draft, const vndf_knot *knot, double *grazing, ray *room)
{
    vndf_table_draft *t = &draft->table;
    double sum = 0;
    for (unsigned i = t->cells + 1; i-- > 0; grazing[i] = sum)
        for (size_t k = draft->first[i]; k < draft->first[i + 1]; k++)
            sum += draft->points.at[k].mass * draft->points.at[k].r;
    shares b = {0.43, 0.57};
    for (unsigned i = 0; i <= t->cells; i++) {
        double rho = i ? t->knot[i] : 0.1 * (t->cells ? t->knot[1] : 1), drawn = 0, factor = 1;
        double area = knot[i].area.below * (1 + rho);
        b = best_shares(room, look(draft, i, rho, grazing, room), b);
        for (unsigned k = i; i > 0 && k <= t->cells; k++)
            drawn += vndf_drawn_below(&draft->laws.cell[k], rho, b.b0, b.b1).mass / PI;
        if (drawn > 0 && area > 1e-30)
            factor = fmin(fmax(area / drawn, 0.5), 2);
        t->b0[i] = (float)(factor * b.b0);
        t->b1[i] = (float)(factor * b.b1);
    }
}

/* ---- the whole ---- */

static int ascending(const void *a, const void *b)
{
    float x = ((const vndf_knot *)a)->r, y = ((const vndf_knot *)b)->r;
    return (x > y) - (x < y);
}

/* Eleven arrays in one block. */
static int allocate(vndf_table_draft *t)
{
    size_t n = t->cells + 1;
    float *block = calloc(11 * n, sizeof *block),
          **array[] = {&t->knot,  &t->g0, &t->g1, &t->m0,   &t->m1,   &t->m2,
                       &t->cubes, &t->b0, &t->b1, &t->area, &t->slope};
    for (int i = 0; block && i < 11; i++)
        *array[i] = block + (size_t)i * n;
    return block != NULL;
}

int vndf_draft_from(vndf_draft *draft, const vndf_knots *knots, unsigned count, unsigned moments)
{
    const vndf_profile *profile = knots->profile;
    *draft = (vndf_draft){.table = {.cells = count - 1,
                                    .moments = moments,
                                    .squarings = knots->squarings,
                                    .normalization = profile->normalization,
                                    .scale = profile->scale,
                                    .source = profile->description}};
    vndf_table_draft *t = &draft->table;
    vndf_knot *knot = malloc(count * sizeof *knot);
    double *grazing = malloc(count * sizeof *grazing);
    ray *room = NULL;
    if (knot && grazing && allocate(t)) {
        memcpy(knot, knots->knot, count * sizeof *knot);
        qsort(knot, count, sizeof *knot, ascending);
        for (unsigned i = 0; i < count; i++) {
            double rho = t->knot[i] = knot[i].r;
            t->area[i] = (float)(knot[i].area.below + rho / (1 + rho));
            t->slope[i] = (float)(1 - knot[i].area.turned - knot[i].area.along);
        }
        if (measure_cells(draft, profile, 1))
            room = malloc((draft->points.count + 1) * sizeof *room);
        if (room)
            put_shares(draft, knot, grazing, room);
    }
    int good = room != NULL;
    free(knot);
    free(grazing);
    free(room);
    return good;
}

int vndf_draft_of(vndf_draft *draft, const vndf_distribution *table, const vndf_profile *profile)
{
    memset(draft, 0, sizeof *draft);
    if (vndf_table_draft_of(table, &draft->table))
        return measure_cells(draft, profile, 0);
    draft->table.knot = NULL; /* it is still the table's own */
    return 0;
}

void vndf_draft_free(vndf_draft *draft)
{
    free(draft->table.knot);
    vndf_laws_free(&draft->laws);
    free(draft->points.at);
    free(draft->first);
}
