/* Bounded normals are drawn as sampler.h says: unit, not below the surface, facing wi, with a density that is that of
 * the normal returned, has the integral 1 and passes chi-square; those of closed forms have the means of visible ones
 * that reflect wi to above the horizon, and no table of round roughness loses one; the weight is the visible density
 * over the one drawn. It notices a bound or a factor that is wrong. (All normals and those of V-cavities, as materials
 * draw them: bsdf_values, bsdf_chi_square.) */
#include <float.h>

#include "evidence/measure/statistics.h"
#include "sampler/sampler.h"
#include "sampler/seen.h"

enum { SETTINGS = 4 };

static vndf_vec3 draw_slope(const void *of, float u1, float u2, float *pdf)
{
    vndf_drawn_normal n = vndf_sample_bounded(of, u1, u2);
    *pdf = n.density;
    return n.wm;
}

static double density_at(const double wm[3], const void *of)
{
    return (double)vndf_pdf_bounded(of, vec3_of(wm));
}

/* How far wo is above the horizon. */
static double rise(const vndf_view *view, vndf_vec3 wm)
{
    return 2 * dot_of(view->wi, wm) * wm.z - (double)view->wi.z;
}

/* `round`: of a table with round roughness, whose arcs end within some 1e-5 of the border. */
static int is_good(const vndf_view *view, vndf_drawn_normal n, int round, int edge)
{
    double visible = (double)vndf_visible(view, n.wm), weighed = (double)n.weight * (double)n.density;
    return TEST(fabs(length_of(n.wm) - 1) <= 4 * 0x1p-23 && n.wm.z >= 0) & TEST(dot_of(view->wi, n.wm) > 0) &
           TEST(n.density >= FLT_MIN && n.density <= FLT_MAX && n.weight >= 0 && n.weight <= FLT_MAX) &
           TEST(!round || rise(view, n.wm) > -1e-4) &
           TEST((edge && !round) || fabs(weighed - visible) <= 1e-3 * visible + 1e-20);
}

static void test_samples(const vndf_view *view, int round, const char *name, size_t samples)
{
    static const float edges[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f, 1, NAN};
    unsigned long long state = 17;
    size_t apart[2] = {0, 0};
    for (size_t i = 0; i < samples; i++) {
        float r1 = test_uniform(&state), r2 = test_uniform(&state);
        float u1 = i < 64 ? edges[i / 8] : r1, u2 = i < 64 ? edges[i % 8] : r2;
        vndf_drawn_normal n = vndf_sample_bounded(view, u1, u2);
        double error = fabs((double)vndf_pdf_bounded(view, n.wm) / (double)n.density - 1);
        if (i >= 64 && rise(view, n.wm) > 0) /* not at the bound, nor lost, nor at the border */
            apart[0] += !(error <= 1e-5), apart[1] += !(error <= 1e-3);
        if (!is_good(view, n, round, i < 64) && test_failures < 20)
            fprintf(stderr, "  %s, wi.z %.9g, u %.9g %.9g: %.9g %.9g %.9g, %.9g, weight %.9g\n", name,
                    (double)view->wi.z, (double)u1, (double)u2, (double)n.wm.x, (double)n.wm.y, (double)n.wm.z,
                    (double)n.density, (double)n.weight);
    }
    if (!(TEST(apart[0] <= samples / 100) & TEST(apart[1] <= samples / 5000)))
        fprintf(stderr, "  %s: %lu densities are apart by 1e-5, %lu by 1e-3\n", name, (unsigned long)apart[0],
                (unsigned long)apart[1]);
}

/* Means over bounded normals, by their weights, and over visible ones, of what reflects wi to above the horizon: 5
 * sigma, 6e-7 each. */
static void test_means(const vndf_view *view, const char *name, size_t samples)
{
    enum { MEANS = 5 };
    double sums[MEANS] = {0}, squares[MEANS] = {0};
    unsigned long long state = 23;
    for (size_t i = 0; i < 2 * samples; i++) {
        float u1 = test_uniform(&state), u2 = test_uniform(&state);
        vndf_drawn_normal n = (i % 2 ? vndf_sample_visible : vndf_sample_bounded)(view, u1, u2);
        double up = rise(view, n.wm), sign = i % 2 ? -1 : 1;
        const double g[MEANS] = {1, n.wm.x, n.wm.y, (double)n.wm.z * n.wm.z, up};
        for (int k = 0; up > 0 && k < MEANS; k++) {
            double value = sign * (double)n.weight * g[k];
            sums[k] += value;
            squares[k] += value * value;
        }
    }
    for (int k = 0; k < MEANS; k++)
        if (!TEST(fabs(sums[k]) <= 5 * sqrt(squares[k]) + 1e-6 * (double)samples))
            fprintf(stderr, "  %s, wi.z %.9g: mean %d is off by %.3g, sigma %.3g\n", name, (double)view->wi.z, k,
                    sums[k] / (double)samples, sqrt(squares[k]) / (double)samples);
}

static void test_subject(const subject *of, size_t index)
{
    static const double thetas[SETTINGS] = {0, 45, 80, 89.9};
    static const float alphas[SETTINGS][2] = {{0.3f, 0.3f}, {0.05f, 0.05f}, {1, 1}, {0.2f, 0.6f}};
    const size_t samples = test_amount(20000, 100000, 300000);
    for (size_t j = 0; j < 2 * SETTINGS; j++) {
        const float *alpha = alphas[(index + j + j / SETTINGS) % SETTINGS];
        const vndf_vec3 wi = oracle_direction(thetas[j % SETTINGS], 40.0 * (double)j);
        const vndf_affine shape = seen_straight(of->d, alpha[0], alpha[1]);
        const vndf_view view = vndf_affine_view_from(&shape, wi);
        const slope_frame frame = slope_frame_from(&shape, wi);
        const int round = of->owned && alpha[0] == alpha[1];
        test_samples(&view, round, of->name, test_amount(1000, 5000, 100000));
        if (!round) { /* what is lost has no density */
            test_means(&view, of->name, samples);
            continue;
        }
        slope_test found = slope_chi_square(&frame, draw_slope, density_at, &view, samples, 5);
        if (!(TEST(found.p > statistics_sidak(0.01, 2 * SETTINGS * SUBJECT_COUNT)) &
              TEST(fabs(found.mass - 1) < (of->shape.breaks[0] > 0 ? 2e-3 : 5e-4))))
            fprintf(stderr, "  %s, alpha %g, wi.z %.9g: p %.3g of %lu, integral %.7f\n", of->name,
                    (double)alpha[0], (double)wi.z, found.p, (unsigned long)found.classes, found.mass);
    }
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
