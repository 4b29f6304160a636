/* vndf_build_family: chooses the map, places knots on cheap sums, measures between them by quadrature, places more
 * where that finds more, and builds a table at each. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "fit/family/distance.h"
#include "fit/family/knots.h"
#include "fit/family/pattern.h"
#include "table/family/family.h"

static const double DISTANCE_DEFAULT = 1e-3;
static const double MAP_GAIN = 0.75; /* 1/p has to make the largest distance smaller by this */
static const double MARGIN = 0.97;   /* knots are placed for a little less than they must reach */
enum { PROBES = VNDF_FAMILY_PROBES, TRIALS = 8, MAP_KNOTS = 9 };

/* Parts of the progress. */
static const double PLACED = 0.02, MEASURED = 0.2;

typedef struct builder {
    const char *pattern;
    vndf_family_options options;
    vndf_knots_plan plan;
    vndf_member low, middle, high;
    size_t count;
    double knot[VNDF_LIMIT_FAMILY_KNOTS];
    float distance[VNDF_LIMIT_FAMILY_KNOTS];
    double worst, grazing;
    double begin, end; /* of the stage at hand, as parts of all the work */
    char stage[48];
} builder;

/* ---- progress ---- */

static int show(double done, const char *what, void *user)
{
    builder *b = user;
    char text[128];
    snprintf(text, sizeof text, "%s%s%s", b->stage, what ? ": " : "", what ? what : "");
    return b->options.progress
               ? b->options.progress(b->begin + (b->end - b->begin) * done, text, b->options.progress_user)
               : 0;
}

static vndf_status interrupted(const builder *b, vndf_error *error)
{
    return vndf_fail(error, VNDF_ERROR_ARGUMENT, "interrupted (%s)", b->stage);
}

static vndf_status enter(builder *b, double begin, double end, const char *stage, vndf_error *error)
{
    b->begin = begin;
    b->end = end;
    snprintf(b->stage, sizeof b->stage, "%s", stage);
    return show(0, NULL, b) ? interrupted(b, error) : VNDF_OK;
}

static vndf_status no_memory(vndf_error *error)
{
    return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to build a family");
}

/* ---- distances ---- */

static vndf_status measure_probe(builder *b, const vndf_member *low, const vndf_member *high, int probe,
                                 vndf_distances *found, vndf_error *error)
{
    vndf_member member = {0, NULL, NULL};
    double p = vndf_knots_between(low->p, high->p, (double)probe / (PROBES + 1), b->plan.reciprocal);
    double t = vndf_family_weight(low->p, high->p, p, b->plan.reciprocal);
    vndf_status status = vndf_member_open(&member, b->pattern, p, error);
    if (status == VNDF_OK && !vndf_distance_at(low, high, &member, t, found))
        status = no_memory(error);
    vndf_member_close(&member);
    return status;
}

static vndf_status measure_interval(builder *b, const vndf_member *low, const vndf_member *high, size_t index,
                                    vndf_error *error)
{
    double slopes = 0;
    for (int probe = 1; probe <= PROBES; probe++) {
        vndf_distances found;
        vndf_status status = measure_probe(b, low, high, probe, &found, error);
        if (status != VNDF_OK)
            return status;
        slopes = fmax(slopes, found.slopes);
        b->grazing = fmax(b->grazing, found.grazing);
        if (show((double)(index * PROBES + (size_t)probe) / (double)((b->count - 1) * PROBES), NULL, b))
            return interrupted(b, error);
    }
    b->worst = fmax(b->worst, slopes);
    b->distance[index] = (float)fmin(slopes, 1);
    return VNDF_OK;
}

/* Between all knots. */
static vndf_status measure(builder *b, vndf_error *error)
{
    vndf_member low = {0, NULL, NULL}, high = {0, NULL, NULL};
    vndf_status status = enter(b, PLACED, MEASURED, "distances between knots", error);
    b->worst = b->grazing = 0;
    if (status == VNDF_OK)
        status = vndf_member_open(&low, b->pattern, b->knot[0], error);
    for (size_t i = 0; i + 1 < b->count && status == VNDF_OK; i++) {
        status = vndf_member_open(&high, b->pattern, b->knot[i + 1], error);
        if (status == VNDF_OK)
            status = measure_interval(b, &low, &high, i, error);
        vndf_member_close(&low);
        low = high;
        high = (vndf_member){0, NULL, NULL};
    }
    vndf_member_close(&low);
    return status;
}

/* ---- knots ---- */

