/* A batch of affine surfaces gives to the bit what the calls of one give, samples and answers alike, for every
 * instruction set there is, distribution and count, shared or not, in place or not: matrices of condition up to 1e4,
 * diagonal ones, singular ones, mean slopes or none, directions of the whole sphere and of odd lengths, and invalid
 * numbers. With diagonal matrices and no mean slope it gives the bits of the plain batch. With the argument avx2 or
 * avx512 that instruction set alone. */
#include <float.h>
#include <stdint.h>

#include "harness/constants.h"
#include "sampler/batch_case.h"

enum { COUNT_MOST = 3000 };
enum { XX, XY, YX, YY, MEAN_X, MEAN_Y, WI_X, WI_Y, WI_Z, U1, U2, X, Y, Z, OUT, OUT_2, ARRAYS };

typedef struct numbers {
    float of[ARRAYS][COUNT_MOST];
} numbers;

static double uniform(unsigned long long *state, double from, double to)
{
    return from + (to - from) * test_uniform_double(state);
}

static double exponential(unsigned long long *state, double from, double to)
{
    return exp(uniform(state, log(from), log(to)));
}

static float odd_number(size_t i)
{
    static const float odd[] = {0.0f, -0.0f, 1e-42f, -1e-30f, 1e30f, FLT_MAX, HUGE_VALF, -HUGE_VALF, NAN};
    return odd[i % (sizeof odd / sizeof *odd)];
}

/* Any matrix, a diagonal one, a multiple of a turn, or a singular one. */
static void fill_matrix(numbers *n, size_t i, unsigned long long *state)
{
    double most = exponential(state, 1e-3, 3), least = most / exponential(state, 1, 1e4),
           kind = test_uniform(state);
    double a = uniform(state, 0, 2 * PI), b = uniform(state, 0, 2 * PI);
    if (kind < 0.1)
        a = b = 0;
    else if (kind < 0.2)
        least = most;
    else if (kind < 0.22)
        least = 0;
    double mirror = kind < 0.6 ? 1 : -1;
    n->of[XX][i] = (float)(cos(a) * most * cos(b) - sin(a) * least * sin(b));
    n->of[XY][i] = (float)(mirror * (-cos(a) * most * sin(b) - sin(a) * least * cos(b)));
    n->of[YX][i] = (float)(sin(a) * most * cos(b) + cos(a) * least * sin(b));
    n->of[YY][i] = (float)(mirror * (-sin(a) * most * sin(b) + cos(a) * least * cos(b)));
}

static void fill_wi(numbers *n, size_t i, unsigned long long *state)
{
    double z = uniform(state, -0.6, 1), phi = uniform(state, 0, 2 * PI), s = sqrt(1 - z * z);
    double kind = test_uniform(state), length = kind < 0.05 ? exponential(state, 1e-40, 1e36) : 1;
    n->of[WI_X][i] = (float)(kind > 0.97 ? 0 : length * s * cos(phi));
    n->of[WI_Y][i] = (float)(kind > 0.95 ? 0 : length * s * sin(phi));
    n->of[WI_Z][i] = (float)(kind > 0.9 && kind < 0.92 ? 0 : length * z);
}

/* The largest batch. */
static size_t most(void)
{
    return test_amount(600, 600, COUNT_MOST - 2);
}

/* One in twenty has a number that is odd. The first are ordinary: they serve all where they are shared. */
static void fill(numbers *n, const vndf_distribution *d, unsigned long long seed)
{
    unsigned long long state = seed;
    for (size_t i = 0; i < most() + 2; i++) {
        double mean = test_uniform(&state) < 0.7f ? 0.5 : 0;
        fill_matrix(n, i, &state);
        n->of[MEAN_X][i] = (float)uniform(&state, -mean, mean);
        n->of[MEAN_Y][i] = (float)uniform(&state, -mean, mean);
        fill_wi(n, i, &state);
        n->of[U1][i] = test_uniform(&state);
        n->of[U2][i] = test_uniform(&state);
        if (i < 2) {
            const float height[] = {0.8f, -0.3f, 0.8f, NAN}; /* one view may be below the horizon, or none */
            const float first[] = {0.4f, 0.1f, -0.2f,           0.3f, 0.1f, i == seed % 2 ? 0.2f : 0.0f,
                                   0.6f, 0.0f, height[seed % 4]};
            for (int k = XX; k <= WI_Z; k++)
                n->of[k][i] = first[k];
        }
        vndf_affine surface = {
            d, n->of[XX][i], n->of[XY][i], n->of[YX][i], n->of[YY][i], n->of[MEAN_X][i], n->of[MEAN_Y][i]};
        vndf_vec3 wi = {n->of[WI_X][i], n->of[WI_Y][i], n->of[WI_Z][i]};
        vndf_affine_view view = vndf_affine_view_from(&surface, wi);
        vndf_vec3 wm = vndf_affine_sample(&view, test_uniform(&state), test_uniform(&state), NULL);
        float kind = test_uniform(&state);
        n->of[X][i] = kind < 0.2f ? wm.y : wm.x;
        n->of[Y][i] = wm.y;
        n->of[Z][i] = kind > 0.9f ? -wm.z : kind > 0.85f ? 0.0f : wm.z;
        if (i % 20 == 19)
            n->of[i / 20 % (Z + 1)][i] = odd_number(i / 160);
    }
}

