/* vndf_build: resolves the source, places knots as far as the size allows, takes as few as reach the target, and
 * measures the table. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "fit/certificate.h"
#include "table/table.h"

enum { BYTES_DEFAULT = 8192, BYTES_LEAST = 2048, BYTES_MOST = 1 << 20, MOMENTS_DEFAULT = 4, CELLS_LEAST = 2 };

/* Some 62 knots: a smaller table would not be faster, since lanes hold 64 of them in registers. */
enum { BYTES_ENOUGH = 3000 };

static const double TV_DEFAULT = 1e-3;
static const double BELOW = 30; /* times the total variation above the horizon may be reached below it */
static const char TOOL[] = "vndf " VNDF_VERSION;

/* What a table is asked to be. */
typedef struct request {
    size_t least_bytes; /* a smaller table is not looked for */
    size_t max_bytes;
    double max_tv; /* 0: the best that fits */
    unsigned moments;
} request;

/* A build at work. */
typedef struct builder {
    const vndf_profile *profile;
    request asked;
    vndf_radial *radial;
    size_t base, per_knot; /* bytes */
} builder;

static void note_memory(const builder *b)
{
    b->profile->guard->starved = 1;
}

/* ---- sizes ---- */

static size_t bytes_for(const builder *b, unsigned cells)
{
    float zero[CELLS_LEAST + 2] = {0};
    vndf_table_draft empty = {
        .cells = cells, .moments = b->asked.moments, .source = b->profile->description, .tool = TOOL};
    empty.knot = empty.g0 = empty.g1 = empty.m0 = empty.m1 = empty.m2 = empty.cubes = zero;
    empty.b0 = empty.b1 = empty.area = empty.slope = zero;
    return vndf_table_encode(&empty, NULL, 0);
}

static void measure_bytes(builder *b)
{
    size_t two = bytes_for(b, CELLS_LEAST);
    b->per_knot = bytes_for(b, CELLS_LEAST + 1) - two;
    b->base = two - (CELLS_LEAST + 1) * b->per_knot;
}

/* The largest number of knots that fits, or 0. */
static unsigned knots_in(const builder *b, size_t bytes)
{
    size_t room = bytes > b->base ? bytes - b->base : 0, knots = room / b->per_knot;
    return knots < VNDF_CELLS_MAX + 1 ? (unsigned)knots : VNDF_CELLS_MAX + 1;
}

/* ---- tables ---- */

/* The table on so many knots, measured. 0, and a note to the guard, if there is no memory; free it either way. */
static int draft_with(const builder *b, unsigned knots, vndf_closeness closeness, vndf_draft *draft)
{
    int good =
        vndf_draft_from(draft, b->radial, knots, b->asked.moments) &&
        vndf_certificate_measure(&draft->table.certificate, &draft->laws, &draft->sight, b->profile, closeness);
    if (!good)
        note_memory(b);
    return good;
}

/* The total variations over those asked for, the larger of both. */
static double excess_of(const vndf_certificate *c, double tv)
{
    return fmax((double)c->tv_above, (double)c->tv / BELOW) / tv;
}

static int reaches(const vndf_certificate *c, double tv)
{
    return !(tv > 0) || excess_of(c, tv) <= 1;
}

/* The same of so many knots by a coarse look. */
static double seen_excess(const builder *b, unsigned knots)
{
    const double margin = 0.97; /* a close look finds a little more */
    vndf_draft draft;
    int good = draft_with(b, vndf_radial_refine(b->radial, knots), VNDF_COARSELY, &draft);
    double excess = good ? excess_of(&draft.table.certificate, margin * b->asked.max_tv) : 0;
    vndf_draft_free(&draft);
    return excess;
}

/* About as few knots as seem to reach the target, from `least` to `most`. The total variation falls as the square of
 * their number, or faster. */
static unsigned fewest_knots(const builder *b, unsigned least, unsigned most)
{
    const double step_least = 1.25, step_most = 2.5;
    unsigned enough = least, few = least;
    double excess;
    while ((excess = seen_excess(b, enough)) > 1 && enough < most && !vndf_guard_stopped(b->profile->guard)) {
        double next = enough * fmin(fmax(sqrt(excess), step_least), step_most);
        few = enough;
        enough = next < most ? (unsigned)next : most;
    }
    while (excess <= 1 && enough - few > 1 + enough / 16 && !vndf_guard_stopped(b->profile->guard)) {
        unsigned middle = (few + enough) / 2;
        if (seen_excess(b, middle) <= 1)
            enough = middle;
        else
            few = middle;
    }
    return enough;
}

