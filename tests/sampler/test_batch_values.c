/* A batch of densities, visible densities, D, areas, Lambda, G1 or inverses gives to the bit what the calls of one
 * give, for every instruction set there is, distribution and count, shared or not, in place or not: directions of
 * the whole sphere, grazing, straight up and down, below the horizon; roughness from 1e-8 to 10, 1e4 apart in x and
 * y; normals that were drawn, any normals, at the horizon and beside the cut; and invalid numbers. With the
 * argument avx2 or avx512 that instruction set alone. */
#include <float.h>
#include <stdint.h>
#include <stdlib.h>

#include "sampler/batch_case.h"
#include "oracle/oracle.h"

enum { COUNT_MOST = 6000, ARRAYS = 10 };
enum { ALPHA_X, ALPHA_Y, WI_X, WI_Y, WI_Z, X, Y, Z, OUT, OUT_2 };

typedef struct numbers {
    float of[ARRAYS][COUNT_MOST];
} numbers;

/* NaNs of every payload: the bits of one are all ones. */
static float odd_number(size_t i)
{
    static const float odd[] = {0.0f, -0.0f, 1e-42f, -1e-30f, 1e30f, FLT_MAX, HUGE_VALF, -HUGE_VALF};
    uint32_t bits = i % 2 ? UINT32_MAX : 0x7fffffffu;
    float nan;
    memcpy(&nan, &bits, sizeof nan);
    return i % 10 < 8 ? odd[i % 10] : nan;
}

static float random_alpha(unsigned long long *state)
{
    float kind = test_uniform(state), u = test_uniform(state);
    float exponent = kind < 0.95f ? 9.0f * u - 8.0f : 40.0f * u - 20.0f;
    return kind < 0.6f ? 0.01f + u * u : powf(10.0f, exponent);
}

static vndf_vec3 random_direction(unsigned long long *state)
{
    float z = test_uniform(state), phi = 6.28318531f * test_uniform(state), kind = test_uniform(state);
    z = kind < 0.1f ? z * 1e-6f : kind < 0.15f ? 1.0f - 1e-6f * z : z;
    float s = sqrtf(1.0f - z * z), length = kind > 0.9f ? 10.0f * test_uniform(state) : 1.0f;
    vndf_vec3 w = {length * s * cosf(phi), length * s * sinf(phi), length * z};
    if (kind < 0.02f)
        w = (vndf_vec3){0.0f, kind < 0.01f ? 1e-30f : 0.0f, 1.0f};
    else if (kind < 0.04f)
        w.z = 0.0f;
    return w;
}

/* Drawn ones, beside the border of what is seen too, or any. */
static vndf_vec3 random_normal(const vndf_surface *surface, vndf_vec3 wi, unsigned long long *state)
{
    vndf_view view = vndf_view_from(surface, wi);
    float kind = test_uniform(state), u1 = test_uniform(state), u2 = test_uniform(state);
    vndf_vec3 wm = vndf_sample(&view, u1, kind < 0.3f ? 1.0f - 1e-3f * u2 * u2 : u2, NULL);
    if (kind > 0.7f)
        wm = random_direction(state);
    if (kind > 0.95f)
        wm.z = kind > 0.97f ? -wm.z : 0.0f;
    return wm;
}

static void put(numbers *n, size_t i, const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wm)
{
    const float all[] = {surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z, wm.x, wm.y, wm.z};
    for (int k = 0; k < 8; k++)
        n->of[k][i] = all[k];
}

/* One in twenty has a number that is odd. The first are ordinary: they serve all where they are shared. */
static void fill(numbers *n, const vndf_distribution *d, size_t count, unsigned long long seed)
{
    unsigned long long state = seed;
    for (size_t i = 0; i < count; i++) {
        float alpha = random_alpha(&state), other = random_alpha(&state), kind = test_uniform(&state);
        vndf_surface surface = {d, alpha, kind < 0.4f ? alpha : kind < 0.8f ? 1e4f * alpha : other};
        vndf_vec3 wi = random_direction(&state);
        if (test_uniform(&state) < 0.25f)
            wi.z = -wi.z;
        if (i < 2) {
            surface.alpha_x = surface.alpha_y = 0.3f;
            wi = (vndf_vec3){0.6f, 0.0f, i == seed % 2 ? 0.8f : -0.8f};
        }
        put(n, i, &surface, wi, random_normal(&surface, wi, &state));
        if (i % 20 == 19)
            n->of[i / 20 % 8][i] = odd_number(i / 160);
    }
}

/* ---- the calls ---- */

typedef enum kind { PDF, VISIBLE, NDF, AREA, LAMBDA, G1, INVERT, KINDS } kind;
static const char *const kind_names[KINDS] = {"pdf", "visible", "ndf", "projected_area", "lambda", "g1", "invert"};

static void call_batch(kind which, const vndf_batch *b, vndf_normals wm, float *to, float *to_2)
{
    switch (which) {
    case PDF: vndf_pdf_n(b, wm, to); break;
    case VISIBLE: vndf_visible_n(b, wm, to); break;
    case NDF: vndf_ndf_n(b, wm, to); break;
    case AREA: vndf_projected_area_n(b, to); break;
    case LAMBDA: vndf_lambda_n(b, to); break;
    case G1: vndf_g1_n(b, to); break;
    default: vndf_invert_n(b, wm, to, to_2); break;
    }
}

