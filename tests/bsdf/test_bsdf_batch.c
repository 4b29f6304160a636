/* A batch of a BSDF gives the bits of its calls for one - directions, facets, lobes, weights, values and densities -
 * and writes nothing past its end: for sets of effects whose normals are drawn in blocks and some others, with both
 * instruction sets and without, for batches of one to several blocks that end anywhere, shared or own directions and
 * roughness, wi on either side, and numbers that are hard or invalid. */
#include "bsdf/bsdf_case.h"

enum { COUNT = 600, SPARE = 32 };

/* Every byte of results before the calls, and a float of four of them. */
enum { BYTE = 99 };
static const float MARK = 0x1.c6c6c6p71f;

typedef struct inputs {
    float wi[3][COUNT], wo[3][COUNT], u[3][COUNT], alpha[2][COUNT];
} inputs;

/* Results of the batch, and behind them numbers that have to stay. */
typedef struct results {
    float wo[3][COUNT + SPARE], wm[3][COUNT + SPARE], density[COUNT + SPARE];
    float weight[VNDF_WAVELENGTHS][COUNT + SPARE], value[VNDF_WAVELENGTHS][COUNT + SPARE];
    float alone[VNDF_WAVELENGTHS][COUNT + SPARE], pdf[COUNT + SPARE], pdf_alone[COUNT + SPARE];
    uint8_t lobe[COUNT + SPARE];
} results;

/* ---- inputs ---- */

static float hard(unsigned long long *state)
{
    static const float numbers[] = {0,     -0.0f,    1,      -1,           NAN,     HUGE_VALF, -HUGE_VALF, 1e-30f,
                                    1e30f, 0x1p-24f, 1e-45f, 1 - 0x1p-24f, -1e-10f, 0.5f,      2,          -3};
    return numbers[test_random_bits(state) >> 60];
}

static void put(float (*to)[COUNT], int i, vndf_vec3 w)
{
    to[0][i] = w.x;
    to[1][i] = w.y;
    to[2][i] = w.z;
}

/* `hostile`: every eighth number is hard. */
static void fill(inputs *in, float least, int hostile, unsigned long long *state)
{
    for (int i = 0; i < COUNT; i++) {
        float u[3];
        bsdf_numbers(state, u);
        put(in->wi, i, bsdf_direction(state));
        put(in->wo, i, bsdf_direction(state));
        for (int k = 0; k < 3; k++)
            in->u[k][i] = test_random_bits(state) >> 59 ? u[k] : hard(state);
        in->alpha[0][i] = least * (1 + 9 * test_uniform(state));
        in->alpha[1][i] = test_random_bits(state) >> 63 ? in->alpha[0][i] : least * (1 + 9 * test_uniform(state));
    }
    float *const all[] = {in->wi[0], in->wi[1], in->wi[2], in->wo[0],    in->wo[1],   in->wo[2],
                          in->u[0],  in->u[1],  in->u[2],  in->alpha[0], in->alpha[1]};
    for (int n = 0; n < 11 && hostile; n++)
        for (int i = 0; i < COUNT; i++)
            if (test_random_bits(state) >> 61 == 0)
                all[n][i] = hard(state);
}

/* ---- one batch ---- */

static void run(const vndf_bsdf_batch *b, const inputs *in, int with_wm, results *to)
{
    const float *const u[3] = {in->u[0], in->u[1], in->u[2]};
    vndf_scattered_n out = {{to->wo[0], to->wo[1], to->wo[2]}, {0}, to->density, to->lobe, {0}};
    const vndf_normals given = {(float *)in->wo[0], (float *)in->wo[1], (float *)in->wo[2]};
    float *value[VNDF_WAVELENGTHS], *alone[VNDF_WAVELENGTHS];
    if (with_wm)
        out.wm = (vndf_normals){to->wm[0], to->wm[1], to->wm[2]};
    for (int k = 0; k < VNDF_WAVELENGTHS; k++) {
        out.weight[k] = to->weight[k];
        value[k] = to->value[k];
        alone[k] = to->alone[k];
    }
    vndf_bsdf_sample_n(b, u, out);
    vndf_bsdf_eval_pdf_n(b, given, NULL, value, to->pdf);
    vndf_bsdf_eval_n(b, given, NULL, alone);
    vndf_bsdf_pdf_n(b, given, to->pdf_alone);
}

/* NaN is no result. */
static int same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0 && a == a;
}

static int same_sample(const vndf_scattered *s, const results *r, size_t i, int wavelengths, int with_wm)
{
    int good = same(s->wo.x, r->wo[0][i]) && same(s->wo.y, r->wo[1][i]) && same(s->wo.z, r->wo[2][i]) &&
               same(s->density, r->density[i]) && (int)s->lobe == r->lobe[i];
    if (with_wm)
        good = good && same(s->wm.x, r->wm[0][i]) && same(s->wm.y, r->wm[1][i]) && same(s->wm.z, r->wm[2][i]);
    for (int k = 0; k < VNDF_WAVELENGTHS; k++)
        good = good && same(k < wavelengths ? s->weight[k] : MARK, r->weight[k][i]);
    return good;
}

static int same_values(const float *f, float pdf, const results *r, size_t i, int wavelengths)
{
    int good = same(pdf, r->pdf[i]) && same(pdf, r->pdf_alone[i]);
    for (int k = 0; k < VNDF_WAVELENGTHS; k++) {
        float want = k < wavelengths ? f[k] : MARK;
        good = good && same(want, r->value[k][i]) && same(want, r->alone[k][i]);
    }
    return good;
}

static vndf_vec3 vector(const float (*of)[COUNT], size_t i)
{
    return (vndf_vec3){of[0][i], of[1][i], of[2][i]};
}

