/* Bounded visible normals of Beckmann (bounded.h). Stretched slopes (x, y), x along wi (beckmann.c), are
 * independent, x with the distribution function F(x)/F(K), y normal. The real slope is of squared length q = qxx
 * x^2 + 2 qxy x y + qyy y^2, and with h = s/c the disc is the ellipse
 *
 *     q + 2 h x < 1,
 *
 * of extent x0 < x < x1 and chords y = (-qxy x +- sqrt(det (x1 - x) (x - x0)))/qyy, where det = (alpha_x
 * alpha_y)^2 and x0, x1 are the roots of det x^2 + 2 h qyy x = qyy. x1 < K/2: normals turned away are not in it.
 *
 * u1 moves x through the part of F between x0 and x1, u2 moves y through the part of the normal law on the chord;
 * The inside mass is the product of both parts. y is counted from the tail where the middle of the chord is, so
 * that a chord far out keeps its digits; on a short chord quadrature gives the part and Newton's steps invert it. */
#include "math/elementary.h"
#include "math/erf_quantile.h"
#include "math/vector.h"
#include "sampler/analytic/beckmann.h"
#include "sampler/analytic/beckmann_draw.h"
#include "sampler/bounded/beckmann.h"
#include "sampler/query.h"
#include "sampler/stretch.h"
#include "sampler/surface.h"

/* The bounds hold the extent, the part of F before it and on it, the azimuth of wi and the law of x, in double: rounded
 * to float they would put normals beside the extent. They also hold the stretched direction and its area times the
 * roughness. */
typedef struct vndf_beckmann_bounds extent;

/* The ellipse in the frame turned to the stretched wi. */
typedef struct ellipse {
    double qxx, qxy, qyy, det;
} ellipse;

static ellipse ellipse_of(const vndf_view *view, const extent *bounds)
{
    double a2 = view->alpha_x * view->alpha_x, b2 = view->alpha_y * view->alpha_y;
    double c = bounds->cos_phi, s = bounds->sin_phi;
    ellipse e = {a2 * c * c + b2 * s * s, (b2 - a2) * s * c, a2 * s * s + b2 * c * c, a2 * b2};
    return e;
}

/* The part of the law before x, of a trusted view, in float: to 3e-7. Beyond 4 there is less than that. */
static double part_in_float(const vndf_view *view, double x)
{
    const struct vndf_beckmann_view *w = &view->of.beckmann;
    float bound = w->bound, line = w->line, whole = 1.0f + (line + w->tail);
    float z = lanes_least(fabsf((float)x), 4.0f), side = x < 0.0 ? 1.0f : -1.0f, fall = vndf_exp_lanes(-(z * z));
    vndf_erfc_ratio e = vndf_erfc_lanes(z);
    float tail = fall * (1.0f + side * (bound * (e.above / e.below)));
    return (x < 0.0 ? tail : tail + line) / whole;
}

/* A trusted view holds the law; else `bounds` do. */
VNDF_RARE vndf_beckmann_law law_of(const vndf_view *view, const extent *bounds)
{
    double bound = vndf_beckmann_bound(bounds->s, bounds->c), scale = bound < 1.25 ? vndf_exp(bound * bound) : 1.0;
    if (!view->trusted)
        return (vndf_beckmann_law){bound, bounds->whole, bounds->line};
    double line = view->of.beckmann.line, tail = view->of.beckmann.tail;
    return (vndf_beckmann_law){bound, scale * (1.0 + (line + tail)), scale * line};
}

/* Beyond 7 there is nothing. */
static void set_law(const vndf_view *view, extent *bounds)
{
    vndf_beckmann_law law = vndf_beckmann_law_at(bounds->s, bounds->c);
    double x0 = bounds->x0, x1 = bounds->x1;
    bounds->whole = law.whole;
    bounds->line = law.line;
    bounds->begin = x0 < -7.0 ? 0.0 : vndf_beckmann_part(&law, x0, law.bound - x0);
    bounds->span = (x1 > 7.0 ? 1.0 : vndf_beckmann_part(&law, x1, law.bound - x1)) - bounds->begin;
    bounds->spread =
        (float)(vndf_unit_area(view->distribution, bounds->s, bounds->c) * (view->alpha_x * view->alpha_y));
}

