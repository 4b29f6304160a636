#include "evidence/measure/measure.h"

#include <math.h>

#include "cli/subject.h"

static uint32_t reverse(uint32_t x)
{
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
}

/* The second dimension; the first is the reversed index. Column k is v_k = v_(k-1) ^ (v_(k-1) >> 1). */
static uint32_t second_dimension(uint32_t index)
{
    uint32_t x = 0;
    for (uint32_t column = 0x80000000u; index; index >>= 1, column ^= column >> 1)
        x ^= index & 1 ? column : 0;
    return x;
}

/* A nested uniform scramble: in reversed bits each is flipped by a hash of those below it (Laine & Karras 2011,
 * with the constants of Vegdahl). */
static uint32_t scrambled(uint32_t x, uint32_t seed)
{
    x = reverse(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse(x);
}

static uint32_t hash(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ x >> 16;
}

void stratified_point(uint32_t index, uint32_t scramble, float *u1, float *u2)
{
    *u1 = (float)(scrambled(reverse(index), hash(scramble)) >> 8) * 0x1p-24f;
    *u2 = (float)(scrambled(second_dimension(index), hash(scramble ^ 0x5bd1e995u)) >> 8) * 0x1p-24f;
}

/* Lights: a sky that brightens upwards, and a disc that a glossy surface mirrors, with a soft edge. */
enum { BROAD, SMALL, LIGHTS };

/* The root mean square error of each light over so many scrambled sequences of so many points, relative to the mean; 0
 * where next to nothing is reflected there. The lobe of what is mirrored is twice the median slope wide, at most a
 * quarter turn. The small light stands where a mirror would see it, a little aside; its radius is that of the lobe. */
static void errors_of(const vndf_surface *surface, vndf_vec3 wi, size_t points, size_t scrambles, uint64_t seed,
                      double error[LIGHTS])
{
    const double scale = vndf_distribution_info(surface->distribution).scale, n = (double)scrambles;
    const double width = fmin(1, (scale > 0 ? scale : 1) * (double)surface->xx);
    const vndf_view view = vndf_view_from(surface, wi);
    double sum[LIGHTS] = {0}, squares[LIGHTS] = {0};
    for (size_t i = 0; i < scrambles; i++) {
        double value[LIGHTS] = {0};
        for (size_t j = 0; j < points; j++) {
            float u1, u2, weight;
            stratified_point((uint32_t)j, hash((uint32_t)seed + (uint32_t)i * 0x9e3779b9u), &u1, &u2);
            const vndf_vec3 wm = vndf_sample_weight(&view, u1, u2, NULL, &weight);
            const float twice = 2 * (wi.x * wm.x + wi.y * wm.y + wi.z * wm.z);
            const vndf_vec3 wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
            const double x = wo.x + wi.x - 0.3 * width, y = wo.y + wi.y - 0.2 * width, z = wo.z - wi.z;
            const double share = wo.z > 0 ? (double)weight / (double)points : 0;
            value[BROAD] += share * (0.3 + 0.7 * wo.z * wo.z + 0.2 * wo.x);
            value[SMALL] += share / (1 + exp(8 * (sqrt(x * x + y * y + z * z) / width - 1)));
        }
        for (int k = 0; k < LIGHTS; k++) {
            sum[k] += value[k];
            squares[k] += value[k] * value[k];
        }
    }
    for (int k = 0; k < LIGHTS; k++) {
        const double mean = sum[k] / n;
        error[k] = mean > 1e-4 ? sqrt(fmax(0, squares[k] / n - mean * mean)) / mean : 0;
    }
}

double stratified_beside_caps(const vndf_distribution *distribution, float alpha, size_t scrambles, uint64_t seed)
{
    enum { VIEWS = 6 };
    static const double thetas[VIEWS] = {5, 25, 45, 60, 75, 85};
    const double scale = vndf_distribution_info(distribution).scale;
    const float same = alpha * (float)(scale > 0 ? scale : 1);
    const vndf_surface ours = vndf_rough(distribution, alpha, alpha), caps = vndf_rough(vndf_ggx(), same, same);
    double sum = 0;
    for (int i = 0; i < VIEWS; i++) {
        const vndf_vec3 wi = direction_from(thetas[i], 36.87);
        double a[LIGHTS], b[LIGHTS];
        errors_of(&ours, wi, 64, scrambles, seed, a);
        errors_of(&caps, wi, 64, scrambles, seed + 1, b);
        for (int k = 0; k < LIGHTS; k++)
            sum += a[k] > 0 && b[k] > 0 ? log(a[k] / b[k]) : 0;
    }
    return exp(sum / (VIEWS * LIGHTS));
}
