/* The chi-squares of test_chi_square.c and test_long_chi_square.c. */
#ifndef TESTS_SAMPLER_CHI_SQUARE_CASE_H
#define TESTS_SAMPLER_CHI_SQUARE_CASE_H

#include "measure/statistics.h"
#include "sampler/seen.h"

/* Roughness, mean slope, angle and azimuth of wi in degrees; alpha_y 0: the same as alpha_x. */
typedef struct chi_square_view {
    seen_kind kind;
    double alpha_x, alpha_y, shear, mean, theta, phi;
} chi_square_view;

static const chi_square_view chi_square_views[] = {
    {SEEN_SURFACE, 0.3, 0, 0, 0, 0, 0},         {SEEN_SURFACE, 0.1, 0.4, 0, 0, 30, 25},
    {SEEN_SURFACE, 1, 0.5, 0, 0, 80, 70},       {SEEN_SURFACE, 1e-3, 0, 0, 0, 60, 200},
    {SEEN_SURFACE, 0.5, 0, 0, 0, 89.99, 10},    {SEEN_SURFACE, 1, 0.7, 0, 0, 100, 45},
    {SEEN_SURFACE, 0.7, 0, 0, 0, 130, 0},       {SEEN_AFFINE, 0.3, 0.1, 0.2, 0.4, 50, 130},
    {SEEN_AFFINE, 0.6, 0.5, 0.5, -0.3, 85, 0},  {SEEN_MIXTURE, 0.4, 0.3, 0.1, 0, 40, 60},
    {SEEN_MIXTURE, 0.5, 0.5, 0.2, 0.3, 80, 10}, {SEEN_MIXTURE, 0.6, 0.6, 0, 0, 95, 30},
};
enum { CHI_SQUARE_VIEWS = sizeof chi_square_views / sizeof *chi_square_views };

/* The second lobe is GGX, half as rough and turned. */
static inline seen chi_square_seen(const vndf_distribution *d, const chi_square_view *v)
{
    float ax = (float)v->alpha_x, ay = (float)(v->alpha_y > 0 ? v->alpha_y : v->alpha_x), mean = (float)v->mean;
    float shear = (float)v->shear;
    vndf_mixture of = {v->kind == SEEN_MIXTURE ? 2 : 1,
                       {{{d, ax, shear, -shear / 2, ay, mean, -mean / 2}, 0.6f},
                        {{vndf_ggx(), ax / 2, -shear, shear, ay, mean, mean}, 0.4f}}};
    return seen_from(v->kind, &of, oracle_direction(v->theta, v->phi));
}

/* Where next to nothing is seen there is nothing to test. */
static inline int chi_square_sees(const seen *s)
{
    return seen_area(s, s->wi) > 1e-6f;
}

static inline void chi_square_one(const subject *of, size_t view, size_t samples, double level)
{
    seen s = chi_square_seen(of->d, &chi_square_views[view]);
    slope_frame frame = seen_frame(&s);
    if (!chi_square_sees(&s))
        return;
    slope_test found = slope_chi_square(&frame, seen_draw, seen_density, &s, samples, 1000 + view);
    int good = TEST(found.p > level) & TEST(found.unseen == 0) &
               TEST(fabs(found.mass - 1) < (of->shape.breaks[0] > 0 ? 2e-3 : 1e-4));
    if (!good) {
        seen_print(&s, of->name);
        fprintf(stderr, "    view %lu: p %.3g of %lu classes, integral %.7f, %lu without a density\n",
                (unsigned long)view, found.p, (unsigned long)found.classes, found.mass,
                (unsigned long)found.unseen);
    }
}

/* Of each subject every `stride`-th view, another one first for each. */
static inline int chi_square_main(int arguments, char **argument, size_t samples, size_t stride)
{
    double level = statistics_sidak(0.01, SUBJECT_COUNT * CHI_SQUARE_VIEWS);
    for (size_t i = 0; i < SUBJECT_COUNT; i++) {
        subject s = subject_open(i);
        for (size_t view = i % stride; s.d && view < CHI_SQUARE_VIEWS; view += stride)
            if (oracle_wanted(arguments, argument, i, s.name))
                chi_square_one(&s, view, samples, level);
        vndf_free(s.owned);
    }
    return test_done();
}

#endif
