#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* ---- cells ---- */

/* Far out, where less than this lies beyond, f/R^4 counts for nothing: products with it would be denormal, and slow. */
static const double FOURTH_LEAST = 1e-20;

/* Looks at the profile between the knots of the table; writes the numbers of all cells if `put`. 0 if there is no
 * memory. */
static int measure_cells(vndf_draft *draft, const vndf_profile *profile, int put)
{
    vndf_table_draft *t = &draft->table;
    vndf_strips *s = &draft->strips;
    draft->first = malloc((t->cells + 2) * sizeof *draft->first);
    draft->cell = malloc((t->cells + 1) * sizeof *draft->cell);
    if (!draft->first || !draft->cell || !vndf_strips_from(s, profile, t->knot, t->cells + 1, t->cells))
        return 0;
    for (unsigned i = 0; i <= t->cells; i++)
        draft->first[i] = vndf_strips_edge(s, t->knot[i]);
    draft->first[t->cells + 1] = s->count;
    for (unsigned i = 0; put && i <= t->cells; i++) {
        vndf_cell c = vndf_cell_measure(profile, s, draft->first[i], draft->first[i + 1], t->squarings);
        t->g0[i] = (float)c.g0;
        t->g1[i] = (float)c.g1;
        t->m0[i] = (float)c.m0;
        t->m1[i] = (float)c.m1;
        t->m2[i] = (float)c.m2;
        t->cubes[i] = (float)c.cube;
    }
    double beyond = 0;
    for (unsigned i = t->cells; put && i > 0 && beyond <= FOURTH_LEAST; i--) {
        beyond += (double)t->cubes[i] * t->m0[i];
        t->cubes[i] = beyond > FOURTH_LEAST ? t->cubes[i] : 0;
    }
    for (unsigned i = 0; i <= t->cells; i++)
        draft->cell[i] = vndf_cell_of(t, i);
    return 1;
}

/* ---- shares below the horizon ---- */

/* What is seen from below at one point: the true kernel times f dR, and the two of which shares are drawn. */
typedef struct ray {
    double k, near, far;
} ray;

/* From rho on, in `cell` and beyond. Far out, where next to nothing is added, the rays end. grazing[i]: the integral of
 * R f from cell i on. Returns their number. */
static size_t look(const vndf_draft *draft, unsigned cell, double rho, const double *grazing, ray *out)
{
    const double little = 1e-7;
    const vndf_strips *s = &draft->strips;
    double seen = 0;
    size_t count = 0;
    for (unsigned i = cell; i <= draft->table.cells && !(grazing[i] < little * seen); i++)
        for (size_t k = 2 * draft->first[i]; k < 2 * draft->first[i + 1]; k++) {
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
static void put_shares(vndf_draft *draft, const double *below, double *grazing, ray *room)
{
    vndf_table_draft *t = &draft->table;
    double sum = 0;
    for (unsigned i = t->cells + 1; i-- > 0; grazing[i] = sum)
        for (size_t k = draft->first[i]; k < draft->first[i + 1]; k++)
            sum += draft->strips.at[k].along;
    for (unsigned i = 0; i <= t->cells; i++) {
        double rho = i ? t->knot[i] : 0.1 * (t->cells ? t->knot[1] : 1), drawn = 0, factor = 1;
        double area = below[i] * (1 + rho);
        t->b0[i] = i ? t->b0[i - 1] : 0.43f;
        t->b1[i] = i ? t->b1[i - 1] : 0.57f;
        put_best(room, look(draft, i, rho, grazing, room), &t->b0[i], &t->b1[i]);
        for (unsigned k = i; i > 0 && k <= t->cells; k++)
            drawn += vndf_drawn_below(&draft->cell[k], rho, t->b0[i], t->b1[i]).mass / PI;
        if (drawn > 0 && area > 1e-30)
            factor = fmin(fmax(area / drawn, 0.5), 2);
        t->b0[i] *= (float)factor;
        t->b1[i] *= (float)factor;
    }
}

/* ---- the whole ---- */

int vndf_draft_from(vndf_draft *draft, vndf_knots *knots, unsigned moments)
{
    const vndf_profile *profile = knots->profile;
    unsigned count = knots->count;
    *draft = (vndf_draft){.table = {.cells = count - 1,
                                    .moments = moments,
                                    .squarings = knots->squarings,
                                    .normalization = profile->normalization,
                                    .scale = profile->scale,
                                    .source = profile->description}};
    vndf_table_draft *t = &draft->table;
    double *room = malloc(2 * count * sizeof *room), *below = room, *grazing = room + count;
    ray *rays = NULL;
    if (room && vndf_table_draft_allocate(t)) {
        for (unsigned i = 0; i < count; i++) {
            const vndf_area *area = vndf_knots_area(knots, knots->at[i]);
            double rho = t->knot[i] = vndf_knots_slope(knots, i);
            t->area[i] = (float)(area->below + rho / (1 + rho));
            t->slope[i] = (float)(1 - area->turned - area->along);
            below[i] = area->below;
        }
        rays = measure_cells(draft, profile, 1) ? malloc(2 * draft->strips.count * sizeof *rays) : NULL;
    }
    int good = rays != NULL;
    if (good)
        put_shares(draft, below, grazing, rays);
    free(room);
    free(rays);
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
    free(draft->cell);
    vndf_strips_free(&draft->strips);
    free(draft->first);
}
