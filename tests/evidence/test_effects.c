/* What `vndf bench effects` compares is comparable, and what is wrong is noticed: bare reflection by hand has
 * the mean weight of the library's (two means within 5 standard errors, fixed seeds); densities, values,
 * weights, directions and lobes that are off fail verification; every set of every distribution passes it. */
#include "evidence/evidence.h"
#include "harness/test.h"

static block b;

static method method_of(const vndf_distribution *d, const char *set, float alpha)
{
    const vndf_surface surface = {d, alpha, alpha};
    vndf_error error;
    method m = method_effect(effect_find(set), &surface, &error);
    TEST(m.each != NULL);
    return m;
}

/* Verified, and its worth. */
static int is_right(const method *m, size_t blocks, evidence_row *row)
{
    const block_law law = effect_law(((const effect_case *)m->state)->set, NAN);
    return evidence_verify(m, &law, &b, 500) & worth_of_material(m, &law, 60, &b, blocks, row);
}

/* ---- yardsticks --------------------------------------------------------------------------------- */

static void test_same_mean(const vndf_distribution *d)
{
    for (float alpha = 0.1f; alpha < 1; alpha += 0.4f) {
        method hand = method_of(d, "by hand, over vndf.h", alpha), bare = method_of(d, "bare reflection", alpha);
        evidence_row x, y;
        TEST(is_right(&hand, 16, &x) && is_right(&bare, 16, &y));
        double noise = hypot(x.number[COL_NOISE], y.number[COL_NOISE]);
        TEST(noise > 0 && noise < 0.01);
        TEST_NEAR(x.number[COL_MEAN], y.number[COL_MEAN], 5 * noise);
        TEST_NEAR(x.number[COL_LOST], y.number[COL_LOST], 0.01);
        method_release(&hand);
        method_release(&bare);
    }
}

/* ---- what is wrong ------------------------------------------------------------------------------ */

/* What is off is one number of a run's sixth result. */
enum { WO, LOBE, NOT_A_NUMBER, WEIGHT, VALUE, DENSITY, DEFECTS };

static int defect;
static method_run *right;

static void off(const method *m, block *of, size_t first, size_t count)
{
    vndf_scattered *spoilt = &of->out[first + 5];
    right(m, of, first, count);
    switch (defect) {
    case WO: spoilt->wo.x *= 1.001f; break;
    case LOBE: spoilt->lobe = VNDF_LOBE_TRANSMISSION; break;
    case NOT_A_NUMBER: spoilt->weight[0] = NAN; break;
    case DENSITY: spoilt->density *= 1.001f; break;
    default: spoilt->weight[2] *= 1.001f;
    }
}

static void test_notices(void)
{
    const block_law law = effect_law(effect_find("conductor Fresnel"), NAN);
    method m = method_of(vndf_ggx(), "conductor Fresnel", 0.3f);
    method_run **const run[DEFECTS] = {&m.each, &m.each, &m.each, &m.shared, &m.eval, &m.density};
    TEST(evidence_verify(&m, &law, &b, 500));
    for (defect = 0; defect < DEFECTS; defect++) {
        right = *run[defect];
        *run[defect] = off;
        TEST(!evidence_verify(&m, &law, &b, 500));
        *run[defect] = right;
    }
    method_release(&m);
}

/* ---- every set ---------------------------------------------------------------------------------- */

static void test_sets(const vndf_distribution *d)
{
    const int is_table = d != vndf_ggx() && d != vndf_beckmann();
    for (size_t i = 0; i < effect_set_count; i++) {
        const effect_set *set = &effect_sets[i];
        evidence_row row;
        method m = method_of(d, set->name, 0.5f);
        if (!(TEST(is_right(&m, 4, &row)) & TEST(row.number[COL_MEAN] > 0 && row.number[COL_MEAN] < 2.25)))
            fprintf(stderr, "  %s: mean %g\n", set->name, row.number[COL_MEAN]);
        if (set->effects.normals == VNDF_NORMALS_BOUNDED)
            TEST(row.number[COL_LOST] <= (is_table ? 0 : 0.06));
        if (set->effects.lobes == VNDF_LOBES_REFLECTION && set->effects.normals != VNDF_NORMALS_ALL &&
            set->effects.masking == VNDF_MASKING_HEIGHT_CORRELATED &&
            set->effects.scattering < VNDF_SCATTERING_TURQUIN)
            TEST_NEAR(fmax(row.number[COL_WEIGHT], 1), 1, is_table ? 0.3 : 1e-5);
        method_release(&m);
    }
}

int main(void)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", &error);
    test_same_mean(vndf_ggx());
    test_same_mean(vndf_beckmann());
    test_notices();
    test_sets(vndf_ggx());
    test_sets(vndf_beckmann());
    if (TEST(table != NULL)) {
        test_same_mean(table);
        test_sets(table);
    }
    vndf_free(table);
    return test_done();
}
