/* Bounded normals, all normals and V-cavity normals are drawn as sampler.h says: unit, not below the surface, with a
 * density that is that of the normal returned, has the integral 1 and passes chi-square; bounded normals of closed
 * forms have the means of visible ones that reflect wi to above the horizon, and no table of round roughness loses
 * one; the weight is the visible density over the one drawn. It notices a bound, a twin or a factor that is wrong.
 * (The densities of all normals and of V-cavities: bsdf_values.) */
#include <float.h>

#include "evidence/measure/statistics.h"
#include "sampler/sampler.h"
#include "sampler/seen.h"

typedef enum law { BOUNDED, ALL, V_CAVITY, LAWS } law;
static const char *const law_names[LAWS] = {"bounded", "all", "v-cavity"};

/* A law seen from one direction. */
typedef struct drawn {
    law which;
    vndf_view view;
} drawn;

static vndf_drawn_normal draw(const drawn *d, float u1, float u2)
{
    return d->which == BOUNDED ? vndf_sample_bounded(&d->view, u1, u2)
           : d->which == ALL   ? vndf_sample_all(&d->view, u1, u2)
                               : vndf_sample_v_cavity(&d->view, u1, u2);
}

static float density(const drawn *d, vndf_vec3 wm)
{
    return d->which == BOUNDED ? vndf_pdf_bounded(&d->view, wm)
           : d->which == ALL   ? vndf_pdf_all(&d->view, wm)
                               : vndf_pdf_v_cavity(&d->view, wm);
}

static vndf_vec3 draw_slope(const void *of, float u1, float u2, float *pdf)
{
    vndf_drawn_normal n = draw(of, u1, u2);
    if (pdf)
        *pdf = n.density;
    return n.wm;
}

static double density_at(const double wm[3], const void *of)
{
    return (double)density(of, vec3_of(wm));
}

/* ---- every sample ---- */

/* What the weight is to be: visible normals over the density; of V-cavities D (wi.wm)/A(wi). Both are vndf_visible. */
static int is_good(const drawn *d, vndf_vec3 wi, vndf_drawn_normal n, int round, int edge)
{
    double facing = dot_of(wi, n.wm), up = 2 * facing * n.wm.z - wi.z,
           visible = (double)vndf_visible(&d->view, n.wm);
    int good = TEST(fabs(length_of(n.wm) - 1) <= 4 * 0x1p-23 && n.wm.z >= 0);
    good &= TEST(n.density >= FLT_MIN && n.density <= FLT_MAX && n.weight >= 0 && n.weight <= FLT_MAX);
    if (d->which == BOUNDED)
        return good & TEST(facing > 0) & TEST(!round || up > -1e-4) /* arcs end within some 1e-5 of the border */ &
               TEST((edge && !round) ||
                    fabs((double)n.weight * (double)n.density - visible) <= 1e-3 * visible + 1e-20);
    if (n.wm.z < 1e-3f || !(visible > 1e-20)) /* D grows beyond floats at the horizon */
        return good;
    return good & TEST(d->which == ALL || facing > -1e-7) &
           TEST(facing < 1e-3 || fabs((double)n.weight * (double)n.density - visible) <= 1e-3 * visible);
}

static void test_samples(const drawn *d, const vndf_surface *surface, vndf_vec3 wi, const char *name,
                         size_t samples)
{
    static const float edges[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f, 1, NAN};
    unsigned long long state = 17;
    size_t apart[2] = {0, 0};
    for (size_t i = 0; i < samples; i++) {
        float r1 = test_uniform(&state), r2 = test_uniform(&state);
        float u1 = i < 64 ? edges[i / 8] : r1, u2 = i < 64 ? edges[i % 8] : r2;
        vndf_drawn_normal n = draw(d, u1, u2);
        double error = fabs((double)density(d, n.wm) / (double)n.density - 1);
        if (d->which == BOUNDED && 2 * dot_of(wi, n.wm) * n.wm.z <= wi.z) /* at the bound, or lost: see below */
            error = 0;
        apart[0] += i >= 64 && !(error <= 1e-5), apart[1] += i >= 64 && !(error <= 1e-3); /* not at the border */
        int round = surface->alpha_x == surface->alpha_y && !vndf_is_exact(surface->distribution);
        if (!is_good(d, wi, n, round, i < 64) && test_failures < 20)
            fprintf(stderr, "  %s, %s, wi.z %.9g, alpha %g %g, u %.9g %.9g: %.9g %.9g %.9g, %.9g, weight %.9g\n",
                    name, law_names[d->which], (double)wi.z, (double)surface->alpha_x, (double)surface->alpha_y,
                    (double)u1, (double)u2, (double)n.wm.x, (double)n.wm.y, (double)n.wm.z, (double)n.density,
                    (double)n.weight);
    }
    if (!(TEST(apart[0] <= samples / 100) & TEST(apart[1] <= samples / 5000)))
        fprintf(stderr, "  %s, %s: %lu densities are apart by 1e-5, %lu by 1e-3\n", name, law_names[d->which],
                (unsigned long)apart[0], (unsigned long)apart[1]);
}

