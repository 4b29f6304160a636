/* The calls on a hit agree with each other, to the bit where nothing is rounded anew: value and density at once are
 * those of each alone; element i of a batch is the call for one, for every shape; a material of 1, 2, 3 or 4
 * wavelengths has the first so many values of one with 4, and writes no more; the facet of a sample, wm, faces wi and
 * takes it to wo, within 1e-5; retroreflection turns wo by half a turn and nothing else. A call that is made for
 * another shape scatters nothing. */
#include <float.h>

#include "bsdf/bsdf_case.h"

static const float ALPHAS[] = {0.03f, 0.2f, 0.7f};
enum { ALPHA_COUNT = 3, MARK = 77 };

static vndf_mixture MIXTURE;

static void lean(vndf_affine *a, const vndf_distribution *d, unsigned long long *state)
{
    float alpha = 0.05f + test_uniform(state);
    *a = (vndf_affine){d, alpha, 0.3f * test_uniform(state), -0.2f * test_uniform(state), 0.5f * alpha + 0.1f,
                       0, 0};
    a->mean_x = test_uniform(state) - 0.5f;
    a->mean_y = test_uniform(state) - 0.5f;
}

/* Any effects that make sense with the shape; the walk among them. */
static int random_description(const oracle_ndf *ndf, vndf_shape shape, unsigned long long *state,
                              vndf_description *is)
{
    vndf_effects e = oracle_effects((size_t)(ORACLE_EFFECT_SETS * test_uniform_double(state)));
    vndf_material m;
    e.shape = shape;
    e.reflection = test_uniform(state) < 0.2f ? VNDF_REFLECTION_RETRO : VNDF_REFLECTION_SPECULAR;
    *is = bsdf_material(ndf, &e, ALPHAS, ALPHA_COUNT, state);
    lean(&is->affine, NULL, state);
    is->mixture = &MIXTURE;
    is->wavelengths = 1 + (int)(VNDF_WAVELENGTHS * test_uniform(state));
    return vndf_material_resolve(is, &m, NULL) == VNDF_OK;
}

static int same(const float *a, const float *b, int count)
{
    return memcmp(a, b, (size_t)count * sizeof *a) == 0;
}

/* ---- one hit ---- */

static void check_both_at_once(const vndf_bsdf *b, int wavelengths, vndf_vec3 wo, uint64_t seed)
{
    float alone[VNDF_WAVELENGTHS + 1], together[VNDF_WAVELENGTHS + 1], pdf = -1;
    for (int i = 0; i <= VNDF_WAVELENGTHS; i++)
        alone[i] = together[i] = MARK;
    vndf_bsdf_eval(b, wo, seed, alone);
    vndf_bsdf_eval_pdf(b, wo, seed, together, &pdf);
    TEST(same(alone, together, VNDF_WAVELENGTHS + 1) && pdf == vndf_bsdf_pdf(b, wo));
    for (int i = wavelengths; i <= VNDF_WAVELENGTHS; i++)
        TEST(alone[i] == MARK);
}

static double dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* wi - (wi.wm) wm, and that of wo times the index ratio, are opposite. */
static void check_facet(const vndf_bsdf *b, const vndf_description *is, vndf_vec3 wi, const vndf_scattered *s)
{
    vndf_vec3 wo = s->wo, m = s->wm, rest;
    int walks = is->effects.scattering == VNDF_SCATTERING_MULTIPLE;
    if (s->lobe == VNDF_LOBE_NONE || walks) {
        TEST(m.x == 0 && m.y == 0 && m.z == 0);
        return;
    }
    if (s->lobe == VNDF_LOBE_REFLECTION && is->effects.reflection == VNDF_REFLECTION_RETRO) {
        wo.x = -wo.x;
        wo.y = -wo.y;
    }
    double eta = s->lobe == VNDF_LOBE_REFLECTION ? 1 : b->eta, i = dot(wi, m), o = dot(wo, m);
    rest.x = (float)((double)wi.x - i * (double)m.x + eta * ((double)wo.x - o * (double)m.x));
    rest.y = (float)((double)wi.y - i * (double)m.y + eta * ((double)wo.y - o * (double)m.y));
    rest.z = (float)((double)wi.z - i * (double)m.z + eta * ((double)wo.z - o * (double)m.z));
    TEST(i > -1e-6 && fabs(dot(m, m) - 1) < 1e-5 && sqrt(dot(rest, rest)) < 1e-5 * fmax(eta, 1));
    TEST(s->lobe == VNDF_LOBE_REFLECTION ? o > -1e-6 : o < 1e-6);
}

