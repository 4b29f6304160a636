/* What no size mends: the laws of the slope length with k~ in the place of k and nothing else wrong. With ever smaller
 * cells the distance of a table from D ends there. Above the horizon k~ begins at rho; below it has the best shares. */
#include <math.h>
#include <stdlib.h>

#include "fit/draft.h"

#define VNDF_KERNEL_DOUBLE
#include "kernel/one.h"

#include "kernel/rows.h"

#include "kernel/law.h"

static const double PI = 3.14159265358979323846;
static const double RHO_LEAST = 0x1p-20, RHO_MOST = 0x1p20; /* as certificates claim */

size_t vndf_rays_from(const vndf_strips *s, size_t from, size_t end, double rho, vndf_ray *out, double *sum)
{
    size_t count = 0;
    for (size_t k = 2 * from; k < 2 * end; k++) {
        double mass = s->at[k / 2].mass[k % 2], r = s->at[k / 2].r[k % 2], way = r - rho;
        if (!(way > 0 && mass > 0))
            continue;
        out[count] = (vndf_ray){mass * vndf_profile_kernel(r, rho), mass * way, mass * way * way / r};
        *sum += out[count++].k;
    }
    return count;
}

/* That is convex in the first share. */
void vndf_shares_best(const vndf_ray *at, size_t count, float *b0, float *b1)
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

/* ---- one direction ---- */

/* k is what is seen, near what is drawn. */
static double distance(const vndf_ray *at, size_t count)
{
    double all = 0, near = 0, miss = 0;
    for (size_t i = 0; i < count; i++) {
        all += at[i].k;
        near += at[i].near;
    }
    for (size_t i = 0; i < count && near > 0; i++)
        miss += fabs(at[i].k / all - at[i].near / near);
    return miss / 2;
}

typedef struct survey {
    vndf_strips strips;
    const float *terms;
    double least; /* what has to be seen below the horizon of a direction that counts, over its length */
    vndf_ray *ray;
    double worst[2]; /* above, below, */
    size_t where[2]; /* and at which edge */
} survey;

/* With ever closer knots the law of k~ begins in the middle of the eighth of an octave that rho is in. */
static double above(const survey *s, double rho)
{
    const double begin = of_bits((VNDF_RHO_FIRST + law_eighth(rho)) * (1 << 20) + (1 << 19));
    const int far = law_eighth(rho) == VNDF_RHO_PARTS - 1;
    size_t count = 2 * s->strips.count;
    for (size_t i = 0; i < count; i++) {
        const vndf_strip *strip = &s->strips.at[i / 2];
        double mass = PI * strip->mass[i % 2], r = strip->r[i % 2], y = r / rho;
        weights w = {s->terms[0], s->terms[1], s->terms[2], s->terms[3] / (y * y * y)};
        w = law_weights_at(w, 1, far || i + 2 >= count);
        s->ray[i] = (vndf_ray){mass, mass, 0};
        if (r > rho)
            s->ray[i].k += mass * vndf_profile_kernel(r, rho) / (PI * rho);
        if (r > begin)
            s->ray[i].near = mass * (w.w1 * y + w.w0 + (w.wq + w.w4) / y);
    }
    return distance(s->ray, count);
}

static double below(const survey *s, size_t edge, double rho)
{
    double all = 0;
    float b0 = 0, b1 = 0;
    size_t count = vndf_rays_from(&s->strips, edge, s->strips.count, rho, s->ray, &all);
    if (!(all > s->least * hypot(1, rho)))
        return 0;
    vndf_shares_best(s->ray, count, &b0, &b1);
    for (size_t i = 0; i < count; i++)
        s->ray[i].near = (double)b0 * s->ray[i].near + (double)b1 * s->ray[i].far;
    return distance(s->ray, count);
}

static void look_from(survey *s, int side, size_t edge)
{
    double rho = s->strips.at[edge].edge;
    double d = rho < RHO_LEAST || rho > RHO_MOST ? 0 : side ? below(s, edge, rho) : above(s, rho);
    if (d > s->worst[side]) {
        s->worst[side] = d;
        s->where[side] = edge;
    }
}

/* The largest from some edges, and from the neighbourhood of the worst. */
int vndf_floor_measure(vndf_floor *to, const vndf_profile *profile, unsigned moments)
{
    enum { EDGES = 24, LOOKS = 80 }; /* that a side costs */
    const float none = 0;
    survey s = {.terms = law_terms + 4 * (moments - 2),
                .least = vndf_profile_claimed(profile) * 2 * PI * profile->f1};
    int good = vndf_strips_from(&s.strips, profile, &none, 1, 0);
    size_t edges = s.strips.count;
    s.ray = good ? malloc(2 * edges * sizeof *s.ray) : NULL;
    for (int side = 0; s.ray && side < 2 && vndf_guard_spend(profile->guard, LOOKS * (double)edges); side++) {
        size_t step = edges / EDGES + 1;
        for (size_t i = step / 2; i < edges; i += step)
            look_from(&s, side, i);
        while ((step /= 2) > 0) {
            size_t at = s.where[side];
            look_from(&s, side, at > step ? at - step : 0);
            look_from(&s, side, at + step < edges ? at + step : edges - 1);
        }
    }
    *to = (vndf_floor){s.worst[0], fmax(s.worst[0], s.worst[1])};
    good = s.ray != NULL;
    free(s.ray);
    vndf_strips_free(&s.strips);
    return good;
}
