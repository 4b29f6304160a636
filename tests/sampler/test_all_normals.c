/* All normals and V-cavity normals are drawn as they say: unit, above the horizon, never NaN, with the density
 * that belongs to the normal within 1e-5; that density integrates to 1 within 1e-5, is D cos(theta_m) (times 2
 * f/(f + f') for V-cavities, which is D G1 f/cos_i) and passes chi-square at level 0.01 for all tests together;
 * and the azimuth of V-cavities solves its equation within 3e-7, whatever wi sees.
 *
 * Arguments: nothing, or the number of one part (main). */
#include <stdlib.h>

#include "oracle/oracle.h"
#include "sampler/all_normals/all_normals.h"
#include "sampler/surface.h"
#include "sampler/all_normals/v_cavity.h"
#include "measure/statistics.h"
#include "harness/constants.h"
#include "harness/test.h"
#include "statistics/grid.h"

/* ---- subjects ---- */

typedef struct subject {
    const char *name;
    const vndf_distribution *d;
    vndf_distribution *owned;
} subject;

enum { SUBJECTS = 6 };

static subject subject_at(int i)
{
    static const char *const tables[] = {"student-t-2.5", "student-t-1.8", "hazy", "student-t-2.5-small"};
    subject s = {i == 0 ? "ggx" : "beckmann", i == 0 ? vndf_ggx() : vndf_beckmann(), NULL};
    if (i < 2)
        return s;
    s.name = tables[i - 2];
    s.d = s.owned = oracle_shipped(s.name);
    TEST(s.d != NULL);
    return s;
}

/* Either law: wi is not read unless `cavity`. */
typedef struct law {
    const vndf_distribution *d;
    double ax, ay;
    vndf_vec3 wi;
    int cavity;
} law;

static law law_of(const subject *s, float alpha_x, float alpha_y, vndf_vec3 wi, int cavity)
{
    vndf_surface surface = {s->d, alpha_x, alpha_y};
    law l = {s->d, 0, 0, wi, cavity};
    TEST(vndf_surface_scaled(&surface, &l.ax, &l.ay));
    return l;
}

static vndf_vec3 draw(const law *l, float u1, float u2, float *pdf)
{
    return l->cavity ? vndf_sample_v_cavity(l->d, l->ax, l->ay, l->wi, u1, u2, pdf)
                     : vndf_sample_all(l->d, l->ax, l->ay, u1, u2, pdf);
}

static double density(const law *l, vndf_normal wm)
{
    return l->cavity ? vndf_pdf_v_cavity(l->d, l->ax, l->ay, l->wi, wm) : vndf_pdf_all(l->d, l->ax, l->ay, wm);
}

/* ---- every sample ---- */

static double worst_density, worst_length;

static void check_sample(const law *l, const char *name, float u1, float u2)
{
    float pdf;
    vndf_vec3 wm = draw(l, u1, u2, &pdf);
    double x = wm.x, y = wm.y, z = wm.z, length = fabs(sqrt(x * x + y * y + z * z) - 1);
    double facing = (double)l->wi.x * x + (double)l->wi.y * y + (double)l->wi.z * z;
    double exact = density(l, vndf_normal_of(wm)),
           error = fabs((double)pdf / fmin(fmax(exact, FLT_MIN), FLT_MAX) - 1);
    int good =
        TEST(length < 4 * 0x1p-23) & TEST(wm.z > 0) & TEST(pdf >= FLT_MIN && pdf <= FLT_MAX) & TEST(error < 1e-5);
    if (l->cavity && l->wi.z > 0)
        good &= TEST(facing > 0);
    if (!good)
        fprintf(stderr,
                "  %s, alpha %g %g, wi %.9g %.9g %.9g, u %.9g %.9g: %.9g %.9g %.9g density %.9g, exact %.9g\n",
                name, l->ax, l->ay, (double)l->wi.x, (double)l->wi.y, (double)l->wi.z, (double)u1, (double)u2, x,
                y, z, (double)pdf, exact);
    worst_density = fmax(worst_density, error);
    worst_length = fmax(worst_length, length);
}

