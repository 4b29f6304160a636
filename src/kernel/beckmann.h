/* Beckmann in the unit problem: w = (vx, vy, vz) is the stretched direction as in ggx.h, s and c its parts across and
 * along z; the slopes, P22 = exp(-x^2 - y^2)/pi weighted by (c - s x)+, x along w, are independent: y is normal, and x
 * < K = c/s has the distribution function F(x)/F(K) (Heitz & d'Eon, "Importance Sampling Microfacet-Based BSDFs using
 * the Distribution of Visible Normals", EGSR 2014). With d = K - x and the remainder N of erfc (math.h)
 *
 *     (2 sqrt(pi)/s) F(x) = exp(-x^2) (N(|x|) + d)/(N(|x|) + |x|)                      x <= 0
 *                         = exp(-x^2) (N(x) - d)/(N(x) + x) + 2 sqrt(pi) K             x > 0                 (1)
 *
 * For K < 5/4 all is divided by exp(-K^2): then x^2 - K^2 = d (d - 2 K) keeps d's digits, and far below the horizon
 * nothing underflows; the law there is exp(-g) (1 + g), g = -2 K d. u1 is met by steps of Householder's method of order
 * four, F' = s d exp(-x^2)/sqrt(pi). A(w) = F(K), so K of the density is 2/sqrt(pi) exp(-x^2 - y^2) d/whole with
 * whole = (2 sqrt(pi)/s) F(K), and no s is left. */
#ifndef VNDF_KERNEL_BECKMANN_H
#define VNDF_KERNEL_BECKMANN_H

#include "kernel/ggx.h"

/* The azimuth of w, its part across z, K and the law (1): `line` is 2 sqrt(pi) K above the horizon, `around` 1 for K <
 * 5/4, else 0. */
typedef struct beckmann_law {
    real cosine, sine, across, bound, line, whole, around;
} beckmann_law;

/* And where steps start: `near` is 1 for K < 2, else 0. */
typedef struct beckmann_view {
    beckmann_law law;
    real near, p0, p1, p2, p3, p4;
} beckmann_view;

/* The first slope, and K - x: either may hold the digits. */
typedef struct beckmann_place {
    real x, d;
} beckmann_place;

/* Azimuth and K of a direction. K is held above -1e4, where areas have long been 0. */
KERNEL beckmann_law beckmann_toward(real vx, real vy, real vz)
{
    ggx_direction w = ggx_direction_of(vx, vy, vz);
    const real none = set(0.0f);
    const beckmann_law law = {w.cosine, w.sine, w.across, max(vz / w.across, set(-1e4f)), none, none, none};
    return law;
}

/* The law of such a direction. Of exp(-K^2) next to 1 what lies below exp(-40) is rounded away. */
KERNEL beckmann_law beckmann_law_of(beckmann_law w)
{
    real bound = w.bound, z = min(abs(bound), set(1e4f)), gauss = exp_near(-min(z * z, set(40.0f)));
    erfc_quotient n = erfc_rest(z);
    mask far = le(set(1.25f), bound);
    real under = n.above + z * n.below, fall = select(far, set(1.0f), max(gauss, set(0.2f))),
         per = 1.0f / (under * fall);
    real line = 3.54490770f * max(bound, set(0.0f)) * (under * per), around = select(far, set(0.0f), set(1.0f));
    const beckmann_law law = {
        w.cosine, w.sine, w.across, bound, line, line + n.above * per * select(far, gauss, fall), around};
    return law;
}

/* A(w), measured: 3e-6 where it is above 1e-10 of what it is at grazing; at least 1e-37. */
KERNEL real beckmann_area(real vx, real vy, real vz)
{
    beckmann_law law = beckmann_law_of(beckmann_toward(vx, vy, vz));
    real fall = exp_of(-(law.around * law.bound * law.bound));
    return max(0.282094792f * law.across * law.whole * fall, set(1e-37f));
}

KERNEL beckmann_view beckmann_view_of(beckmann_law toward)
{
    beckmann_law law = beckmann_law_of(toward);
    real near = select(lt(law.bound, set(2.0f)), set(1.0f), set(0.0f)), bound = max(law.bound, set(0.0f));
    real k = min(bound, 4.0f / max(bound, set(1.0f)));
    beckmann_view v;
    v.law = law;
    v.near = near;
    v.p0 = (-0.00170040639f + 0.903457906f * near) +
           k * ((0.135259418f + 0.153947952f * near) + k * (-0.00489802073f + 0.0110058123f * near));
    v.p1 = (0.00880105618f - 0.374491386f * near) +
           k * ((0.0091959214f - 0.0388641993f * near) + k * (0.00669192853f + 0.0220522592f * near));
    v.p2 = (0.0013695223f - 0.0102647104f * near) +
           k * ((-0.00863748644f - 0.0428237496f * near) + k * (0.00479493748f + 0.0153825733f * near));
    v.p3 = (-0.00132920409f + 0.0093151226f * near) +
           k * ((-0.00405786226f + 0.0013423552f * near) + k * (0.00460161987f - 0.00648317075f * near));
    v.p4 = (7.23658072e-05f + 0.00169871453f * near) +
           k * ((-0.000398632971f + 0.0042367207f * near) + k * (0.00128372159f - 0.003633866f * near));
    return v;
}

