/* The methods that the benchmark sets ours against are what they are said to be: the exact ones draw the visible
 * normals of GGX (chi-square, fixed seeds, chance of a false alarm 1e-6 for each), and those for any D
 * tell the density with which they draw. */
#include "cli/subject.h"
#include "evidence/evidence.h"
#include "evidence/measure/bins.h"
#include "harness/test.h"
#include "oracle/oracle.h"

static const double level = 1e-6;

/* ---- chi-square of visible normals ------------------------------------------------------------- */

typedef struct drawn {
    const method *m;
    vndf_view view; /* of what the normals should be */
    block *b;       /* aimed */
} drawn;

static vndf_vec3 draw(const void *of, float u1, float u2, float *pdf)
{
    const drawn *d = of;
    block *b = d->b;
    b->u[0][0] = b->in[0].u[0] = u1;
    b->u[1][0] = b->in[0].u[1] = u2;
    (b->limit ? d->m->batch : d->m->each)(d->m, b);
    *pdf = b->pdf[0];
    return (vndf_vec3){b->x[0], b->y[0], b->z[0]};
}

static float density(const void *of, vndf_vec3 wm)
{
    return vndf_pdf(&((const drawn *)of)->view, wm);
}

/* Of a method's samples of the visible normals of d, or of what they should not be. */
static double chi_square_of(const method *m, vndf_instructions set, const vndf_distribution *d, double theta,
                            float alpha)
{
    static block b;
    const vndf_surface surface = vndf_rough(d, alpha, alpha);
    const vndf_vec3 wi = direction_from(theta, 25);
    const drawn of = {m, vndf_view_from(&surface, wi), &b};
    const bins_sampler judged = {bins_frame_of(&surface, wi), draw, density, &of};
    block_aim(&b, wi, alpha);
    b.count = 1;
    b.limit = set;
    return bins_chi_square(&judged, test_quick() ? 10000 : 100000, 31).found.p;
}

/* Caps, one by one and by each batch. */
static void test_caps(void)
{
    static const double thetas[] = {5, 60, 88};
    const method m = method_ggx_caps();
    for (vndf_instructions set = VNDF_INSTRUCTIONS_BEST; set <= VNDF_INSTRUCTIONS_AVX512; set++)
        for (int i = 0; i < 3 && (!set || method_has_batch(&m, set)); i++)
            if (!TEST(chi_square_of(&m, set, vndf_ggx(), thetas[i], i == 1 ? 0.1f : 0.7f) > level))
                fprintf(stderr, "  set %d: at %g degrees\n", (int)set, thetas[i]);
}

/* ---- any D ------------------------------------------------------------------------------------- */

/* Unbiased: the albedo is the reference's within the noise at 60 and 85 degrees, and the noise is small. */
static void test_unbiased(method m, const method_reference *reference)
{
    static block b;
    method ours = method_ours(reference->canonical.distribution, "", METHOD_SAMPLE);
    for (double theta = 60; TEST(m.each != NULL) && theta < 90; theta += 25) {
        findings f = worth_of_normals(&m, reference, theta, 64, &b),
                 t = worth_of_normals(&ours, reference, theta, 64, &b);
        int agrees = fabs(f.albedo - t.albedo) <= 6 * hypot(f.albedo_noise, t.albedo_noise) + 1e-6;
        if (!(TEST(agrees) & TEST(f.albedo_noise < 0.02 * f.albedo) & TEST(t.albedo_noise < 1e-3)))
            fprintf(stderr, "  %s at %g: %g +- %g, not %g\n", m.name, theta, f.albedo, f.albedo_noise, t.albedo);
    }
    method_release(&m);
}

/* ---- verification ------------------------------------------------------------------------------ */

/* One number of the sixth result of a run is off, of normals of ours or of a material. */
static enum { LENGTH, AWAY, OTHER_BITS, WO, LOBE, NOT_A_NUMBER, BATCH, DEFECTS } defect;
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
    test_caps();
    vndf_distribution *table = oracle_build("student-t:2.5", 32768, NULL, NULL);
    const vndf_distribution *const all[] = {vndf_ggx(), vndf_beckmann(), table};
    for (int i = 0; i < 3 && TEST(table != NULL); i++) {
        const method_reference reference = method_reference_of(all[i], "");
        test_unbiased(method_all_normals(&reference), &reference);
        if (i == 2)
            test_unbiased(method_warp(&reference), &reference);
    }
    vndf_free(table);
    return test_done();
}
