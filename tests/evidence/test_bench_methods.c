/* The methods that the benchmark sets ours against are what they are said to be: the exact ones draw the visible
 * normals of GGX and Beckmann (chi-square and Kolmogorov-Smirnov, fixed seeds, chance of a false alarm 1e-6 for
 * each), those for any D tell the density with which they draw, and tables of inverse CDFs are biased. */
#include <string.h>

#include "evidence/measure/bins.h"
#include "cli/sort.h"
#include "evidence/measure/pearson.h"
#include "cli/subject.h"
#include "oracle/oracle.h"
#include "cli/random.h"
#include "evidence/measure/statistics.h"
#include "evidence/evidence.h"
#include "harness/test.h"

static const double level = 1e-6;

enum { BLOCKS = 100, QUICK_BLOCKS = 10 };

static size_t blocks(void)
{
    return test_quick() ? QUICK_BLOCKS : BLOCKS;
}

/* ---- chi-square of visible normals ------------------------------------------------------------- */

static void fill_uniform(block *b, uint64_t seed)
{
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < BLOCK; i++) {
        b->u[0][i] = random_float(&stream);
        b->u[1][i] = random_float(&stream);
    }
    block_pack(b);
}

/* Bins for the visible normals of a view, and what is expected of a method's samples. */
typedef struct expectation {
    vndf_vec3 wi;
    float alpha;
    bin_map map;
    double counts[BINS_COUNT];
} expectation;

static const expectation *expect(const vndf_distribution *d, double theta, float alpha)
{
    static expectation e;
    vndf_surface surface = {d, alpha, alpha};
    e.wi = direction_from(theta, 25);
    e.alpha = alpha;
    e.map = bins_for(&surface, e.wi, 3);
    bins_integrate(&e.map, &surface, e.wi, e.counts);
    for (size_t i = 0; i < BINS_COUNT; i++)
        e.counts[i] *= (double)blocks() * BLOCK;
    return &e;
}

static double chi_square_of(const method *m, const expectation *e)
{
    static double count[BINS_COUNT];
    static block b;
    memset(count, 0, sizeof count);
    block_aim(&b, e->wi, e->alpha);
    for (size_t n = 0; n < blocks(); n++) {
        fill_uniform(&b, 31 + n);
        m->each(m, &b, 0, BLOCK);
        for (size_t i = 0; i < BLOCK; i++)
            count[bins_place(&e->map, (vndf_vec3){b.x[i], b.y[i], b.z[i]})] += 1;
    }
    return pearson_of(e->counts, count, NULL, BINS_COUNT, 5).p;
}

static void test_visible(const method *methods, size_t count, const vndf_distribution *d)
{
    static const double thetas[] = {5, 60, 88};
    for (size_t i = 0; i < 3; i++) {
        const expectation *e = expect(d, thetas[i], i == 1 ? 0.1f : 0.7f);
        for (const method *m = methods; m < methods + count; m++)
            if (m->each && !TEST(chi_square_of(m, e) > level))
                fprintf(stderr, "  %s, %s: at %g degrees\n", m->name, m->instructions, thetas[i]);
    }
}

/* It notices: the normals of one distribution are not those of another, nor all normals the visible ones. */
static void test_notices(void)
{
    method caps = method_ggx_caps(), normals = method_ggx_all_normals();
    TEST(chi_square_of(&caps, expect(vndf_beckmann(), 60, 0.5f)) < level);
    TEST(chi_square_of(&normals, expect(vndf_ggx(), 60, 0.5f)) < level);
}

/* ---- all normals ------------------------------------------------------------------------------- */

static double law_of_ggx(double slope2)
{
    return slope2 / (1 + slope2);
}

static double law_of_beckmann(double slope2)
{
    return 1 - exp(-slope2);
}

