#include "bsdf/quadrature.h"

#include <math.h>
#include <string.h>

#include "bsdf/wide.h"
#include "math/vector.h"
#include "sampler/sampler.h"

/* ---- rules ---- */

/* Keeps the borders ascending, and apart. */
static void add_border(double *border, int *count, double x)
{
    int i = *count;
    while (i > 0 && border[i - 1] > x)
        --i;
    if (!(x >= 0.0 && x <= 1.0) || (i > 0 && !(x - border[i - 1] > 1e-7 * (1.0 - border[i - 1]))))
        return;
    for (int j = (*count)++; j > i; j--)
        border[j] = border[j - 1];
    border[i] = x;
}

void vndf_quadrature_of(vndf_quadrature *q, const vndf_distribution *distribution)
{
    const vndf_surface unit = {distribution, 1.0f, 1.0f};
    const vndf_vec3 up = {0.0f, 0.0f, 1.0f};
    vndf_view view = vndf_view_from(&unit, up);
    vndf_info info = vndf_distribution_info(distribution);
    int is_table = info.bytes > 0; /* whose tail may be heavier than that of a closed form */
    double rest = 1.0 / 16.0;
    q->distribution = distribution;
    q->scale = info.scale;
    q->borders = 0;
    for (int j = 0; j <= VNDF_QUADRATURE_EVEN; j++)
        add_border(q->border, &q->borders, (1.0 - rest) * j / VNDF_QUADRATURE_EVEN);
    for (int j = 1, count = is_table ? VNDF_QUADRATURE_TAIL : 12; j < count; j++)
        add_border(q->border, &q->borders, 1.0 - (rest *= 0.5));
    for (int j = 1; is_table && j < VNDF_QUADRATURE_QUANTILES; j++) {
        vndf_vec3 wm = vndf_sample(&view, 0.5f, (float)j / VNDF_QUADRATURE_QUANTILES, NULL);
        double slope = sqrt((double)wm.x * wm.x + (double)wm.y * wm.y);
        add_border(q->border, &q->borders, slope / (slope + q->scale * wm.z));
    }
    add_border(q->border, &q->borders, 1.0);
    vndf_gauss_rule_of(&q->radial, is_table ? 4 : 5);
    vndf_gauss_rule_of(&q->azimuth, 12);
}

/* ---- one direction ---- */

/* wi, and all normals of one slope length r. */
typedef struct ring {
    const vndf_quadrature *q;
    vndf_view view;
    double cosine, sine, roughness, eta, area; /* area: A(wi) */
    double along, square, length;              /* sin_i r, 1 + r^2 and its root: 1/wm.z */
} ring;

/* A(-wo). */
static double area_below(const ring *g, double cos_o)
{
    double square = 1.0 - cos_o * cos_o;
    return vndf_view_area(&g->view, vndf_vec3_of(square > 0.0 ? (float)sqrt(square) : 0.0f, 0.0f, (float)-cos_o));
}

/* The integrands; w = wi.wm/wm.z. */
typedef double integrand(const ring *g, double w);

static double reflected(const ring *g, double w)
{
    double cos_o = 2.0 * w / g->square - g->cosine, f = g->eta > 0.0 ? dielectric(w / g->length, g->eta) : 1.0;
    return cos_o > 0.0 ? f * w * cos_o / (cos_o * g->area + g->cosine * area_below(g, cos_o)) : 0.0;
}

static double transmitted(const ring *g, double w)
{
    double facing = w / g->length, square = refracted_square(facing, g->eta);
    if (!(square > 0.0) || !(g->cosine > 0.0) || !(w > 0.0))
        return 0.0;
    double beyond = sqrt(square), cos_o = g->cosine / g->eta + (beyond - facing / g->eta) / g->length;
    double i = g->area / g->cosine;
    if (!(cos_o > 0.0))
        return 0.0;
    cos_o = cos_o < 1.0 ? cos_o : 1.0;
    return w / g->cosine * (1.0 - dielectric_at(facing, beyond, g->eta)) *
           beta_of(i > 1.0 ? i : 1.0, 1.0 + area_below(g, cos_o) / cos_o);
}

/* Over azimuths whose cosines run from `from` down to `to`, on one side of a right angle. */
static double sum_side(const ring *g, double from, double to, integrand *of)
{
    const vndf_gauss_rule *rule = &g->q->azimuth;
    double side = from > 0.0 ? 1.0 : -1.0, sum = 0.0;
    double begin = sqrt((1.0 - side * from) / (1.0 + side * from)),
           end = sqrt((1.0 - side * to) / (1.0 + side * to));
    for (int i = 0; i < rule->count; i++) {
        double rest = 1.0 - rule->node[i], h = end + (begin - end) * (rest * rest), square = h * h;
        double cosine = side * (1.0 - square) / (1.0 + square);
        sum += rule->weight[i] * rest / (1.0 + square) * of(g, g->cosine + g->along * cosine);
    }
    return 4.0 * fabs(end - begin) * sum;
}