static void check_all_samples(const law *l, const char *name, unsigned long long seed)
{
    const float edge[] = {0, 0x1p-30f, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f, 1, -1, 2, (float)NAN};
    const size_t edges = sizeof edge / sizeof edge[0];
    unsigned long long state = seed;
    int random = (int)test_amount(100, 200, 500);
    for (size_t i = 0; i < edges; i++)
        for (size_t j = 0; j < edges; j++)
            check_sample(l, name, edge[i], edge[j]);
    for (size_t i = 0; i < edges; i++)
        for (int j = 0; j < random / 10; j++) {
            check_sample(l, name, edge[i], test_uniform(&state));
            check_sample(l, name, test_uniform(&state), edge[i]);
        }
    for (int i = 0; i < random; i++) {
        float u1 = test_uniform(&state), u2 = test_uniform(&state);
        check_sample(l, name, u1, u2);
        check_sample(l, name, u1, 1 - u2 * u2 * u2 * u2); /* tails */
    }
}

static const vndf_vec3 DIRECTIONS[] = {
    {0, 0, 1},      {1e-4f, 0, 1},        {0.6f, 0, 0.8f}, {-0.48f, 0.64f, 0.6f}, {0.8f, -0.6f, 0.01f},
    {-1, 0, 1e-6f}, {0.6f, 0.8f, 1e-20f}, {1, 0, 0}};
enum { DIRECTION_COUNT = sizeof DIRECTIONS / sizeof DIRECTIONS[0] };

static void test_samples(void)
{
    const float alphas[] = {1e-17f, 1e-6f, 1e-3f, 0.1f, 1, 10, 1e16f};
    for (int i = 0; i < SUBJECTS; i++) {
        subject s = subject_at(i);
        worst_density = worst_length = 0;
        for (size_t j = 0; s.d && j < 7; j++)
            for (size_t k = 0; k < 7; k++)
                for (size_t w = 0; w <= DIRECTION_COUNT; w++) {
                    law l = law_of(&s, alphas[j], alphas[k], DIRECTIONS[w % DIRECTION_COUNT], w < DIRECTION_COUNT);
                    check_all_samples(&l, s.name, 1 + j + 10 * k + 100 * w);
                }
        fprintf(stderr, "%s: density within %.2g, length within %.2g\n", s.name, worst_density, worst_length);
        vndf_free(s.owned);
    }
}

/* ---- integrals over the hemisphere ---- */

/* Gauss's rule of five. */
static const double NODE[] = {0, 0.538469310105683091, -0.538469310105683091, 0.906179845938663993,
                              -0.906179845938663993};
static const double WEIGHT[] = {0.568888888888888889, 0.478628670499366468, 0.478628670499366468,
                                0.236926885056189088, 0.236926885056189088};

/* Density times steradians per dx da at slope length X/(1 - X) and azimuth a of the stretched hemisphere: dR =
 * dx/Z^2, so dwm = ax ay X/length^3 dx da. */
static double stretched_density(const law *l, double x, double a)
{
    double lx = l->ax * x * cos(a), ly = l->ay * x * sin(a), z = 1 - x, length = sqrt(lx * lx + ly * ly + z * z);
    vndf_normal wm = {lx / length, ly / length, z / length};
    return density(l, wm) * (l->ax / length) * (l->ay / length) * (x / length);
}

/* Over [x0, x1] times [a0, a1] by Gauss's rule. */
static double integrate_cell(const law *l, double x0, double x1, double a0, double a1)
{
    double sum = 0, h = 0.5 * (x1 - x0), k = 0.5 * (a1 - a0);
    for (int i = 0; i < 25; i++)
        sum += WEIGHT[i % 5] * WEIGHT[i / 5] * h * k *
               stretched_density(l, x0 + h * (1 + NODE[i % 5]), a0 + k * (1 + NODE[i / 5]));
    return sum;
}

/* Knots of a table, where the density has kinks; even ones for the closed forms. */
static double knot_at(const law *l, uint32_t i, uint32_t count)
{
    return vndf_is_table(l->d) ? (double)l->d->knots.at[i].x / ((double)l->d->knots.at[i].x + l->d->knots.at[i].z)
                               : (double)i / count;
}