/* ---- the calls ---- */

typedef enum kind { SAMPLE, PDF, VISIBLE, NDF, AREA, LAMBDA, G1, INVERT, KINDS } kind;
static const char *const kind_names[KINDS] = {"sample", "pdf", "visible", "ndf", "area", "lambda", "g1", "invert"};

/* What may be left out of a batch. */
enum { NO_SHEAR = 1, NO_MEAN = 2, ABSENCES = 4 };

static vndf_affine_batch batch_of(const vndf_distribution *d, numbers *n, size_t count, unsigned shared,
                                  int absent, vndf_instructions limit)
{
    vndf_affine_batch b = {d,
                           count,
                           shared,
                           limit,
                           n->of[XX] + 1,
                           absent & NO_SHEAR ? NULL : n->of[XY] + 1,
                           absent & NO_SHEAR ? NULL : n->of[YX] + 1,
                           n->of[YY] + 1,
                           absent & NO_MEAN ? NULL : n->of[MEAN_X] + 1,
                           absent & NO_MEAN ? NULL : n->of[MEAN_Y] + 1,
                           n->of[WI_X] + 1,
                           n->of[WI_Y] + 1,
                           n->of[WI_Z] + 1};
    return b;
}

static vndf_normals normals_of(numbers *n)
{
    vndf_normals wm = {n->of[X] + 1, n->of[Y] + 1, n->of[Z] + 1};
    return wm;
}

/* Samples go over the normals, densities to `to`. */
static void call_batch(kind which, const vndf_affine_batch *b, numbers *n, float *to)
{
    vndf_normals wm = normals_of(n);
    switch (which) {
    case SAMPLE: vndf_affine_sample_n(b, n->of[U1] + 1, n->of[U2] + 1, wm, to); break;
    case PDF: vndf_affine_pdf_n(b, wm, to); break;
    case VISIBLE: vndf_affine_visible_n(b, wm, to); break;
    case NDF: vndf_affine_ndf_n(b, wm, to); break;
    case AREA: vndf_affine_projected_area_n(b, to); break;
    case LAMBDA: vndf_affine_lambda_n(b, to); break;
    case G1: vndf_affine_g1_n(b, to); break;
    default: vndf_affine_invert_n(b, wm, to, n->of[OUT_2] + 1); break;
    }
}

static float number_at(const float *from, size_t i)
{
    return from ? from[i] : 0.0f;
}

/* What the calls of one give for element i: up to four numbers. */
static void call_one(kind which, const vndf_affine_batch *b, const numbers *n, size_t i, float to[4])
{
    size_t a = b->shared & VNDF_SHARED_ALPHA ? 0 : i, w = b->shared & VNDF_SHARED_WI ? 0 : i;
    vndf_affine surface = {b->distribution,        b->xx[a], number_at(b->xy, a),
                           number_at(b->yx, a),    b->yy[a], number_at(b->mean_x, a),
                           number_at(b->mean_y, a)};
    vndf_vec3 wi = {b->wi_x[w], b->wi_y[w], b->wi_z[w]}, wm = {n->of[X][i + 1], n->of[Y][i + 1], n->of[Z][i + 1]};
    vndf_affine_view view = vndf_affine_view_from(&surface, wi);
    switch (which) {
    case SAMPLE:
        wm = vndf_affine_sample(&view, n->of[U1][i + 1], n->of[U2][i + 1], &to[0]);
        to[1] = wm.x;
        to[2] = wm.y;
        to[3] = wm.z;
        break;
    case PDF: to[0] = vndf_affine_pdf(&view, wm); break;
    case VISIBLE: to[0] = vndf_affine_visible(&view, wm); break;
    case NDF: to[0] = vndf_affine_ndf(&surface, wm); break;
    case AREA: to[0] = vndf_affine_projected_area(&surface, wi); break;
    case LAMBDA: to[0] = vndf_affine_lambda(&surface, wi); break;
    case G1: to[0] = vndf_affine_g1(&surface, wi); break;
    default: vndf_affine_invert(&view, wm, &to[0], &to[1]); break;
    }
}

/* How many differ from the calls of one; *seen counts those that are not 0. */
static size_t differences(kind which, const vndf_affine_batch *b, const numbers *given, const numbers *made,
                          const float *to, size_t *seen)
{
    size_t different = 0;
    for (size_t i = 0; i < b->count; i++) {
        float want[4] = {0, 0, 0, 0}, got[4] = {to[i], which == INVERT ? made->of[OUT_2][i + 1] : 0, 0, 0};
        for (int k = 0; which == SAMPLE && k < 3; k++)
            got[1 + k] = made->of[X + k][i + 1];
        call_one(which, b, given, i, want);
        different += memcmp(want, got, sizeof want) != 0;
        *seen += got[0] > 0;
    }
    return different;
}

