/* Integrals of a resolved profile: cells, the two wedge functions, and projected areas.
 *
 * Areas of half a turn for the direction (s, c) with k = |c|/s are 1D integrals of P with kernels in
 * y = sqrt((R/k)^2 - 1), R > k (integrate the azimuth first):
 *     below   s integral P R k (y - atan y) dR
 *     above   s [ integral_0^k P R (k pi/2 - R) dR + integral_k^inf P R (k atan(1/y) - k/(sqrt(1+y^2) + y)) dR ]
 * each without a difference of large terms. */
#include <math.h>

#include "core/inline.h"
#include "fit/profile/profile.h"

static const double HALF_PI = 1.57079632679489661923;

/* y - atan y: at this y the series has a relative error of 1e-11, the difference of 1e-13. */
static const double SERIES_MOST = 0.05;

static const double KERNEL_OPERATIONS = 2; /* of one point: a root and an arc tangent */

/* The panel of R: r_i <= R < r_(i+1), the ends extended. */
static size_t panel_of(const vndf_profile *profile, double r)
{
    size_t low = 0, high = profile->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (profile->panel[middle].r <= r)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* integral over [a, b] inside a panel of P r dr and P r (r - a) dr. */
static vndf_moments part(const vndf_profile *profile, double a, double b)
{
    double u0 = log(a), du = log(b / a), r[VNDF_GAUSS], p22[VNDF_GAUSS];
    vndf_moments sum = {0.0, 0.0};
    if (!(b > a))
        return sum;
    for (int i = 0; i < VNDF_GAUSS; i++)
        r[i] = exp(u0 + du * vndf_gauss_node[i]);
    vndf_profile_p22_many(profile, r, VNDF_GAUSS, p22);
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double w = vndf_gauss_weight[i] * du * r[i] * r[i] * p22[i];
        sum.m0 += w;
        sum.m1 += w * (r[i] - a);
    }
    return sum;
}

static void add(vndf_moments *sum, double a, vndf_moments more, double from)
{
    sum->m0 += more.m0;
    sum->m1 += more.m1 + more.m0 * (from - a);
}

vndf_moments vndf_profile_moments(const vndf_profile *profile, double a, double b)
{
    const vndf_panel *p = profile->panel;
    double first = p[0].r, last = p[profile->count].r, from = a > first ? a : first, to = b < last ? b : last;
    vndf_moments sum = {0.0, 0.0}, tail = {profile->tail_m0, profile->tail_m1};
    if (b > last)
        add(&sum, a, tail, last);
    if (!(to > from))
        return sum;
    size_t i = panel_of(profile, from), end = panel_of(profile, to);
    if (i == end) {
        add(&sum, a, part(profile, from, to), from);
        return sum;
    }
    add(&sum, a, part(profile, from, p[i + 1].r), from);
    for (i++; i < end; i++) {
        vndf_moments whole = {p[i].m0, p[i].m1};
        add(&sum, a, whole, p[i].r);
    }
    add(&sum, a, part(profile, p[end].r, to), p[end].r);
    return sum;
}

/* Less than this part of a sum changes no bit of it. */
static const double LOST = 0x1p-55;

double vndf_profile_e(const vndf_profile *profile, double rho)
{
    const vndf_panel *p = &profile->panel[panel_of(profile, rho)];
    if (rho >= profile->panel[profile->count].r)
        return profile->f0;
    if (rho <= p->r)
        return 0.0;
    double inside = p->e + p->f1 * (1 / p->r - 1 / rho);
    if (p->m0 < LOST * inside)
        return inside;
    vndf_moments in = part(profile, p->r, rho);
    return inside + ((rho - p->r) * in.m0 - in.m1) / rho;
}

double vndf_profile_s(const vndf_profile *profile, double rho)
{
    const vndf_panel *p = &profile->panel[panel_of(profile, rho)], *end = &profile->panel[profile->count];
    if (rho >= end->r)
        return profile->tail_m1 * end->r / rho; /* or a little more: no panel resolves it */
    double from = rho > p->r ? rho : p->r;
    double inside = p[1].s + p[1].t0 * (p[1].r - from);
    if (!(p->m0 * (p[1].r - p->r) < LOST * inside))
        inside += part(profile, from, p[1].r).m1;
    return inside + (from > rho ? p->t0 * (from - rho) : 0.0);
}

