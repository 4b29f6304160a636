/* Samples follow the density that vndf_pdf states, and that density has the integral 1 and is positive wherever that
 * of the D that was given is: estimators are unbiased for it, however coarse the table. For closed forms and tables,
 * smooth roughness and rough, anisotropic, sheared and leaning surfaces and mixtures, from straight above to below the
 * horizon. It notices a cell, an arc or a lobe that is drawn too often, a density that is not the one drawn, and a
 * hole. Seeds are fixed; the level, 0.01, is that of all tests together. test_chi_square SUBJECT SAMPLES: all views of
 * one. */
#include <float.h>

#include "sampler/seen.h"

/* Roughness, mean slope, angle and azimuth of wi in degrees; alpha_y 0: the same as alpha_x. */
typedef struct setting {
    seen_kind kind;
    double alpha_x, alpha_y, shear, mean, theta, phi;
} setting;

static const setting views[] = {
    {SEEN_SURFACE, 0.3, 0, 0, 0, 0, 0},         {SEEN_SURFACE, 0.1, 0.4, 0, 0, 30, 25},
    {SEEN_SURFACE, 1, 0.5, 0, 0, 80, 70},       {SEEN_SURFACE, 1e-3, 0, 0, 0, 60, 200},
    {SEEN_SURFACE, 0.5, 0, 0, 0, 89.99, 10},    {SEEN_SURFACE, 1, 0.7, 0, 0, 100, 45},
    {SEEN_SURFACE, 0.7, 0, 0, 0, 130, 0},       {SEEN_SURFACE, 0.3, 0.1, 0.2, 0.4, 50, 130},
    {SEEN_SURFACE, 0.6, 0.5, 0.5, -0.3, 85, 0}, {SEEN_MIXTURE, 0.4, 0.3, 0.1, 0, 40, 60},
    {SEEN_MIXTURE, 0.5, 0.5, 0.2, 0.3, 80, 10}, {SEEN_MIXTURE, 0.6, 0.6, 0, 0, 95, 30},
};
enum { VIEWS = sizeof views / sizeof *views };

/* The second lobe is GGX, half as rough and turned. */
static seen view_of(const vndf_distribution *d, const setting *v)
{
    float ax = (float)v->alpha_x, ay = (float)(v->alpha_y > 0 ? v->alpha_y : v->alpha_x), mean = (float)v->mean;
    float shear = (float)v->shear;
    vndf_mixture of = {v->kind == SEEN_MIXTURE ? 2 : 1,
                       {{{d, ax, shear, -shear / 2, ay, mean, -mean / 2}, 0.6f},
                        {{vndf_ggx(), ax / 2, -shear, shear, ay, mean, mean}, 0.4f}}};
    return seen_from(v->kind, &of, oracle_direction(v->theta, v->phi));
}

/* Wherever the visible density of the formula is a number that floats can tell from 0, in its own tails too. */
static int is_positive(const seen *s, const oracle *shape)
{
    const vndf_surface *a = &s->of.lobe[0].surface;
    const oracle_surface truth = oracle_surface_from(shape, a);
    unsigned long long state = 5;
    for (int i = 0; i < 3000; i++) {
        double r = random_decade(&state, -4, 4), t = random_between(&state, -PI, PI);
        double x = a->xx * r * cos(t), y = a->yy * r * sin(t), z = 1 / sqrt(1 + x * x + y * y);
        const double at[3] = {x * z, y * z, z};
        const vndf_vec3 wm = vec3_of(at);
        const double rounded[3] = {(double)wm.x, (double)wm.y, (double)wm.z};
        double seen_of_it = dot_of(s->wi, wm) * oracle_surface_ndf(&truth, rounded);
        if (seen_of_it > 1e-30 && !(seen_pdf(s, wm) >= FLT_MIN))
            return 0;
    }
    return 1;
}

static size_t samples, stride; /* of each subject every `stride`-th view, another one first for each */

static void test_subject(const subject *of, size_t index)
{
    const double level = statistics_sidak(0.01, SUBJECT_COUNT * VIEWS),
                 off = of->shape.shape == ORACLE_DISC ? 2e-3 : 1e-4;
    for (size_t view = index % stride; view < VIEWS; view += stride) {
        seen s = view_of(of->d, &views[view]);
        if (seen_quantity(&s, AREA, s.wi) <= 1e-6f) /* next to nothing is seen */
            continue;
        const bins_sampler judged = {bins_frame_of(&s.of.lobe[0].surface, s.wi), seen_draw, seen_pdf, &s};
        bins_result of_all = bins_chi_square(&judged, samples, 1000 + view);
        if (TEST(of_all.found.p > level) & TEST(of_all.found.classes > 50) & TEST(of_all.unseen == 0) &
            TEST(fabs(of_all.mass - 1) < off) & TEST(views[view].shear > 0 || is_positive(&s, &of->shape)))
            continue;
        seen_print(&s, of->name);
        fprintf(stderr, "    view %lu: p %.3g of %lu classes, integral %.7f, %lu without a density\n",
                (unsigned long)view, of_all.found.p, (unsigned long)of_all.found.classes, of_all.mass,
                (unsigned long)of_all.unseen);
    }
}

int main(int arguments, char **argument)
{
    samples = arguments > 2 ? strtoul(argument[2], NULL, 10) : test_amount(20000, 100000, 1000000);
    stride = arguments > 2 ? 1 : test_amount(2, 2, 1);
    return subjects_test(arguments, argument, test_subject);
}