static void set_law_in_float(const vndf_view *view, extent *bounds)
{
    bounds->begin = part_in_float(view, bounds->x0);
    bounds->span = part_in_float(view, bounds->x1) - bounds->begin;
    bounds->spread = view->of.beckmann.spread * bounds->s * 0.318309886f;
}

void vndf_bound_beckmann(const vndf_view *view, extent *bounds)
{
    vndf_stretched w = vndf_stretched_analytic(view);
    vndf_heading to = vndf_heading_of(&w);
    bounds->s = (float)w.s;
    bounds->c = (float)w.c;
    bounds->cos_phi = to.cosine;
    bounds->sin_phi = to.sine;
    ellipse e = ellipse_of(view, bounds);
    double h = w.s / w.c, across = h * e.qyy, root = sqrt(across * across + e.det * e.qyy), sum = across + root;
    bounds->x0 = -sum / e.det;
    bounds->x1 = e.qyy / sum;
    if (view->trusted)
        set_law_in_float(view, bounds);
    else
        set_law(view, bounds);
}

/* ---- the chord ---- */

/* y from low to high, with the middle at or below 0, after `mirrored` ones have been turned round; the part of
 * the normal law below and on it. */
typedef struct chord {
    double low, high, before, part;
    int mirrored, is_short;
} chord;

/* integral exp(-y^2)/sqrt(pi) over a short interval: three points of Gauss. */
static double short_part(double low, double high)
{
    double half = 0.5 * (high - low), middle = low + half, away = 0.77459666924148338 * half;
    double below = middle - away, above = middle + away;
    double sum = 8.0 * vndf_exp(-middle * middle) + 5.0 * (vndf_exp(-below * below) + vndf_exp(-above * above));
    return half * sum / (9.0 * vndf_root_pi);
}

/* But for its part. */
static chord chord_on(const ellipse *e, const extent *bounds, double x)
{
    double square = e->det * (bounds->x1 - x) * (x - bounds->x0);
    double half = square > 0.0 ? sqrt(square) / e->qyy : 0.0;
    double middle = -e->qxy * x / e->qyy;
    chord h = {-fabs(middle) - half, -fabs(middle) + half, 0.0, 0.0, middle > 0.0, 0};
    h.is_short = half * (1.0 + fabs(middle)) < 0.125;
    return h;
}

static void weigh_chord(chord *h)
{
    h->before = vndf_half_erfc(-h->low);
    h->part = h->is_short ? short_part(h->low, h->high) : vndf_half_erfc(-h->high) - h->before;
}

/* erfc(-x)/2 to 2e-7. */
static float half_erfc_in_float(float x)
{
    float z = lanes_least(fabsf(x), 4.0f);
    vndf_erfc_ratio e = vndf_erfc_lanes(z);
    float tail = 0.282094792f * vndf_exp_lanes(-(z * z)) * (e.above / e.below);
    return x < 0.0f ? tail : 1.0f - tail;
}

/* In float where that leaves the inside mass its digits. */
static void weigh_chord_in_float(chord *h)
{
    float before = half_erfc_in_float((float)h->low), part = half_erfc_in_float((float)h->high) - before;
    h->before = before;
    h->part = part;
    if (h->is_short || !(part > VNDF_TRUST_BOUNDED_PART))
        weigh_chord(h);
}

/* Newton's steps from where a constant density would put y; on the chord the density changes by at most 27%. */
static double short_draw(const chord *h, double u)
{
    double y = h->low + u * (h->high - h->low), target = u * h->part;
    for (int i = 0; i < 3; i++)
        y += (target - short_part(h->low, y)) * (vndf_root_pi * vndf_exp(y * y));
    return y;
}

static double draw_across(const chord *h, double u)
{
    if (h->mirrored)
        u = 1.0 - u;
    double v = h->before + u * h->part, y = 0.0;
    if (h->is_short && h->part > 1e-300)
        y = short_draw(h, u);
    else if (vndf_beckmann_product((float)v) > VNDF_TRUST_BECKMANN_MIDDLE)
        y = vndf_beckmann_second((float)v);
    else
        y = vndf_erf_quantile(v > 0x1p-64 ? (v < 1.0 - 0x1p-26 ? v : 1.0 - 0x1p-26) : 0x1p-64);
    y = y > h->low ? (y < h->high ? y : h->high) : h->low;
    return h->mirrored ? -y : y;
}

