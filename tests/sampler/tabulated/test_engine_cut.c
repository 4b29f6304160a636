/* The law of the slope length follows its cut, wherever that stands. As the cut passes a knot of the table no
 * part of the law jumps by more than 1e-4 of u2, though the cells beside it are drawn in another way than those
 * away from it. Where the cut lies at slopes of 1e10, at 179.9 degrees with a roughness of 1e-8, samples
 * have their density and come back through vndf_invert within 1e-3. And at grazing, where the law of an azimuth
 * at a right angle from wi has next to no mass or none, slopes still grow with u2, and none is infinite. */
#include <float.h>

#include "oracle/oracle.h"
#include "table/layout.h"
#include "sampler/tabulated/theory.h"
#include "sampler/frame.h"
#include "sampler/stretch.h"
#include "harness/constants.h"
#include "harness/test.h"

/* ---- passing a knot ---- */

/* The part of the law before the slope at xi of a cell, where the cut stands at `slope` times 1 + shift. */
static double part_before(const vndf_view *view, double slope, double shift, uint32_t cell, double xi)
{
    const vndf_distribution *d = view->distribution;
    vndf_knot from = d->knots.at[cell], to = d->knots.at[cell + 1];
    double x = from.x * (1 - xi) + to.x * xi, z = from.z * (1 - xi) + to.z * xi;
    vndf_stretched w = vndf_stretched_of(view);
    double cosine = -w.c / (w.s * slope * (1 + shift)), sine = sqrt(1 - cosine * cosine);
    double across = x * view->alpha_x, l = hypot(across, z);
    vndf_vec3 wm = {(float)(across * cosine / l), (float)(across * sine / l), (float)(z / l)};
    float u1, u2;
    vndf_frame frame = vndf_table_frame(view);
    vndf_engine_invert(view, vndf_to_unit(&frame, wm), &u1, &u2); /* the law, not the number nearest in floats */
    return u2;
}

/* The jump at knot j of the part before a place: the step across the knot less what the steps on either side say
 * that it would be anyway. */
static double jump_of(const vndf_view *view, uint32_t j, uint32_t cell, double xi)
{
    const double h = 2e-6;
    double part[4], slope = vndf_knot_slope(view->distribution, j);
    for (int i = 0; i < 4; i++)
        part[i] = part_before(view, slope, (2 * i - 3) * h, cell, xi);
    return fabs(part[2] - part[1] - 0.5 * (part[3] - part[2] + part[1] - part[0]));
}

/* The largest jump as the cut passes knot j, over the four cells beside it that are seen. */
static double largest_jump(const vndf_view *view, uint32_t j)
{
    const vndf_distribution *d = view->distribution;
    double worst = 0;
    uint32_t first = view->of.table.c < 0 ? j : j > 4 ? j - 4 : 0, end = view->of.table.c < 0 ? j + 4 : j;
    if (!(fabs((double)view->of.table.c) < 0.99 * view->of.table.s * vndf_knot_slope(d, j)))
        return 0;
    for (uint32_t cell = first; cell < end && cell + 1 < d->radial_count; cell++)
        for (int i = 1; i < 8; i++)
            worst = fmax(worst, jump_of(view, j, cell, i / 8.0));
    return worst;
}

static void test_knots(const vndf_distribution *d, const char *name)
{
    static const double cuts[] = {0.05, 0.3, 0.8, 1.2, 2, 4};
    double worst = 0;
    for (int i = 0; i < 12; i++) { /* c/s at canonical scale, above and below */
        vndf_surface surface = {d, 1.0f, 1.0f};
        double c = cuts[i / 2] * vndf_distribution_info(d).scale * (i % 2 ? -1 : 1), l = hypot(1, c);
        vndf_vec3 wi = {(float)(1 / l), 0, (float)(c / l)};
        vndf_view view = vndf_view_from(&surface, wi);
        for (uint32_t j = 1; view.of.table.area > 1e-10f && j + 1 < d->radial_count; j++)
            worst = fmax(worst, largest_jump(&view, j));
    }
    if (!TEST(worst > 0 && worst <= 1e-4))
        fprintf(stderr, "  %s (%lu bytes): the law jumps by %.3g as the cut passes a knot\n", name,
                (unsigned long)vndf_distribution_info(d).bytes, worst);
}

