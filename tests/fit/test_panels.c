/* Passes over a profile find the same mass at once, wherever in an octave a ring stands: the one before tells the next
 * where an octave holds nothing narrow, and no more. Then no edges are made, which tell of passes that disagreed. Where
 * a source is proven to give nothing it is hardly looked at. */
#include "fit/profile/profile.h"
#include "harness/test.h"
#include "vndf_build.h"

static const double PI = 3.14159265358979323846;

/* A ring so narrow that the first points of an octave may miss it. */
static void test_ring(double center)
{
    char text[128];
    snprintf(text, sizeof text, "exp(-r^2)+exp(-((r-%.17g)/0.008)^2)", center);
    vndf_source *source = vndf_source_slope_expression(text, NULL, 0, NULL);
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, NULL, &guard, NULL);
    double ring = sqrt(PI) * 0.008 * center, bell = 0.5;
    if (TEST(profile != NULL) && !(TEST(profile->edge_count == 0) & TEST_NEAR(2 * PI * profile->f0, 1, 1e-9) &
                                   TEST_RELATIVE(1 / profile->normalization, 2 * PI * (ring + bell), 1e-9)))
        fprintf(stderr, "  %s\n", text);
    vndf_profile_free(profile);
    vndf_source_free(source);
}

/* The values of a source that a profile takes. */
static double values_of(const char *text)
{
    vndf_source *source = vndf_source_slope_expression(text, NULL, 0, NULL);
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, NULL, &guard, NULL);
    double values = TEST(profile != NULL) ? guard.spent / source->operations : 0;
    vndf_profile_free(profile);
    vndf_source_free(source);
    return values;
}

/* Half of all octaves hold nothing of an exponential, and a quarter nothing of a power. */
static void test_nothing(void)
{
    double exponential = values_of("exp(-5*r)"), power = values_of("exp(-5*log(1+r))");
    if (!TEST(exponential < 0.8 * power))
        fprintf(stderr, "  %g values of an exponential, %g of a power\n", exponential, power);
}

int main(void)
{
    for (int i = 0; i < 24; i++)
        test_ring(1.02 + 0.04 * i);
    test_nothing();
    return test_done();
}
