/* vndf_build_family: chooses knots along a parameter so that the distances between the family and the mixtures of
 * neighbouring knots are about the same and the largest is small, then builds a table at each.
 *
 * The family is tabulated once, on a fine grid of parameters, at slopes even in log r, where sums converge fast:
 * families are smooth there, and features that are no wider than a slope step are refused or resolved when tables are
 * built. Distances between points of the grid need no more. From each knot the next one is as far as a distance allows;
 * for so many knots that distance is halved between what is enough and what is not.
 *
 * A family of sources along one number is a specification (vndf_source_family) with {p} in the place of the number; a
 * name alone, "student-t", is "student-t:{p}". */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fit/profile/profile.h"
#include "source/source.h"
#include "source/words.h"
#include "table/family/family.h"

static const char PLACE[] = "{p}";

enum { KNOTS_MOST = VNDF_LIMIT_FAMILY_KNOTS, PROBES = VNDF_FAMILY_PROBES, MAP_KNOTS = 9, GRID = 1024 };
enum { SLOPES_TO_E = 16, SLOPES = SLOPES_TO_E * 94 }; /* VNDF_SOURCE_MANY at a time */
static const double SLOPE_LEAST = 1e-13;              /* the largest is 7e27 */
static const double DISTANCE_DEFAULT = 1e-3;
static const double MAP_GAIN = 0.75; /* 1/p has to make the largest distance smaller by this */
static const double PLACED = 0.1;    /* of the progress */

/* P22 at a parameter: shares of the slopes, and the mean slope. */
typedef struct point {
    double p, mean, share[SLOPES];
} point;

typedef struct builder {
    vndf_guard guard;
    const char *pattern;
    vndf_family_options options;
    double low, high;
    int reciprocal; /* mixtures are linear in 1/p */
    double slope[SLOPES];
    point grid[GRID + 1]; /* parameters ascend, as floats do, to that of `last` */
    size_t last;
    size_t count, knot[KNOTS_MOST + 1]; /* places in the grid */
    double begin, width;                /* of the table at hand, as parts of all the work */
    char stage[48];
} builder;

/* What a table's build shows, as a part of the whole. */
static int show(double done, const char *what, void *user)
{
    builder *b = user;
    char text[128];
    snprintf(text, sizeof text, "%s: %s", b->stage, what);
    return b->options.progress ? b->options.progress(b->begin + b->width * done, text, b->options.progress_user)
                               : 0;
}

/* ---- the grid ---- */

/* With seven digits: what the grid is rounded to, so that a specification shows all of them. */
static double number_of(double p)
{
    char text[VNDF_NUMBER_TEXT];
    snprintf(text, sizeof text, "%.6e", p);
    return strtod(text, NULL);
}

/* The source at p, whose number takes the places in the pattern. */
static vndf_source *source_at(builder *b, double p)
{
    const char *pattern = b->pattern, *place;
    int alone = !strchr(pattern, ':');
    vndf_error error = {VNDF_OK, ""};
    vndf_writer text = {NULL, 0, 0, 0};
    for (; (place = strstr(pattern, PLACE)) != NULL; pattern = place + strlen(PLACE)) {
        vndf_write_bytes(&text, pattern, (size_t)(place - pattern));
        vndf_text_add_number(&text, p);
    }
    vndf_text_add(&text, pattern);
    if (alone) {
        vndf_text_add(&text, ":");
        vndf_text_add_number(&text, p);
    }
    char *specification = vndf_text_finish(&text, &error);
    vndf_source *source = specification ? vndf_source_family(specification, &error) : NULL;
    if (!source)
        vndf_fail(vndf_guard_why(&b->guard), error.status, "at the parameter %.7g: %s", p, error.message);
    free(specification);
    return source;
}

static void tabulate(builder *b, double p, point *to)
{
    vndf_source *source = source_at(b, p);
    double sum = 0, along = 0;
    for (size_t i = 0; i < SLOPES && source; i += VNDF_SOURCE_MANY)
        source->p22(source, &b->slope[i], VNDF_SOURCE_MANY, &to->share[i]);
    for (size_t i = 0; i < SLOPES && source; i++) {
        double value = to->share[i] * b->slope[i] * b->slope[i];
        to->share[i] = value > 0 && value < HUGE_VAL ? value : 0;
        sum += to->share[i];
        along += to->share[i] * b->slope[i];
    }
    for (size_t i = 0; sum > 0 && i < SLOPES; i++)
        to->share[i] /= sum;
    to->mean = sum > 0 ? along / sum : 1;
    to->p = p;
    vndf_source_free(source);
}

