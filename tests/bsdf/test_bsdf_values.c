/* Samples, values and densities of one hit agree with the published formulas and with each other, for every sensible
 * set of effects of single scattering and every shape, closed forms, tables and a tail of r^-3.2, roughness from 1e-3
 * to 3, matrices of condition up to 300, mean slopes, mixtures of up to three lobes, from both sides, cosines down to
 * 1e-6, index ratios down to 1.001 and up to 2.4, Schlick's f0 from 0 on.
 *
 *   formulas      vndf_bsdf_eval and vndf_bsdf_pdf, where directions are sampled and where they are spread over the
 *                 sphere: within 1e-5 (matrices 3e-5, their densities 1e-4) from roughness 0.01 on. The law of bounded
 *                 normals is the library's own: it leaves no hole, and chi-squares are for it
 *   weight        f |cos_o| over the density, and the density vndf_bsdf_pdf: within 1e-5 for 99.9% of the samples
 *                 (weights of normals that are not visible ones 98%), but for tails beyond r^-3.6
 *   bound         visible normals, from cosine 0.01 on: at most 1, on tables the largest weight of the certificate;
 *                 bounded normals of a table of equal roughness lose nothing
 *   facet         wm faces wi and takes it to wo, within 1e-5; wo is unit and on the side that the lobe says
 *   bits          nothing is written beyond the wavelengths; a lost sample is (0, 0, 1) with weights and density 0
 *
 * All of this is of directions within two roundings of those that are given (2^-22 in each coordinate; weights: one),
 * which is as good as floats can be: a lobe is narrow, or a half vector short. */
#include <float.h>

#include "bsdf/bsdf_case.h"

enum { READINGS = VNDF_WAVELENGTHS + 1, MARK = 77 }; /* f of the wavelengths and the density */

typedef struct hit {
    bsdf_subject of;
    oracle_bsdf oracle;
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_vec3 wi;
} hit;

/* How often. */
typedef struct finding {
    size_t positive, zero, lost, kept, extreme;
    size_t weights, others, densities; /* beyond 1e-5; others: weights where normals are not visible ones */
} finding;

/* ---- formulas ---- */

/* A value of the formulas, and how far it is from there to other readings of the same floats: with their lengths, and
 * two roundings away. */
typedef struct reading {
    double value, spread;
} reading;

static void widen(const oracle_value *by, double factor, reading want[READINGS])
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        want[i].spread += factor * fabs(by->f[i] - want[i].value);
    want[VNDF_WAVELENGTHS].spread += factor * fabs(by->pdf - want[VNDF_WAVELENGTHS].value);
}

static void read_formulas(oracle_bsdf *o, vndf_vec3 wi, vndf_vec3 wo, reading want[READINGS])
{
    double w[2][3];
    oracle_from_vec3(wi, w[0]);
    oracle_from_vec3(wo, w[1]);
    o->lengths = 0;
    oracle_value plain = oracle_bsdf_eval(o, w[0], w[1]), other;
    for (int i = 0; i < READINGS; i++)
        want[i] = (reading){i < VNDF_WAVELENGTHS ? plain.f[i] : plain.pdf, 0};
    o->lengths = 1;
    other = oracle_bsdf_eval(o, w[0], w[1]);
    widen(&other, 2, want);
    for (int i = 0; i < 8; i++) { /* z both ways, since the side on which a steep normal lies hangs on it */
        double *at = &w[i < 6 ? i / 3 : i - 6][i < 6 ? i % 3 : 2], given = *at;
        *at += i < 6 ? 0x1p-22 : -0x1p-22;
        other = oracle_bsdf_eval(o, w[0], w[1]);
        widen(&other, 1, want);
        *at = given;
    }
}

/* Below 1e-30 what underflows is right; the tail of Beckmann's density ends where exp underflows, over wm.z^3. */
static int agrees(double got, reading want, double within)
{
    if (!(want.value > 1e-10))
        return got <= 1e-4 + want.spread;
    if (want.value > 1e35)
        return got >= 1e35;
    return fabs(got - want.value) - want.spread <= within * want.value;
}