/* What the calls of one give for element i. */
static void call_one(kind which, const vndf_batch *b, vndf_normals normals, size_t i, float to[2])
{
    vndf_surface surface = batch_surface_at(b, i);
    vndf_vec3 wi = batch_wi_at(b, i), wm = {normals.x[i], normals.y[i], normals.z[i]};
    vndf_view view = vndf_view_from(&surface, wi);
    switch (which) {
    case PDF: to[0] = vndf_pdf(&view, wm); break;
    case VISIBLE: to[0] = vndf_visible(&view, wm); break;
    case NDF: to[0] = vndf_ndf(&surface, wm); break;
    case AREA: to[0] = vndf_projected_area(&surface, wi); break;
    case LAMBDA: to[0] = vndf_lambda(&surface, wi); break;
    case G1: to[0] = vndf_g1(&surface, wi); break;
    default: vndf_invert(&view, wm, &to[0], &to[1]); break;
    }
}

static vndf_batch batch_of(const vndf_distribution *d, numbers *n, size_t count, unsigned shared,
                           vndf_instructions limit)
{
    const float *const from[5] = {n->of[ALPHA_X], n->of[ALPHA_Y], n->of[WI_X], n->of[WI_Y], n->of[WI_Z]};
    return batch_over(d, from, count, shared, limit);
}

static vndf_normals normals_of(numbers *n)
{
    vndf_normals wm = {n->of[X] + 1, n->of[Y] + 1, n->of[Z] + 1};
    return wm;
}

/* How many differ from the calls of one; *numbers_seen counts those that are not 0. */
static size_t differences(kind which, const vndf_batch *b, numbers *given, const float *to, const float *to_2,
                          size_t *numbers_seen)
{
    size_t different = 0;
    for (size_t i = 0; i < b->count; i++) {
        float want[2] = {0, 0}, got[2] = {to[i], which == INVERT ? to_2[i] : 0};
        call_one(which, b, normals_of(given), i, want);
        different += memcmp(want, got, sizeof want) != 0;
        *numbers_seen += got[0] > 0;
    }
    return different;
}

static void test_call(kind which, const vndf_distribution *d, const char *name, vndf_instructions limit)
{
    const size_t counts[] = {0, 1, 2, 7, 15, 17, 255, 256, 257, test_amount(1500, COUNT_MOST - 1, COUNT_MOST - 1)};
    static numbers given, made;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        fill(&given, d, counts[c] + 1, 99 + c);
        for (unsigned shared = 0; shared < 4; shared++) {
            size_t seen = 0, count = counts[c];
            made = given;
            vndf_batch b = batch_of(d, &given, count, shared, limit);
            call_batch(which, &b, normals_of(&given), made.of[OUT], made.of[OUT_2]);
            size_t different = differences(which, &b, &given, made.of[OUT], made.of[OUT_2], &seen);
            if (!TEST(different == 0))
                fprintf(stderr, "  %s, %s, instructions %d, shared %u: %lu of %lu differ\n", name,
                        kind_names[which], (int)limit, shared, (unsigned long)different, (unsigned long)count);
            TEST(memcmp(&made.of[OUT][count], &given.of[OUT][count], sizeof(float)) == 0); /* nothing beyond */
            TEST(count < 1000 || !d || seen > count / 4 || which == INVERT || (shared & VNDF_SHARED_WI));
        }
    }
}

/* Results over alpha_x, and over the normals' x where these are read. */
static void test_in_place(kind which, const vndf_distribution *d, vndf_instructions limit)
{
    static numbers given, made;
    size_t seen = 0;
    for (int over = ALPHA_X; over <= X; over += X - ALPHA_X) {
        fill(&given, d, COUNT_MOST, 5);
        made = given;
        vndf_batch apart = batch_of(d, &given, COUNT_MOST - 1, 0, limit);
        vndf_batch b = batch_of(d, &made, COUNT_MOST - 1, 0, limit);
        call_batch(which, &b, normals_of(&made), made.of[over] + 1, made.of[OUT_2]);
        TEST(differences(which, &apart, &given, made.of[over] + 1, made.of[OUT_2], &seen) == 0);
    }
}

static void test_distribution(const vndf_distribution *d, const char *name, vndf_instructions only)
{
    for (int limit = batch_first_limit(only); limit <= batch_last_limit(only); limit++)
        for (int which = 0; which < KINDS; which++) {
            test_call((kind)which, d, name, (vndf_instructions)limit);
            test_in_place((kind)which, d, (vndf_instructions)limit);
        }
}

/* vndf_ndf_n reads no wi, areas read no normals: they need not be there. */
static void test_unread(const vndf_distribution *d)
{
    static numbers given;
    fill(&given, d, 101, 3);
    vndf_batch b = batch_of(d, &given, 100, 0, VNDF_INSTRUCTIONS_BEST);
    vndf_batch no_wi = b;
    float with[100], without[100];
    no_wi.wi_x = no_wi.wi_y = no_wi.wi_z = NULL;
    vndf_ndf_n(&b, normals_of(&given), with);
    vndf_ndf_n(&no_wi, normals_of(&given), without);
    TEST(memcmp(with, without, sizeof with) == 0);
}

static void test_all(const vndf_distribution *d, const char *name, vndf_instructions only)
{
    test_distribution(d, name, only);
    if (d && d != vndf_ggx() && d != vndf_beckmann())
        test_unread(d);
}

int main(int arguments, char **argument)
{
    return batch_main(arguments, argument, test_all);
}