/* Even in log p, or in p where that begins at 0 or below. */
static void make_grid(builder *b)
{
    for (size_t i = 0; i < SLOPES; i++)
        b->slope[i] = SLOPE_LEAST * exp((double)i / SLOPES_TO_E);
    tabulate(b, b->low, &b->grid[0]);
    for (size_t i = 1; i < GRID && !vndf_guard_stopped(&b->guard); i++) {
        double part = (double)i / GRID, p = number_of(b->low > 0 ? b->low * pow(b->high / b->low, part)
                                                                 : b->low + part * (b->high - b->low));
        if ((float)p > (float)b->grid[b->last].p && (float)p < (float)b->high)
            tabulate(b, p, &b->grid[++b->last]);
        vndf_guard_stage(&b->guard, PLACED * part, "placing knots");
    }
    if (!vndf_guard_stopped(&b->guard))
        tabulate(b, b->high, &b->grid[++b->last]);
}

/* ---- knots ---- */

/* The distance between two points at the probes between them; that at grazing incidence, if it is larger. */
static double distance_of(const builder *b, size_t from, size_t to, double *grazing)
{
    const point *left = &b->grid[from], *right = &b->grid[to];
    double worst = 0;
    for (size_t k = 1, at; k <= PROBES; k++) {
        if ((at = from + (to - from) * k / (PROBES + 1)) == from)
            continue;
        const point *own = &b->grid[at];
        double t = vndf_family_weight(left->p, right->p, own->p, b->reciprocal), sum = 0, along = 0,
               mean = (1 - t) * left->mean + t * right->mean;
        for (size_t n = 0; n < SLOPES; n++) {
            double mixed = (1 - t) * left->share[n] + t * right->share[n];
            sum += fabs(mixed - own->share[n]);
            along += fabs(mixed / mean - own->share[n] / own->mean) * b->slope[n];
        }
        worst = fmax(worst, sum / 2);
        *grazing = fmax(*grazing, along / 2);
    }
    return worst;
}

/* Knots for a distance, until there are more than `most`; returns whether there are not. */
static int march(builder *b, double distance, size_t most)
{
    size_t from = 0, step = 1;
    double unused = 0;
    for (b->count = 1; from < b->last && b->count <= most; b->knot[b->count++] = from) {
        size_t good = from + 1, bad = b->last + 1;
        for (size_t to = from + step; good + 1 < bad; to = bad > b->last ? 2 * to - from : (good + bad) / 2) {
            to = to > b->last ? b->last : to <= good ? good + 1 : to;
            *(distance_of(b, from, to, &unused) <= distance ? &good : &bad) = to;
        }
        step = good - from;
        from = good;
    }
    return from == b->last && b->count <= most;
}

/* Places so many knots for the least distance, which it returns. */
static double spread_knots(builder *b, size_t count)
{
    const double close = 1.01, nothing = 1e-12;
    double low = 0, unused = 0, high = distance_of(b, 0, b->last, &unused);
    while (high > close * low && high > nothing && !vndf_guard_stopped(&b->guard)) {
        double middle = low > 0 ? sqrt(low * high) : high / 4;
        *(march(b, middle, count) ? &high : &low) = middle;
        vndf_guard_stage(&b->guard, PLACED, "placing knots");
    }
    march(b, high, count);
    while (b->count < count) { /* the grid may be too coarse for the last ones: in the middle of the widest gap */
        size_t widest = 0;
        for (size_t i = 0; i + 1 < b->count; i++)
            widest = b->knot[i + 1] - b->knot[i] > b->knot[widest + 1] - b->knot[widest] ? i : widest;
        memmove(&b->knot[widest + 2], &b->knot[widest + 1], (b->count++ - widest - 1) * sizeof *b->knot);
        b->knot[widest + 1] = (b->knot[widest] + b->knot[widest + 2]) / 2;
    }
    return high;
}

/* Chooses between mixtures that are linear in p and in 1/p, then places as few knots as reach the distance, or as many
 * as are wanted. */
static void place(builder *b)
{
    double target = b->options.max_distance, distance[2] = {0, 0};
    make_grid(b);
    if (vndf_guard_stopped(&b->guard))
        return;
    for (b->reciprocal = 0; b->low > 0 && b->last >= MAP_KNOTS && b->reciprocal < 2; b->reciprocal++)
        distance[b->reciprocal] = spread_knots(b, MAP_KNOTS);
    b->reciprocal = distance[1] < MAP_GAIN * distance[0];
    size_t knots = b->options.knots;
    if (!knots && !march(b, target, KNOTS_MOST))
        vndf_fail(vndf_guard_why(&b->guard), VNDF_ERROR_TARGET,
                  "a distance of %g between family and mixture cannot be met: %d knots reach %.3g", target,
                  KNOTS_MOST, spread_knots(b, KNOTS_MOST));
    else if (knots > b->last + 1)
        vndf_fail(vndf_guard_why(&b->guard), VNDF_ERROR_ARGUMENT,
                  "parameters from %.7g to %.7g are too close for %lu knots of seven digits", b->low, b->high,
                  (unsigned long)knots);
    else
        spread_knots(b, knots ? knots : b->count);
}

