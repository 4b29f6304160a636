/* Projected areas of a resolved profile. With y = R/rho, rho = c/s, and v = sqrt(y^2 - 1) the direction (s, 0, -c) sees
 *     2 integral_rho^inf P R (s R v/y - c acos(1/y)) dR = 2 c integral P R (v - atan v) dR
 * and the derivatives by -c and s are the integrals of acos(1/y) and R v/y. Beyond some octaves the kernels are
 * series of 1/y, and the integrals sums of moments. */
#include <math.h>

#include "fit/profile/profile.h"
#include "math/ascending.h"

static const double HALF_PI = 1.57079632679489661923;

/* y from which on three terms are enough: they err by 1e-9. */
static const double FAR = 16;

static const double KERNEL_OPERATIONS = 2; /* of one point: a root and an arc tangent */

/* What adds less than this part to a sum is taken as if it were far out, which errs by a tenth of it. */
static const double LITTLE = 1e-10;

/* Adds P r dr = weight at r: the three integrals over rho, 1 and 1. */
static void add_point(vndf_area *sum, double r, double rho, double weight)
{
    sum->below += weight * vndf_profile_kernel(r, rho);
    sum->turned += weight * acos(rho / r);
    sum->along += weight * sqrt((r - rho) * (r + rho));
}

/* integral over R in [from, to], rho <= from < to, within a panel: by t with R = rho + t^2 where the root shows. One
 * rule for an octave that begins at rho would err by 4e-6 where P falls as exp(-3 R). */
static void add_near(vndf_area *sum, const vndf_profile *profile, double rho, double from, double to)
{
    const double ratio = 1.15;
    for (double end; from < to; from = end) {
        end = ratio * from < to ? ratio * from : to;
        double t0 = sqrt(from - rho), dt = sqrt(end - rho) - t0, t[VNDF_GAUSS], r[VNDF_GAUSS], p22[VNDF_GAUSS];
        for (int i = 0; i < VNDF_GAUSS; i++) {
            t[i] = t0 + dt * vndf_gauss_node[i];
            r[i] = rho + t[i] * t[i];
        }
        vndf_profile_p22_many(profile, r, VNDF_GAUSS, p22);
        for (int i = 0; i < VNDF_GAUSS; i++)
            add_point(sum, r[i], rho, vndf_gauss_weight[i] * 2 * t[i] * dt * r[i] * p22[i]);
    }
}

/* What lies beyond the inner edge of a panel that is far out, or beyond all. */
static void add_far(vndf_area *sum, const vndf_panel *p, double rho)
{
    double t1 = p->s + p->r * p->t0, square = rho * rho;
    sum->below += fmax(t1 - HALF_PI * rho * p->t0, 0) + square * p->less / 2 + square * square * p->least / 24;
    sum->turned += HALF_PI * p->t0 - rho * p->less - rho * square * p->least / 6;
    sum->along += t1 - square * p->less / 2 - square * square * p->least / 8;
}

/* Adds a panel, anew near rho, or several that are slim together beside their distance, by their mean slope, which errs
 * by 1e-6 of them; returns the next. */
static size_t add_panels(vndf_area *sum, const vndf_profile *profile, size_t i, double rho)
{
    const double slim = 0.01,
                 near = 0.3; /* nearer than this part of a panel's width ten points err by over 1e-9 */
    const vndf_panel *p = &profile->panel[i], *end = p + 1;
    const vndf_profile_point *point = p->point;
    double most = p->r + slim * (p->r - rho), m0 = p->m0, m1 = p->m1;
    if (p->r - rho < near * (p[1].r - p->r))
        add_near(sum, profile, rho, fmax(p->r, rho), end->r);
    else if (end->r < most) {
        for (; end < profile->panel + profile->count && end[1].r < most; end++) {
            m0 += end->m0;
            m1 += end->m1 + (end->r - p->r) * end->m0;
        }
        if (m0 > 0)
            add_point(sum, p->r + m1 / m0, rho, m0);
    } else
        for (int k = 0; k < VNDF_GAUSS; k++)
            add_point(sum, point[k].r, rho, point[k].weight);
    return (size_t)(end - profile->panel);
}

vndf_area vndf_profile_below(const vndf_profile *profile, double s, double c)
{
    vndf_area sum = {0.0, 0.0, 0.0};
    double rho = c / s;
    const vndf_panel *p = profile->panel;
    size_t count = profile->count, i = vndf_last_before(&p->r, sizeof *p, count, rho), first = i;
    if (rho >= p[count].r)
        return sum;
    for (; i < count && p[i].r < FAR * rho && !(2 * (p[i].s + p[i].r * p[i].t0) < LITTLE * sum.below);)
        i = add_panels(&sum, profile, i, rho);
    add_far(&sum, &p[i], rho);
    vndf_guard_spend(profile->guard, KERNEL_OPERATIONS * VNDF_GAUSS * (double)(i - first + 1));
    sum.below *= 2 * s;
    sum.turned *= 2;
    sum.along *= 2;
    return sum;
}

double vndf_profile_claimed(const vndf_profile *profile)
{
    return 1e-10 * fmin(fmax(profile->scale, 1e-4), 1.0);
}
