/* From a source to its profile, or to the reason why it is no microsurface: panels are made, a proof looks between
 * their points, and where it finds more, panels are made anew with edges there. Then slopes and values are brought to
 * canonical scale. The public oracle is a profile without a table. */
#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "fit/profile/profile.h"
#include "math/ascending.h"

static const double PI = 3.14159265358979323846;
static const double POLE_LOST = 1e-6;  /* part of the mass that may lie below the first panel, */
static const double TAIL_LOST = 2e-3;  /* of the area at grazing incidence beyond the last: one cell draws it */
static const double SAME_EDGE = 1e-13; /* of a slope: below the width that resolve() calls a jump */

/* ---- what a microsurface must be ---- */

/* There is mass, both ends are integrable, and little lies beyond the panels. */
static vndf_status check(const vndf_profile *profile, double peak, vndf_error *error)
{
    if (peak > 0.0 && peak < VNDF_LEAST_PEAK)
        return vndf_fail(
            error, VNDF_ERROR_DISTRIBUTION,
            "P22 r^2 is no more than %.3g at any slope: too small for doubles; multiply P22 by a factor", peak);
    if (!(profile->f0 > 0.0))
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 is zero everywhere from slope 1e-30 to 1e30: no projected area");
    double tail = profile->tail, pole = profile->pole;
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

/* ---- panels until nothing hides ---- */

/* Adds slopes at which panels are to end; all are kept ascending and apart. 0 if there is no memory. */
static int add_edges(vndf_profile *profile, const double *more, size_t count)
{
    size_t n = profile->edge_count, kept = 0;
    double *edge = realloc(profile->edge, (n + count + 1) * sizeof *edge);
    if (!edge)
        return 0;
    profile->edge = edge;
    for (size_t i = 0; i < count; i++)
        if (more[i] >= exp2(-VNDF_OCTAVES) && more[i] <= exp2(VNDF_OCTAVES))
            edge[n++] = more[i];
    qsort(edge, n, sizeof *edge, vndf_ascending);
    for (size_t i = 0; i < n; i++)
        if (kept == 0 || edge[i] - edge[kept - 1] > SAME_EDGE * edge[i])
            edge[kept++] = edge[i];
    profile->edge_count = kept;
    return 1;
}

/* What the panels found wrong is told only if nothing hides from them. */
static void look(vndf_profile *profile)
{
    enum { LOOKS = 12 };
    vndf_guard *guard = profile->guard;
    for (int i = 1, more = 1; more; i++) {
        vndf_proof proof;
        vndf_error found = {VNDF_OK, ""};
        double peak = vndf_panels_make(profile);
        if (vndf_guard_stopped(guard))
            return;
        check(profile, peak, &found);
        if (!vndf_proof_from(&proof, profile) || !add_edges(profile, proof.edge, proof.edge_count))
            vndf_guard_starve(guard);
        free(proof.edge);
        profile->hidden = fmin(proof.hidden, 1.0);
        more = proof.edge_count > 0 && i < LOOKS;
        if (more || vndf_guard_stopped(guard))
            continue;
        if (proof.proven || (found.status != VNDF_OK && profile->f0 > 0.0))
            guard->why = found;
        else if (isinf(proof.worst))
            vndf_fail(&guard->why, VNDF_ERROR_DISTRIBUTION,
                      "P22 cannot be bounded at slope %.9g: it may be infinite or not a number there",
                      proof.where);
        else
            vndf_fail(&guard->why, VNDF_ERROR_DISTRIBUTION,
                      "P22 cannot be resolved at slope %.9g: up to %.3g of the mass, or of the area at grazing "
                      "incidence, may lie between the points that were looked at, %.3g of it there",
                      proof.where, proof.hidden, proof.worst);
    }
}

/* ---- canonical scale ---- */

/* The slope with half of the mass on either side. */
static double median_of(const vndf_profile *profile)
{
    size_t i = 0;
    while (profile->panel[i + 1].f0 < profile->f0 / 2)
        i++;
    const vndf_panel *p = &profile->panel[i];
    double low = p->r, high = p[1].r;
    for (int step = 0; step < 30; step++) {
        vndf_profile_point point[VNDF_GAUSS];
        double middle = sqrt(low * high), mass = p->f0;
        vndf_profile_rule(profile, p->r, middle, point);
        for (int k = 0; k < VNDF_GAUSS; k++)
            mass += point[k].weight;
        if (mass < profile->f0 / 2)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void make_canonical(vndf_profile *profile)
{
    double mass = 2 * PI * profile->f0, scale = median_of(profile);
    if (!(scale > 1e-17 && scale < 1e17))
        vndf_fail(vndf_guard_why(profile->guard), VNDF_ERROR_DISTRIBUTION,
                  "the median slope is %g; from 1e-17 to 1e17 can be tabulated", scale);
    if (vndf_guard_stopped(profile->guard))
        return;
    profile->scale = scale;
    profile->normalization /= mass;
    for (vndf_panel *p = profile->panel; p <= profile->panel + profile->count; p++) {
        p->r /= scale;
        p->m0 /= mass;
        p->m1 /= mass * scale;
        for (int k = 0; k < VNDF_GAUSS; k++) {
            p->point[k].r /= scale;
            p->point[k].weight /= mass;
        }
    }
    vndf_panels_sum(profile);
}

/* ---- the whole ---- */

vndf_profile *vndf_profile_from(const vndf_source *source, vndf_guard *guard, vndf_error *error)
{
    double octave[2 * VNDF_OCTAVES + 1];
    for (int i = 0; i <= 2 * VNDF_OCTAVES; i++)
        octave[i] = exp2(i - VNDF_OCTAVES);
    vndf_profile *profile = calloc(1, sizeof *profile);
    if (profile) {
        profile->source = source;
        profile->guard = guard;
        profile->panel = malloc((VNDF_LIMIT_BUILD_PANELS + 1) * sizeof *profile->panel);
    }
    if (profile && profile->panel && add_edges(profile, octave, 2 * VNDF_OCTAVES + 1) &&
        add_edges(profile, source->breaks, source->break_count))
        look(profile);
    else
        vndf_guard_starve(guard);
    if (!vndf_guard_stopped(guard))
        make_canonical(profile);
    if (vndf_guard_status(guard, error) == VNDF_OK)
        return profile;
    vndf_profile_free(profile);
    return NULL;
}

void vndf_profile_free(vndf_profile *profile)
{
    if (!profile)
        return;
    free(profile->panel);
    free(profile->edge);
    free(profile);
}
