/* vndf_build_family: places knots along a parameter so that the distances between the family and the mixtures of
 * neighbouring knots are about the same and the largest is small, then builds a table at each.
 *
 * P22 is tabulated at slopes that are even in log r, where sums converge fast: families are smooth there, and features
 * that are no wider than a slope step are refused or resolved when tables are built. The distance between two knots
 * grows as the square of the way between them: its root is shared out evenly, again and again, as de Boor shares out
 * knots of splines ("Good approximation by splines with variable knots", 1973).
 *
 * A family of sources along one number is a specification (vndf_source_family) with {p} in the place of the number; a
 * name alone, "student-t", is "student-t:{p}". */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fit/guard.h"
#include "source/words.h"
#include "table/family/family.h"

static const char PLACE[] = "{p}";

enum { KNOTS_MOST = VNDF_LIMIT_FAMILY_KNOTS, PROBES = VNDF_FAMILY_PROBES, MAP_KNOTS = 9, SWEEPS = 12 };
enum { SLOPES_TO_E = 16, SLOPES = SLOPES_TO_E * 94 };
static const double SLOPE_LEAST = 1e-13; /* the largest is 7e27 */
static const double DISTANCE_DEFAULT = 1e-3;
static const double MAP_GAIN = 0.75; /* 1/p has to make the largest distance smaller by this */
static const double EVEN = 1.03;     /* largest over mean distance: good enough */
static const double PLACED = 0.1;    /* of the progress */

/* Knots, the distances between them, and the largest. */
typedef struct spread {
    double knot[KNOTS_MOST], distance[KNOTS_MOST], worst, grazing;
} spread;

/* P22 at some parameter: shares of the slopes, and of the normals that are visible at grazing incidence. */
typedef struct shares {
    double slope[SLOPES], grazing; /* grazing: the mean slope */
} shares;

typedef struct builder {
    vndf_guard guard;
    const char *pattern;
    vndf_family_options options;
    double low, high;
    int reciprocal; /* mixtures are linear in 1/p */
    shares left, right, own;
    size_t count;
    spread spread, trial;
    double begin, width; /* of the stage at hand, as parts of all the work */
    char stage[48];
} builder;

/* What a table's build shows, as a part of the whole. */
static int show(double done, const char *what, void *user)
{
    builder *b = user;
    char text[128];
    snprintf(text, sizeof text, "%s%s%s", b->stage, what ? ": " : "", what ? what : "");
    return b->options.progress ? b->options.progress(b->begin + b->width * done, text, b->options.progress_user)
                               : 0;
}

/* ---- distances ---- */

/* With seven digits: what knots and probes are rounded to, so that a specification shows all of them. */
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
    int alone = !strchr(pattern, ':') && !strstr(pattern, PLACE);
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

static double slope_at(size_t i)
{
    return SLOPE_LEAST * exp((double)i / SLOPES_TO_E);
}

static void tabulate(builder *b, double p, shares *to)
{
    vndf_source *source = source_at(b, p);
    double sum = 0, along = 0;
    if (!source)
        return;
    for (size_t i = 0; i < SLOPES; i++) {
        double r = slope_at(i), value = vndf_source_p22(source, r) * r * r;
        to->slope[i] = value > 0 && value < HUGE_VAL ? value : 0;
        sum += to->slope[i];
        along += to->slope[i] * r;
    }
    for (size_t i = 0; sum > 0 && i < SLOPES; i++)
        to->slope[i] /= sum;
    to->grazing = sum > 0 ? along / sum : 1;
    vndf_source_free(source);
}

/* The distances between all knots, at the probes. */
static void measure(builder *b, spread *s)
{
    const shares *left = &b->left, *right = &b->right, *own = &b->own;
    tabulate(b, s->knot[0], &b->right);
    s->worst = s->grazing = 0;
    for (size_t i = 0; i + 1 < b->count && !vndf_guard_stopped(&b->guard); i++) {
        double low = s->knot[i], high = s->knot[i + 1];
        b->left = b->right;
        tabulate(b, high, &b->right);
        s->distance[i] = 0;
        for (int k = 1; k <= PROBES && !vndf_guard_stopped(&b->guard); k++) {
            double part = (double)k / (PROBES + 1), sum = 0, along = 0; /* the weight of the upper knot */
            double p = b->reciprocal ? low * high / (high - part * (high - low)) : low + part * (high - low);
            double t = vndf_family_weight(low, high, p, b->reciprocal);
            double grazing = (1 - t) * left->grazing + t * right->grazing;
            tabulate(b, p, &b->own);
            for (size_t n = 0; n < SLOPES; n++) {
                double mixed = (1 - t) * left->slope[n] + t * right->slope[n];
                sum += fabs(mixed - own->slope[n]);
                along += fabs(mixed / grazing - own->slope[n] / own->grazing) * slope_at(n);
            }
            s->distance[i] = fmax(s->distance[i], sum / 2);
            s->grazing = fmax(s->grazing, along / 2);
        }
        vndf_guard_stage(&b->guard, b->begin, b->stage);
        s->worst = fmax(s->worst, s->distance[i]);
    }
}

/* ---- knots ---- */

/* Moves knots to where the sum of roots, spread evenly between the old ones, reaches its parts; along log p, or along p
 * where that begins at 0 or below. At first the old ones are both ends. 0 if floats do not tell the new ones apart. */
