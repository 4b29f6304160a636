#include "evidence/measure/stress.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "cli/random.h"
#include "cli/sort.h"
#include "cli/subject.h"

/* Below it certificates do not measure either: the whole lobe is the far end of a tail. */
static const float least_area = 1e-12f;

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

int stress_note(stress_result *result, stress_id id, double value, const stress_point *at)
{
    stress_finding *found = &result->found[id];
    int good = value <= stress_properties[id].limit; /* not for NaN */
    if (found->checked++ == 0 || !(value <= found->worst)) {
        found->worst = isnan(value) ? INFINITY : value;
        found->at = *at;
    }
    found->failed += !good;
    return good;
}

/* ---- samples ------------------------------------------------------------------------------------- */

static double length_of(vndf_vec3 w)
{
    return sqrt((double)w.x * (double)w.x + (double)w.y * (double)w.y + (double)w.z * (double)w.z);
}

/* How far a normal is turned away from wi, in 2^-24. */
static double turned_away(vndf_vec3 wi, vndf_vec3 wm)
{
    double x = (double)wi.x * (double)wm.x, y = (double)wi.y * (double)wm.y, z = (double)wi.z * (double)wm.z;
    double size = fabs(x) + fabs(y) + fabs(z);
    return size > 0 ? -(x + y + z) / size * 0x1p24 : 0;
}

static int is_density(float pdf)
{
    return pdf > 0 && pdf <= FLT_MAX;
}

static void measure_sample(const vndf_view *view, const stress_point *at, stress_result *result)
{
    float pdf = -1, u1 = -1, u2 = -1;
    vndf_vec3 wm = vndf_sample(view, at->u1, at->u2, &pdf);
    int blind = at->wi.x == 0 && at->wi.y == 0 && at->wi.z < 0; /* from straight below no normal is visible */
    int dense = blind ? pdf == 0 : is_density(pdf) && is_density(vndf_pdf(view, wm));
    result->samples++;
    vndf_invert(view, wm, &u1, &u2);
    stress_note(result, STRESS_UNIT, fabs(length_of(wm) - 1) * 0x1p23, at);
    stress_note(result, STRESS_ABOVE, -(double)wm.z, at);
    stress_note(result, STRESS_FACING, blind ? 0 : turned_away(at->wi, wm), at);
    stress_note(result, STRESS_POSITIVE, !dense, at);
    stress_note(result, STRESS_RETURNED, !(u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1), at);
}

/* ---- directions ---------------------------------------------------------------------------------- */

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

static double g2_error(const stress_point *at)
{
    const vndf_affine *m = &at->surface;
    double apart = (double)vndf_affine_g2(m, at->wi, at->wo, VNDF_G2_SEPARABLE);
    double joint = (double)vndf_affine_g2(m, at->wi, at->wo, VNDF_G2_HEIGHT_CORRELATED);
    double least = fmin((double)vndf_affine_g1(m, at->wi), (double)vndf_affine_g1(m, at->wo));
    if (!(apart >= 0 && apart <= 1 && joint >= 0 && joint <= 1))
        return INFINITY;
    return least > 0 ? fmax(apart - joint, joint - least) / least : apart + joint;
}

/* Of surfaces without a mean slope. */
static void measure_direction(const stress_point *at, stress_result *result)
{
    const vndf_affine *m = &at->surface;
    vndf_vec3 back = {-at->wi.x, -at->wi.y, -at->wi.z};
    double cosine = (double)at->wi.z / length_of(at->wi), up = fmax(cosine, 0);
    float a = vndf_affine_projected_area(m, at->wi), b = vndf_affine_projected_area(m, back);
    float lambda = vndf_affine_lambda(m, at->wi), mirrored = vndf_affine_lambda(m, back);
    double area = (double)a, largest = fmax(area, (double)b), miss = fabs(area - (double)b - cosine);
    stress_note(result, STRESS_AREA, a >= 0 && a <= FLT_MAX ? (up - area) / (up > 0 ? up : 1) : INFINITY, at);
    stress_note(result, STRESS_MIRRORED, largest > 0 ? miss / largest : fabs(cosine), at);
    stress_note(result, STRESS_LAMBDA, lambda_error(at->wi, lambda, mirrored), at);
    stress_note(result, STRESS_G1, g1_error(at->wi, vndf_affine_g1(m, at->wi), lambda), at);
    stress_note(result, STRESS_G2, g2_error(at), at);
}

