/* A sample's weight is, within 1e-5, f |cos_o| over the density of the sample or over vndf_bsdf_pdf, and that
 * density vndf_bsdf_pdf, of a direction within one rounding (2^-23 in each coordinate) of wo, for 99.9% of the
 * samples (weights of normals that are not visible ones 99.5%), in every sensible set of effects, GGX, Beckmann
 * and tables, Schlick's f0 from 0 on, roughness from 1e-3 to 3, from both sides, cosines down to 1e-6, index
 * ratios down to 1.001 and up to 2.4. The direction is unit within 10 ulps and on the side that the lobe says; a
 * lost sample is (0, 0, 1) with weights and density 0. Only samples whose f or density is beyond what a float
 * holds are left out, and counted. */
#include <float.h>

#include "bsdf/bsdf_case.h"

static const float ALPHAS[] = {1e-3f, 0.01f, 0.05f, 0.3f, 1, 3};
enum { ALPHA_COUNT = 6 };

typedef struct finding {
    double weight, density, length; /* largest errors */
    size_t kept, lost, extreme;
    size_t weights, others, densities; /* beyond 1e-5; others: weights where normals are not visible ones */
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

/* f |cos_o| over the density, and that density, of one direction. */
typedef struct looked {
    double pdf, weight[VNDF_WAVELENGTHS];
} looked;

static looked look(const vndf_bsdf *bsdf, vndf_vec3 wo)
{
    float f[VNDF_WAVELENGTHS], pdf;
    vndf_bsdf_eval_pdf(bsdf, wo, 0, f, &pdf);
    looked at = {(double)pdf, {0}};
    for (int i = 0; i < VNDF_WAVELENGTHS && pdf > 0; i++)
        at.weight[i] = (double)f[i] * fabs((double)wo.z) / (double)pdf;
    return at;
}

/* How far one rounding of wo moves both. */
static looked spread_of(const vndf_bsdf *bsdf, vndf_vec3 wo, const looked *at)
{
    looked sum = {0, {0}};
    for (int i = 0; i < 6; i++) {
        float by = i % 2 ? 0x1p-23f : -0x1p-23f;
        vndf_vec3 near = {wo.x + (i / 2 == 0) * by, wo.y + (i / 2 == 1) * by, wo.z + (i / 2 == 2) * by};
        looked other = look(bsdf, near);
        sum.pdf += fabs(other.pdf - at->pdf);
        for (int k = 0; k < VNDF_WAVELENGTHS; k++)
            sum.weight[k] += other.pdf > 0 ? fabs(other.weight[k] - at->weight[k]) : 0;
    }
    return sum;
}

static int check_weight(const vndf_bsdf *bsdf, const vndf_scattered *s, finding *found)
{
    looked at = look(bsdf, s->wo), spread = spread_of(bsdf, s->wo, &at);
    double worst = 0;
    /* G2 of transmission through V-cavities is a difference: as exact as what it is taken from */
    double least = bsdf->material->is.effects.masking == VNDF_MASKING_V_CAVITIES ? 2 : 1e-30;
    if (!(s->density < 1e37f) || !(s->density > 1e-30f)) {
        found->extreme++;
        return 1;
    }
    double density = fmax(fabs(at.pdf - (double)s->density) - spread.pdf, 0) / (double)s->density;
    for (int i = 0; i < VNDF_WAVELENGTHS && at.pdf > 0; i++) {
        double beside = at.weight[i] * at.pdf / (double)s->density; /* f |cos_o| over the density of the sample */
        double off = fmin(fabs((double)s->weight[i] - at.weight[i]), fabs((double)s->weight[i] - beside));
        if (at.weight[i] > 1e-30 || s->weight[i] > 1e-6f) /* below it f has been cut to 0 or to FLT_MIN */
            worst = fmax(worst, (off - spread.weight[i]) / fmax(at.weight[i], least));
    }
    found->kept++;
    found->density = fmax(found->density, density);
    found->weight = fmax(found->weight, worst);
    found->densities += density > 1e-5;
    *(bsdf->material->is.effects.normals == VNDF_NORMALS_VISIBLE ? &found->weights : &found->others) +=
        worst > 1e-5;
    return density <= 1e-3 && worst <= 1e-3;
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
        if (k % 2)
            is.f0[0] = 0; /* F is (1 - wi.wm)^5 alone */
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
    finding found = {0};
    if (!TEST(oracle_ndf_open(&ndf, name)))
        return;
    for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
        vndf_effects effects = oracle_effects(i);
        if (effects.scattering == VNDF_SCATTERING_SINGLE && oracle_effects_sensible(&effects))
            test_set(&ndf, &effects, seed + i, &found);
    }
    printf("%s: weight within %.2g (%lu and %lu above 1e-5), density within %.2g (%lu), length within %.2g; "
           "%lu samples, %lu lost, %lu extreme\n",
           name, found.weight, (unsigned long)found.weights, (unsigned long)found.others, found.density,
           (unsigned long)found.densities, found.length, (unsigned long)found.kept, (unsigned long)found.lost,
           (unsigned long)found.extreme);
    size_t few = found.kept / 1000 + 5; /* of the 12000 samples of a quick run 12 are no more than 9 or 13 */
    TEST(found.weights < few && found.others < found.kept / 50 && found.densities < few);
    TEST(found.kept > 2 * found.lost && found.extreme < found.kept / 20);
    oracle_ndf_close(&ndf);
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {
        "ggx", "beckmann", "student-t-2.5", "hazy", "epd-0.6", "sgd-blue-metallic-paint-b", "abc-two-layer-gold"};
    for (size_t i = 0; i < 7; i++)
        if (oracle_wanted(arguments, argument, i, names[i]))
            test_ndf(names[i], 1000 * i + 23);
    return test_done();
}