/* Compares with the calls for one. Counts the lobes that were met. */
static void compare(const vndf_bsdf_batch *b, const inputs *in, const results *r, int with_wm, size_t lobes[4])
{
    const vndf_material *m = b->material;
    for (size_t i = 0; i < b->count; i++) {
        size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i, from = b->shared & VNDF_SHARED_WI ? 0 : i;
        vndf_roughness rough = {in->alpha[0][at], in->alpha[1][at], 1, 0};
        const float u[3] = {in->u[0][i], in->u[1][i], in->u[2][i]};
        float f[VNDF_WAVELENGTHS], pdf;
        vndf_scattered s;
        vndf_bsdf hit;
        vndf_bsdf_rough(&hit, m, b->alpha_x ? &rough : NULL, vector(in->wi, from));
        vndf_bsdf_sample(&hit, u, &s);
        vndf_bsdf_eval_pdf(&hit, vector(in->wo, i), 0, f, &pdf);
        if (!TEST(same_sample(&s, r, i, m->is.wavelengths, with_wm)) ||
            !TEST(same_values(f, pdf, r, i, m->is.wavelengths)))
            bsdf_describe(&m->is, "batch", vector(in->wi, from), vector(in->wo, i));
        lobes[s.lobe]++;
    }
    for (size_t i = b->count; i < COUNT + SPARE; i++)
        TEST(r->lobe[i] == BYTE && r->wo[0][i] == MARK && r->wm[2][i] == MARK && r->density[i] == MARK &&
             r->weight[0][i] == MARK && r->value[0][i] == MARK && r->alone[0][i] == MARK && r->pdf[i] == MARK &&
             r->pdf_alone[i] == MARK);
}

/* ---- materials ---- */

/* Bare reflection, a Fresnel term, both lobes of a dielectric, and others that take turns. */
static vndf_effects effects_of(size_t n)
{
    static const vndf_fresnel fresnel[] = {VNDF_FRESNEL_NONE, VNDF_FRESNEL_SCHLICK, VNDF_FRESNEL_CONDUCTOR,
                                           VNDF_FRESNEL_DIELECTRIC};
    vndf_effects e = {0};
    e.fresnel = fresnel[n % 4];
    if (n % 8 == 3)
        e.lobes = VNDF_LOBES_BOTH;
    if (n % 16 == 9)
        e.masking = VNDF_MASKING_SEPARABLE;
    if (n % 16 == 13)
        e.lobes = VNDF_LOBES_BOTH;
    if (n % 16 == 15)
        e.lobes = VNDF_LOBES_TRANSMISSION;
    e.transport = n % 32 < 16 ? VNDF_TRANSPORT_RADIANCE : VNDF_TRANSPORT_IMPORTANCE;
    return e;
}

static void test_material(const oracle_ndf *ndf, size_t n, unsigned long long *state, size_t lobes[4])
{
    static const float alphas[] = {1e-3f, 0.03f, 0.1f, 0.4f, 0.5f, 1, 3};
    static const size_t counts[] = {1, 2, 7, 8, 16, 17, 255, 256, 257, 512, 575, 600};
    static const vndf_instructions limits[] = {VNDF_INSTRUCTIONS_BEST, VNDF_INSTRUCTIONS_BEST,
                                               VNDF_INSTRUCTIONS_AVX2, VNDF_INSTRUCTIONS_AVX2,
                                               VNDF_INSTRUCTIONS_PORTABLE};
    static inputs in;
    static results r;
    vndf_effects e = effects_of(n);
    vndf_description is = bsdf_material(ndf, &e, alphas, 7, state);
    vndf_material m;
    is.wavelengths = 1 + (int)(n / 3 % VNDF_WAVELENGTHS);
    if (n % 24 == 11)
        is.eta = 1;
    if (n % 40 == 2)
        is.conductor_k[0] = 0.01f; /* steep */
    TEST(vndf_material_resolve(&is, &m, NULL) == VNDF_OK);
    fill(&in, bsdf_pick(alphas, 7, state) / 5, n % 5 == 4, state);
    int own = test_uniform(state) < 0.5f, with_wm = test_uniform(state) < 0.7f;
    vndf_bsdf_batch b = {.material = &m, .shared = (unsigned)(4 * test_uniform(state))};
    b.count = counts[(size_t)(12 * test_uniform_double(state))];
    b.limit = limits[(size_t)(5 * test_uniform(state))];
    b.alpha_x = own ? in.alpha[0] : NULL;
    b.alpha_y = own ? in.alpha[1] : NULL;
    b.wi_x = in.wi[0];
    b.wi_y = in.wi[1];
    b.wi_z = in.wi[2];
    memset(&r, BYTE, sizeof r);
    run(&b, &in, with_wm, &r);
    compare(&b, &in, &r, with_wm, lobes);
}

static void test_ndf(const oracle_ndf *ndf)
{
    unsigned long long state = 11 + strlen(ndf->name);
    size_t lobes[4] = {0};
    for (size_t n = 0; n < test_amount(64, 256, 2048); n++)
        test_material(ndf, n, &state, lobes);
    for (int lobe = 0; lobe <= VNDF_LOBE_STRAIGHT; lobe++)
        TEST(lobes[lobe] > 10);
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx", "beckmann", "student-t-2.5-small", "student-t-2.5-large", "hazy"};
    for (size_t i = 0; i < 5; i++) {
        oracle_ndf ndf;
        if (!oracle_wanted(arguments, argument, i, names[i]) || !TEST(oracle_ndf_open(&ndf, names[i])))
            continue;
        test_ndf(&ndf);
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