/* ---- the product --------------------------------------------------------------------------------- */

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

/* Of all pairs of edges, if they are asked for, and of random numbers. */
static void run_view(stress_point *at, random_stream *stream, size_t edged, stress_result *result)
{
    vndf_view view = vndf_affine_view_from(&at->surface, at->wi);
    result->views++;
    for (size_t i = 0; i < edged + RANDOM; i++) {
        at->u1 = i < edged ? edges[i / COUNT(edges)] : hard_float(stream);
        at->u2 = i < edged ? edges[i % COUNT(edges)] : hard_float(stream);
        measure_sample(&view, at, result);
    }
}

/* A distribution's median slope, which divides its roughness: 1 where that is unknown. */
static double scale_of(const vndf_distribution *d)
{
    double scale = vndf_distribution_info(d).scale;
    return scale > 0 ? scale : 1;
}

static void run_product(const vndf_distribution *d, size_t every, random_stream *stream, stress_result *result)
{
    const float scale = (float)scale_of(d);
    for (size_t i = 0; i < COUNT(roughnesses) * COUNT(roughnesses) * DIRECTIONS; i += every) {
        const float x = roughnesses[i / DIRECTIONS / COUNT(roughnesses)],
                    y = roughnesses[i / DIRECTIONS % COUNT(roughnesses)], low = fminf(x, y), high = fmaxf(x, y);
        stress_point at = {.surface = {d, x, 0, 0, y, 0, 0}, .wi = direction(i % DIRECTIONS)};
        if (high > 1.0001e8f * low)
            continue;
        if (low * scale < 1e-15f || high * scale > 1e15f) {
            result->outside++;
            continue;
        }
        at.wo = direction((size_t)(random_bits(stream) % DIRECTIONS));
        run_view(&at, stream, COUNT(edges) * COUNT(edges), result);
        measure_direction(&at, result);
    }
}

/* ---- random surfaces ----------------------------------------------------------------------------- */

static const double turn = 6.28318530717958648;

/* Between two positive numbers, evenly in the logarithm. */
static double log_even(random_stream *stream, double low, double high)
{
    return low * pow(high / low, random_double(stream));
}

/* R(a) diag(most, least) R(b), one in two mirrored, divided by the scale of the distribution. */
static vndf_affine random_surface(const vndf_distribution *d, random_stream *stream)
{
    double most = log_even(stream, 1e-5, 10), least = most / log_even(stream, 1, fmin(1e4, most / 1e-5));
    double a = turn * random_double(stream), b = turn * random_double(stream), c = turn * random_double(stream);
    double side = random_bits(stream) & 1 ? 1 : -1, scale = scale_of(d);
    double mean = random_bits(stream) % 8 == 0 ? 0 : 2 * random_double(stream);
    most /= scale;
    least *= side / scale;
    return (vndf_affine){d,
                         (float)(cos(a) * most * cos(b) - sin(a) * least * sin(b)),
                         (float)(-cos(a) * most * sin(b) - sin(a) * least * cos(b)),
                         (float)(sin(a) * most * cos(b) + cos(a) * least * sin(b)),
                         (float)(-sin(a) * most * sin(b) + cos(a) * least * cos(b)),
                         (float)(mean * cos(c)),
                         (float)(mean * sin(c))};
}

/* Anywhere, evenly in the angle; on the horizon, up or down; or in the mean plane. */
static vndf_vec3 random_direction(const vndf_affine *surface, random_stream *stream)
{
    static const float heights[] = {0.0f, 1e-7f, -1e-7f, 1e-42f, -1e-42f};
    double phi = 360 * random_double(stream);
    vndf_vec3 level = direction_from(90, phi);
    double up = (double)level.x * (double)surface->mean_x + (double)level.y * (double)surface->mean_y;
    switch (random_bits(stream) % 8) {
    case 0: level.z = heights[random_bits(stream) % 5]; return level;
    case 1: return direction_from(random_bits(stream) & 1 ? 0 : 180, 0);
    case 2: return direction_from(90 - atan(up) / turn * 360, phi);
    default: return direction_from(180 * random_double(stream), phi);
    }
}

