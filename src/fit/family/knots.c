/* The distance between two knots grows as the square of the way between them: its root is shared out evenly, again
 * and again, as de Boor shares out knots of splines ("Good approximation by splines with variable knots", 1973). */
#include "fit/family/knots.h"

#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "fit/family/pattern.h"
#include "fit/profile/profile.h"
#include "table/family/family.h"

enum { PROBES = 3, SWEEPS = 12, SLOPES_TO_E = 24 };
static const double LEFT_OUT = 1e-9; /* of the mass, on either side */
static const double EVEN = 1.03;     /* largest over mean distance: good enough */

double vndf_knots_between(double low, double high, double t, int reciprocal)
{
    return reciprocal ? low * high / (high - t * (high - low)) : low + t * (high - low);
}

/* ---- slopes ---- */

/* The slopes with LEFT_OUT of the mass below and beyond. */
static void widen(const vndf_profile *profile, double *first, double *last)
{
    double left_out = LEFT_OUT * profile->f0;
    size_t from = 0, to = profile->count;
    while (from + 1 < profile->count && profile->panel[from + 1].f0 < left_out)
        from++;
    while (to > from + 1 && profile->panel[to - 1].t0 < left_out)
        to--;
    *first = fmin(*first, profile->panel[from].r * profile->scale);
    *last = fmax(*last, profile->panel[to].r * profile->scale);
}

int vndf_knots_plan_from(vndf_knots_plan *plan, const char *pattern, const vndf_member *low,
                         const vndf_member *middle, const vndf_member *high)
{
    double first = HUGE_VAL, last = 0;
    widen(low->profile, &first, &last);
    widen(middle->profile, &first, &last);
    widen(high->profile, &first, &last);
    *plan = (vndf_knots_plan){.pattern = pattern, .low = low->p, .high = high->p};
    plan->first = log(first);
    plan->slopes = 2 + (size_t)(SLOPES_TO_E * log(last / first));
    plan->step = log(last / first) / (double)(plan->slopes - 1);
    plan->scratch = malloc(3 * plan->slopes * sizeof *plan->scratch);
    return plan->scratch != NULL;
}

void vndf_knots_plan_free(vndf_knots_plan *plan)
{
    free(plan->scratch);
}

/* P22 r^2 at p, whose sum is 1. */
static vndf_status tabulate(const vndf_knots_plan *plan, double p, double *share, vndf_error *error)
{
    vndf_source *source = vndf_pattern_source(plan->pattern, p, error);
    double sum = 0;
    if (!source)
        return VNDF_ERROR_ARGUMENT;
    for (size_t i = 0; i < plan->slopes; i++) {
        double r = exp(plan->first + plan->step * (double)i), value = vndf_source_p22(source, r) * r * r;
        share[i] = value > 0 && value < HUGE_VAL ? value : 0;
        sum += share[i];
    }
    for (size_t i = 0; sum > 0 && i < plan->slopes; i++)
        share[i] /= sum;
    vndf_source_free(source);
    return VNDF_OK;
}

/* The largest distance at the probes between two knots; `low` is tabulated already. */
static vndf_status distance_between(const vndf_knots_plan *plan, double a, double b, double *found,
                                    vndf_error *error)
{
    const double *low = plan->scratch, *high = low + plan->slopes;
    double *own = plan->scratch + 2 * plan->slopes;
    *found = 0;
    for (int k = 1; k <= PROBES; k++) {
        double p = vndf_knots_between(a, b, (double)k / (PROBES + 1), plan->reciprocal), sum = 0;
        double t = vndf_family_weight(a, b, p, plan->reciprocal);
        vndf_status status = tabulate(plan, p, own, error);
        if (status != VNDF_OK)
            return status;
        for (size_t i = 0; i < plan->slopes; i++)
            sum += fabs((1 - t) * low[i] + t * high[i] - own[i]);
        *found = fmax(*found, sum / 2);
    }
    return VNDF_OK;
}

