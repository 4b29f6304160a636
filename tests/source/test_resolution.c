/* Narrow features of what is no formula: a callback shows those as wide as 1e-3 of their slope, a CSV every row, a
 * family its lobes at any scale. */
#include "fit/profile/profile.h"
#include "source/sources.h"

/* exp(-r) and a ring 1e-3 of its slope wide, at *user, with masses of 2 pi each. */
static double ring_p22(double r, void *user)
{
    const double at = *(const double *)user, width = 1e-3, x = (r - at) / (at * width);
    return exp(-r) + exp(-x * x) / (at * at * width * sqrt(PI));
}

/* The mass that the builder finds, and the width of features that it was sure of: 0 for all. Frees the source. */
static void test_mass(vndf_source *source, double mass, double tolerance, double finest)
{
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_error error = {VNDF_OK, ""};
    vndf_profile *profile = vndf_profile_from(source, &guard, &error);
    if (!TEST(profile != NULL))
        fprintf(stderr, "  %s\n", error.message);
    if (profile) {
        TEST_RELATIVE(1 / profile->normalization, mass, tolerance);
        TEST(profile->finest == finest && (finest > 0 ? profile->hidden == 1 : profile->hidden <= 1e-5));
    }
    vndf_profile_free(profile);
    vndf_source_free(source);
}

/* At any place. */
static void test_rings(int places)
{
    unsigned long long state = 11;
    double at = 1;
    for (int i = 0; i < places; i++) {
        at = 0.1 * exp(4 * test_uniform(&state));
        test_mass(vndf_source_slope_callback(ring_p22, &at, "ring", NULL), 4 * PI, 1e-5, 1e-3);
    }
}

/* exp(-r) in rows of few digits is smooth; one row among many that has more is seen, as the curve through it has it. */
static void test_rows(int rows, int spike)
{
    enum { PARTS = 6000 };
    static double x[VNDF_LIMIT_CSV_ROWS], y[VNDF_LIMIT_CSV_ROWS];
    double step = 20.0 / (rows - 1), r = spike * step, more = 0, h = 6 * step / PARTS, all = 1 - 21 * exp(-20);
    for (int i = 0; i < rows; i++) {
        x[i] = i * step;
        y[i] = (double)(float)exp(-x[i]);
    }
    test_mass(vndf_source_rows(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, x, y, (size_t)rows, NULL, NULL),
              2 * PI * all, 1e-6, 0);
    y[spike] += 0.1 / (r * step);
    vndf_source *peaked = vndf_source_rows(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, x, y, (size_t)rows, NULL, NULL);
    for (int i = 0; i < PARTS; i++) {
        double at = r - 3 * step + h * (i + 0.5);
        more += h * at * (vndf_source_p22(peaked, at) - exp(-at));
    }
    test_mass(peaked, 2 * PI * (all + more), 1e-5, 0);
}

int main(void)
{
    test_rings((int)test_amount(20, 20, 60));
    test_rows(5000, 3000);
    test_rows(16384, 12345);
    test_mass(family_of("mix:(0.5,1e-9,ggx)+(0.5,1e3,ggx)"), 1, 1e-5, 0);
    test_mass(family_of("mix:(0.5,1e-6,epd:1000)+(0.5,1e6,epd:1000)"), 1, 1e-5, 0);
    test_mass(family_of("mix:(0.001,1e-6,beckmann)+(0.999,1,epd:1000)"), 1, 1e-5, 0);
    return test_done();
}
