/* A sample's weight is f |cos_o|/density and its density what vndf_bsdf_pdf gives for its direction, both to
 * 1e-5, for every sensible set of effects, GGX, Beckmann and tables, roughness from 1e-3 to 3, from both sides,
 * cosines down to 1e-6, index ratios down to 1.001 and up to 2.4. The direction is unit within 10 ulps and on the
 * side that the lobe says; a lost sample is (0, 0, 1) with weights and density 0. Only samples whose f or density
 * is beyond what a float holds are left out, and counted. */
#include <float.h>

#include "bsdf/bsdf_case.h"

static const float ALPHAS[] = {1e-3f, 0.01f, 0.05f, 0.3f, 1, 3};
enum { ALPHA_COUNT = 6 };

typedef struct finding {
    double weight, density, length; /* largest errors */
    size_t kept, lost, extreme;
} finding;

static void check_lost(const vndf_scattered *s)
{
    TEST(s->density == 0 && s->weight[0] == 0 && s->weight[1] == 0 && s->weight[2] == 0);
    TEST(s->wo.x == 0 && s->wo.y == 0 && s->wo.z == 1);
}

static int check_place(const vndf_scattered *s, vndf_vec3 wi, finding *found)
{
    double w[3];
    int same = (s->wo.z > 0) == (wi.z > 0);
    oracle_from_vec3(s->wo, w);
    double length = fabs(sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) - 1);
    found->length = fmax(found->length, length);
    return TEST(length <= 10 * 0x1p-23) & TEST(w[2] != 0 && s->density > 0) &
           TEST((s->lobe == VNDF_LOBE_REFLECTION) == same);
}

static int check_weight(const vndf_bsdf *bsdf, const vndf_scattered *s, finding *found)
{
    float f[VNDF_WAVELENGTHS], pdf = vndf_bsdf_pdf(bsdf, s->wo);
    double density = fabs((double)pdf / (double)s->density - 1), worst = 0;
    /* G2 of transmission through V-cavities is a difference: as exact as what it is taken from */
    double least = bsdf->material->is.effects.masking == VNDF_MASKING_V_CAVITIES ? 2 : 1e-30;
    vndf_bsdf_eval(bsdf, s->wo, 0, f);
    if (!(s->density < 1e37f) || !(s->density > 1e-30f)) {
        found->extreme++;
        return 1;
    }
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) {
        double want = (double)f[i] * fabs((double)s->wo.z) / (double)s->density;
        if (f[i] < 1e37f &&
            (f[i] > 1e-30f || s->weight[i] > 1e-6f)) /* below it f has been cut to 0 or to FLT_MIN */
            worst = fmax(worst, fabs((double)s->weight[i] - want) / fmax(want, least));
    }
    found->kept++;
    found->density = fmax(found->density, density);
    found->weight = fmax(found->weight, worst);
    return TEST(density <= 1e-5) & TEST(worst <= 1e-5);
}

static void check_sample(const vndf_description *is, const char *name, vndf_vec3 wi, const float u[3],
                         finding *found)
{
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_scattered s;
    TEST(vndf_material_resolve(is, &material, NULL) == VNDF_OK);
    TEST(vndf_bsdf_at(&bsdf, &material, wi));
    vndf_bsdf_sample(&bsdf, u, &s);
    if (s.lobe == VNDF_LOBE_NONE) {
        found->lost++;
        check_lost(&s);
        return;
    }
    if (check_place(&s, wi, found) & check_weight(&bsdf, &s, found))
        return;
    float f[VNDF_WAVELENGTHS];
    vndf_bsdf_eval(&bsdf, s.wo, 0, f);
    bsdf_describe(is, name, wi, s.wo);
    fprintf(stderr, "    u %.9g %.9g %.9g: lobe %d, density %.9g pdf %.9g, weight %.9g f cos/density %.9g\n",
            (double)u[0], (double)u[1], (double)u[2], (int)s.lobe, (double)s.density,
            (double)vndf_bsdf_pdf(&bsdf, s.wo), (double)s.weight[0],
            (double)f[0] * fabs((double)s.wo.z) / (double)s.density);
}

