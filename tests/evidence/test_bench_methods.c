/* The methods that the benchmark sets ours against are what they are said to be: spherical caps, one by one and by each
 * batch, draw the visible normals of GGX as ours do, and those for any D tell the density with which they draw; and
 * what it times is verified. It notices a law that is another on one side, a density for another, and a batch whose
 * bits are not compared. */
#include "cli/subject.h"
#include "evidence/evidence.h"
#include "harness/test.h"
#include "oracle/oracle.h"

/* Unbiased: the albedo is the reference's within the noise, and the noise is small. What is exact has the variance of
 * ours too, of all light and of that of a lamp aside, and its densities are the true ones. */
static void test_unbiased(method m, vndf_instructions set, const method_reference *reference, int is_exact)
{
    static block b;
    method ours = method_ours(reference->canonical.distribution, "", METHOD_SAMPLE);
    if (!TEST(m.each != NULL))
        return;
    m.each = set ? m.batch : m.each;
    for (double theta = 10; theta < 90; theta += 25) {
        b.limit = set;
        findings f = worth_of_normals(&m, reference, theta, 64, &b),
                 t = worth_of_normals(&ours, reference, theta, 64, &b);
        int agrees = fabs(f.albedo - t.albedo) <= 6 * hypot(f.albedo_noise, t.albedo_noise) + 1e-6;
        int alike = fabs(f.variance / t.variance - 1) < 5e-3 &&
                    fabs(f.light_variance / t.light_variance - 1) < 0.1 && f.tv < 1e-4 && f.max_weight < 1.01;
        if (!(TEST(agrees) & TEST(!is_exact || alike) & TEST(f.albedo_noise < 0.02 * f.albedo) &
              TEST(t.albedo_noise < 1e-3)))
            fprintf(stderr, "  %s, set %d, at %g: %g +- %g, not %g, variances %g and %g, not %g and %g\n", m.name,
                    (int)set, theta, f.albedo, f.albedo_noise, t.albedo, f.variance, f.light_variance, t.variance,
                    t.light_variance);
    }
    method_release(&m);
}

/* ---- verification ------------------------------------------------------------------------------ */

/* One number of the sixth result of a run is off, of normals of ours or of a material. */
enum { LENGTH, AWAY, OTHER_BITS, WO, LOBE, NOT_A_NUMBER, BATCH, DEFECTS };
static int defect;
static method_run *right;

static void off(const method *m, block *b)
{
    vndf_scattered *s = &b->out[5];
    right(m, b);
    switch (defect) {
    case LENGTH: b->x[5] *= 1.0001f; break;
    case AWAY: b->x[5] = -b->x[5], b->y[5] = -b->y[5]; break; /* seen along the surface */
    case OTHER_BITS: b->pdf[5] = nextafterf(b->pdf[5], 0); break;
    case WO: s->wo.x *= 1.001f; break;
    case LOBE: s->lobe = VNDF_LOBE_TRANSMISSION; break;
    case NOT_A_NUMBER: s->weight[0] = NAN; break;
    default: b->value[2][5] = nextafterf(b->value[2][5], 2);
    }
}

static void test_verify(void)
{
    static block b[2];
    const effect_set set = {.name = "conductor", .effects = {.fresnel = VNDF_FRESNEL_CONDUCTOR}};
    const vndf_surface surface = vndf_rough(vndf_ggx(), 0.3f, 0.3f);
    const block_law laws[] = {{vndf_ggx(), 0.05f, 0.95f, 89.9, 0}, effect_law(&set)};
    vndf_error error;
    method of[] = {method_ours(vndf_ggx(), "", METHOD_SAMPLE), method_effect(&set, &surface, &error)};
    for (int i = 0; i < DEFECTS; i++) {
        const int k = i >= WO, is_batch = i == OTHER_BITS || i == BATCH;
        const vndf_instructions lanes = is_batch ? VNDF_INSTRUCTIONS_PORTABLE : VNDF_INSTRUCTIONS_BEST;
        method_run **run = is_batch ? &of[k].batch : &of[k].each;
        TEST(evidence_verify(&of[k], lanes, &laws[k], b, 5));
        right = *run, *run = off, defect = i;
        TEST(!evidence_verify(&of[k], lanes, &laws[k], b, 5));
        *run = right;
    }
    method_release(&of[1]);
}

int main(void)
{
    test_verify();
    vndf_distribution *table = oracle_build("student-t:2.5", 32768, NULL, NULL);
    const vndf_distribution *const all[] = {vndf_ggx(), vndf_beckmann(), table};
    for (int i = 0; i < 3 && TEST(table != NULL); i++) {
        const method_reference reference = method_reference_of(all[i], "");
        const method caps = method_ggx_caps();
        test_unbiased(method_all_normals(&reference), VNDF_INSTRUCTIONS_BEST, &reference, 0);
        if (i == 2)
            test_unbiased(method_warp(&reference), VNDF_INSTRUCTIONS_BEST, &reference, 0);
        for (vndf_instructions set = VNDF_INSTRUCTIONS_BEST; set <= VNDF_INSTRUCTIONS_AVX512 && i == 0; set++)
            if (!set || method_has_batch(&caps, set))
                test_unbiased(caps, set, &reference, 1);
    }
    vndf_free(table);
    return test_done();
}
