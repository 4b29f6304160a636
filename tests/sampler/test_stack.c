/* Batches stay within the stack that vndf.h states: 300 KiB for mixtures of 8 lobes, 200 KiB for affine and plain
 * surfaces, 200 for those of vndf_bsdf.h; one call of each kind in a thread whose stack was painted. Unoptimised and
 * sanitized code takes more. */
#if defined(VNDF_TEST_PTHREADS) && defined(__OPTIMIZE__)

#  define _XOPEN_SOURCE 700
#  include <pthread.h>

#  include "harness/test.h"
#  include "vndf_bsdf.h"

enum { COUNT = 600, STACK = 1 << 22, PAINT = 0xA5, MATRIX = 6, INPUTS = MATRIX + 6 };

static _Alignas(4096) unsigned char stack[STACK];
static float input[INPUTS][COUNT], normal[3][COUNT], result[2][COUNT];
static int lobe[COUNT];
static vndf_batch plain;
static vndf_affine_batch affine;
static vndf_mixture_batch mixture;
static vndf_material material;
static vndf_bsdf_batch bsdf;

static vndf_normals normals(void)
{
    vndf_normals wm = {normal[0], normal[1], normal[2]};
    return wm;
}

/* ---- calls ---- */

static void *call_nothing(void *unused)
{
    return unused;
}

static void *call_plain(void *unused)
{
    vndf_sample_n(&plain, input[0], input[1], normals(), result[0]);
    vndf_pdf_n(&plain, normals(), result[0]);
    vndf_visible_n(&plain, normals(), result[0]);
    vndf_ndf_n(&plain, normals(), result[0]);
    vndf_lambda_n(&plain, result[0]);
    vndf_invert_n(&plain, normals(), result[0], result[1]);
    return unused;
}

static void *call_affine(void *unused)
{
    vndf_affine_sample_n(&affine, input[0], input[1], normals(), result[0]);
    vndf_affine_pdf_n(&affine, normals(), result[0]);
    vndf_affine_visible_n(&affine, normals(), result[0]);
    vndf_affine_ndf_n(&affine, normals(), result[0]);
    vndf_affine_lambda_n(&affine, result[0]);
    vndf_affine_invert_n(&affine, normals(), result[0], result[1]);
    return unused;
}

static void *call_mixture(void *unused)
{
    vndf_mixture_sample_n(&mixture, input[0], input[1], normals(), result[0], lobe);
    vndf_mixture_pdf_n(&mixture, normals(), result[0]);
    vndf_mixture_visible_n(&mixture, normals(), result[0]);
    vndf_mixture_ndf_n(&mixture, normals(), result[0]);
    vndf_mixture_lambda_n(&mixture, result[0]);
    vndf_mixture_invert_n(&mixture, normals(), NULL, result[0], result[1], lobe);
    return unused;
}

static void *call_bsdf(void *unused)
{
    static float more[6][COUNT];
    static uint8_t scattered[COUNT];
    const float *const u[3] = {input[0], input[1], input[MATRIX]};
    float *const value[VNDF_WAVELENGTHS] = {more[3], more[4], more[5]};
    const vndf_scattered_n to = {
        {more[0], more[1], more[2]}, {more[3], more[4], more[5]}, result[0], scattered, normals()};
    vndf_bsdf_sample_n(&bsdf, u, to);
    vndf_bsdf_eval_pdf_n(&bsdf, to.wo, NULL, value, result[1]);
    return unused;
}

/* ---- what they take ---- */

/* Bytes that a thread took of its stack, with what the system puts there. */
static size_t taken(void *(*call)(void *))
{
    pthread_attr_t attributes;
    pthread_t thread;
    size_t clean = 0;
    memset(stack, PAINT, sizeof stack);
    if (!TEST(pthread_attr_init(&attributes) == 0))
        return 0;
    if (TEST(pthread_attr_setstack(&attributes, stack, sizeof stack) == 0) &&
        TEST(pthread_create(&thread, &attributes, call, NULL) == 0))
        TEST(pthread_join(thread, NULL) == 0);
    pthread_attr_destroy(&attributes);
    while (clean < sizeof stack && stack[clean] == PAINT)
        clean++;
    return sizeof stack - clean;
}

static void fill(void)
{
    unsigned long long state = 1;
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < INPUTS; k++)
            input[k][i] = test_uniform(&state);
        input[2][i] -= 0.5f;
        input[3][i] -= 0.5f;
        input[MATRIX][i] += 0.1f; /* of a matrix that is not singular */
        input[MATRIX + 1][i] *= 0.05f;
        input[MATRIX + 2][i] *= 0.05f;
        input[MATRIX + 3][i] += 0.1f;
    }
}

static void test_instructions(const vndf_distribution *table, vndf_instructions limit)
{
    float(*m)[COUNT] = input + MATRIX;
    const vndf_distribution *of[3] = {table, vndf_ggx(), vndf_beckmann()};
    plain = (vndf_batch){table, COUNT, 0, limit, m[0], m[3], input[2], input[3], input[4]};
    affine = (vndf_affine_batch){table, COUNT, 0,    limit,    m[0],     m[1],    m[2],
                                 m[3],  m[4],  m[5], input[2], input[3], input[4]};
    mixture = (vndf_mixture_batch){.count = COUNT, .limit = limit, .lobes = VNDF_MIXTURE_LOBES};
    mixture.wi_x = input[2];
    mixture.wi_y = input[3];
    mixture.wi_z = input[4];
    for (int l = 0; l < VNDF_MIXTURE_LOBES; l++)
        mixture.lobe[l] = (vndf_lobe_batch){of[l % 3], m[0], m[1], m[2], m[3], m[4], m[5], input[5]};
    vndf_description both = {.distribution = table, .alpha_x = 0.5f, .alpha_y = 0.5f, .eta = 1.5f};
    both.effects.lobes = VNDF_LOBES_BOTH;
    both.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    TEST(vndf_material_resolve(&both, &material, NULL) == VNDF_OK);
    bsdf =
        (vndf_bsdf_batch){.material = &material, .count = COUNT, .limit = limit, .alpha_x = m[0], .alpha_y = m[3]};
    bsdf.wi_x = input[2];
    bsdf.wi_y = input[3];
    bsdf.wi_z = input[4];
    double bare = (double)taken(call_nothing) / 1024;
    double of_plain = (double)taken(call_plain) / 1024 - bare,
           of_affine = (double)taken(call_affine) / 1024 - bare;
    double of_mixture = (double)taken(call_mixture) / 1024 - bare,
           of_bsdf = (double)taken(call_bsdf) / 1024 - bare;
    printf("instructions %d: plain %.0f KiB, affine %.0f, mixture %.0f, BSDF %.0f\n", (int)limit, of_plain,
           of_affine, of_mixture, of_bsdf);
    TEST(of_plain <= 200);
    TEST(of_affine <= 200);
    TEST(of_mixture <= 300);
    TEST(of_bsdf <= 200);
    TEST(of_mixture > 1);
}

int main(void)
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    fill();
    for (int limit = VNDF_INSTRUCTIONS_PORTABLE; limit <= VNDF_INSTRUCTIONS_AVX512; limit++)
        if (vndf_instructions_used((vndf_instructions)limit) == (vndf_instructions)limit)
            test_instructions(table, (vndf_instructions)limit);
    vndf_free(table);
    return test_done();
}

#else

#  include <stdio.h>

int main(void)
{
    puts("SKIPPED: this build has no POSIX threads, or is not optimised, or sanitized");
    return 0;
}

#endif
