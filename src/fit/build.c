/* vndf_build: resolves the source, places knots as far as the size allows, takes as few as reach the target, and
 * measures the table. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "fit/draft.h"

enum { BYTES_DEFAULT = 8192, BYTES_LEAST = 2048, BYTES_MOST = 1 << 20, MOMENTS_DEFAULT = 4, CELLS_LEAST = 2 };

/* Some 62 knots: a smaller table would not be faster, since lanes hold 64 of them in registers. */
enum { BYTES_ENOUGH = 3000 };

static const double TV_DEFAULT = 1e-3;
static const double BELOW = 30; /* times the total variation above the horizon may be reached below it */
static const char TOOL[] = "vndf " VNDF_VERSION;

/* A build at work. */
typedef struct builder {
    const vndf_profile *profile;
    vndf_knots knots;
    size_t least_bytes, max_bytes; /* a smaller table than the first is not looked for */
    double max_tv;                 /* 0: the best that fits */
    unsigned moments;
    vndf_distribution *table; /* the last that was tried; NULL if the build must end */
} builder;

/* ---- tables ---- */

/* The total variations over those asked for, the larger of both. */
static double excess_of(const vndf_certificate *c, double tv)
{
    return tv > 0 ? fmax((double)c->tv_above, (double)c->tv / BELOW) / tv : 0;
}

/* Of no text an empty one. */
static char *copy_of(const char *text)
{
    text = text ? text : "";
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    return copy ? memcpy(copy, text, size) : NULL;
}

/* Makes and measures the table on so many knots, or as many as there can be; returns its excess, or 0 if the build must
 * end. */
static double try_knots(builder *b, unsigned knots)
{
    vndf_guard *guard = b->profile->guard;
    vndf_free(b->table);
    b->table = NULL;
    vndf_knots_place(&b->knots, knots);
    if (b->knots.count < 3)
        vndf_fail(vndf_guard_why(guard), VNDF_ERROR_DISTRIBUTION, "a table has at least two cells, this one %d",
                  (int)b->knots.count - 1);
    if (vndf_guard_stopped(guard))
        return 0;
    vndf_distribution *t = b->table = vndf_draft_from(&b->knots, b->moments);
    const char *why = NULL;
    int good = t && (t->source = copy_of(b->profile->source->description)) && (t->tool = copy_of(TOOL)) &&
               (t->notes = copy_of(b->profile->source->notes));
    if (good) {
        t->bytes = vndf_table_size(b->knots.count, b->moments, t->source, TOOL, t->notes);
        why = vndf_table_fill(t);
        good = why || vndf_guard_stopped(guard) || vndf_certificate_measure(&t->certificate, t, b->profile);
    }
    if (!good)
        vndf_guard_starve(guard);
    if (why)
        vndf_fail(vndf_guard_why(guard), VNDF_ERROR_DISTRIBUTION,
                  "the distribution cannot be held in a table of floats: not a consistent table: %s", why);
    if (!vndf_guard_stopped(guard))
        return excess_of(&t->certificate, b->max_tv);
    vndf_free(t);
    b->table = NULL;
    return 0;
}

/* About as few knots as reach the target, from `least` to `most`: the total variation falls as the square of their
 * number, or hardly at all where the moments limit it. Then the number is halved between what is enough and what is
 * not. */
static void search(builder *b, unsigned least, unsigned most)
{
    const double step_least = 1.1, step_most = 2.5, step_slow = 1.5, close = 0.7;
    unsigned few = least, enough = least, there = 0;
    double excess = try_knots(b, least), before = HUGE_VAL;
    while (excess > 1 && enough < most && b->knots.count > there) {
        there = b->knots.count;
        int slow = excess * enough > before * few;
        double next = enough * (slow ? step_slow : fmin(fmax(1.1 * sqrt(excess), step_least), step_most));
        few = enough;
        before = excess;
        enough = next < most ? (unsigned)next : most;
        excess = try_knots(b, enough);
    }
    int reached = excess <= 1;
    while (reached && excess < close && enough - few > 1 + enough / 16 && !vndf_guard_stopped(b->profile->guard)) {
        unsigned middle = (few + enough) / 2;
        excess = try_knots(b, middle);
        *(excess <= 1 ? &enough : &few) = middle;
    }
    if (reached && excess > 1)
        try_knots(b, enough);
}

static size_t bytes_of_knots(const builder *b, size_t knots)
{
    return vndf_table_size(knots, b->moments, b->profile->source->description, TOOL, b->profile->source->notes);
}

/* The largest number of knots that fits into bytes. */
static unsigned knots_in(const builder *b, size_t bytes)
{
    size_t base = bytes_of_knots(b, 0), each = bytes_of_knots(b, 1) - base;
    size_t knots = bytes > base ? (bytes - base) / each : 0;
    return knots < VNDF_CELLS_MAX + 1 ? (unsigned)knots : VNDF_CELLS_MAX + 1;
}

