/* What no point has met: panels are made, bounds look between the points, and where they find more, panels are made
 * anew with edges there. See profile.h. */
#include "fit/profile/panels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/profile/proof.h"
#include "core/error.h"
#include "math/ascending.h"

static const double NARROW = 1.01; /* ratio of the ends of a panel that was cut for a feature */

static vndf_status no_memory(vndf_error *error)
{
    return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to resolve the distribution");
}

static int add_edges(vndf_profile *profile, const double *more, size_t more_count)
{
    size_t count = profile->edge_count + more_count;
    double *edge = realloc(profile->edge, (count + 1) * sizeof *edge);
    if (!edge)
        return 0;
    profile->edge = edge;
    memcpy(edge + profile->edge_count, more, more_count * sizeof *edge);
    qsort(edge, count, sizeof *edge, vndf_ascending);
    profile->edge_count = count;
    return 1;
}

/* The ends of panels that were cut more than by default: the next passes look where one pass met a feature by
 * chance. */
static int keep_edges(vndf_profile *profile)
{
    const vndf_panel *p = profile->panel;
    double *edge = malloc(2 * profile->count * sizeof *edge);
    size_t count = 0;
    for (size_t i = 0; edge && i < profile->count; i++)
        if (p[i + 1].r < p[i].r * NARROW) {
            edge[count++] = p[i].r * profile->scale;
            edge[count++] = p[i + 1].r * profile->scale;
        }
    int good = edge && add_edges(profile, edge, count);
    free(edge);
    return good;
}

static vndf_status unproven(const vndf_proof *proof, vndf_error *error)
{
    if (isinf(proof->worst))
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 cannot be bounded at slope %.9g: it may be infinite or not a number there",
                         proof->where);
    return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                     "P22 cannot be resolved at slope %.9g: up to %.3g of the mass, or of the area at grazing "
                     "incidence, may lie between the points that were looked at, %.3g of it there",
                     proof->where, proof->hidden, proof->worst);
}

static const double FINEST = 1e-3; /* the default width of features that samples find */

/* Tries the proof; without one, samples. 0 if there is no memory. */
static int look_between(vndf_profile *profile, vndf_proof *proof)
{
    profile->finest = 0.0;
    int good = profile->source->reach ? vndf_proof_from(proof, profile) : 1;
    if (profile->source->reach && (proof->proven || proof->edge_count || profile->sampled == 0.0))
        return good;
    profile->finest = profile->sampled > 0.0 ? profile->sampled : FINEST;
    if (profile->source->reach)
        vndf_proof_free(proof);
    return good && vndf_proof_by_samples(proof, profile, profile->finest);
}

/* 1 if panels must be made anew, with more edges; else *status is the answer. */
static int look_closer(vndf_profile *profile, int last, vndf_status *status, vndf_error *error)
{
    vndf_proof proof = {0};
    int good = look_between(profile, &proof), again = 0;
    profile->hidden = fmin(proof.hidden, 1.0);
    if (vndf_guard_stopped(profile->guard))
        *status = vndf_guard_status(profile->guard, error);
    else if (!good || (proof.edge_count && !add_edges(profile, proof.edge, proof.edge_count)))
        *status = no_memory(error);
    else if (proof.edge_count && !last)
        again = 1;
    else if (!proof.proven && (*status == VNDF_OK || !(profile->f0 > 0.0)))
        *status = unproven(&proof, error);
    vndf_proof_free(&proof);
    return again;
}

/* Looks at points first, then between them, until it finds nothing more. */
static vndf_status make(vndf_profile *profile, vndf_error *error)
{
    enum { LOOKS = 12 };
    for (int i = 0;; i++) {
        profile->normalization = profile->scale = 1.0;
        profile->floor = 0.0;
        profile->unsettled = 0;
        vndf_status status = vndf_profile_settle(profile, error);
        if (vndf_profile_stopped(profile) || profile->count == 0)
            return status;
        if (!vndf_panels_points(profile))
            return no_memory(error);
        int again = look_closer(profile, i + 1 == LOOKS, &status, error);
        if (!again && (!profile->unsettled || i + 1 == LOOKS))
            return status;
        if (!again && !keep_edges(profile))
            return no_memory(error);
    }
}

/* Adds panels that are narrower the nearer they are to a break, where a feature may have any width. */
static int add_break(vndf_profile *profile, double r)
{
    enum { SHELLS = 20 };
    double edge[2 * SHELLS + 1] = {r};
    for (int i = 0; i < SHELLS; i++) {
        double beside = ldexp(r, -2 * (i + 1));
        edge[2 * i + 1] = r - beside;
        edge[2 * i + 2] = r + beside;
    }
    return add_edges(profile, edge, 2 * SHELLS + 1);
}

/* 0 if there is no memory. */
static int take_resolution(vndf_profile *profile, const vndf_resolution *resolution, vndf_error *error)
{
    vndf_resolution none = {NULL, 0, 0.0}, given = resolution ? *resolution : none;
    profile->sampled = given.finest;
    profile->description = vndf_resolution_describe(&given, profile->source->description, error);
    int good = profile->description != NULL;
    for (size_t i = 0; good && i < given.break_count; i++)
        good = add_break(profile, given.breaks[i]);
    if (profile->description && !good)
        no_memory(error);
    return good;
}

vndf_profile *vndf_profile_from(const vndf_source *source, const vndf_resolution *resolution, vndf_guard *guard,
                                vndf_error *error)
{
    vndf_profile *profile = source ? calloc(1, sizeof *profile) : NULL;
    if (!profile) {
        vndf_fail(error, source ? VNDF_ERROR_MEMORY : VNDF_ERROR_ARGUMENT,
                  source ? "no memory to resolve the distribution" : "no source: NULL was given");
        return NULL;
    }
    profile->source = source;
    profile->guard = guard;
    vndf_error inner = {VNDF_ERROR_MEMORY, ""}; /* a pass that fails may precede one that succeeds */
    if (take_resolution(profile, resolution, &inner) && make(profile, &inner) == VNDF_OK)
        return profile;
    vndf_fail(error, inner.status, "%s", inner.message);
    vndf_profile_free(profile);
    return NULL;
}

void vndf_profile_free(vndf_profile *profile)
{
    if (!profile)
        return;
    free(profile->panel);
    free(profile->point);
    free(profile->edge);
    free(profile->description);
    free(profile);
}
