#include "evidence/measure/measure.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "cli/random.h"
#include "cli/subject.h"

const stress_property stress_properties[STRESS_COUNT] = {
    {"unit", "|length - 1| in ulps of 2^-23", 4},
    {"above", "-wm.z", 0},
    {"facing", "-wi.wm over the sum of |terms|, in 2^-24", 2},
    {"positive", "1 where the density is not finite and > 0, or pdf of the normal is not", 0},
    {"returned", "1 where invert gives numbers outside [0, 1]", 0},
    {"area", "A < max(0, cos), relative, or not finite", 2e-6},
    {"mirrored", "|A(w) - A(-w) - cos|/A", 3e-5},
    {"lambda", "Lambda < 0 above, |Lambda(-w) + 1 + Lambda(w)|/(1 + |Lambda|)", 3e-5},
    {"g1", "G1 outside [0, 1], |G1 (1 + Lambda) - 1|", 2e-6},
    {"g2", "G2 outside [0, 1]; separable <= correlated <= least G1", 2e-6},
};

const char *const stress_numbers[STRESS_NUMBERS] = {"alpha_x", "alpha_y", "wi_x", "wi_y", "wi_z",
                                                    "wo_x",    "wo_y",    "wo_z", "u1",   "u2"};

int stress_note(stress_result *result, stress_id id, double value, const float at[STRESS_NUMBERS])
{
    stress_finding *found = &result->found[id];
    int good = value <= stress_properties[id].limit; /* not for NaN */
    if (found->checked++ == 0 || !(value <= found->worst)) {
        found->worst = isnan(value) ? INFINITY : value;
        memcpy(found->number, at, sizeof found->number);
    }
    found->failed += !good;
    return good;
}

