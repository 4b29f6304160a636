/* No call of the run time takes more than 32 KiB of stack, or any heap: each runs in a thread of 64 KiB - calls for one
 * and batches at every instruction set of the machine, tables and closed forms, plain, sheared and on both sides of the
 * horizon, mixtures of eight lobes, families, BSDFs of single, compensated and multiple scattering. */
#define _POSIX_C_SOURCE 200809L
#include "harness/test.h"
#include "vndf_bsdf.h"

#if defined(__unix__) && defined(__OPTIMIZE__) && !defined(VNDF_TEST_SANITIZED)
#  include <pthread.h>

enum { LIMIT = 32 * 1024, STACK = 64 * 1024, BELOW = 192 * 1024, PAINT = 0xa5, COUNT = 300 };

/* What calls read and write: surfaces with matrix and mean slope, directions, numbers, normals. */
static float xx[COUNT], xy[COUNT], yx[COUNT], yy[COUNT], mean[COUNT], wi[3][COUNT], u[3][COUNT], wm[3][COUNT],
    to[5][COUNT], spectrum[VNDF_WAVELENGTHS][COUNT], weight[COUNT];
static uint8_t lobe[COUNT];
static uint64_t seed[COUNT];
static vndf_batch batch;
static vndf_surface surface;
static vndf_mixture mixture;
static vndf_material material;
static vndf_family *family;

/* ---- a call in a thread ---- */

static int allocations;

#  if defined(VNDF_TEST_WRAP)
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);

void *__wrap_malloc(size_t size)
{
    allocations++;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    allocations++;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *old, size_t size)
{
    allocations++;
    return __real_realloc(old, size);
}
#  endif

typedef void call(void);

static call *chosen;

static void *run_chosen(void *nothing)
{
    chosen();
    return nothing;
}

/* Bytes of the stack of a thread that are not as they were painted, and of those below it. */
static long stack_of(call *c)
{
    static _Alignas(64) unsigned char room[BELOW + STACK];
    pthread_attr_t attributes;
    pthread_t thread;
    long untouched = 0;
    memset(room, PAINT, sizeof room);
    chosen = c;
    TEST(pthread_attr_init(&attributes) == 0 && pthread_attr_setstack(&attributes, room + BELOW, STACK) == 0 &&
         pthread_create(&thread, &attributes, run_chosen, NULL) == 0 && pthread_join(thread, NULL) == 0);
    pthread_attr_destroy(&attributes);
    while (untouched < (long)sizeof room && room[untouched] == PAINT)
        untouched++;
    return (long)sizeof room - untouched;
}

static void nothing_at_all(void)
{
}

static void test_call(const char *name, call *c)
{
    char text[160];
    allocations = 0;
    const long used = stack_of(c) - stack_of(nothing_at_all);
    snprintf(text, sizeof text, "%s takes %ld bytes of stack, and allocates %d times", name, used, allocations);
    test_report(used <= LIMIT && !allocations, __FILE__, __LINE__, text);
}

#  define CALL(name) test_call(#  name, name)

static void too_large(void)
{
    volatile char large[40 * 1024];
    large[0] = 1;
    to[0][0] = (float)large[0];
}

/* ---- batches ---- */

static const vndf_normals normals = {wm[0], wm[1], wm[2]}, results = {to[0], to[1], to[2]};

static void sample_n(void)
{
    vndf_sample_n(&batch, u[0], u[1], results, to[3]);
}

static void sample_weight_n(void)
{
    vndf_sample_weight_n(&batch, u[0], u[1], results, to[3], to[4]);
}

static void of_normals_n(void)
{
    vndf_pdf_n(&batch, normals, to[0]);
    vndf_visible_n(&batch, normals, to[0]);
    vndf_ndf_n(&batch, normals, to[0]);
    vndf_invert_n(&batch, normals, to[0], to[1]);
}

static void of_directions_n(void)
{
    vndf_projected_area_n(&batch, to[0]);
    vndf_lambda_n(&batch, to[0]);
    vndf_g1_n(&batch, to[0]);
}