static vndf_status all_distances(const vndf_knots_plan *plan, size_t count, const double *knot, double *distance,
                                 vndf_error *error)
{
    vndf_status status = VNDF_OK;
    for (size_t i = 0; i + 1 < count && status == VNDF_OK; i++) {
        status = tabulate(plan, knot[i], plan->scratch, error);
        if (status == VNDF_OK)
            status = tabulate(plan, knot[i + 1], plan->scratch + plan->slopes, error);
        if (status == VNDF_OK)
            status = distance_between(plan, knot[i], knot[i + 1], &distance[i], error);
    }
    return status;
}

/* ---- places ---- */

/* Along log p; along p where that begins at 0 or below. */
static double place_of(const vndf_knots_plan *plan, double p)
{
    return plan->low > 0 ? log(p) : p;
}

static double number_at(const vndf_knots_plan *plan, double place)
{
    return vndf_pattern_number(plan->low > 0 ? exp(place) : place);
}

static void place_evenly(const vndf_knots_plan *plan, size_t count, double *knot)
{
    double from = place_of(plan, plan->low), to = place_of(plan, plan->high);
    for (size_t i = 1; i + 1 < count; i++)
        knot[i] = number_at(plan, from + (to - from) * (double)i / (double)(count - 1));
    knot[0] = plan->low;
    knot[count - 1] = plan->high;
}

/* New knots where the sum of roots, spread evenly between the old ones, reaches its parts. */
static void share_out(const vndf_knots_plan *plan, size_t count, const double *old, const double *distance,
                      double *knot)
{
    double whole = 0, before = 0;
    size_t i = 0;
    for (size_t k = 0; k + 1 < count; k++)
        whole += sqrt(distance[k]);
    for (size_t k = 1; k + 1 < count; k++) {
        double target = whole * (double)k / (double)(count - 1);
        while (i + 2 < count && before + sqrt(distance[i]) < target)
            before += sqrt(distance[i++]);
        double from = place_of(plan, old[i]), to = place_of(plan, old[i + 1]), root = sqrt(distance[i]);
        knot[k] = number_at(plan, from + (to - from) * (root > 0 ? fmin((target - before) / root, 1) : 0.5));
    }
    knot[0] = plan->low;
    knot[count - 1] = plan->high;
}

static int ascends(size_t count, const double *knot)
{
    for (size_t i = 0; i + 1 < count; i++)
        if (!((float)knot[i] < (float)knot[i + 1]))
            return 0;
    return 1;
}

static double largest(size_t count, const double *distance, double *mean)
{
    double most = 0, sum = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        most = fmax(most, distance[i]);
        sum += distance[i];
    }
    *mean = sum / (double)(count - 1);
    return most;
}

vndf_status vndf_knots_spread(const vndf_knots_plan *plan, size_t count, double *knot, double *worst,
                              vndf_error *error)
{
    double distance[VNDF_LIMIT_FAMILY_KNOTS], trial[VNDF_LIMIT_FAMILY_KNOTS], next[VNDF_LIMIT_FAMILY_KNOTS];
    *worst = HUGE_VAL;
    place_evenly(plan, count, trial);
    for (int sweep = 0; sweep < SWEEPS && ascends(count, trial); sweep++) {
        double mean;
        vndf_status status = all_distances(plan, count, trial, distance, error);
        if (status != VNDF_OK)
            return status;
        double most = largest(count, distance, &mean);
        for (size_t i = 0; i < count && most < *worst; i++)
            knot[i] = trial[i];
        *worst = fmin(*worst, most);
        if (most <= EVEN * mean)
            break;
        share_out(plan, count, trial, distance, next);
        for (size_t i = 0; i < count; i++)
            trial[i] = next[i];
    }
    if (*worst < HUGE_VAL)
        return VNDF_OK;
    return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                     "parameters from %.7g to %.7g are too close for %lu knots of seven digits", plan->low,
                     plan->high, (unsigned long)count);
}