static double dot_of(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

static double turned_away(vndf_vec3 wi, vndf_vec3 wm)
{
    const vndf_vec3 a = {fabsf(wi.x), fabsf(wi.y), fabsf(wi.z)}, b = {fabsf(wm.x), fabsf(wm.y), fabsf(wm.z)};
    const double size = dot_of(a, b);
    return size > 0 ? -dot_of(wi, wm) / size * 0x1p24 : 0;
}

static int is_density(float pdf)
{
    return pdf > 0 && pdf <= FLT_MAX;
}

static void measure_sample(const vndf_view *view, vndf_vec3 wi, const float at[STRESS_NUMBERS],
                           stress_result *result)
{
    float pdf = -1, v1 = -1, v2 = -1;
    vndf_vec3 wm = vndf_sample(view, at[8], at[9], &pdf);
    const double level = fabs((double)at[0] * (double)wi.x) + fabs((double)at[1] * (double)wi.y);
    const double scale = fmax(vndf_distribution_info(view->distribution).scale, 1e-30);
    int blind = level * scale <= -1e-15 * (double)wi.z; /* from straight below no normal is visible */
    int dense = blind ? pdf == 0 : is_density(pdf) && is_density(vndf_pdf(view, wm));
    result->samples++;
    vndf_invert(view, wm, &v1, &v2);
    stress_note(result, STRESS_UNIT, fabs(sqrt(dot_of(wm, wm)) - 1) * 0x1p23, at);
    stress_note(result, STRESS_ABOVE, -(double)wm.z, at);
    stress_note(result, STRESS_FACING, blind ? 0 : turned_away(wi, wm), at);
    stress_note(result, STRESS_POSITIVE, !dense, at);
    stress_note(result, STRESS_RETURNED, !(v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1), at);
}

/* On the horizon itself Lambda is the largest float of either sign. */
static double lambda_error(vndf_vec3 wi, float lambda, float back)
{
    if (wi.z == 0)
        return fabsf(lambda) == FLT_MAX && fabsf(back) == FLT_MAX ? 0 : INFINITY;
    if (wi.z > 0 && !(lambda >= 0))
        return INFINITY;
    return fabs((double)lambda + 1 + (double)back) / (1 + fabs((double)lambda));
}

static double g1_error(vndf_vec3 wi, float g1, float lambda)
{
    if (!(g1 >= 0 && g1 <= 1) || (wi.z <= 0 && g1 != 0))
        return INFINITY;
    return wi.z > 0 && lambda < 1e30f ? fabs((double)g1 * (1 + (double)lambda) - 1) : 0;
}

static double g2_error(const vndf_surface *m, vndf_vec3 wi, vndf_vec3 wo)
{
    double apart = (double)vndf_g2(m, wi, wo, VNDF_G2_SEPARABLE),
           joint = (double)vndf_g2(m, wi, wo, VNDF_G2_HEIGHT_CORRELATED);
    double least = fmin((double)vndf_g1(m, wi), (double)vndf_g1(m, wo));
    if (!(apart >= 0 && apart <= 1 && joint >= 0 && joint <= 1))
        return INFINITY;
    return least > 0 ? fmax(apart - joint, joint - least) / least : apart + joint;
}

static void measure_direction(const vndf_surface *m, vndf_vec3 wi, vndf_vec3 wo, const float at[STRESS_NUMBERS],
                              stress_result *result)
{
    vndf_vec3 back = {-wi.x, -wi.y, -wi.z};
    double cosine = (double)wi.z / sqrt(dot_of(wi, wi)), up = fmax(cosine, 0);
    float a = vndf_projected_area(m, wi), b = vndf_projected_area(m, back);
    float lambda = vndf_lambda(m, wi), mirrored = vndf_lambda(m, back);
    double area = (double)a, largest = fmax(area, (double)b), miss = fabs(area - (double)b - cosine);
    stress_note(result, STRESS_AREA, a >= 0 && a <= FLT_MAX ? (up - area) / (up > 0 ? up : 1) : INFINITY, at);
    stress_note(result, STRESS_MIRRORED, largest > 0 ? miss / largest : fabs(cosine), at);
    stress_note(result, STRESS_LAMBDA, lambda_error(wi, lambda, mirrored), at);
    stress_note(result, STRESS_G1, g1_error(wi, vndf_g1(m, wi), lambda), at);
    stress_note(result, STRESS_G2, g2_error(m, wi, wo), at);
}

/* From the pole down: an angle in degrees or, at 90 degrees, the cosine. */
static const struct {
    double degrees;
    float cosine;
} angles[] = {{0, 1},       {1e-7, 1},  {1e-4, 1},   {0.01, 1},     {30, 1},       {60, 1},
              {85, 1},      {89, 1},    {89.9, 1},   {89.9999, 1},  {90, 1e-7f},   {90, 1e-20f},
              {90, 1e-42f}, {90, 0.0f}, {90, -0.0f}, {90, -1e-42f}, {90, -1e-20f}, {90, -1e-7f},
              {91, 1},      {130, 1},   {179.9, 1},  {180, 1}};
static const double azimuths[] = {0, 90, 45, 200};
static const double lengths[] = {1, 1 + 1e-6, 1 - 1e-6};
static const float roughnesses[] = {1e-8f, 1e-6f, 1e-4f, 1e-2f, 0.1f, 0.5f, 1, 2, 10, 1e4f};
static const float edges[] = {0.0f, FLT_TRUE_MIN,    0x1p-24f,     0.5f - 0x1p-25f,
                              0.5f, 0.5f + 0x1p-24f, 1 - 0x1p-24f, 1.0f};

#define COUNT(array) (sizeof(array) / sizeof *(array))

enum { DIRECTIONS = COUNT(angles) * COUNT(azimuths) * COUNT(lengths), RANDOM = 16 };

/* A direction of the list: angles vary slowest. */
static vndf_vec3 direction(size_t index)
{
    size_t angle = index / (COUNT(azimuths) * COUNT(lengths));
    vndf_vec3 w = direction_from(angles[angle].degrees, azimuths[index / COUNT(lengths) % COUNT(azimuths)]);
    double length = lengths[index % COUNT(lengths)];
    if (angles[angle].degrees == 90)
        w.z = angles[angle].cosine;
    return (vndf_vec3){(float)(length * (double)w.x), (float)(length * (double)w.y),
                       (float)(length * (double)w.z)};
}

/* As often within 2^-2 of an end, the nearer the likelier, as anywhere: there one step of a number leads far. */
static float hard_float(random_stream *stream)
{
    unsigned long long which = random_bits(stream) >> 62;
    float u = random_float(stream), near = exp2f(20 * u - 22);
    return which < 2 ? u : which == 2 ? near : 1 - near;
}

stress_result stress_run(const vndf_distribution *distribution, size_t every, uint64_t seed)
{
    const double scale = vndf_distribution_info(distribution).scale; /* 0: unknown */
    const size_t edged = COUNT(edges) * COUNT(edges);
    stress_result result = {.views = 0};
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < COUNT(roughnesses) * COUNT(roughnesses) * DIRECTIONS; i += every) {
        const float x = roughnesses[i / DIRECTIONS / COUNT(roughnesses)],
                    y = roughnesses[i / DIRECTIONS % COUNT(roughnesses)], low = fminf(x, y), high = fmaxf(x, y);
        if (high > 1.0001e8f * low)
            continue;
        if (scale > 0 && ((double)low * scale < 1e-15 || (double)high * scale > 1e15)) {
            result.outside++;
            continue;
        }
        const vndf_surface surface = vndf_rough(distribution, x, y);
        const vndf_vec3 wi = direction(i % DIRECTIONS),
                        wo = direction((size_t)(random_bits(&stream) % DIRECTIONS));
        const vndf_view view = vndf_view_from(&surface, wi);
        float at[STRESS_NUMBERS] = {x, y, wi.x, wi.y, wi.z, wo.x, wo.y, wo.z, 0, 0};
        result.views++;
        for (size_t k = 0; k < edged + RANDOM; k++) { /* all pairs of edges, and random numbers */
            at[8] = k < edged ? edges[k / COUNT(edges)] : hard_float(&stream);
            at[9] = k < edged ? edges[k % COUNT(edges)] : hard_float(&stream);
            measure_sample(&view, wi, at, &result);
        }
        measure_direction(&surface, wi, wo, at, &result);
    }
    return result;
}
