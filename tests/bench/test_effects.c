/* What `vndf bench effects` compares is comparable, and what is wrong is noticed: bare reflection by hand has
 * the mean weight of the library's (two means within 5 standard errors, fixed seeds); densities, values,
 * weights, directions and lobes that are off fail verification; every set of every distribution passes it. */
#include <stdlib.h>

#include "bench/effects/effects.h"
#include "harness/test.h"

static effects_entry entry_of(const vndf_distribution *d, const char *set, float alpha)
{
    effects_entry e = {.distribution = "", .theta = NAN, .worth_theta = 60, .bare = EFFECTS_NONE};
    const vndf_surface surface = {d, alpha, alpha};
    vndf_error error;
    TEST(effects_subject_make(&e.subject, effects_find(set), &surface, &error) == VNDF_OK);
    return e;
}

/* ---- yardsticks --------------------------------------------------------------------------------- */

static void test_same_mean(const vndf_distribution *d, const char *by_hand, effects_block *block)
{
    for (float alpha = 0.1f; alpha < 1; alpha += 0.4f) {
        effects_entry hand = entry_of(d, by_hand, alpha), bare = entry_of(d, "bare reflection", alpha);
        effects_verify(&hand, block);
        effects_weigh(&hand, block, 16);
        effects_weigh(&bare, block, 16);
        double noise = sqrt(hand.row.noise * hand.row.noise + bare.row.noise * bare.row.noise);
        TEST(!hand.row.wrong && !bare.row.wrong);
        TEST(noise > 0 && noise < 0.01);
        TEST_NEAR(hand.row.mean, bare.row.mean, 5 * noise);
        TEST_NEAR(hand.row.lost, bare.row.lost, 0.01);
    }
}

/* ---- what is wrong ------------------------------------------------------------------------------ */

static void off_direction(const effects_job *job)
{
    effects_loops_library.each(job);
    job->out[5].wo.x *= 1.0001f;
    job->out[5].wo.y *= 1.0001f;
    job->out[5].wo.z *= 1.0001f;
}

static void off_lobe(const effects_job *job)
{
    effects_loops_library.each(job);
    job->out[5].lobe = VNDF_LOBE_TRANSMISSION;
}

static void off_weight(const effects_job *job)
{
    effects_loops_library.shared(job);
    job->out[5].weight[1] *= 1.001f;
}

static void off_value(const effects_job *job)
{
    effects_loops_library.eval(job);
    job->out[5].weight[2] *= 1.001f;
}

static void off_density(const effects_job *job)
{
    effects_loops_library.pdf(job);
    job->out[5].density *= 1.001f;
}

static void nan_weight(const effects_job *job)
{
    effects_loops_library.each(job);
    job->out[5].weight[0] = NAN;
}

static int passes(effects_loops loops, effects_block *block)
{
    effects_entry e = entry_of(vndf_ggx(), "conductor Fresnel", 0.3f);
    e.subject.loops = &loops;
    effects_verify(&e, block);
    return !e.row.wrong;
}

static void test_notices(effects_block *block)
{
    const effects_loops ours = effects_loops_library;
    TEST(passes(ours, block));
    TEST(!passes((effects_loops){off_direction, ours.shared, ours.eval, ours.pdf}, block));
    TEST(!passes((effects_loops){off_lobe, ours.shared, ours.eval, ours.pdf}, block));
    TEST(!passes((effects_loops){nan_weight, ours.shared, ours.eval, ours.pdf}, block));
    TEST(!passes((effects_loops){ours.each, off_weight, ours.eval, ours.pdf}, block));
    TEST(!passes((effects_loops){ours.each, ours.shared, off_value, ours.pdf}, block));
    TEST(!passes((effects_loops){ours.each, ours.shared, ours.eval, off_density}, block));
}

/* ---- every set ---------------------------------------------------------------------------------- */

static void test_sets(const vndf_distribution *d, effects_block *block)
{
    for (size_t i = 0; i < effects_set_count; i++) {
        const effects_set *set = &effects_sets[i];
        if (set->kind == EFFECTS_BY_CAPS && d != vndf_ggx())
            continue;
        effects_entry e = entry_of(d, set->name, 0.5f);
        e.subject.material.is.mixture = &e.subject.mixture; /* it was copied */
        effects_verify(&e, block);
        effects_weigh(&e, block, 4);
        int right = TEST(!e.row.wrong), plausible = TEST(e.row.mean > 0 && e.row.mean < 2.25);
        if (!right || !plausible)
            fprintf(stderr, "  %s: mean %g\n", set->name, e.row.mean);
        if (set->effects.normals == VNDF_NORMALS_BOUNDED)
            TEST(d == vndf_ggx() || d == vndf_beckmann() ? e.row.lost < 0.06 : e.row.lost == 0);
        if (set->effects.lobes == VNDF_LOBES_REFLECTION && set->effects.normals != VNDF_NORMALS_ALL &&
            set->effects.masking == VNDF_MASKING_HEIGHT_CORRELATED &&
            set->effects.scattering < VNDF_SCATTERING_TURQUIN)
            TEST_NEAR(fmax(e.row.max_weight, 1), 1, d == vndf_ggx() || d == vndf_beckmann() ? 1e-5 : 0.3);
        vndf_albedo_free(e.subject.albedo);
    }
}

int main(void)
{
    effects_block *block = calloc(1, sizeof *block);
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", &error);
    if (TEST(block != NULL && table != NULL)) {
        test_same_mean(vndf_ggx(), "by hand, without the library", block);
        test_same_mean(vndf_ggx(), "by hand, over vndf.h", block);
        test_same_mean(vndf_beckmann(), "by hand, over vndf.h", block);
        test_same_mean(table, "by hand, over vndf.h", block);
        test_notices(block);
        test_sets(vndf_ggx(), block);
        test_sets(vndf_beckmann(), block);
        test_sets(table, block);
    }
    vndf_free(table);
    free(block);
    return test_done();
}
