/* No NaN and nothing infinite or negative comes out of the BSDF layer, whatever bits go in; directions that are
 * NaN, infinite or zero, at either end, and roughness that is not above 0, scatter nothing. Random bits of all
 * numbers at a hit, for every set of effects that makes sense, walks among them; then one invalid number at a
 * time; uniform numbers outside [0, 1] are as good as any. */
#include <float.h>

#include "bsdf/bsdf_case.h"

static float any_bits(unsigned long long *state)
{
    unsigned bits = (unsigned)(test_random_bits(state) >> 32);
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Mostly an ordinary number in [-1, 1], else any bits or one of the hard ones. */
static float some_number(unsigned long long *state)
{
    static const float hard[] = {0,         -0.0f,   1,        -1,      NAN,    INFINITY,
                                 -INFINITY, FLT_MIN, -FLT_MIN, FLT_MAX, 1e-45f, 0.99999994f};
    float which = test_uniform(state);
    return which < 0.6f   ? 2 * test_uniform(state) - 1
           : which < 0.8f ? bsdf_pick(hard, sizeof hard / sizeof *hard, state)
                          : any_bits(state);
}

static vndf_vec3 some_direction(unsigned long long *state)
{
    vndf_vec3 w = bsdf_direction(state);
    if (test_uniform(state) < 0.5f)
        return w;
    w.x = some_number(state);
    w.y = some_number(state);
    w.z = some_number(state);
    return w;
}

static int sound(float x)
{
    return x >= 0 && x <= FLT_MAX;
}

static int sound_all(const float f[VNDF_WAVELENGTHS])
{
    return sound(f[0]) && sound(f[1]) && sound(f[2]);
}

static int is_direction(vndf_vec3 w)
{
    return isfinite(w.x) && isfinite(w.y) && isfinite(w.z) && (w.x != 0 || w.y != 0 || w.z != 0);
}

static int is_nothing(const vndf_scattered *s)
{
    return s->lobe == VNDF_LOBE_NONE && s->density == 0 && s->weight[0] == 0 && s->weight[1] == 0 &&
           s->weight[2] == 0;
}

static void check_hit(const vndf_description *is, const vndf_bsdf *bsdf, vndf_vec3 wi, vndf_vec3 wo,
                      const float u[3])
{
    vndf_scattered s;
    float f[VNDF_WAVELENGTHS], pdf = vndf_bsdf_pdf(bsdf, wo);
    vndf_bsdf_sample(bsdf, u, &s);
    vndf_bsdf_eval(bsdf, wo, 7, f);
    int good =
        TEST(sound_all(s.weight) && sound(s.density) && is_direction(s.wo)) & TEST(sound_all(f) && sound(pdf));
    good &= TEST((s.lobe == VNDF_LOBE_NONE) == (s.density == 0) && (unsigned)s.lobe <= VNDF_LOBE_STRAIGHT);
    if (!is_direction(wo) || wo.z == 0)
        good &= TEST(pdf == 0 && f[0] == 0 && f[1] == 0 && f[2] == 0);
    if (good)
        return;
    bsdf_describe(is, "", wi, wo);
    fprintf(stderr, "    u %g %g %g: lobe %d wo %g %g %g weight %g density %g; f %g pdf %g\n", (double)u[0],
            (double)u[1], (double)u[2], (int)s.lobe, (double)s.wo.x, (double)s.wo.y, (double)s.wo.z,
            (double)s.weight[0], (double)s.density, (double)f[0], (double)pdf);
}

/* Any numbers at once. */
static void test_any(const vndf_description *is, const vndf_material *material, unsigned long long *state)
{
    vndf_bsdf bsdf;
    vndf_vec3 wi = some_direction(state), wo = some_direction(state);
    float turn = 7 * test_uniform(state), u[3] = {some_number(state), some_number(state), some_number(state)};
    vndf_roughness r = {is->alpha_x, is->alpha_y, cosf(turn), sinf(turn)};
    if (test_uniform(state) < 0.3f)
        r.alpha_x = fabsf(some_number(state));
    if (test_uniform(state) < 0.1f)
        r.cos_rotation = some_number(state);
    int seen = vndf_bsdf_rough(&bsdf, material, &r, wi);
    if (!is_direction(wi) || !(r.alpha_x > 0) || !isfinite(r.alpha_x))
        TEST(!seen);
    check_hit(is, &bsdf, wi, wo, u);
}

/* One number at a time. */
static void test_one(const vndf_description *is, const vndf_material *material, unsigned long long *state)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    const float u[3] = {test_uniform(state), test_uniform(state), test_uniform(state)};
    vndf_vec3 wi = bsdf_direction(state), wo = bsdf_direction(state), zero = {0, 0, 0};
    vndf_scattered s;
    wi.z = fabsf(wi.z);
    for (int i = 0; i < 9; i++) {
        float *at[2][3] = {{&wi.x, &wi.y, &wi.z}, {&wo.x, &wo.y, &wo.z}};
        for (int end = 0; end < 2; end++) {
            vndf_bsdf bsdf;
            float keep = *at[end][i / 3];
            *at[end][i / 3] = bad[i % 3];
            TEST(vndf_bsdf_at(&bsdf, material, wi) == end);
            check_hit(is, &bsdf, wi, wo, u);
            vndf_bsdf_sample(&bsdf, u, &s);
            TEST(end == 1 || is_nothing(&s));
            *at[end][i / 3] = keep;
        }
    }
    vndf_bsdf bsdf;
    TEST(!vndf_bsdf_at(&bsdf, material, zero));
    vndf_bsdf_sample(&bsdf, u, &s);
    TEST(is_nothing(&s));
}

