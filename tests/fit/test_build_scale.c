/* The scale of the input does not matter: a distribution a million times narrower or a thousand times wider gives
 * a table as good and as large, and the same samples when roughness undoes the scale, within the tables' errors.
 *
 * Not the same bits: panels begin at octaves of the input's own unit, and the median, to which tables are scaled,
 * is found within 2% only. */
#include "oracle/oracle.h"
#include "harness/test.h"

/* P22 of width *user, not normalised: Laplace in slope length, with a ring. */
static double shape(double r, void *user)
{
    double x = r / *(const double *)user;
    return exp(-x) + exp(-pow((x - 3) / 0.5, 2));
}

static vndf_distribution *build(double width, vndf_certificate *claim)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_slope_callback(shape, &width, "laplace with a ring", &error);
    vndf_build_options options = {.max_bytes = 8192};
    vndf_distribution *table = source ? vndf_build(source, &options, claim, &error) : NULL;
    if (!table)
        fprintf(stderr, "width %g: %s\n", width, error.message);
    vndf_source_free(source);
    return table;
}

/* Samples of one, inverted by the other: the mean distance of the uniform numbers is no more than the two tables
 * differ in mass. */
static double mean_difference(const vndf_distribution *a, const vndf_distribution *b, double width)
{
    enum { SAMPLES = 20000 };
    unsigned long long state = 3;
    vndf_surface sa = {a, 0.5f, 0.2f}, sb = {b, (float)(0.5 / width), (float)(0.2 / width)};
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++) {
        float z = 1.2f * test_uniform(&state) - 0.2f, s = sqrtf(1 - z * z), u1 = test_uniform(&state),
              u2 = test_uniform(&state), v1, v2;
        vndf_vec3 wi = {s * 0.6f, s * 0.8f, z};
        vndf_view va = vndf_view_from(&sa, wi), vb = vndf_view_from(&sb, wi);
        vndf_invert(&vb, vndf_sample(&va, u1, u2, NULL), &v1, &v2);
        sum += fabs((double)u1 - v1) + fabs((double)u2 - v2);
    }
    return sum / SAMPLES;
}

int main(void)
{
    const double widths[] = {1e-6, 1e-3, 1e3};
    vndf_certificate one, other;
    vndf_distribution *unit = build(1, &one);
    for (int i = 0; TEST(unit != NULL) && i < 3; i++) {
        vndf_distribution *table = build(widths[i], &other);
        if (!TEST(table != NULL))
            continue;
        double apart = mean_difference(unit, table, widths[i]);
        TEST_RELATIVE(vndf_distribution_info(table).scale, widths[i] * vndf_distribution_info(unit).scale, 0.02);
        TEST_RELATIVE((double)other.tv, (double)one.tv, 0.3);
        TEST_RELATIVE((double)vndf_distribution_info(table).bytes, (double)vndf_distribution_info(unit).bytes,
                      0.2);
        TEST_NEAR(apart, 0, (double)one.tv + (double)other.tv);
        fprintf(stderr, "width %g: TV %.3g (%.3g at width 1), uniform numbers within %.2g\n", widths[i],
                (double)other.tv, (double)one.tv, apart);
        vndf_free(table);
    }
    vndf_free(unit);
    return test_done();
}
