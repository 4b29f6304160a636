/* Light of spheres and rectangles on a matte floor is that of closed forms: R^2/d^2 cos for a sphere, the form
 * factor of a parallel rectangle above its corner; and what stands before a light bars it. Notices wrong densities
 * of drawn points, areas, powers and cosines, lights that shine backwards, and shadow rays that end too early or
 * too late. */
#include "render_case.h"

#define FLOOR                                                                                 \
  "camera from 0 1 3 to 0 0 0\nintegrator depth 1\nmaterial floor matte colour 0.5 0.5 0.5\n" \
  "rectangle corner -9 0 9 edge-u 18 0 0 edge-v 0 0 -18 material floor\n"

/* From a point in the plane of the corner, at right angles below it: both sides over the distance (Siegel &
 * Howell). */
static double corner_factor(double a, double b)
{
    double x = sqrt(1 + a * a), y = sqrt(1 + b * b);
    return (a / x * atan(b / x) + b / y * atan(a / y)) / (2 * PI);
}

static void test_floor(const char *lights, double want)
{
    char text[2048];
    snprintf(text, sizeof text, FLOOR "%s", lights);
    scene *s = case_point(text);
    if (s && !case_agrees(case_light(s, SAMPLER_VISIBLE, test_amount(64, 512, 512)), want, 1e-4))
        fprintf(stderr, "    %s", lights);
    scene_free(s);
}

int main(void)
{
    const double above = 0.5 * 8 * 0.25 * 0.25 / (2 * 2), aside = 0.5 * 8 * 0.25 * 0.25 / 25 * (3 / 5.0);
    const double panel = 0.5 * 8 * 4 * corner_factor(0.5, 0.25);
#define LAMP "material lamp light radiance 8 8 8\n"
#define PANEL "rectangle corner -1 2 -0.5 edge-u 2 0 0 edge-v 0 0 1 material lamp\n"
    test_floor(LAMP "sphere centre 0 2 0 radius 0.25 material lamp\n", above);
    test_floor(LAMP "sphere centre 4 3 0 radius 0.25 material lamp\n", aside);
    test_floor(LAMP PANEL, panel);
    test_floor(
        LAMP
        "sphere centre 0 2.2 0 radius 0.1 material lamp\nsphere centre 4 3 0 radius 0.25 material lamp\n" PANEL,
        panel + aside); /* the panel hides the first */
    test_floor(LAMP PANEL "rectangle corner -1 1.999999 -0.5 edge-u 1 0 0 edge-v 0 0 1 material floor\n",
               panel / 2);
    test_floor(LAMP "rectangle corner -1 2 0.5 edge-u 2 0 0 edge-v 0 0 -1 material lamp\n" /* its front is above */
                    "sphere centre 4 3 0 radius 0.25 material lamp\n",
               aside);
    test_floor(LAMP "sphere centre 0 0 0 radius 40 material lamp\n",
               0); /* all is inside, where it does not shine */
    return test_done();
}
