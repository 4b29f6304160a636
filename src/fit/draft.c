/* From knots to the numbers of a table. */
#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* Far out, where less than this lies beyond, f/R^4 counts for nothing: products with it would be denormal, and slow. */
static const double FOURTH_LEAST = 1e-20;

static void put_cells(vndf_distribution *t, const vndf_strips *s, const vndf_profile *profile)
{
    double beyond = 0;
    for (unsigned i = (unsigned)t->cells + 1; i-- > 0;) {
        vndf_cell c = vndf_cell_measure(profile, s, s->first[i], s->first[i + 1], (unsigned)t->squarings);
        float *law = vndf_table_row(t, VNDF_LAW, i), *more = vndf_table_row(t, VNDF_MORE, i);
        law[0] = (float)c.g0;
        law[1] = (float)c.g1;
        law[2] = (float)c.m0;
        law[3] = (float)c.m1;
        more[0] = (float)c.m2;
        beyond += (double)(float)c.cube * law[2];
        more[1] = t->moments == 4 && beyond > FOURTH_LEAST ? (float)c.cube : 0.0f;
    }
}

/* ---- shares below the horizon ---- */

/* From rho on, in `cell` and beyond. Far out, where next to nothing is added, the rays end. grazing[i]: the integral of
 * R f from cell i on. Returns their number. */
static size_t look(const vndf_strips *s, unsigned cell, unsigned cells, double rho, const double *grazing,
                   vndf_ray *out)
{
    const double little = 1e-7;
    double seen = 0;
    size_t count = 0;
    for (unsigned i = cell; i <= cells && !(grazing[i] < little * seen); i++)
        count += vndf_rays_from(s, s->first[i], s->first[i + 1], rho, out + count, &seen);
    return count;
}

/* Puts the shares of all knots, scaled so that the area that is drawn from there is the true one, below[i]. */
static void put_shares(vndf_distribution *t, const vndf_strips *s, const double *below, double *grazing,
                       vndf_cell *cell, vndf_ray *room)
{
    unsigned cells = (unsigned)t->cells;
    float b0 = 0.43f, b1 = 0.57f;
    double sum = 0;
    for (unsigned i = cells + 1; i-- > 0; grazing[i] = sum) {
        const float *knot = vndf_table_row(t, VNDF_KNOT, i), *law = vndf_table_row(t, VNDF_LAW, i);
        cell[i] =
            vndf_cell_between(knot[0], i < cells ? (double)knot[VNDF_STRIDE] : HUGE_VAL, (unsigned)t->squarings);
        cell[i].g0 = law[0];
        cell[i].g1 = law[1];
        cell[i].m0 = law[2];
        cell[i].m1 = law[3];
        cell[i].m2 = vndf_table_row(t, VNDF_MORE, i)[0];
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++)
            sum += s->at[k].along;
    }
    for (unsigned i = 0; i <= cells; i++) {
        float *shares = vndf_table_row(t, VNDF_MORE, i) + 2;
        double rho = i ? cell[i].r : 0.1 * cell[1].r, drawn = 0, factor = 1, area = below[i] * (1 + rho);
        vndf_shares_best(room, look(s, i, cells, rho, grazing, room), &b0, &b1);
        for (unsigned k = i; i > 0 && k <= cells; k++)
            drawn += vndf_drawn_below(&cell[k], rho, b0, b1).mass / PI;
        if (drawn > 0 && area > 1e-30)
            factor = fmin(fmax(area / drawn, 0.5), 2);
        b0 = shares[0] = b0 * (float)factor;
        b1 = shares[1] = b1 * (float)factor;
    }
}

/* ---- the whole ---- */

vndf_distribution *vndf_draft_from(vndf_knots *knots, unsigned moments)
{
    const vndf_profile *profile = knots->profile;
    unsigned count = knots->count;
    vndf_strips strips = {0, NULL, NULL};
    vndf_distribution *t = vndf_table_allocate(count - 1, moments, knots->squarings);
    double *room = malloc(2 * count * sizeof *room), *below = room, *grazing = room + count;
    float *knot = malloc(count * sizeof *knot);
    vndf_cell *cell = malloc(count * sizeof *cell);
    vndf_ray *rays = NULL;
    if (t && room && knot && cell) {
        t->normalization = profile->normalization;
        t->scale = profile->scale;
        for (unsigned i = 0; i < count; i++) {
            const vndf_area *area = vndf_knots_area(knots, knots->at[i]);
            float *low = vndf_table_row(t, VNDF_LOW, i), r = knot[i] = vndf_knots_slope(knots, i);
            vndf_table_row(t, VNDF_KNOT, i)[0] = r;
            low[2] = (float)(area->below + (double)r / (1 + (double)r));
            low[3] = (float)(1 - area->turned - area->along);
            below[i] = area->below;
        }
        if (vndf_strips_from(&strips, profile, knot, count, count - 1))
            rays = malloc(2 * strips.count * sizeof *rays);
    }
    if (rays) {
        put_cells(t, &strips, profile);
        put_shares(t, &strips, below, grazing, cell, rays);
    } else {
        vndf_free(t);
        t = NULL;
    }
    free(room);
    free(knot);
    free(cell);
    free(rays);
    vndf_strips_free(&strips);
    return t;
}
