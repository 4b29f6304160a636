/* A comparison calls pictures the same that differ by chance, and different where a difference is planted: a
 * lamp brighter by 7%, one ball of six that is duller. Of too few samples it says that it does not know. Its
 * figures are right for ways whose ratio is known: twice the samples halve the squared noise. Notices a variance
 * that is off by a factor, blocks that are left out, alarms about nothing, and random numbers that depend on the
 * pass. */
#include "render_case.h"

static const char balls[] =
    "film width 96 height 64\ncamera from 0 0 8 to 0 0 0 field 30\n"
    "environment constant 0.2 0.2 0.2\nmaterial lamp light radiance %g %g %g\n"
    "material gold conductor of gold distribution ggx alpha 0.2\n"
    "material odd conductor of gold distribution ggx alpha %g\n"
    "sphere centre 2 4 4 radius 0.3 material lamp\n"
    "sphere centre -2 1 0 radius 0.9 material gold\nsphere centre 0 1 0 radius 0.9 material gold\n"
    "sphere centre 2 1 0 radius 0.9 material gold\nsphere centre -2 -1 0 radius 0.9 material gold\n"
    "sphere centre 0 -1 0 radius 0.9 material gold\nsphere centre 2 -1 0 radius 0.9 material odd\n";

static film render(double lamp, double alpha, uint64_t samples, uint64_t seed)
{
    char text[2048];
    film f = {.sum = NULL};
    snprintf(text, sizeof text, balls, lamp, lamp, lamp, alpha);
    scene *s = case_scene(text);
    if (s)
        case_render(&f, s, SAMPLER_VISIBLE, samples, seed);
    scene_free(s);
    return f;
}

static void test_verdict(double lamp, double alpha, uint64_t samples, verdict want)
{
    for (uint64_t seed = 1; seed <= 2; seed++) {
        film f = render(30, 0.2, samples, 2 * seed), other = render(lamp, alpha, samples, 2 * seed + 1), read;
        image written;
        agreement a = agreement_between(&f, &other, 0);
        if (!TEST(a.is == want))
            fprintf(stderr, "    light %g, alpha %g: %g, worst %g at (%d, %d), mean square %g\n", lamp, alpha,
                    a.whole, a.worst, a.x, a.y, a.mean_square);
        if (want == VERDICT_DIFFERS && lamp == 30)
            TEST(a.x >= 48 && a.y >= 24); /* where the odd ball is */
        if (want == VERDICT_UNKNOWN)
            TEST(isnan(a.whole) && isnan(a.worst) && isfinite(a.ratio));
        if (TEST(film_image(&other, &written) && film_from_image(&read, &written)))
            TEST(agreement_between(&f, &read, 1).is == want);
        image_free(&written);
        film_free(&read);
        film_free(&f);
        film_free(&other);
    }
}

static void test_figures(void)
{
    film f = render(30, 0.2, 64, 1), other = render(30, 0.2, 128, 2);
    noise of_f, of_other;
    film all;
    f.processor = 2;
    other.processor = 3;
    comparison c = {.way = {{.film = f}, {.film = other}}, .count = 2};
    if (TEST(comparison_mean(&c, &all) && noise_of(&f, &all, &of_f) && noise_of(&other, &all, &of_other))) {
        TEST_NEAR(of_other.all.value / of_f.all.value, 0.5, 0.05);
        TEST(of_f.trimmed.value < of_f.all.value && of_f.all.spread > 0);
        const noise both[2] = {of_f, of_other};
        const gain g = gain_of(&c, both, 1);
        TEST_RELATIVE(g.samples.value, 2 * of_other.all.value / of_f.all.value, 1e-12);
        TEST_RELATIVE(g.efficiency.value, 2 * of_f.all.value / (3 * of_other.all.value), 1e-12);
        TEST(gain_of(&c, both, 0).samples.spread == 0);
    }
    film_free(&all);
    film_free(&f);
    film_free(&other);
    film one = render(30, 0.2, 1, 1);
    TEST(noise_of(&one, &one, &of_f) && isnan(of_f.all.value) && isnan(of_f.trimmed.spread));
    film_free(&one);
}

static void test_run(void)
{
    char text[2048], message[512];
    snprintf(text, sizeof text, balls, 30.0, 30.0, 30.0, 0.2);
    scene *s = case_scene(text);
    comparison c = {
        .count = 2, .samples = 24, .threads = 2, .way = {{.sampler = SAMPLER_VISIBLE}, {.sampler = SAMPLER_ALL}}};
    for (size_t i = 0; i < 2 && s; i++) {
        c.way[i].plan = path_prepare(s, c.way[i].sampler, message, sizeof message);
        TEST(c.way[i].plan && film_make(&c.way[i].film, s->width, s->height));
    }
    TEST(comparison_run(&c) && c.way[0].film.samples == 24 && c.way[1].film.samples == 24);
    TEST(memcmp(c.way[0].film.sum, c.way[1].film.sum, 3 * film_pixels(&c.way[0].film) * sizeof(double)) != 0);
    film once = {.sum = NULL}; /* which is the same, but for rounding, in one run */
    case_render(&once, s, SAMPLER_VISIBLE, 24, 0);
    for (size_t i = 0; i < 3 * film_pixels(&once); i++)
        TEST_NEAR(once.sum[i], c.way[0].film.sum[i], 1e-9);
    film_free(&once);
    c.has_equal_time = 1;
    c.samples = 96;
    TEST(comparison_run(&c) && c.way[0].film.samples == 96);
    TEST(c.way[1].film.processor >= c.way[0].film.processor);
    for (size_t i = 0; i < 2; i++) {
        path_free(c.way[i].plan);
        film_free(&c.way[i].film);
    }
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
