/* Samples of a walk. A lossless one loses nothing: each sample that leaves has weight 1 (closed forms: to the bit;
 * tables, whose weight holds the ratio of true to drawn density: in the mean, 4.5 sigma), and the order limit of 64
 * loses less than 1e-3 of any; directions are unit and on the side that the lobe says. Cut after one event a walk is
 * single scattering with height-correlated masking: eval to 3e-5 (test_walk_eval has samples follow eval); after two it
 * is the same walk. Radiance is over the square of the index ratio across the boundary.
 * vndf_bsdf_pdf is a density, of integral 1 within 3e-4 and positive, near the law of the samples: a total variation
 * over the bins below 0.42 everywhere (0.39 measured, for a hazy mirror of roughness 0.1 x 1), and below 0.05 where
 * alpha is 0.1 (0.034). */
#include "bsdf/walk/walk_case.h"

enum { WALKS = 4 };

static void walks_of(vndf_description walks[WALKS])
{
    walks[0] = walk_of_mirror();
    walks[1] = walk_of_glass(1.5f);
    walks[2] = walk_of_glass(1.0f / 1.5f);
    walks[3] = walk_of_glass(2.4f);
}

/* ---- energy ---- */

static void check_sample(const vndf_scattered *w, int closed)
{
    double length2 = (double)w->wo.x * w->wo.x + (double)w->wo.y * w->wo.y + (double)w->wo.z * w->wo.z;
    TEST_NEAR(length2, 1.0, 1e-6);
    if (w->lobe == VNDF_LOBE_NONE)
        TEST(w->weight[0] == 0.0f);
    else if (closed)
        TEST(w->weight[0] == 1.0f);
    TEST(w->lobe == VNDF_LOBE_NONE || (w->lobe == VNDF_LOBE_REFLECTION) == (w->wo.z > 0.0f));
}

/* Mean weight of what left, and how much was lost. */
static void check_energy(const walk_hit *h, int closed)
{
    const double most_lost = 1e-3;
    size_t count = walk_count(20000);
    unsigned long long state = 20160724;
    walk_mean weight = {0, 0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        float u[3];
        vndf_scattered w;
        bsdf_numbers(&state, u);
        vndf_bsdf_sample(&h->bsdf, u, &w);
        check_sample(&w, closed);
        weight.count += w.lobe != VNDF_LOBE_NONE;
        walk_add(&weight, (double)w.weight[0]);
    }
    double lost = 1.0 - weight.count / (double)count, noise = 4.5 * sqrt(most_lost / (double)count);
    /* the area of a table of default size is within some 1e-4 of that of its D, and a walk meets some facets */
    if (TEST_NEAR(walk_value(&weight), 1.0, 4.5 * sqrt(walk_variance(&weight)) + (closed ? 1e-6 : 1e-3)) &
        TEST(lost <= most_lost + noise))
        return;
    walk_describe(h);
    fprintf(stderr, "    lost %g\n", lost);
}

static void test_energy(const oracle_ndf *ndf)
{
    static const float alphas[][2] = {{0.05f, 0.05f}, {0.3f, 0.3f}, {1, 1}, {0.1f, 1}, {1e-3f, 1e-3f}};
    static const double cosines[] = {1, 0.8660254, 0.5, 0.1736482, 1e-3, 1e-6};
    vndf_description walks[WALKS];
    walks_of(walks);
    for (size_t i = 0; i < 5 * 6 * WALKS; i++) {
        walk_hit h;
        walk_hit_at(&h, &walks[i % WALKS], ndf, alphas[i / WALKS % 5], 0,
                    oracle_toward(cosines[i / WALKS / 5], 0.4));
        check_energy(&h, !ndf->owned);
    }
}

/* ---- one event ---- */

static void test_single(const oracle_ndf *ndf)
{
    static const float alphas[][2] = {{0.3f, 0.3f}, {1, 1}, {0.4f, 0.8f}};
    static const double cosines[] = {1, 0.5, 0.15};
    unsigned long long state = 77;
    vndf_description walks[WALKS];
    walks_of(walks);
    for (size_t i = 0; i < 3 * WALKS; i++) {
        walk_hit h;
        int good = 1;
        walks[i % WALKS].order_limit = 1;
        walk_hit_at(&h, &walks[i % WALKS], ndf, alphas[i / WALKS], 1, oracle_toward(cosines[i % 3], 0.4));
        for (int k = 0; k < 3000; k++) {
            vndf_vec3 wo = bsdf_direction(&state);
            double want = walk_eval(&h.single, wo, 0);
            good &= TEST_NEAR(walk_eval(&h.bsdf, wo, 1), want, 3e-5 * want + 1e-12);
        }
        if (!good)
            walk_describe(&h);
    }
}