/* Kolmogorov-Smirnov of one block's slopes; the density told is that of D cos, within the tolerance. */
static void test_all_normals(method m, const vndf_surface *surface, double law(double), double density_tolerance)
{
    static double value[BLOCK];
    static block b;
    double mean = 0, worst = 0, distance = 0;
    if (!TEST(m.each != NULL))
        return;
    block_aim(&b, (vndf_vec3){0, 0, 1}, surface->alpha_x);
    fill_uniform(&b, 5);
    m.each(&m, &b, 0, BLOCK);
    for (size_t i = 0; i < BLOCK; i++) {
        vndf_vec3 wm = {b.x[i], b.y[i], b.z[i]};
        double z = (double)wm.z, ratio = (double)vndf_ndf(surface, wm) * z / (double)b.pdf[i];
        double alpha = (double)surface->alpha_x, slope2 = (1 - z * z) / (z * z * alpha * alpha);
        value[i] = law(slope2);
        mean += ratio / BLOCK;
        worst = fmax(worst, fabs(ratio - 1));
    }
    sort_numbers(value, BLOCK);
    for (size_t i = 0; i < BLOCK; i++)
        distance = fmax(distance, fabs(value[i] - ((double)i + 0.5) / BLOCK));
    TEST(statistics_kolmogorov_p(distance, BLOCK) > level);
    TEST(worst < density_tolerance);
    TEST_NEAR(mean, 1, 0.02);
}

/* ---- any D ------------------------------------------------------------------------------------- */

static findings findings_of(const method *m, const method_reference *reference, double theta, size_t replicates)
{
    findings f = {0};
    TEST(worth_of_normals(m, reference, theta, replicates, &f));
    return f;
}

static int albedo_agrees(const findings *a, const findings *b)
{
    double noise = sqrt(a->albedo_noise * a->albedo_noise + b->albedo_noise * b->albedo_noise);
    return fabs(a->albedo - b->albedo) <= 6 * noise + 1e-6;
}