/* ---- both ---- */

vndf_bounded_factors vndf_bounded_beckmann_at(const vndf_view *view, const extent *bounds, vndf_normal wm,
                                              double facing)
{
    ellipse e = ellipse_of(view, bounds);
    double along = bounds->cos_phi * wm.x / view->alpha_x + bounds->sin_phi * wm.y / view->alpha_y;
    chord h = chord_on(&e, bounds, -along / wm.z);
    weigh_chord(&h);
    vndf_bounded_factors at = {vndf_normal_visible(view, wm, facing), bounds->span * h.part};
    return at;
}

/* Whether the density is that of the normal as it is rounded: slopes move by 1.2e-7 of themselves, the ends of
 * the chord with them, and the part on it by no more than (1 - part) (2 |y| + 1.2) times that. */
static int is_settled(const vndf_view *view, const extent *bounds, const ellipse *e, const chord *h, double x,
                      double y)
{
    double farther = -h->low, root = 0.5 * (h->high - h->low) * e->qyy;
    double gain = fabs(e->qxy) * root + 0.5 * e->det * (bounds->x1 - bounds->x0);
    double change = (1.0 - h->part) * (2.0 * farther + 1.2) * gain * (fabs(x) + fabs(y));
    double turned = bounds->s * (fabs(x) + fabs(y)) + bounds->c, facing = bounds->c - bounds->s * x;
    int trusted =
        view->trusted && x * x + y * y < VNDF_TRUST_BOUNDED_SLOPE && VNDF_TRUST_BOUNDED_FACING * turned < facing;
    return trusted && change < VNDF_TRUST_BOUNDED_STEEP * h->part * e->qyy * root;
}

/* The slope along wi. */
static double draw_along(const vndf_view *view, const extent *bounds, float u1)
{
    double u = bounds->begin + u1 * bounds->span, x;
    if (view->trusted && vndf_beckmann_product((float)u) > VNDF_TRUST_BECKMANN_MIDDLE) {
        vndf_beckmann_incidence w = vndf_beckmann_incidence_of(view);
        x = vndf_beckmann_step(&w, vndf_beckmann_first(&w, (float)u), (float)u).x;
    } else {
        vndf_beckmann_law law = law_of(view, bounds);
        x = vndf_beckmann_slope(&law, u);
    }
    return x > bounds->x0 ? (x < bounds->x1 ? x : bounds->x1) : bounds->x0;
}

static vndf_bounded settled(const vndf_view *view, const extent *bounds, vndf_normal drawn)
{
    vndf_vec3 wm = vndf_disc_normal(view, drawn);
    return vndf_bounded_from(
        wm, vndf_bounded_beckmann_at(view, bounds, vndf_normal_of(wm), vndf_exact_dot(view->wi, wm)));
}

vndf_bounded vndf_bounded_beckmann(const vndf_view *view, const extent *bounds, float u1, float u2)
{
    ellipse e = ellipse_of(view, bounds);
    double x = draw_along(view, bounds, u1);
    chord h = chord_on(&e, bounds, x);
    if (view->trusted)
        weigh_chord_in_float(&h);
    else
        weigh_chord(&h);
    double y = draw_across(&h, u2), c = bounds->cos_phi, s = bounds->sin_phi;
    vndf_normal m = {-view->alpha_x * (c * x - s * y), -view->alpha_y * (s * x + c * y), 1.0};
    double length2 = m.x * m.x + m.y * m.y + 1.0, up = bounds->c - bounds->s * x;
    if (!(VNDF_TRUST_INSIDE * bounds->c * length2 < 2.0 * up) || !is_settled(view, bounds, &e, &h, x, y))
        return settled(view, bounds, m);
    double length = sqrt(length2), per = 1.0 / length, inside_mass = bounds->span * h.part;
    float p22 = 0.318309886f * vndf_exp_lanes(-(float)(x * x + y * y));
    double density = p22 * (up * length2 * length) / (bounds->spread * inside_mass);
    vndf_vec3 wm = vndf_vec3_of((float)(m.x * per), (float)(m.y * per), (float)per);
    vndf_bounded b = {wm, (float)density, (float)inside_mass, 0.0f};
    return b;
}