static int share_out(const builder *b, const spread *old, spread *s)
{
    double whole = 0, before = 0;
    size_t i = 0, n = b->count;
    int ascends = 1;
    for (size_t k = 0; k + 1 < n; k++)
        whole += sqrt(old->distance[k]);
    s->knot[0] = b->low;
    s->knot[n - 1] = b->high;
    for (size_t k = 1; k + 1 < n; k++) {
        double target = whole * (double)k / (double)(n - 1);
        while (i + 2 < n && before + sqrt(old->distance[i]) < target)
            before += sqrt(old->distance[i++]);
        double from = old->knot[i], to = old->knot[i + 1], root = sqrt(old->distance[i]);
        double part = root > 0 ? fmin((target - before) / root, 1) : 0.5;
        s->knot[k] = number_of(b->low > 0 ? from * pow(to / from, part) : from + (to - from) * part);
    }
    for (size_t k = 0; k + 1 < n; k++)
        ascends &= (float)s->knot[k] < (float)s->knot[k + 1];
    return ascends;
}

/* Places b->count knots for the least distance; 0 if the build must end. */
static int spread_knots(builder *b)
{
    spread *s = &b->trial, old = {.knot = {b->low, b->high}, .distance = {1}};
    b->spread.worst = HUGE_VAL;
    for (int sweep = 0; sweep < SWEEPS && share_out(b, &old, s); sweep++) {
        measure(b, s);
        if (vndf_guard_stopped(&b->guard))
            return 0;
        double sum = 0;
        for (size_t i = 0; i + 1 < b->count; i++)
            sum += s->distance[i];
        if (s->worst < b->spread.worst)
            b->spread = *s;
        if (s->worst * (double)(b->count - 1) <= EVEN * sum)
            break;
        old = *s;
    }
    if (b->spread.worst == HUGE_VAL)
        vndf_fail(vndf_guard_why(&b->guard), VNDF_ERROR_ARGUMENT,
                  "parameters from %.7g to %.7g are too close for %lu knots of seven digits", b->low, b->high,
                  (unsigned long)b->count);
    return !vndf_guard_stopped(&b->guard);
}

/* About as few knots as reach the distance, which falls as the square of their number: an estimate from below, then one
 * by one. */
static void reach_distance(builder *b)
{
    double target = b->options.max_distance;
    for (b->count = 2; spread_knots(b) && b->spread.worst > target;) {
        double more = 1 + floor((double)(b->count - 1) * sqrt(b->spread.worst / target));
        if (b->count == KNOTS_MOST) {
            vndf_fail(vndf_guard_why(&b->guard), VNDF_ERROR_TARGET,
                      "a distance of %g between family and mixture cannot be met: %d knots reach %.3g", target,
                      KNOTS_MOST, b->spread.worst);
            return;
        }
        b->count = (size_t)fmin(fmax(more, (double)b->count + 1), KNOTS_MOST);
    }
}

/* Chooses between mixtures that are linear in p and in 1/p, then places knots. */
static void place(builder *b)
{
    double linear = 0;
    b->width = PLACED;
    snprintf(b->stage, sizeof b->stage, "placing knots");
    vndf_guard_stage(&b->guard, b->begin, b->stage);
    b->count = MAP_KNOTS;
    for (int map = 0; map < 2 && b->low > 0 && !vndf_guard_stopped(&b->guard); map++) {
        linear = b->spread.worst;
        b->reciprocal = map;
        spread_knots(b);
    }
    b->reciprocal = b->low > 0 && b->spread.worst < MAP_GAIN * linear;
    b->count = b->options.knots;
    if (vndf_guard_stopped(&b->guard))
        return;
    if (b->count)
        spread_knots(b);
    else
        reach_distance(b);
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
    family->grazing = (float)fmin(b->spread.grazing, 1);
    family->source = vndf_text_pair("--family", b->pattern, tail, vndf_guard_why(&b->guard));
    family->tool = vndf_text_pair("vndf", VNDF_VERSION, "", vndf_guard_why(&b->guard));
    b->width = (1 - PLACED) / (double)b->count;
    for (size_t i = 0; i < b->count; i++) {
        vndf_error inner = {VNDF_OK, ""};
        double p = b->spread.knot[i];
        b->begin = PLACED + b->width * (double)i;
        snprintf(b->stage, sizeof b->stage, "table %lu of %lu", (unsigned long)i + 1, (unsigned long)b->count);
        vndf_guard_stage(&b->guard, b->begin, b->stage);
        if (vndf_guard_stopped(&b->guard))
            return;
        vndf_source *source = source_at(b, p);
        family->parameter[i] = (float)p;
        family->distance[i] = i + 1 < b->count ? (float)fmin(b->spread.distance[i], 1) : 0.0f;
        family->distribution[i] = source ? vndf_build(source, &options, NULL, &inner) : NULL;
        vndf_source_free(source);
        if (!family->distribution[i])
            vndf_fail(vndf_guard_why(&b->guard), inner.status, "at the parameter %.7g: %s", p, inner.message);
    }
    if (vndf_guard_stopped(&b->guard))
        return;
    family->bytes = vndf_family_size(family);
    if (family->bytes > VNDF_LIMIT_FAMILY_BYTES)
        vndf_fail(vndf_guard_why(&b->guard), VNDF_ERROR_TARGET,
                  "%lu tables take %lu bytes; at most %d are possible", (unsigned long)b->count,
                  (unsigned long)family->bytes, VNDF_LIMIT_FAMILY_BYTES);
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
    if (!(low < high && fabs(low) < 1e30 && fabs(high) < 1e30) || (float)low == (float)high)
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