static void test_set(const oracle_ndf *ndf, const vndf_effects *effects, unsigned long long seed, finding *found)
{
    unsigned long long state = seed;
    for (int k = 0; k < (test_quick() ? 40 : 200); k++) {
        vndf_description is = bsdf_material(ndf, effects, ALPHAS, ALPHA_COUNT, &state);
        vndf_vec3 wi = bsdf_direction(&state);
        float u[3];
        bsdf_numbers(&state, u);
        if (k % 8 == 0) /* far out, or beside the pole */
            u[1] = k % 16 == 0 ? u[1] * 1e-5f : 1 - u[1] * 1e-5f;
        if (!oracle_bsdf_two_sided(effects))
            wi.z = fabsf(wi.z);
        check_sample(&is, ndf->name, wi, u, found);
    }
}

static void test_ndf(const char *name, unsigned long long seed)
{
    oracle_ndf ndf;
    finding found = {0, 0, 0, 0, 0, 0};
    if (!TEST(oracle_ndf_open(&ndf, name)))
        return;
    for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
        vndf_effects effects = oracle_effects(i);
        if (effects.scattering == VNDF_SCATTERING_SINGLE && oracle_effects_sensible(&effects))
            test_set(&ndf, &effects, seed + i, &found);
    }
    printf("%s: weight within %.2g, density within %.2g, length within %.2g; %lu samples, %lu lost, %lu extreme\n",
           name, found.weight, found.density, found.length, (unsigned long)found.kept, (unsigned long)found.lost,
           (unsigned long)found.extreme);
    TEST(found.kept > 2 * found.lost && found.extreme < found.kept / 20);
    oracle_ndf_close(&ndf);
}

/* Points that a search found: with Beckmann far out, and beside the pole, where a small table's azimuth is steep. */
typedef struct found_point {
    const char *name;
    int both;
    float alpha_x, alpha_y;
    vndf_vec3 wi;
    float u[3];
} found_point;

static const found_point FOUND[] = {
    {"beckmann",
     0,
     2.5371747f,
     0.0534297973f,
     {0.723192155f, -0.684835255f, 0.0894079581f},
     {2.29220495e-06f, 0.999998629f, 0.2f}},
    {"beckmann",
     0,
     0.29682976f,
     2.46248651f,
     {-0.998412549f, 0.048978541f, 0.0278114453f},
     {1.404059e-08f, 0.999478221f, 0.7f}},
    {"beckmann",
     1,
     1.33290720f,
     1.39052498f,
     {-0.559509099f, -0.292215794f, 0.775602639f},
     {2.39730707e-06f, 1.47953081e-08f, 0.256229937f}},
    {"beckmann",
     1,
     1.54292583f,
     1.5748632f,
     {-0.644765377f, -0.0168178678f, 0.764195502f},
     {2.37543372e-08f, 1.34521883e-06f, 0.646892607f}},
    {"student-t-2.5-small",
     0,
     3.12432814f,
     0.776679993f,
     {0.589946628f, 0.792322278f, 0.15552628f},
     {0.999910235f, 0.00725647854f, 0.9f}},
    {"student-t-2.5-small",
     0,
     1.72422671f,
     0.434209168f,
     {0.816814303f, 0.54522115f, 0.188542724f},
     {0.999924541f, 0.0151153496f, 0.7f}},
};

static void test_found(const found_point *at)
{
    oracle_ndf ndf;
    finding found = {0, 0, 0, 0, 0, 0};
    vndf_description is = {
        .alpha_x = at->alpha_x, .alpha_y = at->alpha_y, .eta = 1.5f, .wavelengths = VNDF_WAVELENGTHS};
    if (!TEST(oracle_ndf_open(&ndf, at->name)))
        return;
    is.distribution = ndf.distribution;
    if (at->both) {
        is.effects.lobes = VNDF_LOBES_BOTH;
        is.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    }
    check_sample(&is, at->name, at->wi, at->u, &found);
    TEST(found.kept == 1);
    oracle_ndf_close(&ndf);
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {
        "ggx", "beckmann", "student-t-2.5", "hazy", "epd-0.6", "sgd-blue-metallic-paint-b", "abc-two-layer-gold"};
    for (size_t i = 0; i < 7; i++)
        if (oracle_wanted(arguments, argument, i, names[i]))
            test_ndf(names[i], 1000 * i + 23);
    for (size_t i = 0; i < sizeof FOUND / sizeof *FOUND; i++)
        test_found(&FOUND[i]);
    return test_done();
}
