/* The methods that the benchmark sets ours against are what they are said to be: the exact ones draw the visible
 * normals of GGX and Beckmann (chi-square, fixed seeds, chance of a false alarm 1e-6 for each), and those for any D
 * tell the density with which they draw. */
#include <string.h>

#include "cli/random.h"
#include "cli/subject.h"
#include "evidence/evidence.h"
#include "evidence/measure/bins.h"
#include "evidence/measure/statistics.h"
#include "harness/test.h"

static const double level = 1e-6;

static size_t blocks(void)
{
    return test_quick() ? 10 : 100;
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
    const method_reference reference = method_reference_of(vndf_ggx(), "ggx");
    method caps = method_ggx_caps(), normals = method_all_normals(&reference);
    TEST(chi_square_of(&caps, expect(vndf_beckmann(), 60, 0.5f)) < level);
    TEST(chi_square_of(&normals, expect(vndf_ggx(), 60, 0.5f)) < level);
    method_release(&normals);
}

/* ---- any D ------------------------------------------------------------------------------------- */

static findings findings_of(const method *m, const method_reference *reference, double theta, size_t replicates)
{
    static block b;
    findings f;
    worth_of_normals(m, reference, theta, replicates, &b, &f);
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

/* ---- how error is measured --------------------------------------------------------------------- */

/* Densities of an exact method are those of the reference, but for rounding. */
static void test_floor(void)
{
    const method_reference reference = {{vndf_ggx(), 1, 1}, 1, "ggx"};
    const method m = method_ggx_caps();
    for (double theta = 0; theta < 90; theta += 40)
        TEST(findings_of(&m, &reference, theta, 16).tv < 1e-6);
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

static enum { LENGTH, AWAY, OTHER_BITS } defect;

static method scalar; /* of GGX, ours */

static void off(const method *m, block *b, size_t first, size_t count)
{
    scalar.each(m, b, first, count);
    b->x[5] *= defect == LENGTH ? 1.0001f : defect == AWAY ? -1.0f : 1.0f;
    b->y[5] *= defect == AWAY ? -1.0f : 1.0f;
    b->pdf[5] = defect == OTHER_BITS ? nextafterf(b->pdf[5], 0) : b->pdf[5];
}

/* What is wrong is noticed: a length, normals that face away (seen along the surface), a bit of a batch. */
static void test_verify(void)
{
    static block b;
    const block_law law = {vndf_ggx(), 0.05f, 0.95f, NAN, 0}, grazing = {vndf_ggx(), 0.05f, 0.95f, 89.9, 0};
    scalar = method_ours(vndf_ggx(), "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST);
    method batch = method_ours(vndf_ggx(), "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_PORTABLE), m = scalar;
    TEST(evidence_verify(&m, &law, &b, 1) && evidence_verify(&batch, &law, &b, 1));
    m.each = off;
    TEST(!evidence_verify(&m, &law, &b, 1));
    defect = AWAY;
    TEST(evidence_verify(&scalar, &grazing, &b, 1) && !evidence_verify(&m, &grazing, &b, 1));
    defect = OTHER_BITS;
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
    vndf_source *source = vndf_source_family("student-t:2.5", NULL);
    vndf_distribution *fine = table_of(source, 32768), *small = table_of(source, 2048);
    if (TEST(fine && small)) {
        method_reference reference = method_reference_of(fine, "fine");
        test_unbiased(method_all_normals(&reference), &reference);
        test_unbiased(method_warp(&reference), &reference);
        test_small_table(&reference, small);
    }
    vndf_free(fine);
    vndf_free(small);
    vndf_source_free(source);
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
    for (int i = 0; i < 2; i++) {
        const method_reference reference = method_reference_of(i ? vndf_beckmann() : vndf_ggx(), "");
        test_unbiased(method_all_normals(&reference), &reference);
    }
    test_floor();
    test_any();
    return test_done();
}
