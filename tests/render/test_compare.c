/* The figures of `vndf compare` are what they are called: films of known light and noise have the errors,
 * agreements and shared errors that arithmetic gives them; ways have equal samples, equal time, and the images
 * that a film of its own has. Fixed seeds; bounds at 5 standard deviations or more but where it is said, 6e-7 each
 * to fail by chance, 14 of them. */
#include "compare/comparison.h"
#include "render/scene_text.h"
#include "harness/constants.h"
#include "harness/test.h"

enum { WIDTH = 96, HEIGHT = 64, PIXELS = WIDTH * HEIGHT };

static double normal(unsigned long long *state)
{
    double u = (double)test_uniform(state), v = (double)test_uniform(state);
    return sqrt(-2 * log(1 - u)) * cos(2 * PI * v);
}

/* Grey light that differs over the film. */
static double light_of(size_t pixel)
{
    return 1 + 0.5 * sin(0.1 * (double)(pixel % WIDTH));
}

/* Of `samples` a pixel with this standard deviation each, around `factor` times the light. */
static void make_noisy(film *f, unsigned samples, double deviation, double factor, unsigned long long seed)
{
    TEST(film_make(f, WIDTH, HEIGHT));
    f->samples = samples;
    for (size_t i = 0; i < PIXELS; i++)
        for (unsigned k = 0; k < samples; k++) {
            double x = factor * light_of(i) + deviation * normal(&seed);
            f->square[i] += x * x;
            for (size_t j = 0; j < 3; j++)
                f->sum[3 * i + j] += x;
        }
}

/* The mean of 1 / (light^2 + floor^2). */
static double mean_scale(void)
{
    double sum = 0, mean = 0;
    for (size_t i = 0; i < PIXELS; i++)
        mean += light_of(i) / PIXELS;
    for (size_t i = 0; i < PIXELS; i++)
        sum += 1 / (light_of(i) * light_of(i) + ERROR_FLOOR * ERROR_FLOOR * mean * mean) / PIXELS;
    return sum;
}

/* Noise of the reference does not count, that of the film does; a few fireflies are trimmed. */
static void test_errors(void)
{
    film of, reference;
    make_noisy(&of, 16, 0.8, 1, 11);
    make_noisy(&reference, 64, 0.8, 1, 12);
    film_error e = error_between(&of, &reference);
    double truth = 0.8 * sqrt(mean_scale() / 16);
    TEST_RELATIVE(e.relative, truth, 5 * 1.5 / sqrt(2.0 * PIXELS));
    TEST(e.trimmed < e.relative && e.trimmed > 0.97 * e.relative);
    TEST(e.spread[0] > sqrt(2.0 / PIXELS) && e.spread[0] < 3 * sqrt(2.0 / PIXELS)); /* 1 of equal noise */
    for (size_t i = 0; i < PIXELS / 2000; i++)
        for (size_t j = 0; j < 3; j++)
            of.sum[3 * (i * 1000 + 7) + j] += 16 * 30;
    film_error fireflies = error_between(&of, &reference);
    TEST(fireflies.relative > 2 * e.relative);
    TEST_RELATIVE(fireflies.trimmed, e.trimmed, 0.03);
    film_free(&of);
    film_free(&reference);
}

static void test_agreement(void)
{
    film of, brighter, reference;
    make_noisy(&of, 16, 0.8, 1, 21);
    make_noisy(&brighter, 16, 0.8, 1.03, 22);
    make_noisy(&reference, 64, 0.8, 1, 23);
    agreement same = agreement_between(&of, &reference), other = agreement_between(&brighter, &reference);
    TEST(same.blocks == 24);
    TEST_NEAR(same.mean_square, 1, 5 * sqrt(2.0 / 24));
    TEST(fabs(same.whole) < 5);
    TEST_NEAR(same.ratio, 1, 5 * 0.8 * sqrt((1.0 / 16 + 1.0 / 64) / PIXELS));
    TEST(other.whole > 6 && other.mean_square > 2);
    TEST_NEAR(other.ratio, 1.03, 0.015);
    film_free(&of);
    film_free(&brighter);
    film_free(&reference);
}