static int check_formulas(hit *h, vndf_vec3 wo, finding *found)
{
    float f[VNDF_WAVELENGTHS] = {MARK, MARK, MARK, MARK}, pdf;
    reading want[READINGS], *density = &want[VNDF_WAVELENGTHS];
    int good = 1, plain = h->of.is_rough;
    vndf_bsdf_eval_pdf(&h->bsdf, wo, 1, f, &pdf);
    if (plain && fminf(h->of.alpha[0], h->of.alpha[1]) < 0.01f)
        return 1;
    read_formulas(&h->oracle, h->wi, wo, want);
    if (!plain && fabsf(h->wi.z + wo.z) < 1e-6f) /* level facets divide 0 by 0 here */
        return 1;
    for (int w = 0; w < h->of.is.wavelengths; w++)
        good &= TEST(agrees((double)f[w], want[w], plain ? 1e-5 : 3e-5));
    for (int w = h->of.is.wavelengths; w < VNDF_WAVELENGTHS; w++)
        good &= TEST(f[w] == MARK);
    if (density->value >= 0)
        good &= TEST(agrees((double)pdf, *density, plain ? 1e-5 : 1e-4));
    else
        good &= TEST(pdf > 0 || !(want[0].value - want[0].spread > 1e-6));
    *(want[0].value > 0 ? &found->positive : &found->zero) += 1;
    if (!good)
        fprintf(stderr, "    eval %.9g want %.9g +- %.2g; pdf %.9g want %.9g +- %.2g\n", (double)f[0],
                want[0].value, want[0].spread, (double)pdf, density->value, density->spread);
    return good;
}

/* ---- weight ---- */

/* Counts what is beyond 1e-5 of surfaces without a matrix; the matrices of even distributions have nothing beyond. */
static int check_weight(hit *h, const vndf_scattered *s, int is_even, finding *found)
{
    bsdf_look at = bsdf_look_at(&h->bsdf, s->wo), spread = bsdf_spread(&h->bsdf, s->wo, &at);
    int is_plain = h->of.is_rough;
    double worst = 0;
    /* G2 of transmission through V-cavities is a difference: as exact as what it is taken from */
    double least = h->of.is.effects.masking == VNDF_MASKING_V_CAVITIES ? 2 : is_plain ? 1e-30 : 1e-3;
    if (!(s->density < 1e35f) || !(s->density > 1e-25f)) {
        found->extreme++;
        return 1;
    }
    /* also where the rounding of wo has lost the side on which a steep facet lies */
    if (s->lobe == VNDF_LOBE_TRANSMISSION && !TEST(at.pdf > 0))
        return 0;
    if (!is_plain) {
        reading want[READINGS];
        read_formulas(&h->oracle, h->wi, s->wo, want);
        spread.pdf += want[VNDF_WAVELENGTHS].spread;
        for (int i = 0; i < h->of.is.wavelengths; i++)
            spread.weight[i] += at.weight[i] * want[VNDF_WAVELENGTHS].spread / at.pdf;
    }
    double density = fmax(fabs(at.pdf - (double)s->density) - spread.pdf, 0) / (double)s->density;
    for (int i = 0; i < h->of.is.wavelengths && at.pdf > 0; i++) {
        double beside = at.weight[i] * at.pdf / (double)s->density; /* f |cos_o| over the density of the sample */
        double off = fmin(fabs((double)s->weight[i] - at.weight[i]), fabs((double)s->weight[i] - beside));
        if (at.weight[i] > 1e-30 || s->weight[i] > 1e-6f) /* below it f has been cut to 0 or to FLT_MIN */
            worst = fmax(worst, (off - spread.weight[i]) / fmax(at.weight[i], least));
    }
    if (!is_plain)
        return !is_even || (TEST(density <= 1e-5) & TEST(worst <= 1e-5));
    found->kept++;
    found->densities += density > 1e-5;
    *(h->of.is.effects.normals == VNDF_NORMALS_VISIBLE ? &found->weights : &found->others) += worst > 1e-5;
    return 1;
}

