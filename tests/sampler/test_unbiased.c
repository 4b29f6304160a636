/* Estimators are unbiased for the D that was given, however coarse the table: the density integrates to 1 and is
 * positive wherever the true one is; the mean of g(wm) times true density over the density returned is the
 * quadrature of g over the true visible normals; with the weight of vndf_sample_weight it is that of the table's own D,
 * which is near. It notices a factor in a density that chi-square cannot see, a hole, and a wrong weight. */
#include <float.h>

#include "oracle/oracle_surface.h"
#include "sampler/seen.h"

enum { FUNCTIONS = 5, SETTINGS = 12 };

typedef struct setting {
    double alpha_x, alpha_y, theta, phi;
} setting;

static const setting settings[SETTINGS] = {{0.3, 0.3, 0, 0},     {1, 1, 45, 0},     {0.05, 0.8, 60, 30},
                                           {0.02, 0.02, 75, 10}, {2, 0.1, 85, 140}, {0.6, 0.6, 89.9, 0},
                                           {0.5, 0.25, 90, 45},  {1, 1, 90.5, 0},   {0.7, 1.4, 96, 77},
                                           {1.5, 1.5, 110, 0},   {1, 1, 135, 20},   {5, 5, 150, 0}};

/* The true visible normals, times one of the functions. */
typedef struct truth {
    oracle_surface surface;
    double wi[3], area;
    int function;
} truth;

static double function_at(int i, const truth *t, const double wm[3])
{
    double facing = t->wi[0] * wm[0] + t->wi[1] * wm[1] + t->wi[2] * wm[2];
    const double values[FUNCTIONS] = {1, wm[2], wm[0], wm[1] * wm[1], facing};
    return values[i];
}

static double true_density(const truth *t, const double wm[3])
{
    double facing = t->wi[0] * wm[0] + t->wi[1] * wm[1] + t->wi[2] * wm[2];
    return facing > 0 ? facing * oracle_surface_ndf(&t->surface, wm) / t->area : 0;
}

static double integrand(const double wm[3], const void *of)
{
    const truth *t = of;
    return true_density(t, wm) * function_at(t->function, t, wm);
}

typedef struct average {
    double sum, squares;
} average;

static void add_to(average *a, double value)
{
    a->sum += value;
    a->squares += value * value;
}

/* How far the mean is from 0, beyond five standard errors and ten samples, since what is rare may not be met; the
 * values are differences from what is expected. */
static double beyond(const average *a, double n)
{
    double mean = a->sum / n;
    return fabs(mean) - 5 * sqrt(fmax(0, a->squares / n - mean * mean) / n) - 10 / n;
}

static void test_means(const seen *s, truth *t, const double expected[FUNCTIONS], const subject *of,
                       size_t samples)
{
    average plain[FUNCTIONS] = {{0, 0}}, weighted[FUNCTIONS] = {{0, 0}};
    unsigned long long state = 77;
    double near = of->shape.rough ? 3e-2 : 2e-3;
    for (size_t i = 0; i < samples; i++) {
        float pdf, weight, u1 = test_uniform(&state), u2 = test_uniform(&state);
        vndf_vec3 w = vndf_sample_weight(&s->view, u1, u2, &pdf, &weight);
        const double wm[3] = {(double)w.x, (double)w.y, (double)w.z};
        double ratio = true_density(t, wm) / (double)pdf;
        for (int j = 0; j < FUNCTIONS; j++) {
            add_to(&plain[j], ratio * function_at(j, t, wm) - expected[j]);
            add_to(&weighted[j], (double)weight * function_at(j, t, wm) - expected[j]);
        }
    }
    for (int j = 0; j < FUNCTIONS; j++)
        if (!(TEST(beyond(&plain[j], (double)samples) < 0) & TEST(beyond(&weighted[j], (double)samples) < near)))
            fprintf(stderr, "    function %d: %.7g, off by %.3g, and with the weight by %.3g\n", j, expected[j],
                    plain[j].sum / (double)samples, weighted[j].sum / (double)samples);
}

/* Wherever the truth is a number that floats can tell from 0, in the shape's own tails too. */
static int is_positive(const seen *s, const truth *t)
{
    unsigned long long state = 5;
    for (int i = 0; i < 3000; i++) {
        double r = random_decade(&state, -4, 4), a = random_between(&state, -PI, PI);
        double x = t->surface.xx * r * cos(a), y = t->surface.yy * r * sin(a), z = 1 / sqrt(1 + x * x + y * y);
        const double wm[3] = {(double)(float)(x * z), (double)(float)(y * z), (double)(float)z};
        if (true_density(t, wm) > 1e-30 && !(seen_pdf(s, vec3_of(wm)) >= FLT_MIN))
            return 0;
    }
    return 1;
}

static void test_setting(const subject *of, const setting *at, size_t samples)
{
    float ax = (float)at->alpha_x, ay = (float)at->alpha_y;
    vndf_vec3 wi = oracle_direction(at->theta, at->phi);
    const vndf_affine shape = seen_straight(of->d, ax, ay);
    const oracle_slopes slopes = {ORACLE_KIND_FORMULA, NULL, &of->shape};
    seen s = seen_surface(of->d, ax, ay, wi);
    truth t = {oracle_surface_from(slopes, &shape), {(double)wi.x, (double)wi.y, (double)wi.z}, 0, 0};
    slope_frame frame = slope_frame_from(&shape, wi, 0);
    double expected[FUNCTIONS], error = of->shape.breaks[0] > 0 ? 2e-3 : 1e-4;
    int failures = test_failures;
    t.area = oracle_surface_area(&t.surface, t.wi);
    if (!(t.area > 1e-6))
        return;
    for (t.function = 0; t.function < FUNCTIONS; t.function++)
        expected[t.function] = slope_integral(&frame, integrand, &t);
    TEST_NEAR(expected[0], 1, 1e-6); /* or the test itself is wrong */
    TEST_NEAR(slope_integral(&frame, seen_density, &s), 1, error);
    TEST(is_positive(&s, &t));
    test_means(&s, &t, expected, of, samples);
    if (test_failures > failures)
        seen_print(&s, of->name);
}

static void test_subject(const subject *of, size_t index)
{
    for (size_t j = index % 2; j < SETTINGS; j += test_long() ? 1 : 2)
        test_setting(of, &settings[j], test_amount(10000, 50000, 200000));
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