/* Ten pairs have 240 blocks, whose mean square is 1 within 0.09: both films' noise counts, each as it is. */
static void test_noise(void)
{
    double mean_square = 0, beyond = 0;
    for (unsigned long long i = 0; i < 10; i++) {
        film of, reference;
        make_noisy(&of, 16, 0.8, 1, 100 + i);
        make_noisy(&reference, 16, 0.4, 1, 200 + i);
        agreement a = agreement_between(&of, &reference);
        mean_square += a.mean_square / 10;
        beyond += a.beyond * (double)a.blocks;
        film_free(&of);
        film_free(&reference);
    }
    TEST_NEAR(mean_square, 1, 0.19); /* 2 of its standard deviations, with these seeds */
    TEST(beyond < 6);
}

/* Half of the error in twice the time, and what follows from it; maps and crops of one bright pixel. */
static void test_ratios(void)
{
    contest c = {.count = 2, .samples = 100};
    c.way[0].by_time = (contest_point){100, 1, {0.2, 0.1, {0.03, 0}}};
    c.way[1].by_time = (contest_point){150, 2, {0.1, 0.05, {0.04, 0}}};
    c.way[0].by_samples = (contest_point){100, 1, {0.2, 0.1, {0, 0}}};
    c.way[1].by_samples = (contest_point){100, 1.3, {0.4, 0.3, {0, 0.5}}};
    TEST_RELATIVE(efficiency(&c, 0, 0).value, 1.0, 1e-12);
    TEST_RELATIVE(efficiency(&c, 1, 0).value, 2.0, 1e-12);
    TEST_RELATIVE(efficiency(&c, 1, 0).spread, 2 * 0.05, 1e-12);
    TEST_RELATIVE(efficiency(&c, 1, 1).value, 2.0, 1e-12);
    TEST(efficiency(&c, 0, 0).spread == 0);
    TEST_RELATIVE(samples_for_error(&c, 1, 1).spread, 450.0, 1e-12);
    TEST_RELATIVE(samples_for_error(&c, 1, 0).value, 400.0, 1e-12);
    TEST_RELATIVE(samples_for_error(&c, 1, 1).value, 900.0, 1e-12);
}

static void test_pictures(void)
{
    static float relative[PIXELS];
    contest c = {.count = 2};
    film reference;
    crop crops[CROPS];
    make_noisy(&reference, 1, 0, 1, 1);
    make_noisy(&c.way[0].at_time, 1, 0, 1, 1);
    make_noisy(&c.way[1].at_time, 1, 0, 1, 1);
    c.reference = &reference;
    for (size_t j = 0; j < 3; j++) {
        c.way[0].at_time.sum[3 * (10 * WIDTH + 20) + j] += 0.5; /* all err here: both ways */
        c.way[1].at_time.sum[3 * (10 * WIDTH + 20) + j] += 0.5;
        c.way[1].at_time.sum[3 * (50 * WIDTH + 70) + j] += 0.3;
    }
    error_map(&c.way[1].at_time, &reference, relative);
    size_t at = 50 * WIDTH + 70;
    TEST_NEAR((double)relative[at], 0.3 / (light_of(at) + ERROR_FLOOR * film_mean(&reference)), 1e-6);
    TEST(relative[0] == 0);
    TEST(choose_crops(&c, 0.5f, crops));
    TEST(crops[0].x <= 20 && crops[0].x + crops[0].width > 20 && crops[0].y <= 10 &&
         crops[0].y + crops[0].height > 10);
    TEST(crops[1].x <= 70 && crops[1].x + crops[1].width > 70 && crops[1].y <= 50 &&
         crops[1].y + crops[1].height > 50);
    film_free(&reference);
    film_free(&c.way[0].at_time);
    film_free(&c.way[1].at_time);
}

