/* No NaN and nothing infinite or negative comes out of the BSDF layer, whatever bits go in; directions that are
 * NaN, infinite or zero, at either end, and roughness that is not above 0, scatter nothing. Random bits of all
 * numbers at a hit, for every set of effects that makes sense, walks and all shapes among them, roughness from 1e-15
 * to 1e15; uniform numbers outside [0, 1] are as good as any. */
#include <float.h>

#include "bsdf/bsdf_case.h"

/* Mostly an ordinary number in [-1, 1], else any bits or one of the hard ones. */
static float some_number(unsigned long long *state)
{
    static const float hard[] = {0,         -0.0f,   1,        -1,      NAN,    INFINITY,
                                 -INFINITY, FLT_MIN, -FLT_MIN, FLT_MAX, 1e-45f, 0.99999994f};
    float which = test_uniform(state), any;
    unsigned bits = (unsigned)(test_random_bits(state) >> 32);
    memcpy(&any, &bits, sizeof any);
    return which < 0.6f ? 2 * test_uniform(state) - 1 : which < 0.8f ? bsdf_pick(hard, 12, state) : any;
}

static vndf_vec3 some_direction(unsigned long long *state)
{
    vndf_vec3 w = bsdf_direction(state);
    if (test_uniform(state) < 0.5f)
        return w;
    w.x = some_number(state);
    w.y = some_number(state);
    w.z = some_number(state);
    return test_uniform(state) < 0.1f ? (vndf_vec3){0, 0, 0} : w;
}

static int sound(float x)
{
    return x >= 0 && x <= FLT_MAX;
}

static int is_direction(vndf_vec3 w)
{
    return isfinite(w.x) && isfinite(w.y) && isfinite(w.z) && (w.x != 0 || w.y != 0 || w.z != 0);
}

/* `seen`: what the hit said of wi. */
static void check_hit(const vndf_description *is, const vndf_bsdf *bsdf, int seen, vndf_vec3 wi, vndf_vec3 wo,
                      const float u[3])
{
    vndf_scattered s;
    float f[VNDF_WAVELENGTHS], pdf = vndf_bsdf_pdf(bsdf, wo);
    int good = TEST(seen || pdf == 0), level = is->effects.shape < VNDF_SHAPE_AFFINE;
    vndf_bsdf_sample(bsdf, u, &s);
    vndf_bsdf_eval(bsdf, wo, 7, f);
    good &= TEST((s.lobe == VNDF_LOBE_NONE) == (s.density == 0) && (unsigned)s.lobe <= VNDF_LOBE_STRAIGHT);
    good &= TEST(sound(s.density) && sound(pdf) && is_direction(s.wo) && (seen || s.lobe == VNDF_LOBE_NONE));
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) {
        good &= TEST(sound(s.weight[i]) && sound(f[i]) && (s.density > 0 || s.weight[i] == 0));
        if (!is_direction(wo) || (level && wo.z == 0) || !seen)
            good &= TEST(pdf == 0 && f[i] == 0);
    }
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
    int is_rough = is->effects.shape <= VNDF_SHAPE_ROTATED;
    if (test_uniform(state) < 0.3f)
        *(test_uniform(state) < 0.5f ? &r.alpha_x : &r.alpha_y) = some_number(state);
    if (test_uniform(state) < 0.1f)
        r.cos_rotation = some_number(state);
    int seen = is_rough ? vndf_bsdf_rough(&bsdf, material, &r, wi) : vndf_bsdf_at(&bsdf, material, wi);
    TEST(!seen || (is_direction(wi) &&
                   (!is_rough || (r.alpha_x > 0 && r.alpha_y > 0 && isfinite(r.alpha_x) && isfinite(r.alpha_y)))));
    check_hit(is, &bsdf, seen, wi, wo, u);
}

static void test_set(const oracle_ndf *ndf, const vndf_effects *effects, unsigned long long seed)
{
    static const float alphas[] = {1e-3f, 0.3f, 1, 1e-15f, 1e15f, 30}, etas[] = {1, 0.01f, 100, 1.5f, 1.0000001f};
    unsigned long long state = seed;
    for (int k = 0; k < (test_quick() ? 2 : 6); k++) {
        bsdf_subject s;
        vndf_material material;
        bsdf_material(&s, ndf, 1, effects, alphas, k % 2 ? 3 : 6, &state);
        s.is.order_limit = 8;
        if (k % 3 == 0)
            s.is.eta = bsdf_pick(etas, 5, &state);
        if (vndf_material_resolve(&s.is, &material, NULL) != VNDF_OK) /* 1e-18 times the scale of a table */
            continue;
        for (int i = 0; i < 30; i++)
            test_any(&s.is, &material, &state);
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
