/* vndf_build: resolves the source, places knots as far as the size allows, takes as few as reach the target, and
 * measures the table. Of a target that is not reached it says what would reach it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "fit/draft.h"

enum { BYTES_DEFAULT = 8192, BYTES_LEAST = 2048, BYTES_MOST = 1 << 20, MOMENTS_DEFAULT = 4, CELLS_LEAST = 2 };

/* Lanes hold so many in registers: by default a table has no fewer, since that would not be faster. */
enum { KNOTS_ENOUGH = 64 };

static const double TV_DEFAULT = 1e-3;
static const double CLOSE = 1.0 / 16,
                    CLOSE_DEFAULT = 1.0 / 4; /* of its knots: without them a target is not reached */
/* Total variations below the horizon over those above it, and at which samples stop being worth their name. */
static const double BELOW = 30, BELOW_MOST = 5e-2;
static const char TOOL[] = "vndf " VNDF_VERSION;

/* A build at work. */
typedef struct builder {
    const vndf_profile *profile;
    vndf_knots knots;
    size_t max_bytes;
    unsigned moments;
    double above, all, close;        /* total variations that are asked for, 0: the best that fits; CLOSE */
    vndf_certificate floor;          /* only that of it */
    vndf_distribution *table, *best; /* the last that was tried; the smallest that is good enough; or NULL */
} builder;

/* ---- tables ---- */

/* Of no text an empty one. */
static char *copy_of(const char *text)
{
    text = text ? text : "";
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    return copy ? memcpy(copy, text, size) : NULL;
}

/* Makes and measures the table on so many knots, or as many as there can be; returns whether it is good enough. There
 * is none if the build must end. */
static int try_knots(builder *b, unsigned knots)
{
    vndf_guard *guard = b->profile->guard;
    if (b->table != b->best)
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
    if (vndf_guard_stopped(guard)) {
        vndf_free(t);
        b->table = NULL;
        return 0;
    }
    t->certificate.floor_above = b->floor.floor_above;
    t->certificate.floor = b->floor.floor;
    return b->above == 0 || ((double)t->certificate.tv_above <= b->above && (double)t->certificate.tv <= b->all);
}

/* How many knots reach the target, by a table: above the horizon its total variation is the floor and what cells add,
 * which falls as the square of their number; below it cells may undo a little of the floor. */
static double knots_enough(const builder *b, unsigned knots, const vndf_certificate *c)
{
    const double margin = 1.02, slow = 1.3, most = 6, floor = (double)c->floor_above;
    double above = ((double)c->tv_above - floor) / fmax(b->above - floor, 1e-3 * b->above);
    double all = (double)c->tv > b->all ? slow * (double)c->tv / b->all : 0;
    return margin * knots * sqrt(fmin(fmax(fmax(above, all), 1 / most), most));
}

/* Whether cells are good enough above the horizon, and what is too much below it is the floor. */
static int is_settled(const builder *b, const vndf_certificate *c)
{
    return (double)c->tv_above <= b->above && (double)c->floor > b->all && c->tv > 0.97f * c->floor;
}

