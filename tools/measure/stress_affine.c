#include "measure/stress_affine.h"

#include <math.h>

#include "cli/random.h"
#include "cli/subject.h"

enum { NUMBERS = 16 };
static const double most_condition = 1e4, least_value = 1e-5, most_value = 10, most_mean = 2;

static const double turn = 6.28318530717958648;

/* Between two positive numbers, evenly in the logarithm. */
static double log_even(random_stream *stream, double low, double high)
{
    return low * pow(high / low, random_double(stream));
}

/* R(a) diag(most, least) R(b), one in two mirrored, divided by the scale of the distribution. */
static vndf_affine random_surface(const vndf_distribution *d, random_stream *stream)
{
    double most = log_even(stream, least_value, most_value), mean = most_mean * random_double(stream);
    double least = most / log_even(stream, 1, fmin(most_condition, most / least_value));
    double a = turn * random_double(stream), b = turn * random_double(stream), c = turn * random_double(stream);
    double side = random_bits(stream) & 1 ? 1 : -1, scale = vndf_distribution_info(d).scale;
    if (random_bits(stream) % 8 == 0)
        mean = 0;
    most /= scale > 0 ? scale : 1;
    least *= side / (scale > 0 ? scale : 1);
    vndf_affine m = {d,
                     (float)(cos(a) * most * cos(b) - sin(a) * least * sin(b)),
                     (float)(-cos(a) * most * sin(b) - sin(a) * least * cos(b)),
                     (float)(sin(a) * most * cos(b) + cos(a) * least * sin(b)),
                     (float)(-sin(a) * most * sin(b) + cos(a) * least * cos(b)),
                     (float)(mean * cos(c)),
                     (float)(mean * sin(c))};
    return m;
}

/* Of unit length: anywhere, evenly in the angle, or where things break. */
static vndf_vec3 random_direction(const vndf_affine *surface, random_stream *stream)
{
    static const float heights[] = {0.0f, 1e-7f, -1e-7f, 1e-42f, -1e-42f};
    double phi = 360 * random_double(stream);
    vndf_vec3 level = direction_from(90, phi);
    switch (random_bits(stream) % 8) {
    case 0: level.z = heights[random_bits(stream) % 5]; return level;
    case 1: return direction_from(random_bits(stream) & 1 ? 0 : 180, 0);
    case 2: { /* the mean plane */
        double up = (double)level.x * (double)surface->mean_x + (double)level.y * (double)surface->mean_y;
        return direction_from(90 - atan(up) / turn * 360, phi);
    }
    default: return direction_from(180 * random_double(stream), phi);
    }
}

/* At an end, beside one, or anywhere. */
static float random_number(random_stream *stream)
{
    static const float ends[] = {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f, 1.0f};
    float u = random_float(stream), near = exp2f(20 * u - 22);
    switch (random_bits(stream) % 4) {
    case 0: return ends[random_bits(stream) % 5];
    case 1: return near;
    case 2: return 1 - near;
    default: return u;
    }
}

/* ---- properties ---- */

static void note(stress_affine_result *result, stress_id id, double value, const stress_affine_finding *at)
{
    stress_affine_finding *found = &result->found[id];
    size_t failed = found->failed + !(value <= stress_property_of(id)->limit); /* also of NaN */
    if (result->samples == 1 || !(value <= found->worst)) {
        *found = *at;
        found->worst = isnan(value) ? INFINITY : value;
    }
    found->failed = failed;
}

static void measure_sample(const vndf_affine_view *view, const stress_affine_finding *at,
                           stress_affine_result *result)
{
    float pdf = -1;
    vndf_vec3 wm = vndf_affine_sample(view, at->u1, at->u2, &pdf);
    result->samples++;
    note(result, STRESS_UNIT, fabs(stress_length(wm) - 1) * 0x1p23, at);
    note(result, STRESS_ABOVE, -(double)wm.z, at);
    note(result, STRESS_FACING, stress_turned_away(at->wi, wm), at);
    note(result, STRESS_POSITIVE, stress_wrong_density(at->wi, pdf), at);
    note(result, STRESS_REPEATED, pdf > 0 ? fabs((double)vndf_affine_pdf(view, wm) / (double)pdf - 1) : 0, at);
}

void stress_affine_run(const vndf_distribution *distribution, size_t views, uint64_t seed,
                       stress_affine_result *result)
{
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < views; i++) {
        stress_affine_finding at = {.surface = random_surface(distribution, &stream)};
        at.wi = random_direction(&at.surface, &stream);
        vndf_affine_view view = vndf_affine_view_from(&at.surface, at.wi);
        result->views++;
        for (int k = 0; k < NUMBERS; k++) {
            at.u1 = random_number(&stream);
            at.u2 = random_number(&stream);
            measure_sample(&view, &at, result);
        }
    }
}