/* Where one number is F of all wavelengths, so that the weight is G2/G1 and the table's ratio. */
static int check_bound(const hit *h, const vndf_scattered *s, int is_even)
{
    const vndf_effects *e = &h->of.is.effects;
    const vndf_info info = vndf_distribution_info(h->of.is.surface.distribution);
    double most = info.bytes > 0 ? (double)info.certificate.max_weight : 1;
    if (is_even && e->normals == VNDF_NORMALS_BOUNDED && info.bytes > 0 && h->of.is_rough &&
        h->of.alpha[0] == h->of.alpha[1])
        return TEST(s->lobe != VNDF_LOBE_NONE);
    if (e->normals != VNDF_NORMALS_VISIBLE || e->shape != VNDF_SHAPE_LEVEL || s->lobe != VNDF_LOBE_REFLECTION ||
        fabsf(h->wi.z) < 0.01f || e->masking == VNDF_MASKING_NONE || e->masking == VNDF_MASKING_V_CAVITIES ||
        (e->lobes == VNDF_LOBES_BOTH && e->fresnel != VNDF_FRESNEL_DIELECTRIC))
        return 1;
    return TEST((double)s->weight[0] <= most * (1 + 1e-5));
}

/* ---- where a sample goes ---- */

static int check_place(const hit *h, const vndf_scattered *s)
{
    const vndf_effects *e = &h->of.is.effects;
    double i[3], o[3], m[3], rest[3], length = 0, facing = 0, beyond = 0, off = 0;
    oracle_from_vec3(h->wi, i);
    oracle_from_vec3(s->wo, o);
    oracle_from_vec3(s->wm, m);
    if (s->lobe == VNDF_LOBE_NONE)
        return TEST(s->density == 0 && s->weight[0] == 0 && s->weight[3] == 0 && o[0] == 0 && o[1] == 0 &&
                    o[2] == 1 && m[0] == 0 && m[1] == 0 && m[2] == 0);
    int reflected = s->lobe == VNDF_LOBE_REFLECTION;
    int same = oracle_bsdf_rise(&h->oracle, i) * oracle_bsdf_rise(&h->oracle, o) > 0;
    double turn = reflected && e->reflection == VNDF_REFLECTION_RETRO ? -1 : 1;
    double eta = reflected ? 1 : h->bsdf.own.eta, cosine = oracle_bsdf_cosine(&h->oracle, o);
    int good = TEST(reflected == same) & TEST(s->density > 0);
    good &= TEST_NEAR((double)vndf_bsdf_cosine(&h->bsdf, s->wo), cosine, 1e-6);
    for (int k = 0; k < 3; k++)
        length += o[k] * o[k];
    o[0] *= turn;
    o[1] *= turn;
    for (int k = 0; k < 3; k++) {
        facing += i[k] * m[k];
        beyond += o[k] * m[k];
    }
    for (int k = 0; k < 3; k++) { /* wi - (wi.wm) wm, and that of wo times the index ratio, are opposite */
        rest[k] = i[k] - facing * m[k] + eta * (o[k] - beyond * m[k]);
        off += rest[k] * rest[k];
    }
    return good & TEST_NEAR(sqrt(length), 1, 10 * 0x1p-23) & TEST(sqrt(off) < 1e-5 * fmax(eta, 1)) &
           TEST(facing > -1e-6 && (reflected ? beyond > -1e-6 : beyond < 1e-6));
}

/* ---- */