static void test_batches(const vndf_distribution *d)
{
    const vndf_surface_batch sheared = {d, xx, xy, yx, yy, mean, mean};
    for (int set = VNDF_INSTRUCTIONS_PORTABLE; set <= (int)vndf_instructions_used(VNDF_INSTRUCTIONS_BEST); set++)
        for (int kind = 0; kind < 4; kind++) { /* sheared or not, of eight lobes or one */
            batch = (vndf_batch){.surface = sheared,
                                 .count = COUNT,
                                 .limit = (vndf_instructions)set,
                                 .wi_x = wi[0],
                                 .wi_y = wi[1],
                                 .wi_z = wi[2]};
            if (kind & 1)
                batch.surface = (vndf_surface_batch){d, xx, NULL, NULL, yy, NULL, NULL};
            batch.lobes = kind & 2 ? VNDF_MIXTURE_LOBES : 0;
            for (int l = 0; l < batch.lobes; l++)
                batch.lobe[l] = (vndf_lobe_batch){batch.surface, weight};
            CALL(sample_n);
            CALL(sample_weight_n);
            CALL(of_normals_n);
            CALL(of_directions_n);
        }
}

/* ---- calls for one ---- */

static void one(void)
{
    for (int i = 0; i < 16; i++) {
        const vndf_vec3 w = {wi[0][i], wi[1][i], wi[2][i]}, n = {wm[0][i], wm[1][i], wm[2][i]};
        const vndf_view view = vndf_view_from(&surface, w);
        vndf_vec3 m = vndf_sample_weight(&view, u[0][i], u[1][i], &to[0][i], &to[1][i]);
        m = vndf_sample(&view, u[0][i], u[1][i], &to[0][i]);
        vndf_invert(&view, m, &to[0][i], &to[1][i]);
        to[2][i] = vndf_pdf(&view, n) + vndf_visible(&view, n) + vndf_ndf(&surface, n) +
                   vndf_p22(&surface, 0.1f, n.y) + vndf_lambda(&surface, w) + vndf_g1(&surface, w) +
                   vndf_projected_area(&surface, w) + vndf_g2(&surface, w, w, VNDF_G2_HEIGHT_CORRELATED);
    }
}

static void one_mixture(void)
{
    vndf_mixture between = mixture;
    for (int i = 0; i < 16; i++) {
        const vndf_vec3 w = {wi[0][i], wi[1][i], wi[2][i]}, n = {wm[0][i], wm[1][i], wm[2][i]};
        const vndf_mixture_view view = vndf_mixture_view_from(&mixture, w);
        int drawn;
        const vndf_vec3 m = vndf_mixture_sample(&view, u[0][i], u[1][i], &to[0][i], &drawn);
        vndf_mixture_invert(&view, m, -1, &to[0][i], &to[1][i]);
        to[2][i] = vndf_mixture_pdf(&view, n) + vndf_mixture_visible(&view, n) + vndf_mixture_ndf(&mixture, n) +
                   vndf_mixture_p22(&mixture, 0.1f, n.y) + vndf_mixture_lambda(&mixture, w) +
                   vndf_mixture_g1(&mixture, w) + vndf_mixture_projected_area(&mixture, w) +
                   vndf_mixture_g2(&mixture, w, w, VNDF_G2_HEIGHT_CORRELATED);
        vndf_family_at(family, u[0][i], &surface, &between);
    }
}

/* ---- BSDFs ---- */

static const float *const numbers[3] = {u[0], u[1], u[2]};

static void bsdf_n(void)
{
    const vndf_bsdf_batch b = {.material = &material,
                               .count = COUNT,
                               .shared = VNDF_SHARED_SURFACE,
                               .mixture = material.is.effects.shape == VNDF_SHAPE_MIXTURE ? &mixture : NULL,
                               .wi_x = wi[0],
                               .wi_y = wi[1],
                               .wi_z = wi[2]};
    vndf_scattered_n s = {results, {NULL}, to[3], lobe, {NULL, NULL, NULL}};
    float *value[VNDF_WAVELENGTHS];
    for (int k = 0; k < VNDF_WAVELENGTHS; k++)
        s.weight[k] = value[k] = spectrum[k];
    vndf_bsdf_sample_n(&b, numbers, s);
    vndf_bsdf_eval_pdf_n(&b, normals, seed, value, to[3]);
}

static void bsdf_one(void)
{
    for (int i = 0; i < 64; i++) {
        const vndf_vec3 w = {wi[0][i], wi[1][i], wi[2][i]}, o = {wm[0][i], wm[1][i], -wm[2][i]};
        const float own[3] = {u[0][i], u[1][i], u[2][i]};
        vndf_scattered s;
        vndf_bsdf hit;
        float value[VNDF_WAVELENGTHS];
        vndf_bsdf_at(&hit, &material, w);
        vndf_bsdf_sample(&hit, own, &s);
        vndf_bsdf_eval(&hit, o, (uint64_t)i, value);
        vndf_bsdf_eval_pdf(&hit, o, (uint64_t)i, value, &to[0][i]);
        to[1][i] = vndf_bsdf_pdf(&hit, o) + vndf_bsdf_cosine(&hit, o);
    }
}

