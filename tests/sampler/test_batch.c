/* A batch gives to the bit what the calls of one give, for every instruction set there is, distribution and
 * count, shared or not, in place or not: directions of the whole sphere, roughness from 1e-6 to 10 and invalid
 * ones, the corners of the unit square and numbers outside it. With the argument avx2 or avx512 that instruction
 * set alone. */
#include <float.h>
#include <stdlib.h>

#include "sampler/batch_case.h"
#include "oracle/oracle.h"

enum { COUNT_MOST = 3000, ARRAYS = 12 };
enum { ALPHA_X, ALPHA_Y, WI_X, WI_Y, WI_Z, U1, U2, X, Y, Z, PDF, WEIGHT };

typedef struct numbers {
    float of[ARRAYS][COUNT_MOST];
} numbers;

static float odd_uniform(unsigned long long *state, size_t i)
{
    static const float odd[] = {0.0f, 1.0f, -1.0f, 2.0f, NAN, 0.5f, 1.0f - 0x1p-24f, 0x1p-30f};
    float u = test_uniform(state);
    return i % 37 == 0 ? odd[i / 37 % 8] : u;
}

static float odd_alpha(unsigned long long *state, size_t i)
{
    static const float odd[] = {1e-6f, 10.0f, 0.0f, -1.0f, NAN, 1e-4f, 1e4f, HUGE_VALF};
    float u = test_uniform(state);
    return i % 41 == 0 ? odd[i / 41 % 8] : 0.01f + u * u;
}

/* Mostly above the horizon; some below, exactly along an axis, on the horizon, invalid, long or short. */
static void odd_direction(numbers *n, unsigned long long *state, size_t i)
{
    float z = test_uniform(state), phi = 6.28318531f * test_uniform(state), s = sqrtf(1.0f - z * z);
    float length = i % 5 == 0 ? 10.0f * z : 1.0f;
    n->of[WI_X][i] = i % 43 == 0 ? 0.0f : length * s * cosf(phi);
    n->of[WI_Y][i] = i % 43 == 0 || i % 47 == 0 ? 0.0f : length * s * sinf(phi);
    n->of[WI_Z][i] = i % 53 == 0 ? 0.0f : i % 59 == 0 ? NAN : i % 13 == 0 ? -length * z : length * z;
}

static void fill(numbers *n, unsigned long long seed)
{
    unsigned long long state = seed;
    for (size_t i = 0; i < COUNT_MOST; i++) {
        n->of[ALPHA_X][i] = odd_alpha(&state, i);
        n->of[ALPHA_Y][i] = i % 3 == 0 ? n->of[ALPHA_X][i] : odd_alpha(&state, i + 7);
        odd_direction(n, &state, i);
        n->of[U1][i] = odd_uniform(&state, i);
        n->of[U2][i] = odd_uniform(&state, i + 11);
    }
}

static vndf_batch batch_of(const vndf_distribution *d, const numbers *n, size_t count, unsigned shared,
                           vndf_instructions limit)
{
    const float *const from[5] = {n->of[ALPHA_X], n->of[ALPHA_Y], n->of[WI_X], n->of[WI_Y], n->of[WI_Z]};
    return batch_over(d, from, count, shared, limit);
}

static vndf_normals normals_of(numbers *n)
{
    vndf_normals wm = {n->of[X], n->of[Y], n->of[Z]};
    return wm;
}

/* What the calls of one give for element i. */
static void one(const vndf_batch *b, const numbers *n, size_t i, float result[5])
{
    vndf_surface surface = batch_surface_at(b, i);
    vndf_view view = vndf_view_from(&surface, batch_wi_at(b, i));
    float pdf;
    vndf_vec3 wm = vndf_sample(&view, n->of[U1][i], n->of[U2][i], &result[3]);
    vndf_vec3 again = vndf_sample_weight(&view, n->of[U1][i], n->of[U2][i], &pdf, &result[4]);
    TEST(memcmp(&wm, &again, sizeof wm) == 0 && memcmp(&pdf, &result[3], sizeof pdf) == 0);
    result[0] = wm.x;
    result[1] = wm.y;
    result[2] = wm.z;
}

