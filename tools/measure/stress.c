#include "measure/stress.h"

#include <float.h>
#include <math.h>

#include "cli/subject.h"
#include "cli/random.h"

/* From the pole down: an angle in degrees or, at 90 degrees, the cosine. */
typedef struct stress_angle {
    double degrees;
    float cosine;
} stress_angle;

static const stress_angle angles[] = {
    {0, 1},        {1e-7, 1},    {1e-4, 1},   {0.01, 1},    {30, 1},      {60, 1},    {85, 1},     {89, 1},
    {89.9, 1},     {89.9999, 1}, {90, 1e-7f}, {90, 1e-20f}, {90, 1e-42f}, {90, 0.0f}, {90, -0.0f}, {90, -1e-42f},
    {90, -1e-20f}, {90, -1e-7f}, {91, 1},     {130, 1},     {179.9, 1},   {180, 1}};
static const double azimuths[] = {0, 90, 45, 200};
static const double lengths[] = {1, 1 + 1e-6, 1 - 1e-6};
static const float roughnesses[] = {1e-8f, 1e-6f, 1e-4f, 1e-2f, 0.1f, 0.5f, 1, 2, 10, 1e4f};
static const float edges[] = {0.0f, FLT_TRUE_MIN,    0x1p-24f,     0.5f - 0x1p-25f,
                              0.5f, 0.5f + 0x1p-24f, 1 - 0x1p-24f, 1.0f};
static const double greatest_ratio = 1.0001e8;

enum {
    ANGLES = sizeof angles / sizeof *angles,
    AZIMUTHS = sizeof azimuths / sizeof *azimuths,
    LENGTHS = sizeof lengths / sizeof *lengths,
    DIRECTIONS = ANGLES * AZIMUTHS * LENGTHS,
    ROUGHNESSES = sizeof roughnesses / sizeof *roughnesses,
    EDGES = sizeof edges / sizeof *edges,
    RANDOM = 16,
    BETWEEN = 16 /* steps from one angle to the next, for what is monotone */
};

/* A direction of the list: angles vary slowest. */
static vndf_vec3 direction(size_t index)
{
    const stress_angle *angle = &angles[index / (AZIMUTHS * LENGTHS)];
    vndf_vec3 w = direction_from(angle->degrees, azimuths[index / LENGTHS % AZIMUTHS]);
    double length = lengths[index % LENGTHS];
    if (angle->degrees == 90)
        w.z = angle->cosine;
    vndf_vec3 scaled = {(float)(length * w.x), (float)(length * w.y), (float)(length * w.z)};
    return scaled;
}

/* As often within 2^-2 of an end, the nearer the likelier, as anywhere: there one step of a number leads far. */
static float hard_float(random_stream *stream)
{
    unsigned long long which = random_bits(stream) >> 62;
    float u = random_float(stream), near = exp2f(20 * u - 22);
    return which < 2 ? u : which == 2 ? near : 1 - near;
}

static void run_view(const vndf_surface *surface, stress_point at, random_stream *stream, stress_result *result)
{
    vndf_view view = vndf_view_from(surface, at.wi);
    for (size_t i = 0; i < EDGES * EDGES + RANDOM; i++) {
        at.u1 = i < EDGES * EDGES ? edges[i / EDGES] : hard_float(stream);
        at.u2 = i < EDGES * EDGES ? edges[i % EDGES] : hard_float(stream);
        stress_measure_sample(surface, &view, &at, result);
    }
}

/* Part t of the way from one direction to another, of unit length. */
static vndf_vec3 between(vndf_vec3 a, vndf_vec3 b, double t)
{
    double x = (1 - t) * a.x + t * b.x, y = (1 - t) * a.y + t * b.y, z = (1 - t) * a.z + t * b.z;
    double length = sqrt(x * x + y * y + z * z);
    vndf_vec3 w = {(float)(x / length), (float)(y / length), (float)(z / length)};
    return w;
}

/* Down the great circle of an azimuth. */
static void run_circle(const vndf_surface *surface, size_t azimuth, stress_result *result)
{
    stress_point at = {.alpha_x = surface->alpha_x, .alpha_y = surface->alpha_y};
    at.wi = direction(azimuth * LENGTHS);
    for (size_t i = 0; i + 1 < ANGLES; i++) {
        vndf_vec3 from = direction((i * AZIMUTHS + azimuth) * LENGTHS);
        vndf_vec3 to = direction(((i + 1) * AZIMUTHS + azimuth) * LENGTHS);
        for (int step = 1; step <= BETWEEN; step++) {
            at.wo = step < BETWEEN ? between(from, to, (double)step / BETWEEN) : to;
            stress_measure_step(surface, &at, result);
            at.wi = at.wo;
        }
    }
}

static void run_surface(const vndf_surface *surface, size_t every, size_t *skip, random_stream *stream,
                        stress_result *result)
{
    for (size_t azimuth = 0; azimuth < AZIMUTHS; azimuth++)
        run_circle(surface, azimuth, result);
    for (; *skip < DIRECTIONS; *skip += every) {
        stress_point at = {.wi = direction(*skip), .alpha_x = surface->alpha_x, .alpha_y = surface->alpha_y};
        result->views++;
        run_view(surface, at, stream, result);
        at.wo = direction((size_t)(random_bits(stream) % DIRECTIONS));
        stress_measure_direction(surface, &at, result);
    }
    *skip -= DIRECTIONS;
}

static int is_valid(const vndf_surface *surface)
{
    float scale = (float)vndf_distribution_info(surface->distribution).scale; /* alpha times it, as vndf.h says */
    float x = surface->alpha_x * scale, y = surface->alpha_y * scale;
    return x >= 1e-18f && x <= 1e18f && y >= 1e-18f && y <= 1e18f;
}

void stress_run(const vndf_distribution *distribution, size_t every, uint64_t seed, stress_result *result)
{
    random_stream stream = random_from(seed);
    size_t skip = 0;
    for (size_t i = 0; i < ROUGHNESSES * ROUGHNESSES; i++) {
        vndf_surface surface = {distribution, roughnesses[i / ROUGHNESSES], roughnesses[i % ROUGHNESSES]};
        double ratio = (double)surface.alpha_x / (double)surface.alpha_y;
        if (ratio > greatest_ratio || ratio < 1 / greatest_ratio)
            continue;
        if (is_valid(&surface))
            run_surface(&surface, every, &skip, &stream, result);
        else
            result->outside++;
    }
}