/* Means over bounded normals, by their weights, and over visible ones, of what reflects wi to above the horizon: 5
 * sigma, 6e-7 each. */
static void test_means(const drawn *d, vndf_vec3 wi, const char *name, size_t samples)
{
    enum { MEANS = 5 };
    double sums[MEANS] = {0}, squares[MEANS] = {0};
    unsigned long long state = 23;
    for (size_t i = 0; i < 2 * samples; i++) {
        float u1 = test_uniform(&state), u2 = test_uniform(&state);
        vndf_drawn_normal n =
            i % 2 ? vndf_sample_visible(&d->view, u1, u2) : vndf_sample_bounded(&d->view, u1, u2);
        double up = 2 * dot_of(wi, n.wm) * n.wm.z - wi.z, sign = i % 2 ? -1 : 1;
        const double g[MEANS] = {1, n.wm.x, n.wm.y, (double)n.wm.z * n.wm.z, up};
        for (int k = 0; up > 0 && k < MEANS; k++) {
            double value = sign * (double)n.weight * g[k];
            sums[k] += value;
            squares[k] += value * value;
        }
    }
    for (int k = 0; k < MEANS; k++)
        if (!TEST(fabs(sums[k]) <= 5 * sqrt(squares[k]) + 1e-6 * (double)samples))
            fprintf(stderr, "  %s, wi.z %.9g: mean %d is off by %.3g, sigma %.3g\n", name, (double)wi.z, k,
                    sums[k] / (double)samples, sqrt(squares[k]) / (double)samples);
}

/* ---- all of them together ---- */

static void test_setting(const subject *of, law which, const float alpha[2], vndf_vec3 wi)
{
    const vndf_surface surface = {of->d, alpha[0], alpha[1]};
    const vndf_affine shape = seen_straight(of->d, alpha[0], alpha[1]);
    const drawn d = {which, vndf_view_from(&surface, wi)};
    const slope_frame frame = slope_frame_from(&shape, wi, which == ALL);
    const size_t samples = test_amount(20000, 100000, 300000);
    test_samples(&d, &surface, wi, of->name, test_amount(1000, 5000, 100000));
    if (which == BOUNDED && (!of->owned || alpha[0] != alpha[1])) { /* what is lost has no density */
        test_means(&d, wi, of->name, samples);
        return;
    }
    slope_test found = slope_chi_square(&frame, draw_slope, density_at, &d, samples, 5);
    if (!(TEST(found.p > statistics_sidak(0.01, 4 * LAWS * SUBJECT_COUNT)) &
          TEST(fabs(found.mass - 1) < (of->shape.breaks[0] > 0 ? 2e-3 : 5e-4))))
        fprintf(stderr, "  %s, %s, alpha %g %g, wi.z %.9g: p %.3g of %lu, integral %.7f\n", of->name,
                law_names[which], (double)alpha[0], (double)alpha[1], (double)wi.z, found.p,
                (unsigned long)found.classes, found.mass);
}

static void test_subject(const subject *of, size_t index)
{
    static const double thetas[] = {0, 45, 80, 89.9};
    static const float alphas[][2] = {{0.3f, 0.3f}, {0.05f, 0.05f}, {1, 1}, {0.2f, 0.6f}};
    for (size_t j = 0; j < 4 * LAWS; j++)
        test_setting(of, (law)(j / 4), alphas[(index + j) % 4], oracle_direction(thetas[j % 4], 40.0 * (double)j));
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