static size_t differences(const vndf_batch *b, const numbers *given, const numbers *made)
{
    size_t different = 0;
    for (size_t i = 0; i < b->count; i++) {
        float want[5];
        const float got[5] = {made->of[X][i], made->of[Y][i], made->of[Z][i], made->of[PDF][i],
                              made->of[WEIGHT][i]};
        one(b, given, i, want);
        different += memcmp(want, got, sizeof want) != 0;
    }
    return different;
}

static void test_count(const vndf_distribution *d, const char *name, const numbers *given, size_t count,
                       unsigned shared, vndf_instructions limit)
{
    static numbers made, alone;
    made = alone = *given;
    vndf_batch b = batch_of(d, given, count, shared, limit);
    vndf_sample_n(&b, given->of[U1], given->of[U2], normals_of(&alone), alone.of[PDF]);
    vndf_sample_weight_n(&b, given->of[U1], given->of[U2], normals_of(&made), made.of[PDF], made.of[WEIGHT]);
    TEST(memcmp(alone.of[X], made.of[X], (size_t)(PDF - X + 1) * sizeof alone.of[X]) == 0);
    size_t different = differences(&b, given, &made);
    if (!TEST(different == 0))
        fprintf(stderr, "  %s, instructions %d, shared %u: %lu of %lu samples differ\n", name, (int)limit, shared,
                (unsigned long)different, (unsigned long)count);
    TEST(made.of[X][count] == given->of[X][count]); /* nothing beyond the end */
}

static void test_sample(const vndf_distribution *d, const char *name, vndf_instructions limit)
{
    static const size_t counts[] = {0, 1, 2, 7, 15, 16, 17, 255, 256, 257, COUNT_MOST - 1};
    static numbers given;
    for (unsigned shared = 0; shared < 4; shared++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            fill(&given, 99 + c);
            test_count(d, name, &given, counts[c], shared, limit);
        }
}

/* All directions are below the horizon, so that one that all share is so too. */
static void test_below(const vndf_distribution *d, const char *name, vndf_instructions limit)
{
    static numbers given;
    fill(&given, 41);
    for (size_t i = 0; i < COUNT_MOST; i++)
        given.of[WI_Z][i] = -fabsf(given.of[WI_Z][i]);
    for (unsigned shared = 0; shared < 4; shared++) {
        test_count(d, name, &given, 33, shared, limit);
        test_count(d, name, &given, COUNT_MOST - 1, shared, limit);
    }
}

/* Normals over directions, the density over u1. */
static void test_in_place(const vndf_distribution *d, vndf_instructions limit)
{
    static numbers given, made, aside;
    fill(&given, 5);
    made = aside = given;
    vndf_batch apart = batch_of(d, &given, COUNT_MOST - 1, 0, limit);
    vndf_batch over = batch_of(d, &made, COUNT_MOST - 1, 0, limit);
    vndf_normals in_place = {made.of[WI_X] + 1, made.of[WI_Y] + 1, made.of[WI_Z] + 1};
    vndf_sample_n(&apart, given.of[U1], given.of[U2], normals_of(&aside), aside.of[PDF]);
    vndf_sample_n(&over, made.of[U1], made.of[U2], in_place, made.of[U1]);
    size_t bytes = (COUNT_MOST - 1) * sizeof(float);
    TEST(memcmp(in_place.x, aside.of[X], bytes) == 0);
    TEST(memcmp(in_place.y, aside.of[Y], bytes) == 0);
    TEST(memcmp(in_place.z, aside.of[Z], bytes) == 0);
    TEST(memcmp(made.of[U1], aside.of[PDF], bytes) == 0);
    made = given;
    vndf_sample_n(&apart, given.of[U1], given.of[U2], normals_of(&made), NULL);
    TEST(memcmp(made.of[Z], aside.of[Z], bytes) == 0);
}

static void test_distribution(const vndf_distribution *d, const char *name, vndf_instructions only)
{
    for (int limit = batch_first_limit(only); limit <= batch_last_limit(only); limit++) {
        vndf_instructions used = vndf_instructions_used((vndf_instructions)limit);
        TEST(used >= VNDF_INSTRUCTIONS_PORTABLE && (limit == VNDF_INSTRUCTIONS_BEST || (int)used <= limit));
        test_sample(d, name, (vndf_instructions)limit);
        test_below(d, name, (vndf_instructions)limit);
        test_in_place(d, (vndf_instructions)limit);
    }
}

int main(int arguments, char **argument)
{
    return batch_main(arguments, argument, test_distribution);
}