/* Values of one wavelength do not depend on how many there are; lobes are chosen by their mean. */
static void check_fewer(const vndf_description *is, vndf_vec3 wi, vndf_vec3 wo)
{
    float f[VNDF_WAVELENGTHS], all[VNDF_WAVELENGTHS];
    vndf_description more = *is;
    vndf_material m[2];
    vndf_bsdf b[2];
    if (is->effects.scattering == VNDF_SCATTERING_MULTIPLE)
        return;
    more.wavelengths = VNDF_WAVELENGTHS;
    TEST(vndf_material_resolve(is, &m[0], NULL) == VNDF_OK &&
         vndf_material_resolve(&more, &m[1], NULL) == VNDF_OK);
    for (int i = 0; i < 2; i++)
        vndf_bsdf_at(&b[i], &m[i], wi);
    vndf_bsdf_eval(&b[0], wo, 0, f);
    vndf_bsdf_eval(&b[1], wo, 0, all);
    TEST(same(f, all, is->wavelengths));
}

static void check_retro(const vndf_description *is, vndf_vec3 wi, vndf_vec3 wo, const float u[3])
{
    vndf_description plain = *is;
    vndf_material m[2];
    vndf_bsdf b[2];
    vndf_scattered s[2];
    float f[2][VNDF_WAVELENGTHS];
    if (is->effects.reflection != VNDF_REFLECTION_RETRO)
        return;
    plain.effects.reflection = VNDF_REFLECTION_SPECULAR;
    TEST(vndf_material_resolve(&plain, &m[0], NULL) == VNDF_OK &&
         vndf_material_resolve(is, &m[1], NULL) == VNDF_OK);
    for (int i = 0; i < 2; i++) {
        int turns = i == 1 && wo.z * wi.z > 0;
        vndf_vec3 to = {turns ? -wo.x : wo.x, turns ? -wo.y : wo.y, wo.z};
        if (!vndf_bsdf_at(&b[i], &m[i], wi))
            return;
        vndf_bsdf_sample(&b[i], u, &s[i]);
        vndf_bsdf_eval(&b[i], to, 5, f[i]);
    }
    float sign = s[0].lobe == VNDF_LOBE_REFLECTION ? -1.0f : 1.0f;
    TEST(s[1].wo.x == sign * s[0].wo.x && s[1].wo.y == sign * s[0].wo.y && s[1].wo.z == s[0].wo.z);
    TEST(s[1].density == s[0].density && same(s[0].weight, s[1].weight, is->wavelengths));
    TEST(same(f[0], f[1], is->wavelengths));
}

static void test_hit(const vndf_description *is, unsigned long long *state)
{
    vndf_material m;
    vndf_bsdf b;
    vndf_scattered s;
    vndf_vec3 wi = bsdf_direction(state), wo = bsdf_direction(state);
    float u[3];
    bsdf_numbers(state, u);
    TEST(vndf_material_resolve(is, &m, NULL) == VNDF_OK);
    vndf_bsdf_at(&b, &m, wi);
    vndf_bsdf_sample(&b, u, &s);
    check_both_at_once(&b, is->wavelengths, wo, 9);
    check_both_at_once(&b, is->wavelengths, s.wo, 9);
    check_facet(&b, is, wi, &s);
    check_fewer(is, wi, wo);
    check_retro(is, wi, wo, u);
}

/* ---- batches ---- */

enum { COUNT = 37 };

typedef struct arrays {
    float u[3][COUNT], wi[3][COUNT], wo[3][COUNT], wm[3][COUNT], alpha[2][COUNT], turn[2][COUNT];
    float weight[VNDF_WAVELENGTHS][COUNT], value[VNDF_WAVELENGTHS][COUNT], density[COUNT], pdf[COUNT];
    float alone[VNDF_WAVELENGTHS][COUNT], pdf_alone[COUNT];
    vndf_affine affine[COUNT];
    vndf_mixture mixture[COUNT];
    uint64_t seed[COUNT];
    uint8_t lobe[COUNT];
} arrays;

