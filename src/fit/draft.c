/* From knots to the numbers of a table; and what none of these numbers mends. */
#include <math.h>
#include <stdlib.h>

#include "fit/draft.h"

#define VNDF_KERNEL_DOUBLE
#include "kernel/one.h"

#include "kernel/rows.h"

#include "kernel/law.h"

static const double PI = 3.14159265358979323846;

/* Far out, where less than this lies beyond, f/R^4 counts for nothing: products with it would be denormal, and slow. */
static const double FOURTH_LEAST = 1e-20;

static void put_cells(vndf_distribution *t, const vndf_strips *s, const vndf_profile *profile)
{
    double beyond = 0;
    for (unsigned i = (unsigned)t->cells + 1; i-- > 0;) {
        vndf_cell c = vndf_cell_measure(profile, s, s->first[i], s->first[i + 1], (unsigned)t->squarings);
        vndf_knot_numbers *k = vndf_knot_at(t, i);
        k->left = (float)c.g0;
        k->right = (float)c.g1;
        k->m0 = (float)c.m0;
        k->m1 = (float)c.m1;
        k->m2 = (float)c.m2;
        beyond += (double)(float)c.cube * k->m0;
        k->cube = t->moments == 4 && beyond > FOURTH_LEAST ? (float)c.cube : 0.0f;
    }
}

/* ---- shares below the horizon ---- */

/* What is seen from below at one point: the true kernel times f dR, and the two of which shares are drawn. */
typedef struct ray {
    double k, near, far;
} ray;

/* From rho on, in `cell` and beyond. Far out, where next to nothing is added, the rays end. grazing[i]: the integral of
 * R f from cell i on. Returns their number. */