static vndf_status choose_map(builder *b, vndf_error *error)
{
    double linear, reciprocal;
    vndf_status status = vndf_knots_spread(&b->plan, MAP_KNOTS, b->knot, &linear, error);
    if (status != VNDF_OK || !(b->plan.low > 0))
        return status;
    b->plan.reciprocal = 1;
    status = vndf_knots_spread(&b->plan, MAP_KNOTS, b->knot, &reciprocal, error);
    b->plan.reciprocal = reciprocal < MAP_GAIN * linear;
    return status;
}

static vndf_status too_many(const builder *b, double worst, vndf_error *error)
{
    return vndf_fail(error, VNDF_ERROR_TARGET,
                     "a distance of %g between family and mixture cannot be met: %lu knots reach %.3g",
                     b->options.max_distance, (unsigned long)b->count, worst);
}

/* The next number of knots to try: the distance falls as the square of their number. */
static size_t more_knots(size_t count, double worst, double target)
{
    double more = 1 + ceil((double)(count - 1) * sqrt(worst / target));
    return more < VNDF_LIMIT_FAMILY_KNOTS ? (size_t)fmax(more, (double)(count + 1)) : VNDF_LIMIT_FAMILY_KNOTS;
}

/* Fewest knots whose cheap distance is at most `target`, from b->count knots on. */
static vndf_status place_for(builder *b, double target, vndf_error *error)
{
    double worst;
    for (;;) {
        vndf_status status = vndf_knots_spread(&b->plan, b->count, b->knot, &worst, error);
        if (status != VNDF_OK || worst <= target)
            return status;
        if (b->count == VNDF_LIMIT_FAMILY_KNOTS)
            return too_many(b, worst, error);
        b->count = more_knots(b->count, worst, target);
    }
}

/* The estimate may be one or two knots too many. */
static vndf_status drop_knots(builder *b, double target, vndf_error *error)
{
    double fewer[VNDF_LIMIT_FAMILY_KNOTS], worst = 0;
    while (b->count > 2) {
        vndf_status status = vndf_knots_spread(&b->plan, b->count - 1, fewer, &worst, error);
        if (status != VNDF_OK || worst > target)
            return status;
        memcpy(b->knot, fewer, (--b->count) * sizeof *fewer);
    }
    return VNDF_OK;
}

static vndf_status reach_distance(builder *b, vndf_error *error)
{
    double target = MARGIN * b->options.max_distance;
    b->count = 2;
    for (int trial = 0; trial < TRIALS; trial++) {
        vndf_status status = place_for(b, target, error);
        if (status == VNDF_OK && trial == 0)
            status = drop_knots(b, target, error);
        if (status == VNDF_OK)
            status = measure(b, error);
        if (status != VNDF_OK || b->worst <= b->options.max_distance)
            return status;
        target *= MARGIN * b->options.max_distance / b->worst;
        if (b->count < VNDF_LIMIT_FAMILY_KNOTS)
            b->count++;
    }
    return too_many(b, b->worst, error);
}

static vndf_status place(builder *b, vndf_error *error)
{
    vndf_status status = enter(b, 0, PLACED, "placing knots", error);
    if (status == VNDF_OK && !vndf_knots_plan_from(&b->plan, b->pattern, &b->low, &b->middle, &b->high))
        status = no_memory(error);
    if (status == VNDF_OK)
        status = choose_map(b, error);
    if (status != VNDF_OK || !b->options.knots)
        return status == VNDF_OK ? reach_distance(b, error) : status;
    b->count = b->options.knots;
    status = vndf_knots_spread(&b->plan, b->count, b->knot, &b->worst, error);
    return status == VNDF_OK ? measure(b, error) : status;
}

/* ---- tables ---- */

static vndf_status build_table(builder *b, vndf_family *family, size_t index, vndf_error *error)
{
    char stage[48];
    double width = (1 - MEASURED) / (double)b->count, begin = MEASURED + width * (double)index;
    vndf_build_options options = {
        .max_bytes = b->options.max_bytes, .moments = b->options.moments, .progress = show, .progress_user = b};
    vndf_error inner = {VNDF_OK, ""};
    snprintf(stage, sizeof stage, "table %lu of %lu", (unsigned long)index + 1, (unsigned long)b->count);
    vndf_status status = enter(b, begin, begin + width, stage, error);
    if (status != VNDF_OK)
        return status;
    vndf_source *source = vndf_pattern_source(b->pattern, b->knot[index], &inner);
    family->parameter[index] = (float)b->knot[index];
    family->distance[index] = index + 1 < b->count ? b->distance[index] : 0.0f;
    family->distribution[index] = source ? vndf_build(source, &options, NULL, &inner) : NULL;
    vndf_source_free(source);
    return family->distribution[index]
               ? VNDF_OK
               : vndf_fail(error, inner.status, "at the parameter %.7g: %s", b->knot[index], inner.message);
}