static double integral(const law *l, uint32_t turns)
{
    uint32_t count = vndf_is_table(l->d) ? l->d->radial_count : 100;
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < turns; j++)
            sum += integrate_cell(l, knot_at(l, i, count), knot_at(l, i + 1, count), 2 * PI * j / turns,
                                  2 * PI * (j + 1) / turns);
    return sum;
}

static void test_integrals(void)
{
    const float alphas[][2] = {{1e-6f, 1e-6f}, {0.3f, 0.3f}, {0.05f, 0.8f}, {10, 2}};
    double worst = 0, worst_cavity = 0;
    for (int i = 0; i < SUBJECTS; i++) {
        subject s = subject_at(i);
        for (size_t j = 0; s.d && j < 4; j++) {
            law all = law_of(&s, alphas[j][0], alphas[j][1], DIRECTIONS[0], 0);
            double one = integral(&all, 8);
            TEST_NEAR(one, 1, 1e-5);
            worst = fmax(worst, fabs(one - 1));
            for (size_t w = j % 2; w < DIRECTION_COUNT; w += 2) {
                law cavity = law_of(&s, alphas[j][0], alphas[j][1], DIRECTIONS[w], 1);
                one = integral(&cavity,
                               8); /* twins are both on the grid: kinks of one are made up for by the other */
                TEST_NEAR(one, 1, 1e-5);
                worst_cavity = fmax(worst_cavity, fabs(one - 1));
            }
        }
        vndf_free(s.owned);
    }
    fprintf(stderr, "integral 1 within %.2g, of V-cavities within %.2g\n", worst, worst_cavity);
}

/* ---- against what they should be ---- */

/* For the closed forms the densities are the ones of the literature, for tables near them. All normals are the
 * visible ones at normal incidence. */
static void test_definitions(void)
{
    unsigned long long state = 7;
    for (int i = 0; i < SUBJECTS; i++) {
        subject s = subject_at(i);
        double most = 0, least = 1e30;
        vndf_surface surface = {s.d, 0.2f, 0.5f};
        vndf_vec3 up = {0, 0, 1}, wi = {0.36f, 0.48f, 0.8f};
        vndf_view view = vndf_view_from(&surface, up);
        law all = law_of(&s, 0.2f, 0.5f, up, 0), cavity = law_of(&s, 0.2f, 0.5f, wi, 1);
        for (int j = 0; s.d && j < 100000; j++) {
            vndf_vec3 wm = vndf_sample_all(s.d, all.ax, all.ay, test_uniform(&state), test_uniform(&state), NULL);
            vndf_normal n = vndf_normal_of(wm);
            double f = (double)wi.x * n.x + (double)wi.y * n.y + (double)wi.z * n.z, drawn = density(&all, n);
            double g1 = fmin(1, 2 * n.z * (double)wi.z / f), ratio = (double)vndf_ndf(&surface, wm) * n.z / drawn;
            TEST_RELATIVE(density(&cavity, n), f > 0 ? drawn * g1 * f / (n.z * (double)wi.z) : 0, 1e-5);
            if (i < 2)
                TEST_RELATIVE((double)vndf_pdf(&view, wm), drawn, 1e-6);
            most = fmax(most, ratio);
            least = fmin(least, ratio);
        }
        fprintf(stderr, "%s: D cos/density of 100000 samples from %.6g to %.6g\n", s.name, least, most);
        TEST(i < 2 ? most < 1 + 1e-6 && least > 1 - 1e-6 : most < (i == 5 ? 1.5 : 1.2) && least > 0.5);
        vndf_free(s.owned);
    }
}

/* ---- chi-square ---- */

static void place(const law *l, vndf_vec3 wm, double *x, double *a)
{
    double lx = wm.x / l->ax, ly = wm.y / l->ay, r = sqrt(lx * lx + ly * ly);
    *x = r / (r + wm.z);
    *a = atan2(ly, lx);
}

static double placed_density(double x, double a, const void *of)
{
    return stretched_density(of, x, a);
}