static size_t cast(const vndf_strips *s, unsigned cell, unsigned cells, double rho, const double *grazing,
                   ray *out)
{
    const double little = 1e-7;
    double sum = 0;
    size_t count = 0;
    for (unsigned i = cell; i <= cells && !(grazing[i] < little * sum); i++)
        for (size_t k = 2 * s->first[i]; k < 2 * s->first[i + 1]; k++) {
            double mass = s->at[k / 2].mass[k % 2], r = s->at[k / 2].r[k % 2], way = r - rho;
            if (!(way > 0 && mass > 0))
                continue;
            out[count] = (ray){mass * vndf_profile_kernel(r, rho), mass * way, mass * way * way / r};
            sum += out[count++].k;
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

/* Puts the shares of all knots. */
static void put_shares(vndf_distribution *t, const vndf_strips *s, double *grazing, ray *room)
{
    unsigned cells = (unsigned)t->cells;
    float b0 = 0.43f, b1 = 0.57f;
    double sum = 0;
    for (unsigned i = cells + 1; i-- > 0; grazing[i] = sum)
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++)
            sum += s->at[k].along;
    for (unsigned i = 0; i <= cells; i++) {
        double rho = s->at[s->first[i ? i : 1]].edge * (i ? 1 : 0.1);
        put_best(room, cast(s, i, cells, rho, grazing, room), &b0, &b1);
        vndf_knot_at(t, i)->b0 = b0;
        vndf_knot_at(t, i)->b1 = b1;
    }
}

/* ---- what no size mends ---- */

/* The total variation from rho with cells that cost nothing: above the horizon by `terms`, which begin in the middle of
 * the eighth of an octave that rho is in; below it, without them, by the best shares. 0 where no more than `least` is
 * seen. */
static double floor_from(const vndf_strips *s, double rho, const float *terms, double least, ray *at)
{
    const double begin = of_bits((VNDF_RHO_FIRST + law_eighth(rho)) * (1 << 20) + (1 << 19)), grazing = 1;
    double all = 0, near = 0, miss = 0;
    float b0 = 0, b1 = 0;
    size_t count = terms ? 2 * s->count : cast(s, 0, 0, rho, &grazing, at);
    if (!terms)
        put_best(at, count, &b0, &b1);
    for (size_t i = 0; i < count; i++) {
        double mass = PI * s->at[i / 2].mass[i % 2], r = s->at[i / 2].r[i % 2], y = r / rho;
        if (terms)
            at[i] = (ray){r > rho ? mass + mass * vndf_profile_kernel(r, rho) / (PI * rho) : mass, mass, 0};
        if (terms && r > begin)
            at[i].near *= terms[0] * y + terms[1] + terms[2] / y + terms[3] / (y * y * y * y);
        if (!terms)
            at[i].near = (double)b0 * at[i].near + (double)b1 * at[i].far;
        all += at[i].k;
        near += at[i].near;
    }
    for (size_t i = 0; i < count && all > least; i++)
        miss += fabs(at[i].k / all - at[i].near / near);
    return miss / 2;
}

/* The largest from some edges, and from the neighbourhood of the worst. */
int vndf_floor_measure(vndf_certificate *to, const vndf_profile *profile, unsigned moments)
{
    enum { EDGES = 24, LOOKS = 80 }; /* that a side costs */
    const double claimed = vndf_profile_claimed(profile) * 2 * PI * profile->f1, rho_least = 0x1p-20,
                 rho_most = 0x1p14;
    const float none = 0;
    double worst[2] = {0, 0};
    vndf_strips s;
    int good = vndf_strips_from(&s, profile, &none, 1, 0);
    ray *rays = good ? malloc(2 * s.count * sizeof *rays) : NULL;
    for (int side = 0; rays && side < 2 && vndf_guard_spend(profile->guard, LOOKS * (double)s.count); side++)
        for (size_t step = s.count / EDGES + 1, from = 0, end = s.count, best = 0; step > 0; step /= 2) {
            for (size_t i = from; i < end; i += step) {
                double rho = s.at[i].edge, d = 0;
                if (rho > rho_least && rho < rho_most)
                    d = floor_from(&s, rho, side ? NULL : law_terms + 4 * (moments - 2), claimed * hypot(1, rho),
                                   rays);
                best = d > worst[side] ? i : best;
                worst[side] = fmax(worst[side], d);
            }
            from = best - (best < step / 2 ? best : step / 2);
            end = best + step / 2 + 1 < s.count ? best + step / 2 + 1 : s.count;
        }
    to->floor_above = (float)worst[0];
    to->floor = (float)fmax(worst[0], worst[1]);
    good = rays != NULL;
    free(rays);
    vndf_strips_free(&s);
    return good;
}

/* ---- the whole ---- */

vndf_distribution *vndf_draft_from(vndf_knots *knots, unsigned moments)
{
    const vndf_profile *profile = knots->profile;
    unsigned count = knots->count;
    vndf_strips strips = {0, NULL, NULL};
    vndf_distribution *t = vndf_table_allocate(count - 1, moments, knots->squarings);
    double *grazing = malloc(count * sizeof *grazing);
    float *knot = malloc(count * sizeof *knot);
    ray *rays = NULL;
    if (t && grazing && knot) {
        t->normalization = profile->normalization;
        t->scale = profile->scale;
        for (unsigned i = 0; i < count; i++) {
            const vndf_area *area = vndf_knots_area(knots, knots->at[i]);
            vndf_knot_numbers *k = vndf_knot_at(t, i);
            k->r = knot[i] = (float)knots->strips.at[knots->at[i]].edge;
            k->area = (float)(area->below + (double)k->r / (1 + (double)k->r));
            k->slope = (float)(1 - area->turned - area->along);
        }
        if (vndf_strips_from(&strips, profile, knot, count, count - 1))
            rays = malloc(2 * strips.count * sizeof *rays);
    }
    if (rays) {
        put_cells(t, &strips, profile);
        put_shares(t, &strips, grazing, rays);
    } else {
        vndf_free(t);
        t = NULL;
    }
    free(grazing);
    free(knot);
    free(rays);
    vndf_strips_free(&strips);
    return t;
}