/* Films that are 0.1% brighter than others of the same numbers, noisier than that by far. */
static void test_common(void)
{
    film exact[2], of[2], nothing[2];
    double noise, none;
    for (unsigned long long i = 0; i < 2; i++) {
        make_noisy(&exact[i], 8, 0.5, 1, 31 + i);
        make_noisy(&of[i], 8, 0.5, 1.001, 31 + i);
        make_noisy(&nothing[i], 8, 0.5, 1, 41 + i);
    }
    TEST_RELATIVE(common_error(of, exact, &noise), 0.001, 0.2); /* beside light that is noisy itself */
    TEST(noise < 3e-4);
    TEST(common_error(nothing, exact, &none) < 2.3 * none); /* the root of 5 */
    TEST(none < 0.1 && none > 0.001);
    for (int i = 0; i < 2; i++) {
        film_free(&exact[i]);
        film_free(&of[i]);
        film_free(&nothing[i]);
    }
}

/* ---- contests ---- */

static const char scene_words[] =
    "film width 40 height 25\n" LIT
    "material floor conductor of gold distribution ggx alpha 0.4\nmaterial lamp light radiance 9 9 9\n"
    "rectangle corner -3 -1 3 edge-u 6 0 0 edge-v 0 0 -6 material floor\n"
    "sphere centre 0 0 0 radius 0.8 material floor\nsphere centre 0 3 2 radius 0.2 material lamp\n";

static int is_same(const film *a, const film *b)
{
    return a->samples == b->samples && memcmp(a->sum, b->sum, 3 * 40 * 25 * sizeof *a->sum) == 0;
}

static void render(film *f, const way *w, uint64_t samples, uint64_t seed)
{
    film_run run = {.samples = samples, .threads = 1, .seed = seed};
    TEST(film_make(f, 40, 25) && film_render(f, w->plan, &run));
}

static void check_way(const contest *c, const way *w)
{
    film alone;
    render(&alone, w, c->samples, c->seed);
    TEST(is_same(&alone, &w->at_samples));
    TEST(w->by_samples.samples == c->samples && w->by_time.samples == w->at_time.samples);
    TEST(w->by_time.seconds >= c->way[0].by_time.seconds);
    TEST(w->by_time.seconds < 2 * c->way[0].by_time.seconds + 0.05); /* a pass takes some 0.02 s at most */
    TEST(w->points > 4 && w->point[0].samples == 1 && w->point[3].samples == 8);
    TEST(w->by_samples.error.relative < 0.6 * w->point[0].error.relative);
    agreement a = agreement_between(&w->at_samples, c->reference);
    TEST(a.blocks == 5 && a.mean_square < 1 + 5 * sqrt(2.0 / 5) && fabs(a.whole) < 5); /* one has no noise */
    film_free(&alone);
}

static void test_contest(void)
{
    static const path_sampler samplers[] = {SAMPLER_VISIBLE, SAMPLER_ALL, SAMPLER_BOUNDED};
    char message[MESSAGE];
    scene s;
    film reference;
    contest c = {.samples = 50, .seed = 3, .threads = 2, .count = 3, .reference = &reference};
    if (!TEST(read_text(&s, scene_words, message)))
        return;
    for (size_t i = 0; i < c.count; i++) {
        c.way[i].scene = &s;
        c.way[i].plan = path_prepare(&s, samplers[i], 0, message, sizeof message);
        TEST(c.way[i].plan != NULL);
    }
    render(&reference, &c.way[0], 400, 77);
    TEST(contest_run(&c));
    for (size_t i = 0; i < c.count; i++)
        check_way(&c, &c.way[i]);
    TEST(is_same(&c.way[0].at_samples, &c.way[0].at_time));
    for (size_t i = 0; i < c.count; i++)
        path_free(c.way[i].plan);
    contest_free(&c);
    film_free(&reference);
    scene_free(&s);
}

int main(void)
{
    test_errors();
    test_agreement();
    test_noise();
    test_ratios();
    test_pictures();
    test_common();
    test_contest();
    return test_done();
}
