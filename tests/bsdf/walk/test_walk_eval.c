/* The mean of eval is what sample scatters: over 96 bins of the sphere, all orders, the integral of eval against
 * the mean weight of the samples that fall in; and f does not change when wi and wo change places, across the
 * boundary with the square of the index ratio (Walter et al. 2007, section 5): means at 5 sigmas, 6e-7 each, of
 * some 3000.
 *
 * Directions for eval are drawn half by single scattering, half by cosines. Bins are compared where there are errors
 * to speak of: 100 samples and evaluations, none of them a tenth of all. */
#include "bsdf/walk/walk_case.h"

/* ---- the two histograms ---- */

static void sample_bins(const walk_hit *h, size_t count, walk_mean bins[], size_t hits[])
{
    unsigned long long state = 31;
    for (size_t i = 0; i < count; i++) {
        float u[3];
        vndf_scattered w;
        bsdf_numbers(&state, u);
        vndf_bsdf_sample(&h->bsdf, u, &w);
        walk_add(&bins[walk_bin(w.wo)], (double)w.weight[0]);
        hits[walk_bin(w.wo)] += w.lobe != VNDF_LOBE_NONE;
    }
}

/* 0 where single scattering loses it. */
static int propose(const walk_hit *h, unsigned long long *state, vndf_vec3 *wo)
{
    float u[3];
    vndf_scattered s;
    bsdf_numbers(state, u);
    int below = walk_transmits(&h->is) && test_uniform(state) < 0.5f;
    vndf_bsdf_sample(&h->single, u, &s);
    *wo = s.wo;
    if (test_uniform(state) < 0.5f)
        return s.lobe != VNDF_LOBE_NONE;
    *wo = oracle_toward((below ? -1 : 1) * sqrt((double)u[0]), 2 * PI * (double)u[1]);
    return wo->z != 0;
}

static double density_of(const walk_hit *h, vndf_vec3 wo)
{
    double cosine = fabs((double)wo.z) / PI * (walk_transmits(&h->is) ? 0.5 : 1);
    return 0.5 * ((double)vndf_bsdf_pdf(&h->single, wo) + cosine);
}

static void eval_bins(const walk_hit *h, size_t count, walk_mean bins[], size_t hits[])
{
    unsigned long long state = 32;
    for (size_t i = 0; i < count; i++) {
        vndf_vec3 wo;
        if (!propose(h, &state, &wo))
            continue;
        double value = walk_eval(&h->bsdf, wo, i);
        TEST(value >= 0.0 && value < HUGE_VAL);
        walk_add(&bins[walk_bin(wo)], value / density_of(h, wo));
        hits[walk_bin(wo)]++;
    }
}

static int is_known(const walk_mean *m, size_t hits)
{
    return hits >= 100 && m->largest < 0.1 * m->sum;
}

static void test_bins(const walk_hit *h, double least)
{
    size_t count = walk_count(100000), drawn[WALK_BINS] = {0}, seen[WALK_BINS] = {0};
    walk_mean sampled[WALK_BINS], evaluated[WALK_BINS];
    double all = 0.0, compared = 0.0, part = test_long() ? least : 0.6 * least;
    for (int b = 0; b < WALK_BINS; b++)
        sampled[b] = evaluated[b] = (walk_mean){0, 0, (double)count, 0};
    sample_bins(h, count, sampled, drawn);
    eval_bins(h, count, evaluated, seen);
    for (int b = 0; b < WALK_BINS; b++) {
        all += sampled[b].sum;
        if (!is_known(&sampled[b], drawn[b]) || !is_known(&evaluated[b], seen[b]))
            continue;
        compared += sampled[b].sum;
        if (!TEST(walk_agree(&sampled[b], &evaluated[b]))) {
            walk_describe(h);
            fprintf(stderr, "    bin %d: sample %g, eval %g +- %g\n", b, walk_value(&sampled[b]),
                    walk_value(&evaluated[b]), sqrt(walk_variance(&evaluated[b])));
        }
    }
    if (!TEST(compared > part * all))
        walk_describe(h);
}

typedef struct setting {
    float alpha[2];       /* over the distribution's scale */
    double cosine, least; /* and of the energy this part has to be compared */
} setting;

static const setting SETTINGS[] = {{{1, 1}, 0.95, 0.9},   {{0.3f, 0.3f}, 0.6, 0.9},  {{1, 1}, 0.3, 0.9},
                                   {{0.1f, 1}, 0.5, 0.8}, {{0.5f, 0.5f}, 1e-3, 0.8}, {{0.05f, 0.05f}, 0.8, 0.5}};

static void test_subject(const oracle_ndf *ndf, size_t subject)
{
    vndf_description walks[] = {walk_of_metal(), walk_of_glass(1.5f), walk_of_glass(1.0f / 1.5f)};
    for (size_t i = 0; i < 6 * 3; i++) {
        const setting *s = &SETTINGS[i % 6];
        walk_hit h;
        if (subject > 0 && i % 5 != subject % 5)
            continue;
        walk_hit_at(&h, &walks[i / 6], ndf, s->alpha, 1, oracle_toward(s->cosine, 0.9));
        test_bins(&h, s->least);
    }
}

/* ---- reciprocity ---- */

/* f of one pair, from either side. */
static walk_mean mean_of_f(const vndf_description *is, const oracle_ndf *ndf, const float alpha[2], vndf_vec3 wi,
                           vndf_vec3 wo)
{
    walk_mean mean = {0, 0, (double)walk_count(30000), 0};
    walk_hit h;
    walk_hit_at(&h, is, ndf, alpha, 1, wi);
    for (double i = 0; i < mean.count; i += 1.0)
        walk_add(&mean, walk_eval(&h.bsdf, wo, (uint64_t)i) / fabs((double)wo.z));
    return mean;
}

static void test_reciprocity(const oracle_ndf *ndf)
{
    static const float alphas[2][2] = {{1, 1}, {1, 0.4f}};
    vndf_description metal = walk_of_metal(), glass = walk_of_glass(1.5f), radiance = glass;
    radiance.effects.transport = VNDF_TRANSPORT_RADIANCE; /* against importance the other way */
    const vndf_description *there[] = {&metal, &glass, &radiance}, *back[] = {&metal, &glass, &glass};
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++) {
            vndf_vec3 wi = oracle_toward(i % 2 ? 0.9 : 0.2, 0.3), wo = oracle_toward(i % 3 ? 0.35 : 0.8, 2.0 + i);
            wo.z = k == 2 ? -wo.z : wo.z;
            walk_mean f = mean_of_f(there[k], ndf, alphas[i / 3], wi, wo);
            walk_mean g = mean_of_f(back[k], ndf, alphas[i / 3], wo, wi);
            TEST(walk_value(&f) > 0.0 && walk_agree(&f, &g));
        }
}

int main(int arguments, char **argument)
{
    for (size_t i = 0; i < WALK_FEW; i++) {
        oracle_ndf ndf;
        if (!oracle_wanted(arguments, argument, i, walk_subjects[i]) ||
            !TEST(oracle_ndf_open(&ndf, walk_subjects[i])))
            continue;
        test_subject(&ndf, i);
        test_reciprocity(&ndf);
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