static double chi_square_of(const law *l, size_t samples, unsigned long long seed)
{
    enum { RADII = 40, AZIMUTHS = 48, PILOT = 20 * RADII };
    static grid g;
    unsigned long long state = 11;
    double pilot[PILOT], x, a;
    grid_even(&g, RADII, 0, 1, AZIMUTHS, -PI, PI);
    for (int i = 0; i < PILOT; i++)
        place(l, draw(l, test_uniform(&state), test_uniform(&state), NULL), &pilot[i], &a);
    grid_quantiles(g.x, RADII, pilot, PILOT);
    grid_expect(&g, placed_density, l, (double)samples, 1e-7);
    for (size_t i = 0; i < samples; i++) {
        place(l, draw(l, test_uniform(&seed), test_uniform(&seed), NULL), &x, &a);
        g.observed[grid_bin(&g, x, a)] += 1;
    }
    pearson found = grid_test(&g);
    return found.classes > 100 ? found.p : 0;
}

static void test_chi_square(void)
{
    const float alphas[][2] = {{0.3f, 0.3f}, {1e-4f, 0.1f}, {2, 0.5f}};
    const size_t tests = SUBJECTS * 3 * 4, samples = test_amount(100000, 200000, 500000);
    double level = statistics_sidak(0.01, tests), least = 1;
    for (int i = 0; i < SUBJECTS; i++) {
        subject s = subject_at(i);
        for (int j = 0; s.d && j < 3; j++)
            for (int w = 0; w < 4; w++) {
                law l = law_of(&s, alphas[j][0], alphas[j][1], DIRECTIONS[w == 0 ? 0 : 1 + w + j % 2], w > 0);
                double p = chi_square_of(&l, samples, 1000 + 100 * (unsigned)i + 10 * (unsigned)j + (unsigned)w);
                if (!TEST(p > level))
                    fprintf(stderr, "  %s, setting %d, direction %d: p = %.3g\n", s.name, j, w, p);
                least = fmin(least, p);
            }
        vndf_free(s.owned);
    }
    fprintf(stderr, "least p of %zu: %.2g (level %.2g)\n", tests, least, level);
}

/* ---- the azimuth of V-cavities ---- */

/* Mass of half a turn beyond w = a/pi, from the density's integral, in double. */
static double mass_beyond(double t, double w)
{
    double h = t > 1 ? asin(1 / t) / PI : 0.5;
    if (w < 0.5 - h)
        return 2 * h + 2 * (0.5 - h - w);
    if (w > 0.5 + h)
        return 0;
    double g = 0.5 + h - w;
    return g - 2 * t / PI * sin(PI * g / 2) * sin(PI * (h - g / 2));
}

static void test_azimuth(void)
{
    enum { STEPS = 2000 };
    const double ratios[] = {0,        1e-20,  1e-3, 0.1, 0.5, 0.9, 0.99, 0.9999, 1 - 1e-6, 1,
                             1 + 1e-6, 1.0001, 1.01, 1.1, 2,   10,  1e3,  1e6,    1e14,     1e30};
    double worst = 0;
    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++) {
        vndf_v_cavity twin = vndf_v_cavity_from(1, (float)ratios[i]);
        float last = 2;
        for (int j = 0; j <= 2 * STEPS; j++) {
            double even = (double)(j % (STEPS + 1)) / STEPS;
            float rest = (float)(j <= STEPS ? even : 2 * even * even * even * fmin(0.5, (double)twin.h));
            float w = vndf_v_cavity_draw(&twin, rest);
            worst = fmax(worst, fabs(mass_beyond(twin.factor, w) - (double)rest));
            TEST(w >= 0 && w <= 1);
            if (j <= STEPS) /* monotone but for roundings */
                TEST(w <= last + 2e-6f);
            last = j == STEPS ? 2 : w;
        }
    }
    fprintf(stderr, "mass beyond the azimuth of V-cavities within %.2g\n", worst);
    TEST(worst < 3e-7);
}

int main(int arguments, char **argument)
{
    void (*const parts[])(void) = {test_samples, test_integrals, test_definitions, test_chi_square, test_azimuth};
    for (size_t i = 0; i < 5; i++)
        if (arguments < 2 || atoi(argument[1]) == (int)i)
            parts[i]();
    return test_done();
}