/* Kernels at R > k: of the two areas over s, of their first derivatives by y (see profile.h), and of the second
 * derivatives times s^3. */
typedef struct kernel {
    double mass, slope, curve;
} kernel;

/* What is asked of the kernels; compilers make a function of each. */
typedef struct kernels {
    int above; /* the horizon */
    int all;   /* 0: the mass alone */
} kernels;

VNDF_INLINE kernel kernel_below(double r, double k, int all)
{
    double q = r / k, y = sqrt((q - 1.0) * (q + 1.0)), angle = atan(y);
    kernel value = {k * (y - angle), 0.0, 0.0};
    if (y < SERIES_MOST)
        value.mass = k * (y * y * y * (1.0 / 3 - y * y * (1.0 / 5 - y * y * (1.0 / 7 - y * y / 9))));
    if (all) {
        value.slope = angle + k * y;
        value.curve = 1.0 / (k * y);
    }
    return value;
}

VNDF_INLINE kernel kernel_above(double r, double k, int all)
{
    double q = r / k, y = sqrt((q - 1.0) * (q + 1.0)), angle = atan2(1.0, y), rest = 1.0 / (q + y);
    kernel value = {k * (angle - rest), 0.0, 0.0};
    if (all) {
        value.slope = angle + k * rest;
        value.curve = 1.0 / (k * y);
    }
    return value;
}

/* Adds the kernel at r, weighted. */
VNDF_INLINE void add_kernel_at(kernel *sum, double r, double k, double weight, kernels of)
{
    kernel value = of.above ? kernel_above(r, k, of.all) : kernel_below(r, k, of.all);
    sum->mass += weight * value.mass;
    if (of.all) {
        sum->slope += weight * value.slope;
        sum->curve += weight * value.curve;
    }
}

/* integral over R in [from, to] of a kernel times P R dR, k <= from < to within one panel: R = k + t^2. */
VNDF_INLINE kernel near_panel(const vndf_profile *profile, double k, double from, double to, kernels of)
{
    double t0 = sqrt(from - k), dt = sqrt(to - k) - t0, t[VNDF_GAUSS], r[VNDF_GAUSS], p22[VNDF_GAUSS];
    kernel sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < VNDF_GAUSS; i++) {
        t[i] = t0 + dt * vndf_gauss_node[i];
        r[i] = k + t[i] * t[i];
    }
    vndf_profile_p22_many(profile, r, VNDF_GAUSS, p22);
    for (int i = 0; i < VNDF_GAUSS; i++)
        add_kernel_at(&sum, r[i], k, vndf_gauss_weight[i] * 2 * t[i] * dt * r[i] * p22[i], of);
    return sum;
}

static void add_kernel(kernel *sum, kernel more)
{
    sum->mass += more.mass;
    sum->slope += more.slope;
    sum->curve += more.curve;
}

/* The same for a range of any length, in steps whose ratio keeps the error of the rule below 1e-9. One panel of an
 * octave that begins at k would err in t by 4e-6 where P falls as exp(-3 R). */
VNDF_INLINE kernel near_panels(const vndf_profile *profile, double k, double from, double to, kernels of)
{
    const double ratio = 1.15;
    kernel sum = {0.0, 0.0, 0.0};
    for (double end; from < to; from = end) {
        end = ratio * from < to ? ratio * from : to;
        add_kernel(&sum, near_panel(profile, k, from, end, of));
    }
    return sum;
}

/* Whether all that lies beyond the inner edge of a panel, which is at 3 k or more, changes no bit of a sum: it is less
 * than half of the last digit. The kernels are at most R, pi/2 + R and 1/(2 k) there. */
VNDF_INLINE int is_lost(const vndf_panel *p, double k, const kernel *sum, int all)
{
    double first = 2 * (p->s + p->r * p->t0), none = 2 * p->t0;
    if (!all)
        return first < LOST * sum->mass;
    return first < LOST * sum->mass && HALF_PI * none + first < LOST * sum->slope &&
           none < LOST * 2 * k * sum->curve;
}

