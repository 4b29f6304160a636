/* What a microsurface must be, and its mass and scale: P22 has a finite area, and two integrations of it agree. */
#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "fit/profile/panels.h"

static const double PI = 3.14159265358979323846;
static const double FLOOR = 1e-26;
static const double LEAST_PEAK = 1e-307; /* of P22 r^2: doubles lose their digits below, and have no reciprocal */
static const double POLE_LOST = 1e-6;    /* part of the mass that may lie below the first panel, */
static const double TAIL_LOST = 2e-3;    /* of the area at grazing incidence beyond the last: one cell draws it */
static const double SAME_MASS = 1e-7;    /* two passes agree */

static vndf_status check_values(const vndf_profile *profile, vndf_error *error)
{
    if (vndf_guard_stopped(profile->guard))
        return vndf_guard_status(profile->guard, error);
    if (profile->rough)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 is too rough: not resolved by %d panels; the last one began at slope %g",
                         VNDF_LIMIT_BUILD_PANELS,
                         profile->count ? profile->panel[profile->count - 1].r * profile->scale : 0.0);
    if (!(profile->f0 > 0.0))
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 is zero everywhere from slope 1e-30 to 1e30: no projected area");
    return VNDF_OK;
}

/* Checks that both ends are integrable, and that little lies beyond the panels. */
static vndf_status check_ends(vndf_profile *profile, vndf_error *error)
{
    double tail = vndf_panels_exponent(profile, exp2(VNDF_OCTAVES - 2), exp2(VNDF_OCTAVES));
    double pole = vndf_panels_exponent(profile, exp2(-VNDF_OCTAVES), exp2(2 - VNDF_OCTAVES));
    const vndf_panel *p = profile->panel;
    size_t n = profile->count;
    if (pole < HUGE_VAL && pole >= 2.0 - VNDF_POWER_MARGIN)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "infinite projected area at the pole: P22 rises as r^-%.4g for r -> 0, must rise slower "
                         "than r^-2",
                         pole);
    if (pole < HUGE_VAL && pole > 0.0 && p[1].f0 / (exp2(2.0 - pole) - 1.0) > POLE_LOST * profile->f0)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 rises as r^-%.4g for r -> 0: too much of its mass lies below slope 1e-30", pole);
    if (tail <= 3.0 + VNDF_POWER_MARGIN)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "infinite projected area: P22 falls as r^%.4g for large r, must fall faster than r^-3 "
                         "(D slower than 1/cos(theta_m) towards 90 degrees)",
                         0.0 - tail);
    if (tail < HUGE_VAL && profile->tail_m1 + p[n].r * profile->tail_m0 > TAIL_LOST * profile->f1)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "the tail is too heavy: P22 falls as r^-%.6g, so that over 0.2%% of the projected area "
                         "at grazing incidence lies beyond slope 1e30, where no single-precision normal can lie",
                         tail);
    return VNDF_OK;
}

static vndf_status measure(vndf_profile *profile, vndf_known *known, vndf_error *error)
{
    vndf_panels_fill(profile, known);
    if (!vndf_profile_stopped(profile))
        vndf_panels_sum(profile);
    return check_values(profile, error);
}

/* Where the narrowest panel begins. */
static double narrowest(const vndf_profile *profile)
{
    const vndf_panel *p = profile->panel;
    size_t at = 0;
    for (size_t i = 1; i < profile->count; i++)
        if (p[i + 1].r * p[at].r < p[at + 1].r * p[i].r)
            at = i;
    return p[at].r;
}

/* Pass 1 works in the unit of the source, the next passes at canonical scale with the floor, until two find the
 * same mass. Their panels begin at the same slopes, but for rounding; where one panel was enough between two edges, the
 * next pass looks no closer. */
static vndf_status settle(vndf_profile *profile, vndf_known *known, vndf_error *error)
{
    enum { PASSES = 4 };
    double most = known->peak =
        vndf_panels_peak(profile); /* scale to a size that neither overflows nor vanishes */
    if (most > 0.0 && most < LEAST_PEAK)
        return vndf_fail(
            error, VNDF_ERROR_DISTRIBUTION,
            "P22 r^2 is no more than %.3g at any slope: too small for doubles; multiply P22 by a factor", most);
    if (most > 0.0)
        profile->normalization = 1.0 / most;
    vndf_status status = measure(profile, known, error);
    if (status == VNDF_OK)
        status = check_ends(profile, error);
    for (int pass = 0; status == VNDF_OK && pass < PASSES; pass++) {
        double mass = 2 * PI * profile->f0;
        if (pass > 0 && fabs(mass - 1.0) < SAME_MASS)
            return VNDF_OK;
        double middle = vndf_panels_median(profile);
        profile->normalization /= mass;
        profile->scale *= middle;
        profile->floor = FLOOR;
        if (!(profile->scale > 1e-17 && profile->scale < 1e17))
            return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                             "the median slope is %g; from 1e-17 to 1e17 can be tabulated", profile->scale);
        status = measure(profile, known, error);
    }
    if (status != VNDF_OK)
        return status;
    profile->unsettled = 1;
    return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                     "P22 has a feature too narrow to be resolved: two integrations of it disagree; the narrowest "
                     "part that was tried lies at slope %.9g",
                     narrowest(profile) * profile->scale);
}

vndf_status vndf_profile_settle(vndf_profile *profile, vndf_error *error)
{
    vndf_known known = {0.0, NULL, 0};
    vndf_status status = settle(profile, &known, error);
    free(known.simple);
    return status;
}
