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

/* With ever closer knots the law of k~ begins in the middle of the eighth of an octave that rho is in. */
static double above(const vndf_strips *s, const float *terms, double rho, vndf_ray *ray)
{
    const double begin = of_bits((VNDF_RHO_FIRST + law_eighth(rho)) * (1 << 20) + (1 << 19));
    size_t count = 2 * s->count;
    for (size_t i = 0; i < count; i++) {
        double mass = PI * s->at[i / 2].mass[i % 2], r = s->at[i / 2].r[i % 2], y = r / rho;
        weights w = {terms[0], terms[1], terms[2], terms[3] / (y * y * y)};
        w = law_weights_at(w, 1, i / 2 == s->count - 1 || law_eighth(rho) == VNDF_RHO_PARTS - 1);
        ray[i] = (vndf_ray){mass, mass, 0};
        if (r > rho)
            ray[i].k += mass * vndf_profile_kernel(r, rho) / (PI * rho);
        if (r > begin)
            ray[i].near = mass * (w.w1 * y + w.w0 + (w.wq + w.w4) / y);
    }
    return distance(ray, count);
}

static double below(const vndf_strips *s, size_t edge, double least, vndf_ray *ray)
{
    double rho = s->at[edge].edge, all = 0;
    float b0 = 0, b1 = 0;
    size_t count = vndf_rays_from(s, edge, s->count, rho, ray, &all);
    if (!(all > least * hypot(1, rho)))
        return 0;
    vndf_shares_best(ray, count, &b0, &b1);
    for (size_t i = 0; i < count; i++)
        ray[i].near = (double)b0 * ray[i].near + (double)b1 * ray[i].far;
    return distance(ray, count);
}

/* ---- all directions ---- */

/* The largest over some edges, and over the neighbourhood of the worst. */
int vndf_floor_measure(vndf_floor *to, const vndf_profile *profile, unsigned moments)
{
    enum { EDGES = 24 };
    const float none = 0, *const terms = law_terms + 4 * (moments - 2);
    const double least = vndf_profile_claimed(profile) * 2 * PI * profile->f1;
    vndf_strips s;
    int good = vndf_strips_from(&s, profile, &none, 1, 0);
    vndf_ray *ray = good ? malloc(2 * s.count * sizeof *ray) : NULL;
    double worst[2] = {0, 0};
    for (int side = 0; ray && side < 2; side++) {
        size_t best = 0, step = s.count / EDGES + 1;
        for (size_t i = step / 2, from = 0, end = s.count; step > 0; step /= 2) {
            for (i = from; i < end; i += step) {
                double rho = s.at[i].edge, d = 0;
                if (rho >= RHO_LEAST && rho <= RHO_MOST && vndf_guard_spend(profile->guard, 4 * (double)s.count))
                    d = side ? below(&s, i, least, ray) : above(&s, terms, rho, ray);
                best = d > worst[side] ? i : best;
                worst[side] = fmax(worst[side], d);
            }
            from = best > step / 2 ? best - step / 2 : 0;
            end = best + step / 2 + 1 < s.count ? best + step / 2 + 1 : s.count;
        }
    }
    *to = (vndf_floor){worst[0], fmax(worst[0], worst[1])};
    free(ray);
    vndf_strips_free(&s);
    return ray != NULL;
}