static void test_call(kind which, const vndf_distribution *d, const char *name, vndf_instructions limit)
{
    const size_t counts[] = {0, 1, 2, 17, 255, 256, 257, most()};
    static numbers given, made;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        fill(&given, d, 99 + c);
        for (unsigned shared = 0; shared < 4; shared++) {
            int absent = (int)((c + shared) % ABSENCES);
            size_t count = counts[c], seen = 0;
            made = given;
            vndf_affine_batch b = batch_of(d, &given, count, shared, absent, limit);
            vndf_affine_batch over = b;
            call_batch(which, &over, &made, made.of[OUT] + 1);
            size_t different = differences(which, &b, &given, &made, made.of[OUT] + 1, &seen);
            if (!TEST(different == 0))
                fprintf(stderr, "  %s, %s, instructions %d, shared %u, absent %d: %lu of %lu differ\n", name,
                        kind_names[which], (int)limit, shared, absent, (unsigned long)different,
                        (unsigned long)count);
            TEST(memcmp(&made.of[OUT][count + 1], &given.of[OUT][count + 1], sizeof(float)) == 0);
            TEST(memcmp(&made.of[X][count + 1], &given.of[X][count + 1], sizeof(float)) == 0);
            TEST(count < 500 || !d || seen > count / 4 || which == INVERT || (shared & VNDF_SHARED_WI));
        }
    }
}

/* Results over the matrix; samples over the directions too. */
static void test_in_place(kind which, const vndf_distribution *d, vndf_instructions limit)
{
    static numbers given, made;
    size_t seen = 0, count = most();
    fill(&given, d, 5);
    made = given;
    vndf_affine_batch apart = batch_of(d, &given, count, 0, 0, limit), b = batch_of(d, &made, count, 0, 0, limit);
    if (which == SAMPLE) {
        vndf_normals wm = {made.of[WI_X] + 1, made.of[WI_Y] + 1, made.of[WI_Z] + 1};
        vndf_affine_sample_n(&b, made.of[U1] + 1, made.of[U2] + 1, wm, made.of[U1] + 1);
        memcpy(made.of[X], made.of[WI_X], 3 * sizeof made.of[X]);
        TEST(differences(which, &apart, &given, &made, made.of[U1] + 1, &seen) == 0);
    } else {
        call_batch(which, &b, &made, made.of[XX] + 1);
        TEST(differences(which, &apart, &given, &made, made.of[XX] + 1, &seen) == 0);
    }
}

/* ---- the plain batch ---- */

static void test_plain(const vndf_distribution *d, vndf_instructions limit)
{
    static numbers given, one, two;
    size_t count = most();
    fill(&given, d, 8);
    for (size_t i = 0; i < COUNT_MOST; i++) {
        given.of[XX][i] = fabsf(given.of[XX][i]);
        given.of[YY][i] = fabsf(given.of[YY][i]);
    }
    one = two = given;
    vndf_batch plain = {d,
                        count,
                        0,
                        limit,
                        given.of[XX] + 1,
                        given.of[YY] + 1,
                        given.of[WI_X] + 1,
                        given.of[WI_Y] + 1,
                        given.of[WI_Z] + 1};
    vndf_affine_batch affine = batch_of(d, &given, count, 0, NO_SHEAR | NO_MEAN, limit);
    vndf_sample_n(&plain, given.of[U1] + 1, given.of[U2] + 1, normals_of(&one), one.of[OUT] + 1);
    vndf_affine_sample_n(&affine, given.of[U1] + 1, given.of[U2] + 1, normals_of(&two), two.of[OUT] + 1);
    TEST(memcmp(&one, &two, sizeof one) == 0);
    vndf_pdf_n(&plain, normals_of(&given), one.of[OUT] + 1);
    vndf_affine_pdf_n(&affine, normals_of(&given), two.of[OUT] + 1);
    TEST(memcmp(&one, &two, sizeof one) == 0);
    vndf_ndf_n(&plain, normals_of(&given), one.of[OUT] + 1);
    vndf_affine_ndf_n(&affine, normals_of(&given), two.of[OUT] + 1);
    TEST(memcmp(&one, &two, sizeof one) == 0);
    vndf_projected_area_n(&plain, one.of[OUT] + 1);
    vndf_affine_projected_area_n(&affine, two.of[OUT] + 1);
    TEST(memcmp(&one, &two, sizeof one) == 0);
}

static void test_distribution(const vndf_distribution *d, const char *name, vndf_instructions only)
{
    int first = only != VNDF_INSTRUCTIONS_BEST ? (int)only : VNDF_INSTRUCTIONS_PORTABLE;
    int last = only != VNDF_INSTRUCTIONS_BEST ? (int)only : VNDF_INSTRUCTIONS_AVX512;
    for (int limit = first; limit <= last; limit++) {
        for (int which = 0; which < KINDS; which++) {
            test_call((kind)which, d, name, (vndf_instructions)limit);
            test_in_place((kind)which, d, (vndf_instructions)limit);
        }
        test_plain(d, (vndf_instructions)limit);
    }
}

int main(int arguments, char **argument)
{
    return batch_main(arguments, argument, test_distribution);
}
