/* Beckmann where float is trusted: beckmann.h in float, for one or for lanes. Above the horizon, with K = c/s,
 * d = K - x and E of simd/gauss_lanes.h,
 *
 *     (2 sqrt(pi)/s) F(x) = exp(-x^2) (1 + K E(-x))                             x < 0
 *                         = exp(-x^2) (1 - K E(x)) + 2 sqrt(pi) K               x >= 0,
 *
 * and F(x) = u1 F(K) is solved by one Householder step of order four, beckmann.c's, from a starting value that is
 * always good enough for that: z(u1) is within 2% of the quantile of exp(-x^2)/sqrt(pi), made with a logarithm to
 * the base of 2 that is linear between powers of 2, p a polynomial of degree 4 in z whose coefficients are
 * quadratic in K, or in 4/K from K = 2 on, and
 *
 *     d = p^2  (K < 2),     x = z - p  (K >= 2).
 *
 * Both were fitted for the least largest error, measured by what the step makes of it: at most 3e-8 of u1,
 * before rounding, where 4 u1 (1 - u1) > exp(-8). Rounding included u1 is met within 1.8e-7 and u2 within 9e-8
 * (test closed_forms_float). The density is within 8e-6.
 *
 * exp(-x^2 - y^2)/pi d s/A1 is the density of the slopes, and A1 = F(K): no s is left. */
#ifndef VNDF_SAMPLER_ANALYTIC_BECKMANN_DRAW_H
#define VNDF_SAMPLER_ANALYTIC_BECKMANN_DRAW_H

#include "simd/gauss_lanes.h"
#include "sampler/tabulated/draw.h"

/* Surface and stretched direction: K, and (2 sqrt(pi)/s) F(K) = 1 + line + tail, line = 2 sqrt(pi) K. */
typedef struct vndf_beckmann_incidence {
    lanes_f ax, ay, cos_phi, sin_phi, bound, line, tail, spread;
    lanes_f near, p0, p1, p2, p3, p4; /* 1 for K < 2, else 0; coefficients of p */
    lanes_m trusted;
} vndf_beckmann_incidence;

/* p = sum of z^i (a_i + b_i k + c_i k^2), k the lesser of K and 4/K: numbers for K >= 2, and for K < 2. */
static const float vndf_beckmann_starts[5][3][2] = {
    {{-0.00170040639f, 0.9017575f}, {0.135259418f, 0.28920737f}, {-0.00489802073f, 0.00610779161f}},
    {{0.00880105618f, -0.36569033f}, {0.0091959214f, -0.0296682779f}, {0.00669192853f, 0.0287441877f}},
    {{0.0013695223f, -0.00889518807f}, {-0.00863748644f, -0.051461236f}, {0.00479493748f, 0.0201775108f}},
    {{-0.00132920409f, 0.00798591851f}, {-0.00405786226f, -0.00271550706f}, {0.00460161987f, -0.00188155088f}},
    {{7.23658072e-05f, 0.00177108034f}, {-0.000398632971f, 0.00383808773f}, {0.00128372159f, -0.00235014441f}},
};
static const float vndf_beckmann_nearness[2] = {0.0f, 1.0f};
/* Up to where K is looked at for the tail. A number would make gcc compile a branch that nothing foresees. */
static const float vndf_beckmann_most[2] = {4.0f, 2.0f};

/* exp(-K^2) (1 - K E(K)) - 1; 3e-9 is left of the first term where K is beyond 4. */
VNDF_INLINE lanes_f vndf_beckmann_tail(lanes_f bound, lanes_m near)
{
    lanes_f z = lanes_least(bound, lanes_one_of(vndf_beckmann_most, near));
    vndf_erfc_ratio e = vndf_erfc_lanes(z);
    lanes_f part = z * e.above / e.below, less = vndf_exp_less_one_lanes(-(z * z));
    return less - (part + part * less);
}

/* k is the lesser of K and 4/K. */
VNDF_INLINE lanes_f vndf_beckmann_start(int i, lanes_f k, lanes_m near)
{
    const float(*c)[2] = vndf_beckmann_starts[i];
    return lanes_one_of(c[0], near) + k * (lanes_one_of(c[1], near) + k * lanes_one_of(c[2], near));
}

VNDF_INLINE vndf_beckmann_incidence vndf_beckmann_incidence_from(lanes_f ax, lanes_f ay, lanes_f wi_x,
                                                                 lanes_f wi_y, lanes_f wi_z)
{
    lanes_f x = ax * wi_x, y = ay * wi_y, across2 = x * x + y * y, across = lanes_root(across2);
    lanes_f both = 1.0f / (across * wi_z), per = wi_z * both, bound = wi_z * per;
    lanes_m near = lanes_less(bound, lanes_set(2.0f));
    lanes_f line = 3.54490770f * bound, tail = vndf_beckmann_tail(bound, near);
    lanes_f k = lanes_least(bound, across2 * both * 4.0f);
    vndf_beckmann_incidence w = {
        ax,
        ay,
        x * per,
        y * per,
        bound,
        line,
        tail,
        0.886226925f * (1.0f + (line + tail)) * (ax * ay),
        lanes_one_of(vndf_beckmann_nearness, near),
        vndf_beckmann_start(0, k, near),
        vndf_beckmann_start(1, k, near),
        vndf_beckmann_start(2, k, near),
        vndf_beckmann_start(3, k, near),
        vndf_beckmann_start(4, k, near),
        lanes_both(vndf_trusts_scale(ax, ay, bound),
                   lanes_less(lanes_most(bound, per), lanes_set(VNDF_TRUST_BECKMANN_BOUND)))};
    return w;
}