/* Unbiased: the albedo is the reference's within the noise at 60 and 85 degrees, and the noise is small. */
static void test_unbiased(method m, const method_reference *reference)
{
    method ours = method_ours(reference->canonical.distribution, "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST);
    for (double theta = 60; TEST(m.each != NULL) && theta < 90; theta += 25) {
        findings f = findings_of(&m, reference, theta, 64), t = findings_of(&ours, reference, theta, 64);
        if (!(TEST(albedo_agrees(&f, &t)) & TEST(f.albedo_noise < 0.02 * f.albedo) & TEST(t.albedo_noise < 1e-3)))
            fprintf(stderr, "  %s at %g: %g +- %g, not %g\n", m.name, theta, f.albedo, f.albedo_noise, t.albedo);
    }
    method_release(&m);
}

/* The inverse CDFs are seen to be biased at 85 degrees. */
static void test_biased(const method_reference *reference)
{
    method ours = method_ours(reference->canonical.distribution, "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST);
    method m = method_inverse_tables(reference);
    if (!TEST(m.each != NULL))
        return;
    findings t = findings_of(&ours, reference, 85, 64), f = findings_of(&m, reference, 85, 64);
    TEST(!albedo_agrees(&f, &t));
    TEST(f.max_weight > 1.1);
    TEST(f.tv > 0.01 && f.tv < 0.2);
    method_release(&m);
}

/* ---- how error is measured --------------------------------------------------------------------- */

/* Histograms of an exact method floor at 0.01; densities at float precision. */
static void test_floor(void)
{
    method_reference reference = {{vndf_ggx(), 1, 1}, 1};
    method m = method_ggx_caps();
    for (double theta = 0; theta < 90; theta += 40) {
        m.biased = 1;
        TEST(findings_of(&m, &reference, theta, 64).tv < 0.01);
        m.biased = 0;
        TEST(findings_of(&m, &reference, theta, 16).tv < 1e-6);
    }
}

/* The samples of a small table show the error that its certificate states, and no more. */
static void test_small_table(const method_reference *reference, const vndf_distribution *small)
{
    float claimed = vndf_distribution_info(small).certificate.tv_above;
    method m = method_ours(small, "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST);
    double worst = 0;
    for (double theta = 0; theta < 90; theta += 15)
        worst = fmax(worst, findings_of(&m, reference, theta, 16).tv);
    TEST(worst <= 1.02 * (double)claimed && worst > 0.1 * (double)claimed);
}

static void test_fresnel(void)
{
    TEST_NEAR(worth_fresnel(1, 0.43, 2.455), (0.57 * 0.57 + 2.455 * 2.455) / (1.43 * 1.43 + 2.455 * 2.455), 1e-14);
    TEST_NEAR(worth_fresnel(0, 0.43, 2.455), 1, 1e-14);
    double brewster = 1 / sqrt(1 + 2.25), across = 1.25 / 3.25;
    TEST_NEAR(worth_fresnel(brewster, 1.5, 0), 0.5 * across * across, 1e-14);
}

/* ---- verification ------------------------------------------------------------------------------ */

static void each_long(const method *m, block *b, size_t first, size_t count)
{
    method ours = method_ours(m->state, "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST);
    ours.each(&ours, b, first, count);
    b->x[5] *= 1.0001f;
}

static void each_other_bits(const method *m, block *b, size_t first, size_t count)
{
    method ours = method_ours(m->state, "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST);
    ours.each(&ours, b, first, count);
    b->pdf[5] = nextafterf(b->pdf[5], 0);
}

static void each_away(const method *m, block *b, size_t first, size_t count)
{
    method normals = method_ggx_all_normals();
    (void)m;
    normals.each(&normals, b, first, count);
}

/* What is wrong is noticed: a length, a bit of a batch, normals that face away. */
static void test_verify(void)
{
    static block b;
    const block_law law = {vndf_ggx(), 0.05f, 0.95f, NAN, 0, 0};
    method scalar = method_ours(vndf_ggx(), "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST), m = scalar;
    method batch = method_ours(vndf_ggx(), "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_PORTABLE);
    TEST(evidence_verify(&m, &law, &b, 1) && evidence_verify(&batch, &law, &b, 1));
    m.each = each_long;
    TEST(!evidence_verify(&m, &law, &b, 1));
    m.each = each_away;
    TEST(!evidence_verify(&m, &law, &b, 1));
    m.each = each_other_bits;
    TEST(evidence_verify(&m, &law, &b, 1)); /* nobody to compare with */
    m.same_bits = scalar.each;
    TEST(!evidence_verify(&m, &law, &b, 1));
}

static vndf_distribution *table_of(const vndf_source *source, size_t bytes)
{
    vndf_build_options options = {.max_bytes = bytes};
    return vndf_build(source, &options, NULL, NULL);
}

static void test_any(void)
{
    vndf_source *source = vndf_source_family("student-t:2.5", NULL), *ggx = vndf_source_family("ggx", NULL);
    vndf_distribution *fine = table_of(source, 32768), *small = table_of(source, 2048);
    vndf_distribution *same = table_of(ggx, 16384);
    if (TEST(fine && small && same)) {
        method_reference reference = method_reference_of(fine), reference_ggx = method_reference_of(same);
        method normals = method_any_all_normals(&reference_ggx);
        test_all_normals(normals, &(vndf_surface){same, 0.5f, 0.5f}, law_of_ggx, 0.5);
        method_release(&normals);
        test_unbiased(method_any_all_normals(&reference), &reference);
        test_unbiased(method_warp(&reference), &reference);
        test_biased(&reference);
        test_small_table(&reference, small);
    }
    vndf_free(fine);
    vndf_free(small);
    vndf_free(same);
    vndf_source_free(source);
    vndf_source_free(ggx);
}

int main(void)
{
    test_fresnel();
    test_verify();
    test_notices();
    const method newton = method_beckmann_newton();
    const method of_ggx[] = {method_ggx_caps(), method_ggx_caps_batch(VNDF_INSTRUCTIONS_PORTABLE),
                             method_ggx_caps_batch(VNDF_INSTRUCTIONS_AVX2),
                             method_ggx_caps_batch(VNDF_INSTRUCTIONS_AVX512)};
    test_visible(of_ggx, sizeof of_ggx / sizeof *of_ggx, vndf_ggx());
    test_visible(&newton, 1, vndf_beckmann());
    test_all_normals(method_ggx_all_normals(), &(vndf_surface){vndf_ggx(), 0.3f, 0.3f}, law_of_ggx, 1e-3);
    test_all_normals(method_beckmann_all_normals(), &(vndf_surface){vndf_beckmann(), 0.3f, 0.3f}, law_of_beckmann,
                     1e-3);
    test_floor();
    test_any();
    return test_done();
}
