/* Two images of one integral: the light that a surface mirrors towards wi, E[light(wo)], wo the mirror image of wi about
 * a visible normal. The broad light is a smooth lobe, the small one a disc beside the mirror direction. The error of
 * each estimate is relative to its own mean, found with 65536 points.
 *
 * Points: the first two dimensions of Sobol' (1967), scrambled as Owen (1995) proposes by the hash of Laine & Karras,
 * "Stratified Sampling for Stochastic Transparency" (EGSR 2011). Caps: Dupuy & Benyoub (HPG 2023). */
#include "measure/stratified_error.h"

#include <math.h>
#include <stdint.h>

#include "cli/subject.h"

enum { SCRAMBLES = 64, REFERENCE_POINTS = 4096, REFERENCE_SCRAMBLES = 16 };

static const double pi = 3.14159265358979323846;

/* The incident angle, and roughness over the median slope of D. */
static const struct {
    double theta, alpha;
} views[] = {{20, 0.5}, {50, 0.5}, {75, 0.5}, {60, 0.15}, {80, 0.15}, {40, 1}};

enum { VIEWS = sizeof views / sizeof *views };

/* ---- points -------------------------------------------------------------------------------------- */

static uint32_t reversed(uint32_t x)
{
    uint32_t y = 0;
    for (int i = 0; i < 32; i++, x >>= 1)
        y = y << 1 | (x & 1u);
    return y;
}

/* Each bit is flipped or not by a hash of the bits above it. */
static uint32_t scrambled(uint32_t x, uint32_t seed)
{
    x = reversed(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
}

static uint32_t second_dimension(uint32_t index)
{
    uint32_t x = 0, direction = 0x80000000u;
    for (; index; index >>= 1, direction ^= direction >> 1)
        x ^= index & 1u ? direction : 0;
    return x;
}

static void point_at(uint32_t index, uint32_t scramble, float u[2])
{
    u[0] = (float)(scrambled(reversed(index), 0x9e3779b9u * (2 * scramble + 1)) >> 8) * 0x1p-24f;
    u[1] = (float)(scrambled(second_dimension(index), 0x85ebca6bu * (2 * scramble + 2)) >> 8) * 0x1p-24f;
}

/* ---- normals ------------------------------------------------------------------------------------- */

typedef struct mirror_view {
    const vndf_distribution *distribution; /* NULL: spherical caps */
    vndf_view view;
    vndf_vec3 wi, light;
    double alpha;
    int broad;
} mirror_view;

static vndf_vec3 cap_normal(const mirror_view *v, const float u[2])
{
    double x = v->alpha * (double)v->wi.x, z = (double)v->wi.z, length = sqrt(x * x + z * z);
    double phi = 2 * pi * (double)u[0], height = (1 - (double)u[1]) * (1 + z / length) - z / length;
    double across = sqrt(fmax(0, 1 - height * height));
    double m[3] = {v->alpha * (across * cos(phi) + x / length), v->alpha * across * sin(phi), height + z / length};
    length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    return (vndf_vec3){(float)(m[0] / length), (float)(m[1] / length), (float)(m[2] / length)};
}

static double light_at(const mirror_view *v, const float u[2])
{
    float weight = 1;
    vndf_vec3 wm = v->distribution ? vndf_sample_weight(&v->view, u[0], u[1], NULL, &weight) : cap_normal(v, u);
    double wi_m = (double)v->wi.x * (double)wm.x + (double)v->wi.y * (double)wm.y + (double)v->wi.z * (double)wm.z;
    double x = 2 * wi_m * (double)wm.x - (double)v->wi.x, y = 2 * wi_m * (double)wm.y - (double)v->wi.y;
    double z = 2 * wi_m * (double)wm.z - (double)v->wi.z;
    double cosine = x * (double)v->light.x + y * (double)v->light.y + z * (double)v->light.z;
    return (double)weight * (v->broad ? (1 + cosine) * (1 + cosine) : cosine > cos(10 * pi / 180));
}

/* ---- errors -------------------------------------------------------------------------------------- */

static double estimate(const mirror_view *v, unsigned points, uint32_t scramble)
{
    double sum = 0;
    for (uint32_t i = 0; i < points; i++) {
        float u[2];
        point_at(i, scramble, u);
        sum += light_at(v, u);
    }
    return sum / points;
}

/* NaN where the light is hardly seen. */
static double relative_error(const mirror_view *v, unsigned points)
{
    double mean = 0, square = 0;
    for (uint32_t i = 0; i < REFERENCE_SCRAMBLES; i++)
        mean += estimate(v, REFERENCE_POINTS, 1000 + i) / REFERENCE_SCRAMBLES;
    for (uint32_t i = 0; i < SCRAMBLES; i++)
        square += pow(estimate(v, points, i) - mean, 2) / SCRAMBLES;
    return mean > 1e-3 ? sqrt(square) / mean : NAN;
}

double vndf_stratified_error(const vndf_distribution *distribution, unsigned points)
{
    double scale = vndf_distribution_info(distribution).scale, logs = 0;
    int count = 0;
    for (int i = 0; i < 2 * VIEWS; i++) {
        mirror_view v = {.wi = direction_from(views[i / 2].theta, 0), .alpha = views[i / 2].alpha, .broad = i % 2};
        v.light = direction_from(views[i / 2].theta, 180 + (v.broad ? 60 : 10));
        double of_caps = relative_error(&v, points);
        float alpha = (float)(v.alpha / (scale > 0 ? scale : 1));
        v.distribution = distribution;
        v.view = vndf_view_from(&(vndf_surface){distribution, alpha, alpha}, v.wi);
        double ratio = relative_error(&v, points) / of_caps;
        if (ratio > 0) {
            logs += log(ratio);
            count++;
        }
    }
    return count ? exp(logs / count) : NAN;
}