/* Integral from k outwards. Up to 3 k the root of the kernel shows, and the panels are integrated anew. */
VNDF_INLINE kernel beyond(const vndf_profile *profile, double k, kernels of)
{
    size_t i = panel_of(profile, k), count = profile->count;
    kernel sum = {0.0, 0.0, 0.0};
    if (!vndf_guard_spend(profile->guard, KERNEL_OPERATIONS * VNDF_GAUSS * (double)(count - i)))
        return sum;
    for (; i < count && profile->panel[i].r < 3 * k; i++) {
        double from = profile->panel[i].r > k ? profile->panel[i].r : k;
        if (profile->panel[i + 1].r > from)
            add_kernel(&sum, near_panels(profile, k, from, profile->panel[i + 1].r, of));
    }
    for (; i < count && !is_lost(&profile->panel[i], k, &sum, of.all); i++)
        for (size_t n = i * VNDF_GAUSS; n < (i + 1) * VNDF_GAUSS; n++)
            add_kernel_at(&sum, profile->point[n].r, k, profile->point[n].weight, of);
    return sum;
}

VNDF_INLINE vndf_area_value area_below(const vndf_profile *profile, double y, int all)
{
    vndf_area_value value = {0.0, 0.0, 0.0};
    if (y <= 0.0)
        return value;
    if (y >= 1.0) { /* the horizon: integral of cos a over a quarter is 1 */
        value.mass = profile->f1;
        value.slope = profile->f1 + profile->f0 * HALF_PI;
        return value;
    }
    double k = (1.0 - y) / y, end = profile->panel[profile->count].r;
    kernels below = {0, all};
    kernel sum = beyond(profile, k, below);
    if (k < end) { /* R beyond the panels: y - atan y is R/k - pi/2 there */
        double far = profile->tail_m1 + end * profile->tail_m0;
        sum.mass += fmax(far - k * HALF_PI * profile->tail_m0, 0.0);
        sum.slope += far + HALF_PI * profile->tail_m0;
    }
    value.mass = y * sum.mass;
    value.slope = sum.slope;
    value.curve = sum.curve / (y * y * y);
    return value;
}

VNDF_INLINE vndf_area_value area_above(const vndf_profile *profile, double y, int all)
{
    vndf_area_value value = {0.0, 0.0, 0.0};
    if (y <= 0.0)
        return value;
    if (y >= 1.0) {
        value.mass = profile->f0 * HALF_PI;
        value.slope = profile->f0 * HALF_PI + profile->f1;
        return value;
    }
    double s = 1.0 - y, k = y / s;
    const vndf_panel *p = &profile->panel[panel_of(profile, k)];
    kernel sum = {0.0, 0.0, 0.0};
    kernels above = {1, all};
    if (k > p->r && k < profile->panel[profile->count].r) {
        vndf_moments in = part(profile, p->r, k);
        double f0 = p->f0 + in.m0, f1 = p->f1 + in.m1 + p->r * in.m0;
        sum = beyond(profile, k, above);
        sum.mass += k * f0 * HALF_PI - f1;
        sum.slope += f0 * HALF_PI + f1;
    } else if (k > p->r) {
        sum.mass = k * profile->f0 * HALF_PI - profile->f1;
        sum.slope = profile->f0 * HALF_PI + profile->f1;
    } else
        sum = beyond(profile, k, above);
    value.mass = s * sum.mass;
    value.slope = sum.slope;
    value.curve = sum.curve / (s * s * s);
    return value;
}

vndf_area_value vndf_profile_area_below(const vndf_profile *profile, double y)
{
    return area_below(profile, y, 1);
}

vndf_area_value vndf_profile_area_above(const vndf_profile *profile, double y)
{
    return area_above(profile, y, 1);
}

double vndf_profile_mass_below(const vndf_profile *profile, double y)
{
    return area_below(profile, y, 0).mass;
}

double vndf_profile_mass_above(const vndf_profile *profile, double y)
{
    return area_above(profile, y, 0).mass;
}

/* A(w) - A(-w) = c: area_below gives the area of w or -w, whichever is below the horizon. */
double vndf_profile_area(const vndf_profile *profile, double s, double c)
{
    double sum = s + fabs(c);
    return 2 * sum * vndf_profile_mass_below(profile, s / sum) + (c > 0 ? c : 0);
}

double vndf_profile_seen(const vndf_profile *profile, double s, double c)
{
    return vndf_profile_area(profile, s, c) / (2 * profile->f1 * hypot(s, c));
}

double vndf_profile_claimed(const vndf_profile *profile)
{
    return 1e-10 * fmin(fmax(profile->scale, 1e-4), 1.0);
}

double vndf_profile_fade(const vndf_profile *profile, double seen, double power)
{
    return pow(seen, power) * fmin(1.0, seen / vndf_profile_claimed(profile));
}
