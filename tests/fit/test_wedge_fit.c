/* What the fit of azimuth rows takes for granted. E and S by polynomials are those of the profile to 1e-13, wherever
 * they are asked and however often, at a small part of the cost. The masses of wedges alone have the bits of the masses
 * with derivatives. The share of a wedge rises with y, so that the largest error is found without asking for all. */
#include "fit/area_fit.h"
#include "fit/profile/strip.h"
#include "harness/test.h"
#include "vndf_build.h"

static const char *const P22[] = {
    "exp(-r^2)*(1+r)", "exp(-3*r)*(1+0.8*cos(6*r))",        "step(1-r)", "(1+r^2)^-1.8", "exp(-((r-1)/0.01)^2)",
    "r^-1.5*exp(-r)",  "exp(-r)+100*exp(-((r-2)/0.001)^2)", "max(0,1-r)"};

/* ---- strips ---- */

enum { PLACES = 20011 };

/* Places from 1e-12 to 1e12, near 1 above all; a step of a few hundred, so that neighbours are not asked in turn. */
static double place(int i)
{
    double x = (double)(i * 433 % PLACES) / (PLACES - 1) * 2 - 1;
    return exp(log(1e12) * x * (0.02 + 0.98 * x * x));
}

static void test_strip(const vndf_profile *profile, const char *text, int beyond)
{
    vndf_strip *strip = vndf_strip_from(profile, beyond);
    double worst = 0, where = 0, cost = 0;
    for (int i = 0; TEST(strip != NULL) && i < 2 * PLACES; i++) {
        double rho = place(i % PLACES), before = profile->guard->spent, found = vndf_strip_at(strip, rho);
        cost += profile->guard->spent - before;
        double sum = beyond ? vndf_profile_s(profile, rho) : vndf_profile_e(profile, rho);
        double miss = fabs(found - sum) / (sum + 1e-40);
        where = miss > worst ? rho : where;
        worst = fmax(worst, miss);
    }
    if (!(TEST(worst < 1e-13) & TEST(cost < 0.4 * 2 * PLACES * VNDF_GAUSS * profile->source->operations)))
        fprintf(stderr, "  %s of %s: %.3g at %.9g, %.3g operations\n", beyond ? "S" : "E", text, worst, where,
                cost);
    vndf_strip_free(strip);
}

/* ---- areas ---- */

static void test_masses(const vndf_profile *profile)
{
    for (int i = 0; i <= 300; i++) {
        double y = pow(i / 300.0, 3);
        TEST(vndf_profile_mass_above(profile, y) == vndf_profile_area_above(profile, y).mass);
        TEST(vndf_profile_mass_below(profile, y) == vndf_profile_area_below(profile, y).mass);
    }
}

static void test_shares(const vndf_profile *profile, int below)
{
    const vndf_side side = {profile, below, 0.3, 0.05, 0.2};
    double most = 0;
    for (int i = 1; i < 1000; i++) {
        double y = i / 1000.0, share = vndf_side_share(&side, y, vndf_side_mass(&side, y));
        TEST(share >= most * (1 - 1e-7));
        most = fmax(most, share);
    }
    TEST(most > 0.1);
}

static void test_largest(const vndf_profile *profile, int below)
{
    const vndf_side side = {profile, below, 0.3, 0.05, 0.2};
    unsigned long long state = 7;
    for (int i = 0; i < 100; i++) {
        double y[6], miss[6], largest = 0, from = test_uniform(&state), width = (1 - from) * test_uniform(&state);
        for (int n = 0; n < 6; n++) {
            y[n] = from + width * (n + 1) / 7;
            miss[n] = 0.5 + test_uniform(&state);
            largest = fmax(largest, miss[n] * vndf_side_share(&side, y[n], vndf_side_mass(&side, y[n])));
        }
        TEST(vndf_side_largest(&side, y, miss, 6) == largest);
    }
}

int main(void)
{
    for (unsigned i = 0; i < sizeof P22 / sizeof *P22; i++) {
        vndf_source *source = vndf_source_slope_expression(P22[i], NULL, 0, NULL);
        vndf_guard guard = vndf_guard_from(NULL, NULL);
        vndf_profile *profile = vndf_profile_from(source, NULL, &guard, NULL);
        for (int below = 0; TEST(profile != NULL) && below < 2; below++) {
            test_strip(profile, P22[i], below);
            test_shares(profile, below);
            test_largest(profile, below);
        }
        if (profile)
            test_masses(profile);
        vndf_profile_free(profile);
        vndf_source_free(source);
    }
    return test_done();
}