stress_result stress_run(const vndf_distribution *distribution, size_t every, size_t random, uint64_t seed)
{
    stress_result result = {.views = 0};
    random_stream stream = random_from(seed);
    run_product(distribution, every, &stream, &result);
    for (size_t i = 0; i < random; i++) {
        stress_point at = {.surface = random_surface(distribution, &stream)};
        at.wi = random_direction(&at.surface, &stream);
        run_view(&at, &stream, 0, &result);
    }
    return result;
}

/* ---- agreement ----------------------------------------------------------------------------------- */

/* One rounding of a normal changes the density by the slope of D there: a lobe a tenth of its slope wide has
 * some 20 for d log P22 / d log r. */
static int is_steep(const vndf_surface *surface, vndf_vec3 wm)
{
    const float x = wm.x / wm.z, y = wm.y / wm.z;
    const double high = (double)vndf_p22(surface, 1.01f * x, 1.01f * y),
                 low = (double)vndf_p22(surface, 0.99f * x, 0.99f * y);
    return !(high > 0 && low > 0 && fabs(log(high / low)) < 20 * 0.02);
}

/* The distance of two normals, slopes over roughness. */
static double distance_of(const vndf_surface *surface, double scale, vndf_vec3 a, vndf_vec3 b)
{
    const double ax = scale * (double)surface->alpha_x, ay = scale * (double)surface->alpha_y;
    const double p[3] = {(double)a.x / ax, (double)a.y / ay, (double)a.z};
    const double q[3] = {(double)b.x / ax, (double)b.y / ay, (double)b.z};
    const double long_p = hypot(hypot(p[0], p[1]), p[2]), long_q = hypot(hypot(q[0], q[1]), q[2]);
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (p[i] / long_p - q[i] / long_q) * (p[i] / long_p - q[i] / long_q);
    return isnan(sum) ? INFINITY : sqrt(sum);
}

/* The distance of the normal and that of its numbers; 0 if the numbers themselves are back. */
static double invert_difference(const vndf_view *view, const vndf_surface *surface, double scale, const float u[2],
                                vndf_vec3 wm)
{
    float u1, u2;
    vndf_invert(view, wm, &u1, &u2);
    if (!(u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1))
        return INFINITY;
    if (fmaxf(fabsf(u1 - u[0]), fabsf(u2 - u[1])) <= 8 * 0x1p-24f)
        return 0;
    return distance_of(surface, scale, wm, vndf_sample(view, u1, u2, NULL));
}

/* Angles uniform, not the sphere: grazing and steep directions are where things break. */
int stress_agree(const vndf_distribution *distribution, size_t points, uint64_t seed,
                 stress_agreement found[STRESS_AGREEMENTS])
{
    double scale = scale_of(distribution), *room = malloc(STRESS_AGREEMENTS * points * sizeof *room);
    random_stream stream = random_from(seed);
    for (int k = 0; k < STRESS_AGREEMENTS; k++)
        found[k] = (stress_agreement){.measured = 0};
    for (size_t i = 0; room && i < points; i++) {
        const double theta = 180 * random_double(&stream), phi = 360 * random_double(&stream);
        const double x = pow(0.02, random_double(&stream)), y = pow(0.02, random_double(&stream));
        const float u1 = random_float(&stream), u2 = random_float(&stream), u[2] = {u1, u2};
        const vndf_surface surface = {distribution, (float)(x / scale), (float)(y / scale)};
        const vndf_vec3 wi = direction_from(theta, phi);
        const size_t side = wi.z >= 0 ? STRESS_ABOVE_HORIZON : STRESS_BELOW_HORIZON;
        if (vndf_projected_area(&surface, wi) < least_area)
            continue;
        float pdf;
        const vndf_view view = vndf_view_from(&surface, wi);
        const vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
        room[STRESS_INVERTED * points + found[STRESS_INVERTED].measured++] =
            invert_difference(&view, &surface, scale, u, wm);
        if (!is_steep(&surface, wm))
            room[side * points + found[side].measured++] = fabs((double)vndf_pdf(&view, wm) / (double)pdf - 1);
    }
    for (size_t k = 0; room && k < STRESS_AGREEMENTS; k++) {
        double *of = room + k * points, last = (double)found[k].measured - 1;
        sort_numbers(of, found[k].measured);
        found[k].usual = last >= 0 ? of[(size_t)(0.999 * last)] : 0;
        found[k].rare = last >= 0 ? of[(size_t)(0.9999 * last)] : 0;
    }
    free(room);
    return room != NULL;
}