static vndf_status finish(builder *b, vndf_family *family, vndf_error *error)
{
    static const char tool[] = "vndf " VNDF_VERSION;
    family->owns = 1;
    family->reciprocal = b->plan.reciprocal;
    family->grazing = (float)fmin(b->grazing, 1);
    family->source = vndf_pattern_describe(b->pattern, b->plan.low, b->plan.high, error);
    family->tool = malloc(sizeof tool);
    if (!family->source || !family->tool)
        return no_memory(error);
    memcpy(family->tool, tool, sizeof tool);
    for (size_t i = 0; i < b->count; i++) {
        vndf_status status = build_table(b, family, i, error);
        if (status != VNDF_OK)
            return status;
    }
    family->bytes = vndf_family_encode(family, NULL, 0);
    if (family->bytes > VNDF_LIMIT_FAMILY_BYTES)
        return vndf_fail(error, VNDF_ERROR_TARGET, "%lu tables take %lu bytes; at most %d are possible",
                         (unsigned long)b->count, (unsigned long)family->bytes, VNDF_LIMIT_FAMILY_BYTES);
    return VNDF_OK;
}

/* ---- the call ---- */

static vndf_status check(const char *pattern, double low, double high, const vndf_family_options *options,
                         vndf_error *error)
{
    vndf_status status = vndf_pattern_check(pattern, error);
    if (status != VNDF_OK)
        return status;
    if (!(low < high && fabs(low) < 1e30 && fabs(high) < 1e30) || (float)low == (float)high)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "parameters from %.7g to %.7g: the first must be below the second, as floats, and both "
                         "between -1e30 and 1e30",
                         low, high);
    if (options->knots == 1 || options->knots > VNDF_LIMIT_FAMILY_KNOTS)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "knots is %lu; from 2 to %d is possible",
                         (unsigned long)options->knots, VNDF_LIMIT_FAMILY_KNOTS);
    if (!(options->max_distance >= 0.0 && options->max_distance < 1.0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "max_distance is %g; it is a total variation, from 0 (none) to below 1",
                         options->max_distance);
    if (options->knots && options->max_distance > 0.0)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "knots and max_distance are given; one of them is possible");
    return VNDF_OK;
}

static vndf_status open_members(builder *b, double low, double high, vndf_error *error)
{
    double middle = low > 0 ? exp(0.5 * (log(low) + log(high))) : 0.5 * (low + high);
    vndf_status status = vndf_member_open(&b->low, b->pattern, vndf_pattern_number(low), error);
    if (status == VNDF_OK)
        status = vndf_member_open(&b->high, b->pattern, vndf_pattern_number(high), error);
    if (status == VNDF_OK)
        status = vndf_member_open(&b->middle, b->pattern, vndf_pattern_number(middle), error);
    return status;
}

static vndf_family *build(builder *b, double low, double high, vndf_error *error)
{
    vndf_status status = open_members(b, low, high, error);
    if (status == VNDF_OK)
        status = place(b, error);
    vndf_family *family = status == VNDF_OK ? vndf_family_allocate(b->count) : NULL;
    if (status == VNDF_OK && !family)
        no_memory(error);
    if (family && finish(b, family, error) == VNDF_OK)
        return family;
    vndf_family_free(family);
    return NULL;
}

vndf_family *vndf_build_family(const char *specification, double low, double high,
                               const vndf_family_options *options, vndf_error *error)
{
    vndf_family_options none = {0}, given = options ? *options : none;
    if (check(specification, low, high, &given, error) != VNDF_OK)
        return NULL;
    if (!given.knots && !(given.max_distance > 0.0))
        given.max_distance = DISTANCE_DEFAULT;
    builder *b = calloc(1, sizeof *b);
    if (!b) {
        no_memory(error);
        return NULL;
    }
    b->pattern = specification;
    b->options = given;
    vndf_family *family = build(b, low, high, error);
    vndf_knots_plan_free(&b->plan);
    vndf_member_close(&b->low);
    vndf_member_close(&b->middle);
    vndf_member_close(&b->high);
    free(b);
    return family;
}
