/* Beckmann: the visible slopes, P22 = exp(-x^2 - y^2)/pi weighted by max(0, c - s x), are independent. y is
 * normal, and x < K = c/s has the distribution function F(x)/F(K) (Heitz & d'Eon, EGSR 2014) with
 *
 *     F(x) = c (1 + erf x)/2 + s exp(-x^2)/(2 sqrt(pi)).
 *
 * Both terms and their inverse, no matter how deep below the horizon, come from the remainder N of erfc (math/
 * erfc_remainder.h). With d = K - x >= 0 the distance from the end,
 *
 *     (2 sqrt(pi)/s) F(x) = exp(-x^2) (N(|x|) + d)/(N(|x|) + |x|)                      x <= 0
 *                         = exp(-x^2) (N(x) - d)/(N(x) + x) + 2 sqrt(pi) K             x > 0
 *
 * For K < 5/4 all is divided by exp(-K^2): then x^2 - K^2 = d (d - 2K) keeps d's digits, and as K goes to
 * -infinity this becomes, without underflow, the limit law exp(-g) (1 + g), g = -2 K d. Since
 * F' = s d exp(-x^2)/sqrt(pi), all derivatives come for nothing, and F(x) = u1 F(K) is solved by Householder
 * steps of order four from a starting value whose error in u1 is below 0.04. One step is enough for most
 * u1 (at 45 degrees for six of ten, beyond 60 for nearly all); see step_done.
 *
 * Starting values. m^2 = (2 sqrt(pi)/s) F(K) exp(K^2) and rho^2 = -log u1. Near the end d = m rho; at K = 0
 * d = rho exactly. K <= 0: exponents compared, d^2 - 2 K d = rho^2 - 2 K m rho/(1 + b rho), where b is nearly
 * constant in rho. 0 < K < 5/4: d = rho m (1 + b rho)/(1 + b m rho), b = 0.8. Above: the shift by
 * h = 1/(2K) that Taylor's formula gives, q = erfinv(2 u1 F(K)/c - 1) - h and x = q/(1 + h^2), damped in the tail
 * where that goes too far; except close to the end, where m rho = d exp(2 K d/3). */
#include "sampler/analytic/beckmann.h"

#include <math.h>

#include "math/elementary.h"
#include "math/erf_quantile.h"
#include "math/erfc_remainder.h"
#include "math/vector.h"
#include "sampler/analytic/face_repair.h"
#include "sampler/analytic/inverse.h"

/* The first slope while it is sought: x, and d = K - x carried beside it since either may hold the digits. */
typedef struct slope {
    double x, d;
} slope;

vndf_beckmann_law vndf_beckmann_law_at(float s, float c)
{
    double bound = vndf_beckmann_bound(s, c);
    double z = fabs(bound), n = vndf_erfc_remainder(z), part = n / (n + z);
    vndf_beckmann_law g = {bound, part, 0.0};
    if (bound >= 1.25) {
        g.line = 2.0 * vndf_root_pi * bound;
        g.whole = g.line + vndf_exp(-bound * bound) * part;
    } else if (bound > 0.0) {
        g.line = 2.0 * vndf_root_pi * bound * vndf_exp(bound * bound);
        g.whole = g.line + part;
    }
    return g;
}

/* m rho = d exp(2 K d/3) solved for d by an approximation of Lambert's function, good to 2%. */
static double end_distance(double bound, double mrho)
{
    double l = vndf_log1p(2.0 / 3.0 * bound * mrho);
    return 1.5 / bound * l * (1.0 - vndf_log1p(l) / (2.0 + l));
}

static slope start_above(const vndf_beckmann_law *g, double u)
{
    double h = 0.5 / g->bound, v = u * g->whole / g->line;
    double y = vndf_erf_quantile(v < 1.0 - 0x1p-40 ? v : 1.0 - 0x1p-40);
    double q = y - h, e = 1.0 + 0.7 * h * fabs(q);
    slope p = {q * e / (e + h * h), 0.0};
    p.d = g->bound - p.x;
    if (p.d < 0.7 && g->bound < 6.0) {
        p.d = end_distance(g->bound, sqrt(-vndf_log(u) * g->whole * vndf_exp(g->bound * g->bound)));
        p.x = g->bound - p.d;
    }
    return p;
}