KERNEL beckmann_view beckmann_see(real vx, real vy, real vz)
{
    return beckmann_view_of(beckmann_toward(vx, vy, vz));
}

/* P22 of the slope over z^4, as for GGX; 0 where it underflows. */
KERNEL real beckmann_p22(real x, real y, real z)
{
    real per = 1.0f / max(z, 1e-9f * (abs(x) + abs(y)) + 1e-37f), square = per * per;
    return 0.318309886f * exp_of(-((x * x + y * y) * square)) * square * square;
}

/* x^2, less K^2 for K < 5/4: one of two products, chosen by arithmetic, which is the fastest. */
KERNEL real beckmann_exponent(beckmann_law v, real x, real d)
{
    real t = v.around * d + (1.0f - v.around) * x;
    return t * (t - 2.0f * v.around * v.bound);
}

/* The density of the slopes; 0 where it underflows, as P22 does: of nearly level normals the least float is times z^-3,
 * which is much. */
KERNEL real beckmann_slopes(beckmann_law v, real x, real y, real d)
{
    return 1.12837917f * exp_of(-(beckmann_exponent(v, x, d) + y * y)) * d / v.whole;
}

/* The factor K of a normal that faces w, facing = w.(x, y, z) > 0: never 0. */
KERNEL real beckmann_density(beckmann_view view, real x, real y, real z, real facing)
{
    beckmann_law v = view.law;
    real per = 1.0f / max(z, 1e-9f * (abs(x) + abs(y)) + 1e-37f);
    real along = v.cosine * x + v.sine * y, across = v.cosine * y - v.sine * x;
    return beckmann_slopes(v, -(along * per), across * per, facing * per / v.across) * per * per * per;
}

/* A start within 4% of u, however extreme u or K is: 0.4% for K <= 0, 2.3% for K >= 5/4; constants by hand. m^2 =
 * whole, rho^2 = -log u. Near the end d = m rho; at K = 0 d = rho exactly. K <= 0: exponents compared, d^2 - 2 K d =
 * rho^2 - 2 K m rho/(1 + b rho). 0 < K < 5/4: d = rho m (1 + b rho)/(1 + b m rho), b = 0.8. Above: Taylor's shift h =
 * 1/(2 K) of the quantile q of u F(K)/c, x = q/(1 + h^2), damped in the tail where that goes too far; except close to
 * the end, where m rho = d exp(2 K d/3). */
KERNEL beckmann_place beckmann_first_anywhere(beckmann_law v, real u)
{
    real k = v.bound, rho2 = -log_of(u), rho = sqrt(rho2), m = sqrt(v.whole), mrho = m * rho;
    real more =
        rho2 - 2.0f * min(k, set(0.0f)) * mrho / (1.0f + sqrt(0.055f + 0.865f * min(v.whole, set(1.0f))) * rho);
    real low = more / (sqrt(k * k + more) + abs(k)), middle = mrho * (1.0f + 0.8f * rho) / (1.0f + 0.8f * mrho);
    real d = select(lt(set(0.0f), k), middle, low);
    beckmann_place p = {k - d, d};
    mask far = le(set(1.25f), k);
    if (any(far)) {
        real h = 0.5f / max(k, set(1.0f)),
             q = erf_quantile(min(u * v.whole / max(v.line, set(1.0f)), set(1.0f))) - h;
        real e = 1.0f + 0.7f * h * abs(q), x = q * e / (e + h * h), small = min(k, set(6.0f));
        real l = log_of(1.0f + small * mrho * exp_of(0.5f * small * small) * 0.666666667f);
        real end = 3.0f * h * l * (1.0f - log_of(1.0f + l) / (2.0f + l));
        mask close = both(lt(k - x, set(0.7f)), lt(k, set(6.0f)));
        p.x = select(far, select(close, k - end, x), p.x);
        p.d = select(far, select(close, end, k - x), p.d);
    }
    return p;
}

/* A start above the horizon, good for one step: 3e-8 of u are left where 4 u (1 - u) > exp(-8). z(u) is within 2% of
 * the quantile of exp(-x^2)/sqrt(pi), from a logarithm that is linear between powers of 2, p = p0 + ... + p4 z^4 with
 * coefficients that are quadratic in K, or in 4/K, and d = p^2 for K < 2, x = z - p beyond; fitted for the least
 * largest error after the step (tools/evidence/fits.py). */
