/* vndf_bsdf_eval and vndf_bsdf_pdf are the published formulas, within 1e-5, of directions within two roundings
 * (2^-22) of those that are given: for every sensible set of effects, GGX, Beckmann and tables, roughness from 0.01
 * to 2, isotropic, anisotropic and rotated, from both sides, index ratios down to 1.001 and up to 2.4, cosines down
 * to 1e-6. Tested at directions that were sampled and at ones that are spread over the sphere. The formulas are of
 * directions; where it shows that a float direction is not unit, either reading is right. The law of bounded normals
 * is the library's own: bsdf_quadrature and bsdf_chi_square are for it. */
#include <float.h>

#include "bsdf/bsdf_case.h"

static const float ALPHAS[] = {0.01f, 0.05f, 0.3f, 1, 2};
enum { ALPHA_COUNT = 5 };

/* A value of the formulas and how far it is from there to other readings of the same floats. */
typedef struct reading {
    double value, spread;
} reading;

static int agrees(double got, reading want, double *worst)
{
    double error = fmax(fabs(got - want.value) - want.spread, 0);
    if (!(want.value >
          1e-30)) /* underflow; the tail of Beckmann's density ends where exp underflows, over wm.z^3 */
        return got <= 1e-4 + want.spread;
    if (want.value > (double)FLT_MAX)
        return got >= (double)FLT_MAX * 0.99999;
    *worst = fmax(*worst, error / want.value);
    return error <= 1e-5 * want.value;
}

/* f of the wavelengths and the density. */
enum { READINGS = VNDF_WAVELENGTHS + 1 };

static void widen(const oracle_value *by, reading want[READINGS])
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        want[i].spread += fabs(by->f[i] - want[i].value);
    want[VNDF_WAVELENGTHS].spread += fabs(by->pdf - want[VNDF_WAVELENGTHS].value);
}

/* Directions count, but lengths may: two roundings of them. Half vectors are floats: two roundings of directions. */
static void read_formulas(oracle_bsdf *o, double wi[3], double wo[3], reading want[READINGS])
{
    o->lengths = 0;
    oracle_value plain = oracle_bsdf_eval(o, wi, wo), other;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        want[i] = (reading){plain.f[i], 0};
    want[VNDF_WAVELENGTHS] = (reading){plain.pdf, 0};
    o->lengths = 1;
    other = oracle_bsdf_eval(o, wi, wo);
    widen(&other, want);
    widen(&other, want);
    for (int i = 0; i < 6; i++) {
        double *at = i < 3 ? &wi[i] : &wo[i - 3], given = *at;
        *at += 0x1p-22;
        other = oracle_bsdf_eval(o, wi, wo);
        widen(&other, want);
        *at = given;
    }
}

typedef struct finding {
    double eval, pdf;
    size_t positive, zero;
} finding;

static void check_at(oracle_bsdf *o, const vndf_bsdf *bsdf, vndf_vec3 wi, vndf_vec3 wo, finding *found)
{
    double i[3], t[3];
    float f[VNDF_WAVELENGTHS], pdf = vndf_bsdf_pdf(bsdf, wo);
    reading want[READINGS], *density = &want[VNDF_WAVELENGTHS];
    int good = 1;
    oracle_from_vec3(wi, i);
    oracle_from_vec3(wo, t);
    vndf_bsdf_eval(bsdf, wo, 1, f);
    read_formulas(o, i, t, want);
    for (int w = 0; w < VNDF_WAVELENGTHS; w++)
        good &= TEST(agrees((double)f[w], want[w], &found->eval));
    if (density->value >= 0)
        good &= TEST(agrees((double)pdf, *density, &found->pdf));
    *(want[0].value > 0 ? &found->positive : &found->zero) += 1;
    if (good)
        return;
    bsdf_describe(&o->is, o->ndf->name, wi, wo);
    fprintf(stderr, "    eval %.9g want %.9g +- %.2g; pdf %.9g want %.9g +- %.2g\n", (double)f[0], want[0].value,
            want[0].spread, (double)pdf, density->value, density->spread);
}

static void test_set(const oracle_ndf *ndf, const vndf_effects *effects, unsigned long long seed, finding *found)
{
    unsigned long long state = seed;
    for (int k = 0; k < (test_quick() ? 20 : 100); k++) {
        oracle_bsdf o = {ndf, bsdf_material(ndf, effects, ALPHAS, ALPHA_COUNT, &state), 0};
        vndf_vec3 wi = bsdf_direction(&state);
        vndf_material material;
        vndf_bsdf bsdf;
        vndf_scattered s;
        float u[3];
        bsdf_numbers(&state, u);
        TEST(vndf_material_resolve(&o.is, &material, NULL) == VNDF_OK);
        if (!oracle_bsdf_two_sided(effects) && k % 8)
            wi.z = fabsf(wi.z);
        TEST(vndf_bsdf_at(&bsdf, &material, wi) == (wi.z > 0 || oracle_bsdf_two_sided(effects)));
        vndf_bsdf_sample(&bsdf, u, &s);
        if (s.lobe == VNDF_LOBE_REFLECTION || s.lobe == VNDF_LOBE_TRANSMISSION)
            check_at(&o, &bsdf, wi, s.wo, found);
        check_at(&o, &bsdf, wi, bsdf_direction(&state), found);
    }
}

static void test_ndf(const char *name, unsigned long long seed)
{
    oracle_ndf ndf;
    finding found = {0, 0, 0, 0};
    if (!TEST(oracle_ndf_open(&ndf, name)))
        return;
    for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
        vndf_effects effects = oracle_effects(i);
        if (effects.scattering == VNDF_SCATTERING_SINGLE && oracle_effects_sensible(&effects))
            test_set(&ndf, &effects, seed + i, &found);
    }
    printf("%s: eval within %.2g, pdf within %.2g; %lu values above 0, %lu at 0\n", name, found.eval, found.pdf,
           (unsigned long)found.positive, (unsigned long)found.zero);
    TEST(found.positive > found.zero / 4 && found.zero > 0);
    oracle_ndf_close(&ndf);
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx", "beckmann", "student-t-2.5", "hazy", "epd-0.6"};
    for (size_t i = 0; i < 5; i++)
        if (oracle_wanted(arguments, argument, i, names[i]))
            test_ndf(names[i], 1000 * i + 17);
    return test_done();
}