/* Of a view, the same in all lanes. */
VNDF_INLINE vndf_beckmann_incidence vndf_beckmann_incidence_of(const vndf_view *v)
{
    const struct vndf_beckmann_view *w = &v->of.beckmann;
    vndf_beckmann_incidence of = {
        lanes_set(v->ax),      lanes_set(v->ay),     lanes_set(w->cos_phi),
        lanes_set(w->sin_phi), lanes_set(w->bound),  lanes_set(w->line),
        lanes_set(w->tail),    lanes_set(w->spread), lanes_set(w->near_side),
        lanes_set(w->p0),      lanes_set(w->p1),     lanes_set(w->p2),
        lanes_set(w->p3),      lanes_set(w->p4),     v->trusted ? lanes_all() : lanes_none()};
    return of;
}

/* The first slope, and K - x: either may hold the digits. */
typedef struct vndf_beckmann_place {
    lanes_f x, d;
} vndf_beckmann_place;

/* 1 at u = 1/2, 0 at both ends. */
VNDF_INLINE lanes_f vndf_beckmann_product(lanes_f u)
{
    return 4.0f * u * (1.0f - u);
}

/* The lesser of both numbers'. */
VNDF_INLINE lanes_f vndf_beckmann_middle(lanes_f u1, lanes_f u2)
{
    return lanes_least(vndf_beckmann_product(u1), vndf_beckmann_product(u2));
}

/* Where to start. */
VNDF_INLINE vndf_beckmann_place vndf_beckmann_first(const vndf_beckmann_incidence *w, lanes_f u)
{
    lanes_f l = 127.0f - lanes_float(lanes_bits(vndf_beckmann_product(u))) * 0x1p-23f; /* -log2 */
    lanes_f z = (u - (1.0f - u)) * ((0.880354f + l * 0.176364f) - l * l * (7.7609e-4f + l * 9.60636e-5f));
    lanes_f z2 = z * z, p = (w->p0 + z * w->p1) + z2 * ((w->p2 + z * w->p3) + z2 * w->p4);
    lanes_f far = 1.0f - w->near; /* z - p or K - p^2: */
    lanes_f x = (far * z + w->near * w->bound) - p * (far + w->near * p);
    vndf_beckmann_place at = {x, w->bound - x};
    return at;
}

/* F''/F' = -1/d - 2x and F'''/F' = 4x/d + 4x^2 - 2. `rest` is (2 sqrt(pi)/s) (u F(K) - what F has more for
 * x >= 0), and 1 less it is formed without a difference: what is missing of F(K), and of 1 at K = 0, keeps its
 * digits. No branch would foresee the side. */
VNDF_INLINE vndf_beckmann_place vndf_beckmann_step(const vndf_beckmann_incidence *w, vndf_beckmann_place at,
                                                   lanes_f u)
{
    lanes_f side = lanes_sign(lanes_set(1.0f), at.x), v = 1.0f - u, t = u * w->tail;
    lanes_f lean = lanes_least(lanes_most(side, -u), v) * w->line; /* -u for x < 0, else v */
    lanes_f rest = u + (t - lean);
    vndf_erfc_ratio e = vndf_erfc_lanes(side * at.x);
    lanes_f per = 1.0f / (at.d * e.below), nearness = per * e.below;
    lanes_f miss = (v + (lean - t)) - rest * vndf_exp_less_one_lanes(at.x * at.x);
    lanes_f h = 0.5f * per * (miss * e.below - side * (w->bound * e.above));
    lanes_f second = nearness + 2.0f * at.x, third = at.x * (nearness + at.x) * 0.666666667f - 0.333333333f;
    lanes_f step = h * (1.0f + 0.5f * h * second) / (1.0f + h * (h * third + second));
    vndf_beckmann_place solved = {at.x - step, at.d + step};
    return solved;
}

/* Where float has starting values and quantiles (`middle` is vndf_beckmann_middle), and where the density of the
 * slopes is that of the normal, as it was rounded: no small wi . wm, and not far in the tail; the former sees to
 * that, as squares of slopes are below 15. */
VNDF_INLINE lanes_m vndf_beckmann_is_trusted(const vndf_beckmann_incidence *w, const vndf_beckmann_place *at,
                                             lanes_f y, lanes_f middle)
{
    lanes_f terms = lanes_abs(at->x) + lanes_abs(y) + w->bound;
    lanes_m inside = lanes_both(w->trusted, vndf_trusts_beckmann_middle(middle));
    return lanes_both(inside, vndf_trusts_beckmann_facing(terms, at->d));
}

VNDF_INLINE lanes_f vndf_beckmann_second(lanes_f u)
{
    return vndf_quantile_lanes(u, -vndf_log_lanes(vndf_beckmann_product(u)));
}

/* The normal of two slopes. Good where *trusted stays. */
VNDF_INLINE vndf_drawn vndf_beckmann_normal(const vndf_beckmann_incidence *w, const vndf_beckmann_place *at,
                                            lanes_f y, lanes_f middle, lanes_m *trusted)
{
    lanes_f mx = w->ax * (w->sin_phi * y - w->cos_phi * at->x);
    lanes_f my = -w->ay * (w->sin_phi * at->x + w->cos_phi * y);
    lanes_f m2 = (mx * mx + my * my) + 1.0f, length = lanes_root(m2);
    lanes_f both = 1.0f / (length * w->spread), per = w->spread * both;
    *trusted = vndf_beckmann_is_trusted(w, at, y, middle);
    vndf_drawn n = {mx * per, my * per, per, vndf_exp_lanes(-(at->x * at->x + y * y)) * at->d * (m2 * m2 * both)};
    return n;
}

#endif