/* The table as it would be read back from its file: certificate and texts included. */
static vndf_distribution *finish(const builder *b, vndf_draft *draft, vndf_error *why)
{
    draft->table.source = b->profile->description;
    draft->table.tool = TOOL;
    size_t size = vndf_table_encode(&draft->table, NULL, 0);
    unsigned char *bytes = malloc(size);
    vndf_distribution *table = NULL;
    vndf_error inner = {VNDF_ERROR_MEMORY, ""};
    if (bytes) {
        vndf_table_encode(&draft->table, bytes, size);
        table = vndf_load_memory(bytes, size, &inner);
    }
    free(bytes);
    if (!table && inner.status == VNDF_ERROR_MEMORY)
        note_memory(b);
    else if (!table)
        vndf_fail(why, VNDF_ERROR_DISTRIBUTION, "the distribution cannot be held in a table of floats: %s",
                  inner.message);
    return table;
}

/* The table on so many knots, more if a close look asks for them, `most` at last. */
static vndf_distribution *build_from(const builder *b, unsigned knots, unsigned most, vndf_error *error)
{
    for (;;) {
        vndf_draft draft;
        unsigned next = knots + knots / 16 + 1, used = vndf_radial_refine(b->radial, knots);
        vndf_guard_stage(b->profile->guard, 0.8, "certificate");
        int good = draft_with(b, used, VNDF_CLOSELY, &draft);
        if (!good || knots >= most || used < knots || reaches(&draft.table.certificate, b->asked.max_tv)) {
            vndf_distribution *table = good ? finish(b, &draft, error) : NULL;
            vndf_draft_free(&draft);
            return table;
        }
        vndf_draft_free(&draft);
        knots = next < most ? next : most;
    }
}

static vndf_distribution *cut_table(const builder *b, vndf_error *error)
{
    unsigned most = knots_in(b, b->asked.max_bytes), few = knots_in(b, b->asked.least_bytes);
    unsigned least = b->radial->start > CELLS_LEAST ? b->radial->start : CELLS_LEAST + 1;
    if (most < least) {
        vndf_fail(error, VNDF_ERROR_TARGET,
                  "%lu bytes are too few: the smallest table of this distribution takes %lu",
                  (unsigned long)b->asked.max_bytes, (unsigned long)(b->base + least * b->per_knot));
        return NULL;
    }
    unsigned first = b->asked.max_tv > 0 ? fewest_knots(b, few > least ? few : least, most) : most;
    return build_from(b, first, most, error);
}

static vndf_distribution *build_within(const vndf_profile *profile, const request *asked, vndf_error *error)
{
    builder b = {.profile = profile, .asked = *asked, .radial = malloc(sizeof *b.radial)};
    vndf_distribution *table = NULL;
    measure_bytes(&b);
    vndf_guard_stage(profile->guard, 0.5, "knots");
    if (b.radial && vndf_radial_from(b.radial, profile))
        table = cut_table(&b, error);
    else
        note_memory(&b);
    if (b.radial)
        vndf_radial_free(b.radial);
    free(b.radial);
    return table;
}

/* ---- the call ---- */

static vndf_status check_request(const vndf_source *source, const request *asked, vndf_error *error)
{
    size_t max_bytes = asked->max_bytes;
    if (!source)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "no source: NULL was given");
    if (max_bytes < BYTES_LEAST || max_bytes > BYTES_MOST)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "max_bytes is %lu; from %d to %d is possible",
                         (unsigned long)max_bytes, BYTES_LEAST, BYTES_MOST);
    if (!(asked->max_tv >= 0.0 && asked->max_tv < 1.0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "max_tv is %g; it is a total variation, from 0 (none) to below 1", asked->max_tv);
    if (asked->moments < 2 || asked->moments > 4)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "moments is %d; 2, 3 and 4 are possible",
                         (int)asked->moments);
    return VNDF_OK;
}