static slope start_around(const vndf_beckmann_law *g, double u)
{
    double rho2 = -vndf_log(u), rho = sqrt(rho2), m = sqrt(g->whole), mrho = m * rho;
    slope p;
    if (g->bound > 0.0) {
        p.d = mrho * (1.0 + 0.8 * rho) / (1.0 + 0.8 * mrho);
    } else {
        double b = sqrt(0.055 + 0.865 * g->whole);
        double difference = rho2 - 2.0 * g->bound * mrho / (1.0 + b * rho);
        p.d = difference / (sqrt(g->bound * g->bound + difference) - g->bound);
    }
    p.x = g->bound - p.d;
    return p;
}

/* x^2, less the K^2 that the members are divided by: for K < 5/4 without their cancellation. */
static double exponent(const vndf_beckmann_law *g, slope p)
{
    return g->bound < 1.25 ? p.d * (p.d - 2.0 * g->bound) : p.x * p.x;
}

/* Newton's step (F(x) - u F(K))/F'(x); the sign of x selects by arithmetic, since no branch would be foreseen. */
static double newton_step(const vndf_beckmann_law *g, slope p, double u)
{
    double z = fabs(p.x), n = vndf_erfc_remainder(z), right = (double)(p.x > 0.0);
    double part = (n + p.d * (1.0 - 2.0 * right)) / (n + z);
    double rest = u * g->whole - right * g->line;
    return (part - rest * vndf_exp(exponent(g, p))) / (2.0 * p.d);
}

/* A step of this size relative to the scale on which log F' bends leaves an error in u1 below 4e-8. */
static const double step_done = 0.03;

/* F''/F' = -1/d - 2x and F'''/F' = 4x/d + 4x^2 - 2. Steps are held inside x < K and to length 1, so that no
 * start could escape. */
static slope solve(const vndf_beckmann_law *g, double u)
{
    slope p = g->bound < 1.25 ? start_around(g, u) : start_above(g, u);
    for (int i = 0; i < 3; i++) {
        double h = newton_step(g, p, u), nearness = 1.0 / p.d;
        double second = -nearness - 2.0 * p.x, third = 4.0 * p.x * (nearness + p.x) - 2.0;
        double divisor = 1.0 + h * (h * third / 6.0 - second);
        double step = divisor > 0.0 ? -h * (1.0 - 0.5 * h * second) / divisor : -h;
        step = step < 0.5 * p.d ? (step > -1.0 ? step : -1.0) : 0.5 * p.d;
        p.x += step;
        p.d -= step;
        if (fabs(h) * (nearness + 2.0 * fabs(p.x)) < step_done)
            break;
    }
    return p;
}

static double clamp_inside(float u)
{
    return u > 0x1p-64f ? (u < 1.0f ? u : 1.0 - 0x1p-26) : 0x1p-64;
}

double vndf_beckmann_slope_distance(float s, float c, float u1)
{
    vndf_beckmann_law g = vndf_beckmann_law_at(s, c);
    return solve(&g, clamp_inside(u1)).d;
}

double vndf_beckmann_part(const vndf_beckmann_law *law, double x, double d)
{
    slope p = {x, d};
    double z = fabs(x), rest = vndf_erfc_remainder(z), gauss = vndf_exp(-exponent(law, p));
    double mass = (x > 0.0 ? rest - d : rest + d) / (rest + z) * gauss + (x > 0.0 ? law->line : 0.0);
    return mass / law->whole;
}

double vndf_beckmann_slope(const vndf_beckmann_law *law, double u)
{
    const double most = 1.0 - 0x1p-40;
    return solve(law, u > 0x1p-64 ? (u < most ? u : most) : 0x1p-64).x;
}

vndf_vec3 vndf_beckmann_sample(float s, float c, float u1, float u2)
{
    vndf_beckmann_law g = vndf_beckmann_law_at(s, c);
    double x = solve(&g, clamp_inside(u1)).x, y = vndf_erf_quantile(clamp_inside(u2));
    double z = 1.0 / sqrt(1.0 + x * x + y * y);
    vndf_vec3 n = {(float)(-x * z), (float)(-y * z), (float)z};
    return vndf_face(s, c, n);
}

void vndf_beckmann_invert(float s, float c, vndf_normal n, float *u1, float *u2)
{
    const vndf_unit_query q = {s, c, n};
    vndf_uniforms u = vndf_beckmann_inverse(&q);
    *u1 = u.u1;
    *u2 = u.u2;
}