static void make_table(builder *b)
{
    unsigned most = knots_in(b, b->max_bytes), few = knots_in(b, b->least_bytes), least = CELLS_LEAST + 1;
    if (most >= least && !vndf_knots_from(&b->knots, b->profile, most)) {
        vndf_guard_starve(b->profile->guard);
        return;
    }
    least = b->knots.least > least ? b->knots.least : least;
    if (most < least) {
        vndf_fail(vndf_guard_why(b->profile->guard), VNDF_ERROR_TARGET,
                  "%lu bytes are too few: the smallest table of this distribution takes %lu",
                  (unsigned long)b->max_bytes, (unsigned long)bytes_of_knots(b, least));
        return;
    }
    search(b, !(b->max_tv > 0) ? most : few > least ? few : least, most);
}

/* ---- the call ---- */

static vndf_status check_request(const vndf_source *source, const builder *b, vndf_error *error)
{
    if (!source)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "no source: NULL was given");
    if (b->max_bytes < BYTES_LEAST || b->max_bytes > BYTES_MOST)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "max_bytes is %lu; from %d to %d is possible",
                         (unsigned long)b->max_bytes, BYTES_LEAST, BYTES_MOST);
    if (!(b->max_tv >= 0.0 && b->max_tv < 1.0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "max_tv is %g; it is a total variation, from 0 (none) to below 1", b->max_tv);
    if (b->moments < 2 || b->moments > 4)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "moments is %d; 2, 3 and 4 are possible", (int)b->moments);
    return VNDF_OK;
}

static void check_target(const vndf_distribution *table, double max_tv, vndf_error *error)
{
    const vndf_certificate *c = &table->certificate;
    int above = c->tv_above > max_tv;
    if (excess_of(c, max_tv) > 1)
        vndf_fail(error, VNDF_ERROR_TARGET,
                  "a total variation of %g%s cannot be met within the size: %lu bytes reach %.3g at %g degrees",
                  above ? max_tv : BELOW * max_tv, above ? "" : " below the horizon", (unsigned long)table->bytes,
                  (double)(above ? c->tv_above : c->tv), (double)(above ? c->tv_above_theta : c->tv_theta));
}

vndf_distribution *vndf_build(const vndf_source *source, const vndf_build_options *options,
                              vndf_certificate *certificate, vndf_error *error)
{
    const vndf_build_options none = {0}, given = options ? *options : none;
    builder b = {.max_bytes = given.max_bytes ? given.max_bytes : BYTES_DEFAULT,
                 .max_tv = given.max_tv,
                 .moments = (unsigned)(given.moments ? given.moments : MOMENTS_DEFAULT)};
    if (check_request(source, &b, error) != VNDF_OK)
        return NULL;
    if (!given.max_bytes && !(given.max_tv > 0.0)) {
        b.max_tv = TV_DEFAULT;
        b.least_bytes = BYTES_ENOUGH;
    }
    vndf_guard guard = vndf_guard_from(given.progress, given.progress_user);
    vndf_guard_stage(&guard, 0, "the source");
    vndf_profile *profile = vndf_profile_from(source, &guard, error);
    if (!profile)
        return NULL;
    b.profile = profile;
    vndf_guard_stage(&guard, 0.5, "knots and certificate");
    make_table(&b);
    if (b.table)
        check_target(b.table, given.max_tv, vndf_guard_why(&guard));
    if (vndf_guard_status(&guard, error) != VNDF_OK) {
        vndf_free(b.table);
        b.table = NULL;
    } else if (certificate)
        *certificate = b.table->certificate;
    vndf_knots_free(&b.knots);
    vndf_profile_free(profile);
    return b.table;
}

vndf_status vndf_certify(const vndf_distribution *distribution, const vndf_source *source,
                         vndf_certificate *certificate, vndf_error *error)
{
    if (!distribution || !vndf_is_table(distribution) || !source || !certificate)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table, a source and a place for the certificate are needed");
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, &guard, error);
    if (!profile)
        return vndf_guard_status(&guard, NULL);
    double scale = profile->scale / distribution->scale;
    double normalization = profile->normalization / distribution->normalization;
    if (!(fabs(scale - 1) < 1e-6) || !(fabs(normalization - 1) < 1e-6))
        vndf_fail(vndf_guard_why(&guard), VNDF_ERROR_DISTRIBUTION,
                  "the table is of another distribution: scale %.9g and normalization %.9g, "
                  "the source has %.9g and %.9g",
                  distribution->scale, distribution->normalization, profile->scale, profile->normalization);
    else if (!vndf_certificate_measure(certificate, distribution, profile))
        vndf_guard_starve(&guard);
    vndf_profile_free(profile);
    return vndf_guard_status(&guard, error);
}