static void fill(arrays *a, const vndf_distribution *d, unsigned long long *state)
{
    for (int i = 0; i < COUNT; i++) {
        vndf_vec3 wi = bsdf_direction(state);
        float u[3], angle = 7 * test_uniform(state);
        bsdf_numbers(state, u);
        for (int k = 0; k < 3; k++)
            a->u[k][i] = u[k];
        a->wi[0][i] = wi.x;
        a->wi[1][i] = wi.y;
        a->wi[2][i] = wi.z;
        a->alpha[0][i] = 0.02f + test_uniform(state);
        a->alpha[1][i] = i % 7 ? 0.02f + test_uniform(state) : -1.0f;
        a->turn[0][i] = cosf(angle);
        a->turn[1][i] = sinf(angle);
        lean(&a->affine[i], NULL, state);
        a->mixture[i] = MIXTURE;
        lean(&a->mixture[i].lobe[0].surface, d, state);
        a->mixture[i].lobe[1].weight = i % 5 ? test_uniform(state) : -1.0f;
        a->seed[i] = (uint64_t)i;
    }
}

static int prepare(vndf_bsdf *b, const vndf_material *m, const arrays *a, const vndf_bsdf_batch *batch, int i)
{
    int at = batch->shared & VNDF_SHARED_ALPHA ? 0 : i, from = batch->shared & VNDF_SHARED_WI ? 0 : i;
    vndf_vec3 wi = {a->wi[0][from], a->wi[1][from], a->wi[2][from]};
    vndf_roughness r = {a->alpha[0][at], a->alpha[1][at], a->turn[0][at], a->turn[1][at]};
    switch (m->is.effects.shape) {
    case VNDF_SHAPE_MATRIX:
    case VNDF_SHAPE_AFFINE: return vndf_bsdf_affine(b, m, batch->affine ? &a->affine[at] : NULL, wi);
    case VNDF_SHAPE_MIXTURE: return vndf_bsdf_mixture(b, m, batch->mixture ? &a->mixture[at] : NULL, wi);
    default: return vndf_bsdf_rough(b, m, batch->alpha_x ? &r : NULL, wi);
    }
}

static void check_element(const vndf_material *m, const arrays *a, const vndf_bsdf_batch *batch, int i)
{
    const float u[3] = {a->u[0][i], a->u[1][i], a->u[2][i]};
    float f[VNDF_WAVELENGTHS], pdf;
    vndf_scattered s;
    vndf_bsdf b;
    prepare(&b, m, a, batch, i);
    vndf_bsdf_sample(&b, u, &s);
    TEST(s.wo.x == a->wo[0][i] && s.wo.y == a->wo[1][i] && s.wo.z == a->wo[2][i] && s.density == a->density[i]);
    TEST(s.wm.x == a->wm[0][i] && s.wm.y == a->wm[1][i] && s.wm.z == a->wm[2][i] && (int)s.lobe == a->lobe[i]);
    vndf_bsdf_eval_pdf(&b, s.wo, a->seed[i], f, &pdf);
    TEST(pdf == a->pdf[i] && pdf == a->pdf_alone[i]);
    for (int k = 0; k < m->is.wavelengths; k++)
        TEST(s.weight[k] == a->weight[k][i] && f[k] == a->value[k][i] && f[k] == a->alone[k][i]);
}

static void test_batch(const vndf_description *is, unsigned shared, int of_material, unsigned long long *state)
{
    static arrays a;
    vndf_material m;
    fill(&a, is->distribution, state);
    TEST(vndf_material_resolve(is, &m, NULL) == VNDF_OK);
    vndf_bsdf_batch batch = {.material = &m, .count = COUNT, .shared = shared};
    batch.wi_x = a.wi[0];
    batch.wi_y = a.wi[1];
    batch.wi_z = a.wi[2];
    if (!of_material) {
        batch.alpha_x = a.alpha[0];
        batch.alpha_y = a.alpha[1];
        batch.cos_rotation = a.turn[0];
        batch.sin_rotation = a.turn[1];
        batch.affine = a.affine;
        batch.mixture = a.mixture;
    }
    const float *const u[3] = {a.u[0], a.u[1], a.u[2]};
    vndf_scattered_n out = {{a.wo[0], a.wo[1], a.wo[2]}, {0}, a.density, a.lobe, {a.wm[0], a.wm[1], a.wm[2]}};
    float *value[VNDF_WAVELENGTHS], *alone[VNDF_WAVELENGTHS];
    for (int k = 0; k < VNDF_WAVELENGTHS; k++) {
        out.weight[k] = a.weight[k];
        value[k] = a.value[k];
        alone[k] = a.alone[k];
    }
    vndf_bsdf_sample_n(&batch, u, out);
    vndf_bsdf_eval_pdf_n(&batch, out.wo, a.seed, value, a.pdf);
    vndf_bsdf_eval_n(&batch, out.wo, a.seed, alone);
    vndf_bsdf_pdf_n(&batch, out.wo, a.pdf_alone);
    for (int i = 0; i < COUNT; i++)
        check_element(&m, &a, &batch, i);
}