static void test_roughness(const vndf_description *is, const vndf_material *material, unsigned long long *state)
{
    static const float bad[] = {0, -1, NAN, INFINITY, -INFINITY, 1e-30f, 1e30f};
    const float u[3] = {0.3f, 0.6f, 0.4f};
    vndf_vec3 wi = {0.6f, 0, 0.8f}, wo = bsdf_direction(state);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        for (int axis = 0; axis < 2; axis++) {
            vndf_roughness r = {axis ? 0.3f : bad[i], axis ? bad[i] : 0.3f, 1, 0};
            vndf_scattered s;
            vndf_bsdf bsdf;
            TEST(!vndf_bsdf_rough(&bsdf, material, &r, wi));
            vndf_bsdf_sample(&bsdf, u, &s);
            TEST(is_nothing(&s));
            check_hit(is, &bsdf, wi, wo, u);
        }
}

static void test_set(const oracle_ndf *ndf, const vndf_effects *effects, unsigned long long seed)
{
    static const float alphas[] = {1e-3f, 0.3f, 1, 1e-15f, 1e15f, 30};
    static const float etas[] = {1, 0.01f, 100, 1.5f, 1.0000001f};
    unsigned long long state = seed;
    for (int k = 0; k < (test_quick() ? 4 : 12); k++) {
        vndf_description is = bsdf_material(ndf, effects, alphas, k % 2 ? 3 : 6, &state);
        vndf_material material;
        is.order_limit = 8;
        if (k % 3 == 0)
            is.eta = bsdf_pick(etas, 5, &state);
        if (vndf_material_resolve(&is, &material, NULL) != VNDF_OK) /* 1e-18 times the scale of a table */
            continue;
        for (int i = 0; i < 40; i++)
            test_any(&is, &material, &state);
        if (k % 4 == 1) {
            test_one(&is, &material, &state);
            test_roughness(&is, &material, &state);
        }
    }
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx", "beckmann", "hazy"};
    for (size_t n = 0; n < 3; n++) {
        oracle_ndf ndf;
        if (!oracle_wanted(arguments, argument, n, names[n]) || !TEST(oracle_ndf_open(&ndf, names[n])))
            continue;
        for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
            vndf_effects effects = oracle_effects(i);
            if (oracle_effects_sensible(&effects))
                test_set(&ndf, &effects, 1000 * n + i + 5);
        }
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
