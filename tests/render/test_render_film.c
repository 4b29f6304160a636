/* A comparison calls pictures the same that differ by chance, and different where a difference is planted: light
 * that is 1% more, half of a block that is 15% darker. Of too few samples it says that it does not know. Its figures
 * are right for ways whose ratio is known: twice the samples halve the squared noise. Ways have random numbers of
 * their own, the same in whatever passes; a slow one gets fewer samples in the same time. Notices a variance that is
 * off by a factor, blocks that are left out, alarms about nothing, and random numbers that depend on the pass. */
#include "harness/test.h"
#include "render/film.h"

enum { WIDTH = 96, HEIGHT = 64, CORNER_X = 88, CORNER_Y = 48 };

/* A film of samples between 0 and 2, times `light`, in a corner times `corner`. */
static film noise(double light, double corner, uint64_t samples, unsigned long long seed)
{
    static double sums[2][3 * WIDTH * HEIGHT], squares[2][WIDTH * HEIGHT];
    film f = {
        WIDTH, HEIGHT, sums[seed % 2], squares[seed % 2], .samples = samples, .processor = (double)(2 + seed % 2)};
    unsigned long long state = seed + 1;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int is_corner = i % WIDTH >= CORNER_X && i / WIDTH >= CORNER_Y;
        double sum = 0, square = 0;
        for (uint64_t k = 0; k < samples; k++) {
            const double x = 2 * test_uniform_double(&state) * light * (is_corner ? corner : 1);
            sum += x;
            square += x * x;
        }
        f.sum[3 * i] = f.sum[3 * i + 1] = f.sum[3 * i + 2] = sum;
        f.square[i] = square;
    }
    return f;
}

static void find(double light, double corner, const uint64_t samples[2], unsigned seed, finding found[SAMPLERS])
{
    const comparison c = {.count = 2,
                          .way = {{.film = noise(1, 1, samples[0], 2 * seed)},
                                  {.film = noise(light, corner, samples[1], 2 * seed + 1)}}};
    comparison_find(&c, found);
}

static void test_verdict(double light, double corner, uint64_t samples, verdict want)
{
    for (unsigned seed = 1; seed <= 4; seed++) {
        finding found[SAMPLERS], *f = &found[1];
        find(light, corner, (const uint64_t[2]){samples, samples}, seed, found);
        if (!TEST(f->is == want))
            fprintf(stderr, "    light %g, corner %g: %g, worst %g at (%d, %d), mean square %g\n", light, corner,
                    f->whole, f->worst, f->x, f->y, f->mean_square);
        TEST(corner == 1 || (f->x == 80 && f->y == 48)); /* its block */
        TEST(want != VERDICT_UNKNOWN || (isnan(f->whole) && isnan(f->worst) && isfinite(f->ratio)));
    }
}

static void test_figures(void)
{
    finding found[SAMPLERS], *first = &found[0], *f = &found[1];
    find(1, 1, (const uint64_t[2]){64, 128}, 1, found);
    const double ratio = f->noise.value / first->noise.value;
    TEST_RELATIVE(first->noise.value, 1 / (3 * 64 * (1 + 0.05 * 0.05)), 0.02); /* less the noise of neighbours */
    TEST_NEAR(ratio, 0.5, 0.01);
    TEST(first->noise.spread > 0 && first->noise.spread < 0.01 * first->noise.value);
    TEST_RELATIVE(f->samples.value, 2 * ratio, 1e-12);
    TEST_RELATIVE(f->efficiency.value, 2 / (3 * ratio), 1e-12);
    TEST(first->samples.value == 1 && first->samples.spread == 0 && f->samples.spread > 0);
}

static void test_run(void)
{
    static const char text[] = "camera --from 0,0,8 --to 0,0,0 --field 18 --width 96 --height 64\n"
                               "environment --constant 0.2,0.2,0.2\nmaterial lamp --light 9,9,9\n"
                               "material gold --conductor gold --distribution ggx --alpha 0.2\n"
                               "sphere --centre 2,4,4 --radius 0.3 --material lamp\n"
                               "sphere --centre 0,0,0 --radius 1.2 --material gold\n";
    scene *s = scene_read("x.scene", strcpy(malloc(sizeof text), text), sizeof text - 1, 0);
    comparison c = {.count = 3, .samples = 96, .threads = 2, .has_equal_time = 1};
    comparison once = {.count = 1, .samples = 7, .threads = 1};
    const film *one = &c.way[0].film, *other = &c.way[1].film, *slow = &c.way[2].film;
    c.way[2].sampler = SAMPLER_PERFECT;
    if (!TEST(s && comparison_begin(&once, s) && comparison_run(&once)))
        return;
    once.samples = 96; /* in other passes */
    TEST(comparison_run(&once) && comparison_begin(&c, s) && comparison_run(&c) && one->samples == 96);
    TEST(slow->samples < 64 && slow->processor >= one->processor && other->processor >= one->processor);
    TEST(memcmp(one->square, once.way[0].film.square, film_pixels(one) * sizeof(double)) == 0);
    TEST(memcmp(one->square, other->square, film_pixels(one) * sizeof(double)) != 0);
    comparison_end(&once);
    comparison_end(&c);
    scene_free(s);
}

int main(void)
{
    test_verdict(1, 1, 64, VERDICT_SAME);
    test_verdict(1.01, 1, 64, VERDICT_DIFFERS);
    test_verdict(1, 0.85, 64, VERDICT_DIFFERS);
    test_verdict(2, 1, 4, VERDICT_UNKNOWN);
    test_figures();
    test_run();
    return test_done();
}