/* ---- far out ---- */

static void test_far(const vndf_distribution *d, const char *name, double theta, float alpha)
{
    vndf_surface surface = {d, alpha, alpha};
    double t = theta * PI / 180, worst1 = 0, worst2 = 0;
    vndf_vec3 wi = {(float)sin(t), 0, (float)cos(t)};
    vndf_view view = vndf_view_from(&surface, wi);
    unsigned long long state = 11;
    int floors = 0;
    for (int i = 0; i < 400; i++) {
        float u1 = 0.01f + 0.98f * test_uniform(&state), u2 = 0.01f + 0.98f * test_uniform(&state), v1, v2, pdf;
        vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
        vndf_invert(&view, wm, &v1, &v2);
        floors += !(pdf > FLT_MIN && pdf < FLT_MAX);
        worst1 = fmax(worst1, fabs((double)u1 - v1));
        worst2 = fmax(worst2, fabs((double)u2 - v2));
    }
    if (!(TEST(floors == 0) & TEST(worst1 <= 1e-4) & TEST(worst2 <= 1e-3)))
        fprintf(stderr,
                "  %s (%lu bytes), theta %g, alpha %g: %d densities are limits, u1 and u2 off by %.3g and %.3g\n",
                name, (unsigned long)vndf_distribution_info(d).bytes, theta, (double)alpha, floors, worst1,
                worst2);
}

/* ---- grazing ---- */

/* 2e-6 is for rounding. */
static void test_grazing(const vndf_distribution *d, const char *name, float c, float u1)
{
    vndf_surface surface = {d, 1, 1};
    vndf_vec3 wi = {1, 0, c};
    vndf_view view = vndf_view_from(&surface, wi);
    double last = 0;
    int falls = 0, level = 0;
    for (int i = 1; i < 400; i++) {
        vndf_vec3 wm = vndf_sample(&view, u1, (float)i / 400, NULL);
        double slope = wm.z > 0 ? hypot(wm.x, wm.y) / wm.z : HUGE_VAL;
        falls += slope < last * (1 - 2e-6);
        level += !(wm.z > 0);
        last = slope;
    }
    if (!(TEST(falls == 0) & TEST(level == 0)))
        fprintf(stderr, "  %s (%lu bytes), wi.z %g, u1 %g: slopes fall %d times, %d are infinite\n", name,
                (unsigned long)vndf_distribution_info(d).bytes, (double)c, (double)u1, falls, level);
}

static void test_size(const oracle *o, size_t bytes)
{
    static const double thetas[] = {91, 100, 130, 175, 179.9};
    static const float alphas[] = {1, 1e-2f, 1e-4f, 1e-6f, 1e-8f};
    static const float heights[] = {0, 1e-45f, 1e-38f, 1e-30f, 1e-20f, 1e-10f, -1e-10f};
    vndf_distribution *d = oracle_build(o, bytes, NULL);
    if (!TEST(d != NULL))
        return;
    test_knots(d, oracle_name(o));
    for (int i = 0; i < 25; i++)
        test_far(d, oracle_name(o), thetas[i / 5], alphas[i % 5]);
    for (int i = 0; i < 21; i++)
        test_grazing(d, oracle_name(o), heights[i / 3], 0.5f * (float)(i % 3));
    vndf_free(d);
}

int main(int arguments, char **argument)
{
    for (size_t i = 0; i < ORACLE_COUNT; i++) {
        oracle o = oracle_get(i);
        if (!oracle_wanted(arguments, argument, i, oracle_name(&o)))
            continue;
        test_size(&o, 2048);
        test_size(&o, 0);
    }
    return test_done();
}