static void test_hit(const oracle_ndf *all, size_t ndfs, int is_even, const vndf_effects *effects,
                     unsigned long long *state, finding *found)
{
    static const float alphas[] = {1e-3f, 0.01f, 0.05f, 0.3f, 1, 3};
    static hit h;
    vndf_vec3 other = bsdf_direction(state);
    vndf_scattered s;
    float u[3];
    double wi[3];
    bsdf_material(&h.of, all, ndfs, effects, alphas, 6, state);
    h.of.is.wavelengths = 1 + (int)(VNDF_WAVELENGTHS * test_uniform(state));
    h.of.ndf[0] = all;
    h.oracle = oracle_bsdf_from(&h.of.is, h.of.ndf);
    h.wi = bsdf_direction(state);
    bsdf_numbers(state, u);
    if (test_uniform(state) < 0.1f) /* far out, or beside the pole */
        u[1] = test_uniform(state) < 0.5f ? u[1] * 1e-5f : 1 - u[1] * 1e-5f;
    if (!oracle_bsdf_two_sided(effects) && effects->shape == VNDF_SHAPE_LEVEL && test_uniform(state) < 0.9f)
        h.wi.z = fabsf(h.wi.z);
    oracle_from_vec3(h.wi, wi);
    double rise = oracle_bsdf_rise(&h.oracle, wi);
    if (effects->shape != VNDF_SHAPE_LEVEL && fabs(rise) < 1e-5) /* along the mean plane: rounding decides */
        return;
    TEST(vndf_material_resolve(&h.of.is, &h.material, NULL) == VNDF_OK);
    int seen = vndf_bsdf_at(&h.bsdf, &h.material, h.wi);
    if (!TEST(seen == (rise > 0 || oracle_bsdf_two_sided(effects))) || !seen)
        return;
    vndf_bsdf_sample(&h.bsdf, u, &s);
    int good = check_formulas(&h, other, found);
    if (s.lobe != VNDF_LOBE_STRAIGHT)
        good &= check_place(&h, &s) & check_bound(&h, &s, is_even);
    if (s.lobe == VNDF_LOBE_REFLECTION || s.lobe == VNDF_LOBE_TRANSMISSION)
        good &= check_formulas(&h, s.wo, found) & check_weight(&h, &s, is_even, found);
    found->lost += s.lobe == VNDF_LOBE_NONE;
    if (!good)
        bsdf_describe(&h.of.is, all->name, h.wi, s.wo);
}

int main(int arguments, char **argument)
{
    /* two heavy tails, two with narrow cores; then what is even */
    static const char *const names[] = {"student-t:1.6", "student-t-1.8", "hazy",    "abc-two-layer-gold",
                                        "student-t-2.5", "ggx",           "beckmann"};
    enum { NDFS = 7, HEAVY = 2, UNEVEN = 4 };
    static oracle_ndf all[NDFS];
    for (size_t i = 0; i < NDFS; i++)
        if (!TEST(oracle_ndf_open(&all[i], names[i])))
            return test_done();
    for (size_t i = 0; i < NDFS; i++) {
        unsigned long long state = 1000 * i + 17;
        finding found = {0};
        if (!oracle_wanted(arguments, argument, i, names[i]))
            continue;
        for (size_t n = 0; n < ORACLE_EFFECT_SETS; n++) {
            vndf_effects e = oracle_effects(n);
            for (size_t k = 0; k < test_amount(4, 8, 24) && oracle_effects_sensible(&e); k++)
                if (e.scattering == VNDF_SCATTERING_SINGLE)
                    test_hit(&all[i], NDFS - i, i >= UNEVEN, &e, &state, &found);
        }
        printf("%s: weights of %lu and %lu above 1e-5, densities of %lu; %lu samples, %lu lost, %lu extreme\n",
               names[i], (unsigned long)found.weights, (unsigned long)found.others, (unsigned long)found.densities,
               (unsigned long)found.kept, (unsigned long)found.lost, (unsigned long)found.extreme);
        size_t few = found.kept / 1000 + 5;
        TEST(i < HEAVY || (found.weights < few && found.others < found.kept / 50 && found.densities < few));
        TEST(found.positive > found.zero / 4 && found.zero > 0);
        TEST(found.kept > found.lost && found.extreme < found.kept / 20);
    }
    for (size_t i = 0; i < NDFS; i++)
        oracle_ndf_close(&all[i]);
    return test_done();
}