/* As few knots as reach the target, from `least` to `most`: the part `close` fewer do not. Begins near `knots`. */
static void search(builder *b, unsigned least, unsigned most, double knots)
{
    unsigned few = least - 1, enough = most + 1;
    for (double next = fmin(fmax(knots, least), most);;) {
        unsigned n = (unsigned)fmax(next, few + 1.0);
        int reached = try_knots(b, n);
        if (!b->table)
            return;
        *(reached ? &enough : &few) = n;
        if (reached) {
            vndf_free(b->best);
            b->best = b->table;
        }
        double gap = enough - few, near = fmax(b->close * enough, 1);
        if (b->best ? gap <= near : few == most || is_settled(b, &b->table->certificate))
            return;
        next = knots_enough(b, n, &b->table->certificate);
        next = reached ? fmin(next, enough - near) : fmax(next, n + fmax(b->close * n, 1));
        next = b->best ? fmin(fmax(next, few + gap / 4), enough - gap / 4) : fmin(next, most);
    }
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

/* Strips for `most` knots; what has no memory ends the build. */
static void place_strips(builder *b, unsigned most)
{
    vndf_knots_free(&b->knots);
    if (!vndf_knots_from(&b->knots, b->profile, most))
        vndf_guard_starve(b->profile->guard);
}

/* Whether tables come to what is asked for. Floors are known to a tenth, and cells may undo a little more below. */
static int is_within(const builder *b, const vndf_certificate *floor)
{
    return 0.9 * (double)floor->floor_above <= b->above && 0.85 * (double)floor->floor <= b->all;
}

/* Says which larger size reaches the target, or what is left whatever the size - in a table that was tried, or the
 * floor - and whether more moments leave less. */
static void refuse(builder *b)
{
    const unsigned most = knots_in(b, b->max_bytes), all = knots_in(b, BYTES_MOST);
    const size_t bytes = b->table ? b->table->bytes : 0;
    vndf_certificate less = b->floor, c = b->table ? b->table->certificate : (vndf_certificate){.tv = less.floor};
    if (b->table && most < all && !is_settled(b, &c)) {
        place_strips(b, all);
        search(b, most + 1, all, knots_enough(b, most, &c));
        c = b->table && !b->best ? b->table->certificate : c;
    }
    const int above = (double)(bytes ? c.tv_above : less.floor_above) > b->above;
    const float left = !bytes && above ? less.floor_above : above ? c.tv_above : c.tv;
    unsigned more = b->moments;
    char target[64], hint[64] = "";
    snprintf(target, sizeof target, "a total variation of %g %s the horizon", above ? b->above : b->all,
             above ? "above" : "below");
    while (!b->best && ++more <= 4 && !*hint)
        if (vndf_floor_measure(&less, b->profile, more) && is_within(b, &less))
            snprintf(hint, sizeof hint, "; %d moments leave %.3g", (int)more,
                     (double)(above ? less.floor_above : less.floor));
    if (b->best)
        vndf_fail(vndf_guard_why(b->profile->guard), VNDF_ERROR_TARGET, "%s takes some %lu bytes: %lu leave %.3g",
                  target, (unsigned long)(b->best->bytes * 9 / 8), (unsigned long)bytes, (double)left);
    else
        vndf_fail(vndf_guard_why(b->profile->guard), VNDF_ERROR_TARGET,
                  "no table reaches %s: %d moments leave %.3g whatever the size%s", target, (int)b->moments,
                  (double)left, hint);
}

/* The best that fits; or what reaches the target, or is refused; or by default what reaches that of KNOTS_ENOUGH, or
 * else the best that fits. */
static void make_table(builder *b, int by_default)
{
    unsigned most = knots_in(b, b->max_bytes), least = CELLS_LEAST + 1;
    if (most >= least) {
        place_strips(b, most);
        if (!vndf_floor_measure(&b->floor, b->profile, b->moments))
            vndf_guard_starve(b->profile->guard);
    }
    least = b->knots.least > least ? b->knots.least : least;
    if (most < least)
        vndf_fail(vndf_guard_why(b->profile->guard), VNDF_ERROR_TARGET,
                  "%lu bytes are too few: the smallest table of this distribution takes %lu",
                  (unsigned long)b->max_bytes, (unsigned long)bytes_of_knots(b, least));
    if (vndf_guard_stopped(b->profile->guard))
        return;
    int is_possible = is_within(b, &b->floor);
    if (b->above == 0 || (by_default && !is_possible))
        least = most;
    else if (by_default)
        least = most < KNOTS_ENOUGH ? most : least < KNOTS_ENOUGH ? KNOTS_ENOUGH : least;
    /* the error of cells is some 0.6 over the square of their number */
    if (b->above == 0 || by_default || is_possible)
        search(b, least, most, 0.8 / sqrt(fmax(b->above - (double)b->floor.floor_above, 0.1 * b->above)));
    if (by_default && !b->best)
        b->best = b->table;
    if (!b->best && !vndf_guard_stopped(b->profile->guard))
        refuse(b);
}

/* ---- the call ---- */

static vndf_status check_request(const vndf_source *source, const builder *b, vndf_error *error)
{
    if (!source)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "no source: NULL was given");
    if (b->max_bytes < BYTES_LEAST || b->max_bytes > BYTES_MOST)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "max_bytes is %lu; from %d to %d is possible",
                         (unsigned long)b->max_bytes, BYTES_LEAST, BYTES_MOST);
    if (!(b->above >= 0.0 && b->above < 1.0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "max_tv is %g; it is a total variation, from 0 (none) to below 1", b->above);
    if (b->moments < 2 || b->moments > 4)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "moments is %d; 2, 3 and 4 are possible", (int)b->moments);
    return VNDF_OK;
}

vndf_distribution *vndf_build(const vndf_source *source, const vndf_build_options *options,
                              vndf_certificate *certificate, vndf_error *error)
{
    const vndf_build_options none = {0}, given = options ? *options : none;
    int by_default = !given.max_bytes && given.max_tv == 0;
    builder b = {.max_bytes = given.max_bytes ? given.max_bytes : BYTES_DEFAULT,
                 .above = by_default ? TV_DEFAULT : given.max_tv,
                 .close = by_default ? CLOSE_DEFAULT : CLOSE,
                 .moments = (unsigned)(given.moments ? given.moments : MOMENTS_DEFAULT)};
    if (check_request(source, &b, error) != VNDF_OK)
        return NULL;
    b.all = fmin(BELOW * b.above, BELOW_MOST);
    vndf_guard guard = vndf_guard_from(given.progress, given.progress_user);
    vndf_guard_stage(&guard, 0, "the source");
    vndf_profile *profile = vndf_profile_from(source, &guard, error);
    if (!profile)
        return NULL;
    b.profile = profile;
    vndf_guard_stage(&guard, 0.5, "knots and certificate");
    make_table(&b, by_default);
    if (b.table != b.best)
        vndf_free(b.table);
    if (vndf_guard_status(&guard, error) != VNDF_OK) {
        vndf_free(b.best);
        b.best = NULL;
    } else if (certificate)
        *certificate = b.best->certificate;
    vndf_knots_free(&b.knots);
    vndf_profile_free(profile);
    return b.best;
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
    else if (!vndf_certificate_measure(certificate, distribution, profile) ||
             !vndf_floor_measure(certificate, profile, (unsigned)distribution->moments))
        vndf_guard_starve(&guard);
    vndf_profile_free(profile);
    return vndf_guard_status(&guard, error);
}