static double sum_azimuths(const ring *g, double from, double to, integrand *of)
{
    if (!(from > to))
        return 0.0;
    if (from > 0.0 && to < 0.0)
        return sum_side(g, from, 0.0, of) + sum_side(g, 0.0, to, of);
    return sum_side(g, from, to, of);
}

/* The cosine of the azimuth where wi.wm/wm.z is w, if there is one, else 1 or -1. */
static double azimuth_of(const ring *g, double w)
{
    double rise = w - g->cosine;
    return rise >= g->along ? 1.0 : rise <= -g->along ? -1.0 : rise / g->along;
}

/* Where eta < 1 the least wi.wm that refracts to below the surface: k at total reflection; beyond it wo.z < 0 while
 * wi.wm > (q^2 + k^2)/(2 q), q = cos_i/wm.z, if q < k. */
static double least_refracted(const ring *g)
{
    double k2 = 1.0 - g->eta * g->eta, q = g->cosine * g->length;
    if (g->eta > 1.0)
        return 0.0;
    return q * q < k2 ? (q * q + k2) / (2.0 * q) : sqrt(k2);
}

/* From straight ahead to where reflection becomes total, if it does; from there to the horizon, where wi.wm/wm.z is
 * cos_i (1 + r^2)/2. */
static double sum_ring(const ring *g)
{
    double horizon = azimuth_of(g, 0.5 * g->cosine * g->square);
    if (g->eta == 0.0)
        return sum_azimuths(g, 1.0, horizon, reflected);
    double total = g->eta < 1.0 ? azimuth_of(g, g->length * sqrt(1.0 - g->eta * g->eta)) : -1.0;
    double cut = total > horizon ? total : horizon;
    double sum = sum_azimuths(g, 1.0, cut, reflected) + sum_azimuths(g, cut, horizon, reflected);
    if (g->cosine > 0.0)
        sum += sum_azimuths(g, 1.0, azimuth_of(g, g->length * least_refracted(g)), transmitted);
    return sum;
}

/* Panels from x0 to x1 in R/(1 + R). */
static double sum_panel(ring *g, double x0, double x1)
{
    const vndf_gauss_rule *rule = &g->q->radial;
    const vndf_surface unit = {g->q->distribution, 1.0f, 1.0f};
    double scale = g->q->scale, sum = 0.0;
    for (int i = 0; i < rule->count; i++) {
        double x = x0 + (x1 - x0) * rule->node[i], z = 1.0 - x, radius = x / z, slope = g->roughness * radius;
        double p22 = scale * scale * (double)vndf_p22(&unit, (float)(radius * scale), 0.0f);
        g->along = g->sine * slope;
        g->square = 1.0 + slope * slope;
        g->length = sqrt(g->square);
        if (p22 > 0.0)
            sum += rule->weight[i] * p22 * radius / (z * z) * sum_ring(g);
    }
    return (x1 - x0) * sum;
}

/* Adds the slopes where the range of azimuths begins to be limited, or is over: tan of the half angle between wi and
 * the horizon, and of its complement; cot of theta_i; with total reflection, tan |theta_c - theta_i| and tan(theta_c +
 * theta_i), which is below 0 beyond a right angle. */
static void add_breaks(const ring *g, double *border, int *count)
{
    double half = g->cosine / (1.0 + g->sine), slopes[5] = {half, 1.0 / half, 0.0, 0.0, 0.0};
    if (g->eta > 0.0 && g->sine > 0.0)
        slopes[2] = g->cosine / g->sine;
    if (g->eta > 0.0 && g->eta < 1.0) {
        double cosine = sqrt(1.0 - g->eta * g->eta), sine = g->eta;
        double less = sine * g->cosine - cosine * g->sine, more = sine * g->cosine + cosine * g->sine;
        slopes[3] = fabs(less) / (cosine * g->cosine + sine * g->sine);
        slopes[4] = more / (cosine * g->cosine - sine * g->sine);
    }
    for (int i = 0; i < 5; i++)
        if (slopes[i] > 0.0)
            add_border(border, count, slopes[i] / (slopes[i] + g->roughness));
}

double vndf_quadrature_albedo(const vndf_quadrature *q, double cosine, double alpha, double eta)
{
    double border[VNDF_QUADRATURE_BORDERS + 5], sum = 0.0, sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    int count = q->borders;
    ring g = {.q = q, .cosine = cosine, .sine = sine, .eta = eta};
    const vndf_surface surface = {q->distribution, (float)alpha, (float)alpha};
    const vndf_vec3 wi = {(float)sine, 0.0f, (float)cosine};
    g.view = vndf_view_from(&surface, wi);
    g.roughness = (double)(float)alpha * q->scale;
    g.area = vndf_view_area(&g.view, wi);
    memcpy(border, q->border, sizeof q->border);
    add_breaks(&g, border, &count);
    for (int j = 0; j + 1 < count; j++)
        sum += sum_panel(&g, border[j], border[j + 1]);
    return 2.0 * sum;
}