KERNEL beckmann_place beckmann_first(beckmann_view v, real u)
{
    real l = 127.0f - to_real(bits(erf_middle(u))) * 1.1920929e-7f;
    real z = (u - (1.0f - u)) * ((0.880354f + l * 0.176364f) - l * l * (7.7609e-4f + l * 9.60636e-5f));
    real z2 = z * z, p = (v.p0 + z * v.p1) + z2 * ((v.p2 + z * v.p3) + z2 * v.p4), far = 1.0f - v.near;
    real x = (far * z + v.near * v.law.bound) - p * (far + v.near * p);
    const beckmann_place at = {x, v.law.bound - x};
    return at;
}

KERNEL real beckmann_inside(real u1)
{
    return min(max(u1, set(5.42101086e-20f)), set(0.99999994f));
}

/* F''/F' = -1/d - 2 x and F'''/F' = 4 x/d + 4 x^2 - 2. No step leaves x < K or is longer than 1. */
KERNEL beckmann_place beckmann_step(beckmann_law v, beckmann_place at, real u1)
{
    real x = at.x, d = at.d, z = abs(x), side = with_sign(set(1.0f), x);
    erfc_quotient n = erfc_rest(z);
    real under = n.above + z * n.below, per = 1.0f / (under * d), nearness = under * per;
    real rest = beckmann_inside(u1) * v.whole - (0.5f + 0.5f * side) * v.line,
         up = exp_near(min(beckmann_exponent(v, x, d), set(80.0f)));
    real h = 0.5f * ((n.above - side * d * n.below) * per - rest * nearness * up);
    real second = nearness + 2.0f * x, third = x * (nearness + x) * 0.666666667f - 0.333333333f;
    real step = h * (1.0f + 0.5f * h * second) / max(1.0f + h * (h * third + second), set(0.1f));
    step = min(max(step, -0.5f * d), set(1.0f));
    const beckmann_place p = {x - step, d + step};
    return p;
}

/* The slope along w for u1 is one step from here. Measured error of the CDF at that slope: 7e-7 (3e-7 above the
 * horizon), and 2e-5 of u1 where u1 is small. */
KERNEL beckmann_place beckmann_start(beckmann_view v, real u1)
{
    real u = beckmann_inside(u1);
    beckmann_place p = beckmann_first(v, u);
    mask rare = either(lt(v.law.bound, set(0.0f)), lt(erf_middle(u), set(3.4e-4f)));
    if (any(rare)) {
        beckmann_place q = beckmann_step(v.law, beckmann_first_anywhere(v.law, u), u);
        p.x = select(rare, q.x, p.x);
        p.d = select(rare, q.d, p.d);
    }
    return p;
}

/* The normal with these slopes along and across w. The density is that of beckmann_density within 3e-6 for 99.9 % of
 * the samples at 0 to 110 degrees, 3e-5 at 160, measured. */
KERNEL normal_sample beckmann_normal(beckmann_view v, beckmann_place p, real y)
{
    const normal_sample n = {v.law.sine * y - v.law.cosine * p.x, -(v.law.sine * p.x + v.law.cosine * y),
                             set(1.0f), beckmann_slopes(v.law, p.x, y, p.d)};
    return n;
}

/* u1 draws the slope along w, from far behind, u2 that across. */
KERNEL normal_sample beckmann_draw(beckmann_view v, real u1, real u2)
{
    return beckmann_normal(v, beckmann_step(v.law, beckmann_start(v, u1), u1), erf_quantile(u2));
}

/* F(x)/F(K). */
KERNEL real beckmann_part(beckmann_law v, real x, real d)
{
    real z = min(abs(x), set(1e4f)), side = with_sign(set(1.0f), x);
    erfc_quotient n = erfc_rest(z);
    real part = (n.above - side * d * n.below) / (n.above + z * n.below) * exp_of(-beckmann_exponent(v, x, d));
    return min(max((part + select(lt(set(0.0f), x), v.line, set(0.0f))) / v.whole, set(0.0f)), set(1.0f));
}

/* The numbers that draw a normal; measured: within 7e-7 of them at 0 to 135 degrees. */
KERNEL pair beckmann_invert(beckmann_view view, real x, real y, real z)
{
    beckmann_law v = view.law;
    real per = 1.0f / max(z, 1e-9f * (abs(x) + abs(y)) + 1e-37f);
    real along = (v.cosine * x + v.sine * y) * per, d = max(v.bound + along, set(0.0f));
    const pair u = {beckmann_part(v, -along, d), half_erfc((v.cosine * y - v.sine * x) * per)};
    return u;
}
#endif
