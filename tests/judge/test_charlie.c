/* The sheen of Estevez & Kulla 2017 as a family: P22 of its source and D of its table are those of D = (2 + 1/a)
 * sin^(1/a)/(2 pi), the table's area is the integral of that D, and small tables have the distances that are known of
 * them. */
#include "harness/test.h"
#include "vndf_build.h"

static double ndf(double a, double theta)
{
    return (2 + 1 / a) * pow(sin(theta), 1 / a) / (2 * PI);
}

/* The integral of max(0, w.wm) D, w at this angle, by the midpoint rule over the hemisphere. */
static double area(double a, double angle)
{
    enum { STEPS = 1000 };
    double sum = 0, step = PI / 2 / STEPS;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            double theta = (i + 0.5) * step, phi = 2 * (k + 0.5) * step;
            double facing = sin(angle) * sin(theta) * cos(phi) + cos(angle) * cos(theta);
            sum += fmax(0, facing) * ndf(a, theta) * sin(theta);
        }
    return 4 * sum * step * step;
}

static void test_source(const vndf_source *source, double a)
{
    for (double r = 0.01; r < 100; r *= 1.3) {
        double ratio = vndf_source_p22(source, r) / vndf_source_p22(source, 1), theta = atan(r);
        TEST_RELATIVE(ratio, 4 * ndf(a, theta) * pow(cos(theta), 4) / ndf(a, PI / 4), 1e-12);
    }
    TEST(vndf_source_p22(source, 0) == 0 && vndf_source_p22(source, 1e200) == 0);
}

static void test_table(const vndf_source *source, double a, size_t bytes, double most, double most_above)
{
    static const double angles[] = {0, 30, 60, 85, 90, 120};
    const vndf_build_options options = {.max_bytes = bytes};
    vndf_certificate claim;
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = vndf_build(source, &options, &claim, &error);
    if (!TEST(table != NULL)) {
        fprintf(stderr, "  %g: %s\n", a, error.message);
        return;
    }
    if (!(TEST((double)claim.tv <= most) & TEST((double)claim.tv_above <= most_above) &
          TEST(claim.hidden <= 1e-5f)))
        fprintf(stderr, "  %g in %zu bytes: %.3g, %.3g above, hidden %.3g\n", a, bytes, (double)claim.tv,
                (double)claim.tv_above, (double)claim.hidden);
    const vndf_surface surface = {table, 1, 1};
    for (int i = 0; i < 6; i++) {
        double angle = angles[i] * PI / 180;
        const vndf_vec3 w = {(float)sin(angle), 0, (float)cos(angle)};
        TEST_RELATIVE((double)vndf_projected_area(&surface, w), area(a, angle), (double)claim.area_error + 1e-4);
        if (w.z > 0.1f && i > 0)
            TEST_NEAR((double)vndf_ndf(&surface, w), ndf(a, angle), 1e-3 * ndf(a, PI / 2));
    }
    vndf_free(table);
}

int main(void)
{
    static const double parameters[] = {0.1, 0.3, 1};
    for (int i = 0; i < 3; i++) {
        char name[32];
        snprintf(name, sizeof name, "charlie:%g", parameters[i]);
        vndf_source *source = vndf_source_family(name, NULL);
        if (!TEST(source != NULL))
            continue;
        test_source(source, parameters[i]);
        test_table(source, parameters[i], 2048, 2e-2, 1.5e-3);
        test_table(source, parameters[i], 8192, 1e-2, 4e-4);
        vndf_source_free(source);
    }
    TEST(!vndf_source_family("charlie:0.04", NULL) && !vndf_source_family("charlie:1.01", NULL));
    return test_done();
}