static void test_bsdfs(const vndf_distribution *d)
{
    static const struct {
        vndf_scattering scattering;
        vndf_shape shape;
        vndf_normals_drawn normals;
    } is[] = {{.normals = VNDF_NORMALS_BOUNDED},
              {.shape = VNDF_SHAPE_LEVEL},
              {.shape = VNDF_SHAPE_TILTED},
              {.shape = VNDF_SHAPE_MIXTURE},
              {.scattering = VNDF_SCATTERING_MULTIPLE},
              {.scattering = VNDF_SCATTERING_TURQUIN},
              {.scattering = VNDF_SCATTERING_KULLA_CONTY}};
    vndf_albedo *glass = vndf_albedo_build(d, 1.5f, NULL), *mirror = vndf_albedo_build(d, 0.0f, NULL);
    for (size_t k = 0; k < sizeof is / sizeof *is; k++) {
        const int reflects =
            is[k].scattering == VNDF_SCATTERING_KULLA_CONTY || is[k].normals == VNDF_NORMALS_BOUNDED;
        const vndf_description material_is = {
            .surface = vndf_rough(d, 0.4f, 0.4f),
            .effects = {.lobes = reflects ? VNDF_LOBES_REFLECTION : VNDF_LOBES_BOTH,
                        .fresnel = reflects ? VNDF_FRESNEL_SCHLICK : VNDF_FRESNEL_DIELECTRIC,
                        .scattering = is[k].scattering,
                        .shape = is[k].shape,
                        .normals = is[k].normals},
            .mixture = &mixture,
            .albedo = reflects ? mirror : glass,
            .eta = 1.5f,
            .f0 = {0.1f, 0.2f, 0.3f}};
        TEST(vndf_material_resolve(&material_is, &material, NULL) == VNDF_OK);
        CALL(bsdf_n);
        CALL(bsdf_one);
    }
    vndf_albedo_free(glass);
    vndf_albedo_free(mirror);
}

int main(void)
{
    const vndf_distribution *d[3] = {NULL, vndf_ggx(), vndf_beckmann()};
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    unsigned long long state = 1;
    if (!TEST(table != NULL))
        return test_done();
    d[0] = table;
    for (int i = 0; i < COUNT; i++) {
        const float p = 6.2831853f * test_uniform(&state), z = 2 * test_uniform(&state) - 1, r = sqrtf(1 - z * z);
        xx[i] = 0.1f + test_uniform(&state), yy[i] = 0.1f + test_uniform(&state);
        xy[i] = yx[i] = mean[i] = 0.05f * test_uniform(&state), weight[i] = test_uniform(&state);
        wi[0][i] = r * cosf(p), wi[1][i] = r * sinf(p), wi[2][i] = z;
        wm[0][i] = 0.3f * sinf(p), wm[1][i] = 0.3f * cosf(p), wm[2][i] = 0.95393920f;
        for (int k = 0; k < 3; k++)
            u[k][i] = test_uniform(&state);
    }
    TEST(stack_of(too_large) > LIMIT);
    const float parameters[] = {0.0f, 0.5f, 1.0f};
    family = vndf_family_of(d, parameters, 3, NULL);
    TEST(family != NULL);
    for (int k = 0; k < 3; k++) {
        surface = (vndf_surface){d[k], 0.3f, 0.1f, 0.05f, 0.4f, 0.02f, 0.01f};
        mixture.count = VNDF_MIXTURE_LOBES;
        for (int l = 0; l < VNDF_MIXTURE_LOBES; l++)
            mixture.lobe[l] = (vndf_mixture_lobe){vndf_rough(d[k], 0.1f * (float)(l + 1), 0.2f), 1.0f};
        test_batches(d[k]);
        CALL(one);
        CALL(one_mixture);
        test_bsdfs(d[k]);
    }
    vndf_family_free(family);
    vndf_free(table);
    return test_done();
}

#else
int main(void)
{
    puts("SKIPPED: stack is measured without sanitizers, optimised, where threads are POSIX's");
    return 0;
}
#endif
