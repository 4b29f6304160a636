/* A comparison calls pictures the same that differ by chance, and different where a difference is planted: a lamp
 * brighter by 7%, one ball of six that is duller. Of too few samples it says that it does not know. Its figures are
 * right for ways whose ratio is known: twice the samples halve the squared noise. Notices a variance that is off by a
 * factor, blocks that are left out, alarms about nothing, and random numbers that depend on the pass. */
#include "render_case.h"

static scene *scene_of(double lamp, double alpha)
{
    char text[2048];
    snprintf(text, sizeof text,
             "camera --from 0,0,8 --to 0,0,0 --field 30 --width 96 --height 64\n"
             "environment --constant 0.2,0.2,0.2\nmaterial lamp --light %g,%g,%g\n"
             "material gold --conductor gold --distribution ggx --alpha 0.2\n"
             "material odd --conductor gold --distribution ggx --alpha %g\n"
             "sphere --centre 2,4,4 --radius 0.3 --material lamp\n"
             "sphere --centre -2,1,0 --radius 0.9 --material gold\n"
             "sphere --centre 0,1,0 --radius 0.9 --material gold\n"
             "sphere --centre 2,1,0 --radius 0.9 --material gold\n"
             "sphere --centre -2,-1,0 --radius 0.9 --material gold\n"
             "sphere --centre 0,-1,0 --radius 0.9 --material gold\n"
             "sphere --centre 2,-1,0 --radius 0.9 --material odd\n",
             lamp, lamp, lamp, alpha);
    return case_scene(text);
}

/* A picture of the scene as it is beside one with another lamp or ball, as ways whose times are known. */
static void find(double lamp, double alpha, const uint64_t samples[2], uint64_t seed, finding found[SAMPLERS])
{
    comparison both = {.count = 2}, each[2];
    for (size_t i = 0; i < 2; i++) {
        scene *s = scene_of(i ? lamp : 30, i ? alpha : 0.2);
        each[i] = case_render(s, SAMPLER_VISIBLE, samples[i], 2 * seed + i);
        both.way[i] = each[i].way[0];
        both.way[i].film.processor = 2.0 + (double)i;
        scene_free(s);
    }
    comparison_find(&both, found);
    comparison_end(&both);
}

static void test_verdict(double lamp, double alpha, uint64_t samples, verdict want)
{
    for (uint64_t seed = 1; seed <= 2; seed++) {
        finding found[SAMPLERS], *f = &found[1];
        find(lamp, alpha, (const uint64_t[2]){samples, samples}, seed, found);
        if (!TEST(f->is == want))
            fprintf(stderr, "    light %g, alpha %g: %g, worst %g at (%d, %d), mean square %g\n", lamp, alpha,
                    f->whole, f->worst, f->x, f->y, f->mean_square);
        TEST(want != VERDICT_DIFFERS || lamp != 30 || (f->x >= 48 && f->y >= 24)); /* where the odd ball is */
        TEST(want != VERDICT_UNKNOWN || (isnan(f->whole) && isnan(f->worst) && isfinite(f->ratio)));
    }
}

static void test_figures(void)
{
    finding found[SAMPLERS], *first = &found[0], *f = &found[1];
    find(30, 0.2, (const uint64_t[2]){64, 128}, 1, found);
    const double ratio = f->noise.value / first->noise.value;
    TEST_NEAR(ratio, 0.5, 0.05);
    TEST(first->noise.spread > 0);
    TEST_RELATIVE(f->samples.value, 2 * ratio, 1e-12);
    TEST_RELATIVE(f->efficiency.value, 2 / (3 * ratio), 1e-12);
    TEST(first->samples.value == 1 && first->samples.spread == 0 && f->samples.spread > 0);
    /* a pixel of light 1 whose samples have a variance of 1/4: that of the mean of 26 is 1/100 */
    double sum[3] = {26, 26, 26}, square = 26 * 1.25;
    const comparison c = {.count = 1, .way = {{.film = {1, 1, sum, &square, .samples = 26}}}};
    comparison_find(&c, found);
    TEST_RELATIVE(first->noise.value, 0.01 / (1 + 0.05 * 0.05), 1e-9);
    TEST(first->noise.spread < 1e-9 && first->ratio == 1);
}

/* Two ways by one sampler, which have numbers of their own; by a slow one fewer samples take the same time. */
static void test_run(void)
{
    scene *s = scene_of(30, 0.2);
    comparison c = {
        .count = 3, .samples = 96, .threads = 2, .has_equal_time = 1, .way = {[2] = {SAMPLER_PERFECT, 0}}};
    comparison once = case_render(s, SAMPLER_VISIBLE, 7, 0);
    const film *one = &c.way[0].film, *other = &c.way[1].film, *slow = &c.way[2].film;
    const size_t size = 3 * film_pixels(&once.way[0].film) * sizeof(double);
    once.samples = 96; /* in other passes */
    TEST(comparison_run(&once) && comparison_begin(&c, s) && comparison_run(&c) && one->samples == 96);
    TEST(slow->samples < 64 && slow->processor >= one->processor && other->processor >= one->processor);
    TEST(memcmp(one->sum, once.way[0].film.sum, size) == 0 && memcmp(one->sum, other->sum, size) != 0);
    comparison_end(&once);
    comparison_end(&c);
    scene_free(s);
}

int main(void)
{
    test_verdict(30, 0.2, 64, VERDICT_SAME);
    test_verdict(32, 0.2, 96, VERDICT_DIFFERS);
    test_verdict(30, 0.3, 64, VERDICT_DIFFERS);
    test_verdict(60, 0.2, 4, VERDICT_UNKNOWN);
    test_figures();
    test_run();
    return test_done();
}
