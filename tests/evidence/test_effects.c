/* What `vndf bench --effects` times is right, and what is wrong is noticed: densities, values, weights, directions and
 * lobes that are off fail verification; every set of every distribution passes it. */
#include "evidence/evidence.h"
#include "harness/test.h"

static block b;

static method method_of(const vndf_distribution *d, const effect_set *set, float alpha)
{
    const vndf_surface surface = {d, alpha, alpha};
    vndf_error error;
    method m = method_effect(set, &surface, &error);
    TEST(m.each != NULL);
    return m;
}

/* What is off is one number of a run's sixth result. */
enum { WO, LOBE, NOT_A_NUMBER, WEIGHT, VALUE, DENSITY, BATCH, DEFECTS = BATCH + 4 };

static int defect;
static method_run *right;

static void off(const method *m, block *of)
{
    vndf_scattered *spoilt = &of->out[5];
    right(m, of);
    switch (defect) {
    case WO: spoilt->wo.x *= 1.001f; break;
    case LOBE: spoilt->lobe = VNDF_LOBE_TRANSMISSION; break;
    case NOT_A_NUMBER: spoilt->weight[0] = NAN; break;
    case DENSITY: spoilt->density *= 1.001f; break;
    case BATCH: of->y[5] = nextafterf(of->y[5], 2); break;
    case BATCH + 1: of->value[2][5] = nextafterf(of->value[2][5], 2); break;
    case BATCH + 2: of->pdf[5] = nextafterf(of->pdf[5], 0); break;
    case BATCH + 3: of->lobe[5] ^= 1; break;
    default: spoilt->weight[2] *= 1.001f;
    }
}

static void test_notices(void)
{
    const effect_set conductor = {.name = "conductor", .effects = {.fresnel = VNDF_FRESNEL_CONDUCTOR}},
                     *set = &conductor;
    const block_law law = effect_law(set);
    method m = method_of(vndf_ggx(), set, 0.3f);
    method_run **const run[BATCH + 1] = {&m.each, &m.each, &m.each, &m.shared, &m.eval, &m.density, &m.batch};
    TEST(evidence_verify(&m, VNDF_INSTRUCTIONS_BEST, &law, &b, 500) &&
         evidence_verify(&m, VNDF_INSTRUCTIONS_PORTABLE, &law, &b, 500));
    for (defect = 0; defect < DEFECTS; defect++) {
        method_run **spoilt = run[defect < BATCH ? defect : BATCH];
        right = *spoilt;
        *spoilt = off;
        TEST(!evidence_verify(&m, defect < BATCH ? VNDF_INSTRUCTIONS_BEST : VNDF_INSTRUCTIONS_PORTABLE, &law, &b,
                              500));
        *spoilt = right;
    }
    method_release(&m);
}

/* Verified, and its weights are what such a set may have. */
static void test_sets(const vndf_distribution *d)
{
    const int is_table = d != vndf_ggx() && d != vndf_beckmann();
    for (const effect_set *set = effect_sets; set < effect_sets + effect_set_count; set++) {
        const vndf_effects *is = &set->effects;
        const block_law law = effect_law(set);
        double found[COLUMNS];
        method m = method_of(d, set, 0.5f);
        int good = 1;
        worth_of_material(&m, &law, 60, &b, 8, found);
        for (vndf_instructions by = VNDF_INSTRUCTIONS_BEST; by <= VNDF_INSTRUCTIONS_AVX512; by++)
            good &= (by && !method_has_batch(&m, by)) || evidence_verify(&m, by, &law, &b, 500);
        if (!TEST(good && found[COL_MEAN] > 0 && found[COL_MEAN] < 2.25))
            fprintf(stderr, "  %s: mean %g\n", set->name, found[COL_MEAN]);
        if (is->normals == VNDF_NORMALS_BOUNDED)
            TEST(found[COL_LOST] <= (is_table ? 0 : 0.06));
        if (is->lobes == VNDF_LOBES_REFLECTION && is->normals != VNDF_NORMALS_ALL &&
            is->masking == VNDF_MASKING_HEIGHT_CORRELATED && is->scattering < VNDF_SCATTERING_TURQUIN)
            TEST_NEAR(fmax(found[COL_WEIGHT], 1), 1, is_table ? 0.3 : 1e-5);
        method_release(&m);
    }
}

int main(void)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", &error);
    test_notices();
    test_sets(vndf_ggx());
    test_sets(vndf_beckmann());
    if (TEST(table != NULL))
        test_sets(table);
    vndf_free(table);
    return test_done();
}