/* ---- tables ---- */

static void fill(builder *b, vndf_family *family)
{
    const vndf_build_options options = {
        .max_bytes = b->options.max_bytes, .moments = b->options.moments, .progress = show, .progress_user = b};
    char tail[96], low[VNDF_NUMBER_TEXT], high[VNDF_NUMBER_TEXT];
    snprintf(tail, sizeof tail, " --parameter %s..%s", vndf_number_print(low, b->low),
             vndf_number_print(high, b->high));
    family->owns = 1;
    family->reciprocal = b->reciprocal;
    family->source = vndf_text_pair("--family", b->pattern, tail, vndf_guard_why(&b->guard));
    family->tool = vndf_text_pair("vndf", VNDF_VERSION, "", vndf_guard_why(&b->guard));
    b->width = (1 - PLACED) / (double)b->count;
    double grazing = 0;
    for (size_t i = 0; i < b->count; i++) {
        vndf_error inner = {VNDF_OK, ""};
        double p = b->grid[b->knot[i]].p, distance = 0;
        b->begin = PLACED + b->width * (double)i;
        snprintf(b->stage, sizeof b->stage, "table %lu of %lu", (unsigned long)i + 1, (unsigned long)b->count);
        vndf_guard_stage(&b->guard, b->begin, b->stage);
        if (vndf_guard_stopped(&b->guard))
            return;
        vndf_source *source = source_at(b, p);
        family->parameter[i] = (float)p;
        if (i + 1 < b->count)
            distance = distance_of(b, b->knot[i], b->knot[i + 1], &grazing);
        family->distance[i] = (float)fmin(distance, 1);
        family->distribution[i] = source ? vndf_build(source, &options, NULL, &inner) : NULL;
        vndf_source_free(source);
        if (!family->distribution[i])
            vndf_fail(vndf_guard_why(&b->guard), inner.status, "at the parameter %.7g: %s", p, inner.message);
    }
    if (vndf_guard_stopped(&b->guard))
        return;
    family->grazing = (float)fmin(grazing, 1);
    family->bytes = vndf_family_size(family);
}

/* ---- the call ---- */

static vndf_status check(const char *pattern, double low, double high, const vndf_family_options *options,
                         vndf_error *error)
{
    char excerpt[VNDF_EXCERPT];
    if (!pattern)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the family's name is NULL");
    if (strchr(pattern, ':') && !strstr(pattern, PLACE))
        return vndf_fail(error, VNDF_ERROR_SYNTAX,
                         "'%s' does not say where the parameter stands; right would be {p} in its place, as in "
                         "abc:{p},0.8, or a name alone, as in student-t",
                         vndf_excerpt(excerpt, pattern, strlen(pattern)));
    if (!(fabs(low) < 1e30 && fabs(high) < 1e30 && (float)number_of(low) < (float)number_of(high)))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "parameters from %.7g to %.7g: the first must be below the second, as floats, and both "
                         "between -1e30 and 1e30",
                         low, high);
    if (options->knots == 1 || options->knots > KNOTS_MOST)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "knots is %lu; from 2 to %d is possible",
                         (unsigned long)options->knots, KNOTS_MOST);
    if (!(options->max_distance >= 0.0 && options->max_distance < 1.0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "max_distance is %g; it is a total variation, from 0 (none) to below 1",
                         options->max_distance);
    if (options->knots && options->max_distance > 0.0)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "knots and max_distance are given; one of them is possible");
    return VNDF_OK;
}

vndf_family *vndf_build_family(const char *specification, double low, double high,
                               const vndf_family_options *options, vndf_error *error)
{
    const vndf_family_options none = {0};
    options = options ? options : &none;
    if (check(specification, low, high, options, error) != VNDF_OK)
        return NULL;
    builder *b = calloc(1, sizeof *b);
    if (!b)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to build a family"), NULL;
    b->guard = vndf_guard_from(options->progress, options->progress_user);
    b->pattern = specification;
    b->options = *options;
    if (!options->knots && !(options->max_distance > 0.0))
        b->options.max_distance = DISTANCE_DEFAULT;
    b->low = number_of(low);
    b->high = number_of(high);
    place(b);
    vndf_family *family = vndf_guard_stopped(&b->guard) ? NULL : vndf_family_allocate(b->count);
    if (family)
        fill(b, family);
    else
        vndf_guard_starve(&b->guard);
    if (vndf_guard_status(&b->guard, error) != VNDF_OK) {
        vndf_family_free(family);
        family = NULL;
    }
    free(b);
    return family;
}
