/* From knots to the numbers of a table. */
#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* Far out, where less than this lies beyond, f/R^4 counts for nothing: products with it would be denormal, and slow. */
static const double FOURTH_LEAST = 1e-20;

static void put_cells(vndf_table_draft *t, const vndf_knots *k)
{
    for (unsigned i = 0; i <= t->cells; i++) {
        vndf_cell c = vndf_cell_measure(k->profile, &k->strips, k->at[i], k->at[i + 1], t->squarings);
        t->g0[i] = (float)c.g0;
        t->g1[i] = (float)c.g1;
        t->m0[i] = (float)c.m0;
        t->m1[i] = (float)c.m1;
        t->m2[i] = (float)c.m2;
        t->cubes[i] = (float)c.cube;
    }
    double beyond = 0;
    for (unsigned i = t->cells; i > 0 && beyond <= FOURTH_LEAST; i--) {
        beyond += (double)t->cubes[i] * t->m0[i];
        t->cubes[i] = beyond > FOURTH_LEAST ? t->cubes[i] : 0;
    }
}

/* ---- shares below the horizon ---- */

/* What is seen from below at one point: the true kernel times f dR, and the two of which shares are drawn. */
typedef struct ray {
    double k, near, far;
} ray;

/* From rho on, at a knot or in the first cell, and beyond. Far out, where next to nothing is added, the rays end.
 * Returns their number. */
static size_t look(const vndf_knots *knots, unsigned cell, double rho, ray *out)
{
    const double little = 1e-7;
    const vndf_strip *at = knots->strips.at;
    double seen = 0;
    size_t count = 0;
    for (unsigned i = cell; i < knots->count && !(at[knots->at[i]].beyond[0] < little * seen); i++)
        for (size_t k = 2 * knots->at[i]; k < 2 * knots->at[i + 1]; k++) {
            double mass = at[k / 2].mass[k % 2], r = at[k / 2].r[k % 2], way = r - rho;
            if (!(way > 0 && mass > 0))
                continue;
            out[count] = (ray){mass * vndf_kernel_below(r, rho), mass * way, mass * way * way / r};
            seen += out[count++].k;
        }
    return count;
}

/* The shares with the least total variation among those of the right area: that is convex in the first share. */
static void put_best(const ray *at, size_t count, float *b0, float *b1)
{
    enum { STEPS = 20 };
    const double least = 0.02;
    double area = 0, near = 0, far = 0;
    for (size_t i = 0; i < count; i++) {
        area += at[i].k;
        near += at[i].near;
        far += at[i].far;
    }
    if (!(area > 1e-30 && far > 1e-9 * near))
        return;
    double low = 0, high = area / near, per = near / far;
    for (int step = 0; step < STEPS; step++) {
        double first = (low + high) / 2, second = (area - first * near) / far, slope = 0;
        for (size_t i = 0; i < count; i++) {
            double change = at[i].near - per * at[i].far;
            slope += first * at[i].near + second * at[i].far > at[i].k ? change : -change;
        }
        *(slope > 0 ? &high : &low) = first;
    }
    *b0 = (float)low;
    *b1 = (float)fmax((area - low * near) / far, least);
}

/* Puts the shares of all knots, scaled so that the area that is drawn from there is the true one. */
static void put_shares(vndf_table_draft *t, const vndf_knots *knots, vndf_cell *cell, ray *room)
{
    for (unsigned i = 0; i <= t->cells; i++)
        cell[i] = vndf_cell_of(t, i);
    for (unsigned i = 0; i <= t->cells; i++) {
        double rho = i ? t->knot[i] : 0.1 * (t->cells ? t->knot[1] : 1), drawn = 0, factor = 1;
        double area = knots->rim[knots->at[i]].area.below * (1 + rho);
        t->b0[i] = i ? t->b0[i - 1] : 0.43f;
        t->b1[i] = i ? t->b1[i - 1] : 0.57f;
        put_best(room, look(knots, i, rho, room), &t->b0[i], &t->b1[i]);
        for (unsigned k = i; i > 0 && k <= t->cells; k++)
            drawn += vndf_drawn_below(&cell[k], rho, t->b0[i], t->b1[i]).mass / PI;
        if (drawn > 0 && area > 1e-30)
            factor = fmin(fmax(area / drawn, 0.5), 2);
        t->b0[i] *= (float)factor;
        t->b1[i] *= (float)factor;
    }
}

/* ---- the whole ---- */

int vndf_draft_from(vndf_table_draft *t, vndf_knots *knots, unsigned moments)
{
    const vndf_profile *profile = knots->profile;
    unsigned count = knots->count;
    *t = (vndf_table_draft){.cells = count - 1,
                            .moments = moments,
                            .squarings = knots->squarings,
                            .normalization = profile->normalization,
                            .scale = profile->scale,
                            .source = profile->source->description};
    vndf_cell *cell = malloc(count * sizeof *cell);
    ray *rays = malloc(2 * knots->strips.count * sizeof *rays);
    int good = cell && rays && vndf_table_draft_allocate(t);
    for (unsigned i = 0; good && i < count; i++) {
        const vndf_area *area = vndf_knots_area(knots, knots->at[i]);
        double rho = knots->strips.at[knots->at[i]].edge;
        t->knot[i] = (float)rho;
        t->area[i] = (float)(area->below + rho / (1 + rho));
        t->slope[i] = (float)(1 - area->turned - area->along);
    }
    if (good) {
        put_cells(t, knots);
        put_shares(t, knots, cell, rays);
    }
    free(cell);
    free(rays);
    return good;
}
