/* From knots to the numbers of a table. */
#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* Far out, where less than this lies beyond, f/R^4 counts for nothing: products with it would be denormal, and slow. */
static const double FOURTH_LEAST = 1e-20;

static void put_cells(vndf_table_draft *t, const vndf_strips *s, const vndf_profile *profile)
{
    for (unsigned i = 0; i <= t->cells; i++) {
        vndf_cell c = vndf_cell_measure(profile, s, s->first[i], s->first[i + 1], t->squarings);
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

/* From rho on, in `cell` and beyond. Far out, where next to nothing is added, the rays end. grazing[i]: the integral of
 * R f from cell i on. Returns their number. */
static size_t look(const vndf_strips *s, unsigned cell, unsigned cells, double rho, const double *grazing,
                   ray *out)
{
    const double little = 1e-7;
    double seen = 0;
    size_t count = 0;
    for (unsigned i = cell; i <= cells && !(grazing[i] < little * seen); i++)
        for (size_t k = 2 * s->first[i]; k < 2 * s->first[i + 1]; k++) {
            double mass = s->at[k / 2].mass[k % 2], r = s->at[k / 2].r[k % 2], way = r - rho;
            if (!(way > 0 && mass > 0))
                continue;
            out[count] = (ray){mass * vndf_profile_kernel(r, rho), mass * way, mass * way * way / r};
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

/* Puts the shares of all knots, scaled so that the area that is drawn from there is the true one, below[i]. */
static void put_shares(vndf_table_draft *t, const vndf_strips *s, const double *below, double *grazing,
                       vndf_cell *cell, ray *room)
{
    double sum = 0;
    for (unsigned i = t->cells + 1; i-- > 0; grazing[i] = sum) {
        cell[i] = vndf_cell_of(t, i);
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++)
            sum += s->at[k].along;
    }
    for (unsigned i = 0; i <= t->cells; i++) {
        double rho = i ? t->knot[i] : 0.1 * (t->cells ? t->knot[1] : 1), drawn = 0, factor = 1;
        double area = below[i] * (1 + rho);
        t->b0[i] = i ? t->b0[i - 1] : 0.43f;
        t->b1[i] = i ? t->b1[i - 1] : 0.57f;
        put_best(room, look(s, i, t->cells, rho, grazing, room), &t->b0[i], &t->b1[i]);
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
    vndf_strips strips = {0, NULL, NULL};
    *t = (vndf_table_draft){.cells = count - 1,
                            .moments = moments,
                            .squarings = knots->squarings,
                            .normalization = profile->normalization,
                            .scale = profile->scale,
                            .source = profile->source->description};
    double *room = malloc(2 * count * sizeof *room), *below = room, *grazing = room + count;
    vndf_cell *cell = malloc(count * sizeof *cell);
    ray *rays = NULL;
    if (room && cell && vndf_table_draft_allocate(t)) {
        for (unsigned i = 0; i < count; i++) {
            const vndf_area *area = vndf_knots_area(knots, knots->at[i]);
            double rho = t->knot[i] = vndf_knots_slope(knots, i);
            t->area[i] = (float)(area->below + rho / (1 + rho));
            t->slope[i] = (float)(1 - area->turned - area->along);
            below[i] = area->below;
        }
        if (vndf_strips_from(&strips, profile, t->knot, count, t->cells))
            rays = malloc(2 * strips.count * sizeof *rays);
    }
    int good = rays != NULL;
    if (good) {
        put_cells(t, &strips, profile);
        put_shares(t, &strips, below, grazing, cell, rays);
    }
    free(room);
    free(cell);
    free(rays);
    vndf_strips_free(&strips);
    return good;
}