/* ---- calls for another shape ---- */

static void test_other_shapes(const oracle_ndf *ndf)
{
    unsigned long long state = 3;
    const vndf_vec3 wi = {0.6f, 0, 0.8f};
    const vndf_roughness r = {0.3f, 0.3f, 1, 0};
    vndf_affine singular = {NULL, 1, 2, 2, 4, 0, 0};
    for (int shape = 0; shape <= VNDF_SHAPE_MIXTURE; shape++) {
        vndf_description is = {.distribution = ndf->distribution, .alpha_x = 0.3f, .alpha_y = 0.3f};
        vndf_material m;
        vndf_bsdf b;
        is.effects.shape = (vndf_shape)shape;
        lean(&is.affine, NULL, &state);
        int affine = shape == VNDF_SHAPE_MATRIX || shape == VNDF_SHAPE_AFFINE,
            mixture = shape == VNDF_SHAPE_MIXTURE;
        TEST(vndf_material_resolve(&is, &m, NULL) == VNDF_OK);
        TEST(vndf_bsdf_rough(&b, &m, &r, wi) == (!affine && !mixture));
        TEST(vndf_bsdf_affine(&b, &m, &is.affine, wi) == affine);
        TEST(vndf_bsdf_mixture(&b, &m, &MIXTURE, wi) == mixture);
        TEST(vndf_bsdf_at(&b, &m, wi) == !mixture); /* it brought none */
        TEST(!vndf_bsdf_affine(&b, &m, &singular, wi));
    }
}

static void test_refused(const oracle_ndf *ndf)
{
    vndf_description is = {.distribution = ndf->distribution, .effects = {.shape = VNDF_SHAPE_AFFINE}};
    vndf_error error = {VNDF_OK, ""};
    vndf_material m;
    is.affine = (vndf_affine){NULL, 1, 2, 2, 4, 0, 0};
    TEST(vndf_material_resolve(&is, &m, &error) == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "affine");
    is = (vndf_description){.distribution = ndf->distribution, .alpha_x = 1, .alpha_y = 1, .wavelengths = 5};
    TEST(vndf_material_resolve(&is, &m, &error) == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "wavelengths");
}

static void test_ndf(const oracle_ndf *ndf, unsigned long long seed)
{
    unsigned long long state = seed;
    size_t tried[VNDF_SHAPE_MIXTURE + 1] = {0};
    MIXTURE.count = 2;
    lean(&MIXTURE.lobe[0].surface, ndf->distribution, &state);
    lean(&MIXTURE.lobe[1].surface, vndf_ggx(), &state);
    MIXTURE.lobe[0].weight = 1;
    MIXTURE.lobe[1].weight = 0.4f;
    for (size_t n = 0; n < test_amount(4000, 20000, 20000); n++) {
        vndf_description is;
        vndf_shape shape = (vndf_shape)(n % (VNDF_SHAPE_MIXTURE + 1));
        if (!random_description(ndf, shape, &state, &is))
            continue;
        tried[shape]++;
        test_hit(&is, &state);
        if (tried[shape] % 20 == 0)
            test_batch(&is, (unsigned)(n / 5 % 4), n / 20 % 3 == 0, &state);
    }
    for (int i = 0; i <= VNDF_SHAPE_MIXTURE; i++)
        TEST(tried[i] > 40);
    test_other_shapes(ndf);
    test_refused(ndf);
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx", "beckmann", "student-t-2.5"};
    for (size_t i = 0; i < 3; i++) {
        oracle_ndf ndf;
        if (!oracle_wanted(arguments, argument, i, names[i]) || !TEST(oracle_ndf_open(&ndf, names[i])))
            continue;
        test_ndf(&ndf, 5 + i);
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