/* ---- orders and sides ---- */

/* `other` is the same walk, cut after two events, or for radiance. */
static void test_same(const vndf_description *is, const vndf_description *other)
{
    static const float alpha[2] = {1, 1};
    unsigned long long state = 4;
    size_t lost = 0, crossed = 0;
    oracle_ndf ggx;
    walk_hit a, b;
    TEST(oracle_ndf_open(&ggx, "ggx"));
    walk_hit_at(&a, is, &ggx, alpha, 0, oracle_toward(0.7, 0));
    walk_hit_at(&b, other, &ggx, alpha, 0, a.wi);
    for (int i = 0; i < 3000; i++) {
        float u[3];
        vndf_scattered v, w;
        bsdf_numbers(&state, u);
        vndf_bsdf_sample(&a.bsdf, u, &v);
        vndf_bsdf_sample(&b.bsdf, u, &w);
        lost += w.lobe == VNDF_LOBE_NONE;
        crossed += w.lobe == VNDF_LOBE_TRANSMISSION;
        double factor = w.lobe == VNDF_LOBE_TRANSMISSION ? 2.25 : 1;
        TEST(w.lobe == VNDF_LOBE_NONE || (memcmp(&v.wo, &w.wo, sizeof v.wo) == 0 && v.lobe == w.lobe));
        if (w.lobe != VNDF_LOBE_NONE)
            TEST_RELATIVE((double)w.weight[0] * factor, (double)v.weight[0], 1e-6);
    }
    TEST(other->order_limit ? lost > 50 && lost < 1000 : crossed > 1000);
}

/* ---- the density ---- */

static double density_towards(double z, double phi, const void *of)
{
    vndf_vec3 wo = oracle_toward(z, phi);
    const walk_hit *h = of;
    double pdf = (double)vndf_bsdf_pdf(&h->bsdf, wo);
    TEST(pdf > 0 || wo.z == 0 || (!walk_transmits(&h->is) && wo.z < 0));
    return pdf;
}

static void test_density(const oracle_ndf *ndf, size_t subject)
{
    static const float alphas[][2] = {{1, 1}, {0.3f, 0.3f}, {1, 1}, {0.1f, 1}, {0.5f, 0.5f}, {0.1f, 0.1f}};
    static const double cosines[] = {0.95, 0.6, 0.2, 0.5, 0.05, 0.9};
    enum { ACROSS = 5, ALONG = 8 }; /* bins of the integral to a bin of samples */
    static grid g, fine;
    vndf_description walks[WALKS];
    walks_of(walks);
    for (size_t i = 0; i < 6 * WALKS; i++) {
        double count = 40000, distance = 0;
        walk_hit h;
        if (subject > 0 && i % 5 != subject % 5)
            continue;
        walk_hit_at(&h, &walks[i / 6], ndf, alphas[i % 6], 1, oracle_toward(cosines[i % 6], 0.9));
        walk_bins(&g);
        grid_even(&fine, ACROSS * WALK_HEIGHTS, -1, 1, ALONG * WALK_TURNS, -PI, PI);
        double mass = grid_expect(&fine, density_towards, &h, 1, 1e-6);
        for (size_t b = 0; b < fine.rows * fine.columns; b++)
            g.expected[b / fine.columns / ACROSS * WALK_TURNS + b % fine.columns / ALONG] += fine.expected[b];
        walk_observe(&h, (size_t)count, 8, &g);
        for (size_t b = 0; b < WALK_BINS; b++)
            distance += 0.5 * fabs(g.observed[b] / count - g.expected[b]);
        if (!(TEST_NEAR(mass, 1.0, 3e-4) & TEST(distance < (i % 6 == 5 ? 0.05 : 0.42)))) {
            walk_describe(&h);
            fprintf(stderr, "    distance %g\n", distance);
        }
    }
}

int main(int arguments, char **argument)
{
    for (size_t i = 0; i < WALK_SUBJECTS; i++) {
        oracle_ndf ndf;
        if (!oracle_wanted(arguments, argument, i, walk_subjects[i]) ||
            !TEST(oracle_ndf_open(&ndf, walk_subjects[i])))
            continue;
        test_energy(&ndf);
        test_single(&ndf);
        if (i < WALK_FEW)
            test_density(&ndf, i);
        oracle_ndf_close(&ndf);
    }
    vndf_description metal = walk_of_metal(), glass = walk_of_glass(1.5f), shorter = metal, radiance = glass;
    shorter.order_limit = 2;
    radiance.effects.transport = VNDF_TRANSPORT_RADIANCE;
    test_same(&metal, &shorter);
    test_same(&glass, &radiance);
    return test_done();
}
