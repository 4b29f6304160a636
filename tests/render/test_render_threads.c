/* A picture is the same to the bit for any number of threads, and but for rounding for samples taken in several runs;
 * another seed gives another. Notices random numbers that depend on the thread or the pass, and sums in the order
 * of arrival. */
#include "render_case.h"

static void render(film *f, const scene *s, const path_plan *plan, unsigned threads, int runs)
{
    TEST(film_make(f, s->width, s->height));
    for (int i = 0; i < runs; i++) {
        const film_run run = {.samples = 12 / (uint64_t)runs, .threads = threads, .seed = 3};
        TEST(film_render(f, plan, &run));
    }
}

int main(void)
{
    char message[512];
    scene *s =
        case_scene("film width 96 height 61\ncamera from 0 0 5 to 0 0 0 field 30\nenvironment constant 1 0.5 0.2\n"
                   "material gold conductor of gold distribution ggx alpha 0.3\n"
                   "material glass dielectric index 1.5 distribution beckmann alpha 0.2 scattering multiple\n"
                   "material lamp light radiance 9 9 9\nsphere centre 2 3 1 radius 0.4 material lamp\n"
                   "sphere centre -0.7 0 0 radius 0.7 material gold\n"
                   "sphere centre 0.7 0 0 radius 0.7 material glass\n");
    path_plan *plan = s ? path_prepare(s, SAMPLER_VISIBLE, message, sizeof message) : NULL;
    static const unsigned threads[] = {2, 3, 16};
    film one, other;
    double worst = 0;
    if (!TEST(plan != NULL))
        return test_done();
    render(&one, s, plan, 1, 1);
    for (int i = 0; i < 3; i++) {
        render(&other, s, plan, threads[i], 1);
        TEST(memcmp(one.sum, other.sum, 3 * film_pixels(&one) * sizeof *one.sum) == 0);
        TEST(other.counts.segments == one.counts.segments && other.counts.shadow_rays == one.counts.shadow_rays);
        film_free(&other);
    }
    render(&other, s, plan, 2, 3);
    for (size_t i = 0; i < 3 * film_pixels(&one); i++)
        worst = fmax(worst, fabs(other.sum[i] - one.sum[i]));
    TEST(worst < 1e-12);
    film_free(&other);
    other = (film){.sum = NULL};
    case_render(&other, s, SAMPLER_VISIBLE, 12, 4);
    TEST(memcmp(one.sum, other.sum, 3 * film_pixels(&one) * sizeof *one.sum) != 0);
    film_free(&other);
    film_free(&one);
    path_free(plan);
    scene_free(s);
    return test_done();
}