/* The target was the caller's: a table that misses it is not what was asked for. */
static vndf_distribution *check_target(vndf_distribution *table, double max_tv, vndf_error *error)
{
    if (!table || reaches(&table->certificate, max_tv))
        return table;
    const vndf_certificate *c = &table->certificate;
    int above = c->tv_above > max_tv;
    vndf_fail(error, VNDF_ERROR_TARGET,
              "a total variation of %g%s cannot be met within the size: %lu bytes reach %.3g at %g degrees",
              above ? max_tv : BELOW * max_tv, above ? "" : " below the horizon", (unsigned long)table->bytes,
              (double)(above ? c->tv_above : c->tv), (double)(above ? c->tv_above_theta : c->tv_theta));
    vndf_free(table);
    return NULL;
}

vndf_distribution *vndf_build(const vndf_source *source, const vndf_build_options *options,
                              vndf_certificate *certificate, vndf_error *error)
{
    vndf_build_options none = {0}, given = options ? *options : none;
    request asked = {0, given.max_bytes ? given.max_bytes : BYTES_DEFAULT, given.max_tv,
                     (unsigned)(given.moments ? given.moments : MOMENTS_DEFAULT)};
    vndf_resolution resolution = {given.breaks, given.break_count, given.finest};
    if (check_request(source, &asked, error) != VNDF_OK || vndf_resolution_check(&resolution, error) != VNDF_OK)
        return NULL;
    if (!given.max_bytes && !(given.max_tv > 0.0)) {
        asked.max_tv = TV_DEFAULT;
        asked.least_bytes = BYTES_ENOUGH;
    }
    vndf_guard guard = vndf_guard_from(given.progress, given.progress_user);
    vndf_guard_stage(&guard, 0, "the source");
    vndf_profile *profile = vndf_profile_from(source, &resolution, &guard, error);
    if (!profile)
        return NULL;
    vndf_distribution *table = build_within(profile, &asked, error);
    if (vndf_guard_status(&guard, error) != VNDF_OK) {
        vndf_free(table);
        table = NULL;
    }
    if (given.max_tv > 0.0)
        table = check_target(table, given.max_tv, error);
    if (table && certificate)
        *certificate = table->certificate;
    vndf_profile_free(profile);
    return table;
}

/* 1 if the table was measured; 0 if there is no memory. */
static int certify(const vndf_distribution *distribution, const vndf_profile *profile,
                   vndf_certificate *certificate)
{
    vndf_draft draft;
    memset(&draft, 0, sizeof draft);
    if (!vndf_table_draft_of(distribution, &draft.table))
        return 0;
    int good = vndf_laws_from(&draft.laws, &draft.table) && vndf_sight_from(&draft.sight, profile, &draft.laws) &&
               vndf_certificate_measure(certificate, &draft.laws, &draft.sight, profile, VNDF_CLOSELY);
    vndf_draft_free(&draft);
    return good;
}

vndf_status vndf_certify(const vndf_distribution *distribution, const vndf_source *source,
                         vndf_certificate *certificate, vndf_error *error)
{
    if (!distribution || !vndf_is_table(distribution) || !source || !certificate)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table, a source and a place for the certificate are needed");
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_error inner = {VNDF_OK, ""};
    vndf_resolution as_built;
    double breaks[VNDF_LIMIT_BREAKS];
    if (vndf_resolution_read(distribution->source, breaks, &as_built, error) != VNDF_OK)
        return error ? error->status : VNDF_ERROR_ARGUMENT;
    vndf_profile *profile = vndf_profile_from(source, &as_built, &guard, &inner);
    if (!profile)
        return vndf_fail(error, inner.status, "%s", inner.message);
    double scale = profile->scale / distribution->scale;
    double normalization = profile->normalization / distribution->normalization;
    if (!(fabs(scale - 1) < 1e-6) || !(fabs(normalization - 1) < 1e-6)) {
        vndf_status other =
            vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                      "the table is of another distribution: scale %.9g and normalization %.9g, "
                      "the source has %.9g and %.9g",
                      distribution->scale, distribution->normalization, profile->scale, profile->normalization);
        vndf_profile_free(profile);
        return other;
    }
    int done = certify(distribution, profile, certificate);
    vndf_profile_free(profile);
    if (!done)
        guard.starved = 1;
    return vndf_guard_status(&guard, error);
}
