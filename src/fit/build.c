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
                    CLOSE_DEFAULT = 1.0 / 4; /* so many of its knots fewer do not reach a target */
/* So many times the total variation above the horizon may be reached below it, but no more than samples are worth. */
static const double BELOW = 30, BELOW_MOST = 5e-2;
static const char TOOL[] = "vndf " VNDF_VERSION;

/* A build at work. */
typedef struct builder {
    const vndf_profile *profile;
    vndf_knots knots;
    size_t max_bytes;
    unsigned moments;
    double above,
        all; /* total variations that are asked for, above the horizon and of all; 0: the best that fits */
    vndf_floor floor;
    vndf_distribution *table,
        *best; /* the last that was tried; the smallest that reached what is asked for, or NULL */
} builder;

/* ---- tables ---- */

/* The total variations over those asked for, the larger of both. */
static double excess_of(const builder *b, const vndf_certificate *c)
{
    return b->above > 0 ? fmax((double)c->tv_above / b->above, (double)c->tv / b->all) : 0;
}

static void put_floor(vndf_certificate *c, const vndf_floor *floor)
{
    c->floor_above = (float)floor->above;
    c->floor = (float)floor->all;
}

static char *copy_of(const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    return copy ? memcpy(copy, text, size) : NULL;
}

/* Makes and measures the table on so many knots, or as many as there can be; returns its excess, or 0 if the build must
 * end. */
static double try_knots(builder *b, unsigned knots)
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
    int good = t && (t->source = copy_of(b->profile->source->description)) && (t->tool = copy_of(TOOL));
    if (good) {
        t->bytes = vndf_table_size(b->knots.count, b->moments, t->source, TOOL);
        why = vndf_table_fill(t);
        good = why || vndf_guard_stopped(guard) || vndf_certificate_measure(&t->certificate, t, b->profile);
    }
    if (!good)
        vndf_guard_starve(guard);
    if (why)
        vndf_fail(vndf_guard_why(guard), VNDF_ERROR_DISTRIBUTION,
                  "the distribution cannot be held in a table of floats: not a consistent table: %s", why);
    if (!vndf_guard_stopped(guard)) {
        put_floor(&t->certificate, &b->floor);
        return excess_of(b, &t->certificate);
    }
    vndf_free(t);
    b->table = NULL;
    return 0;
}

/* How many knots reach the target, by a table: above the horizon its total variation is the floor and what cells add,
 * which falls as the square of their number; below it cells may undo a little of the floor. */
static double knots_enough(const builder *b, unsigned knots, const vndf_certificate *c)
{
    const double margin = 1.02, slow = 1.15, step_most = 2.5;
    double above = ((double)c->tv_above - b->floor.above) / fmax(b->above - b->floor.above, 1e-3 * b->above);
    double all = (double)c->tv > b->all ? slow * slow * (double)c->tv / b->all : 0;
    return margin * knots * sqrt(fmin(fmax(fmax(above, all), 1 / (step_most * step_most)), step_most * step_most));
}

/* Whether cells are good enough above the horizon, and what is too much below it is the floor. */
static int is_settled(const builder *b, const vndf_certificate *c)
{
    return (double)c->tv_above <= b->above && b->floor.all > b->all && (double)c->tv > 0.97 * b->floor.all;
}

/* As few knots as reach the target, from `least` to `most`: the part `close` fewer do not. Begins with `knots`. */
static void search(builder *b, unsigned least, unsigned most, unsigned knots, double close)
{
    unsigned few = least - 1, enough = most + 1;
    for (;;) {
        int reached = try_knots(b, knots) <= 1;
        if (!b->table)
            return;
        *(reached ? &enough : &few) = knots;
        if (reached) {
            vndf_free(b->best);
            b->best = b->table;
        }
        double gap = enough - few, near = fmax(close * enough, 1);
        if (b->best ? gap <= near : few == most || is_settled(b, &b->table->certificate))
            return;
        double next = knots_enough(b, knots, &b->table->certificate);
        next = reached ? fmin(next, enough - near) : fmax(next, knots + 1.0);
        next = b->best ? fmin(fmax(next, few + gap / 4), enough - gap / 4) : fmin(next, most);
        knots = (unsigned)fmax(next, few + 1.0);
    }
}

static size_t bytes_of_knots(const builder *b, size_t knots)
{
    return vndf_table_size(knots, b->moments, b->profile->source->description, TOOL);
}

/* The largest number of knots that fits into bytes. */
static unsigned knots_in(const builder *b, size_t bytes)
{
    size_t base = bytes_of_knots(b, 0), each = bytes_of_knots(b, 1) - base;
    size_t knots = bytes > base ? (bytes - base) / each : 0;
    return knots < VNDF_CELLS_MAX + 1 ? (unsigned)knots : VNDF_CELLS_MAX + 1;
}

/* Whether a table may come to what is asked for. Floors are known to a tenth, and cells may undo so much below the
 * horizon. */
static int is_within(const builder *b, const vndf_floor *floor)
{
    const double known = 0.9, undone = 0.85;
    return known * floor->above <= b->above && undone * floor->all <= b->all;
}

/* Tries larger tables than those that are allowed: which size is it that reaches the target? */
static void refuse_size(builder *b)
{
    const unsigned most = knots_in(b, b->max_bytes), all = knots_in(b, BYTES_MOST);
    const vndf_certificate c = b->table->certificate;
    const size_t bytes = b->table->bytes;
    const int above = (double)c.tv_above > b->above;
    if (most == all || is_settled(b, &c))
        return;
    vndf_knots_free(&b->knots);
    if (!vndf_knots_from(&b->knots, b->profile, all))
        vndf_guard_starve(b->profile->guard);
    search(b, most + 1, all, (unsigned)fmin(fmax(knots_enough(b, most, &c), most + 1), all), CLOSE);
    if (b->best)
        vndf_fail(vndf_guard_why(b->profile->guard), VNDF_ERROR_TARGET,
                  "a total variation of %g %s the horizon takes %lu bytes: %lu reach %.3g at %g degrees",
                  above ? b->above : b->all, above ? "above" : "below", (unsigned long)b->best->bytes,
                  (unsigned long)bytes, (double)(above ? c.tv_above : c.tv),
                  (double)(above ? c.tv_above_theta : c.tv_theta));
}

/* Says what is left whatever the size: by a table that was tried, or the floor; and whether more moments leave less. */
static void refuse_moments(const builder *b)
{
    const vndf_certificate *c = b->table ? &b->table->certificate : NULL;
    const vndf_floor left = c ? (vndf_floor){(double)c->tv_above, (double)c->tv} : b->floor;
    const int above = left.above > b->above;
    vndf_floor less = {1, 1};
    unsigned more = b->moments + 1;
    char hint[80] = "";
    while (more <= 4 && vndf_floor_measure(&less, b->profile, more) && !is_within(b, &less))
        more++;
    if (more <= 4)
        snprintf(hint, sizeof hint, "; %d moments leave %.3g", (int)more, above ? less.above : less.all);
    vndf_fail(vndf_guard_why(b->profile->guard), VNDF_ERROR_TARGET,
              "no table reaches a total variation of %g %s the horizon: %d moments leave %.3g whatever the size%s",
              above ? b->above : b->all, above ? "above" : "below", (int)b->moments, above ? left.above : left.all,
              hint);
}

/* Strips for `most` knots, and the floor; returns how few knots there can be, or 0 if the build must end. */
static unsigned prepare(builder *b, unsigned most)
{
    unsigned least = CELLS_LEAST + 1;
    if (most >= least && (!vndf_knots_from(&b->knots, b->profile, most) ||
                          !vndf_floor_measure(&b->floor, b->profile, b->moments))) {
        vndf_guard_starve(b->profile->guard);
        return 0;
    }
    least = b->knots.least > least ? b->knots.least : least;
    if (most >= least)
        return least;
    vndf_fail(vndf_guard_why(b->profile->guard), VNDF_ERROR_TARGET,
              "%lu bytes are too few: the smallest table of this distribution takes %lu",
              (unsigned long)b->max_bytes, (unsigned long)bytes_of_knots(b, least));
    return 0;
}

/* The best that fits; or what reaches max_tv, or is refused; or by default what reaches TV_DEFAULT and has KNOTS_ENOUGH,
 * or else the best that fits. */
static void make_table(builder *b, double max_tv, int by_default)
{
    const double beyond = 1.1; /* what is taken for a target that moments do not reach, over their floor */
    const double close = by_default ? CLOSE_DEFAULT : CLOSE;
    unsigned most = knots_in(b, b->max_bytes), least = prepare(b, most);
    if (!least)
        return;
    b->above = max_tv;
    b->all = fmin(BELOW * max_tv, fmax(BELOW_MOST, beyond * b->floor.all));
    if (by_default) {
        b->above = b->floor.above < TV_DEFAULT ? TV_DEFAULT : beyond * b->floor.above;
        b->all = b->floor.all < BELOW * TV_DEFAULT ? BELOW * TV_DEFAULT : beyond * b->floor.all;
        least = least > KNOTS_ENOUGH ? least : most < KNOTS_ENOUGH ? most : KNOTS_ENOUGH;
    }
    /* the error of cells is some 0.6 over the square of their number */
    double first = b->above > 0 ? 0.8 / sqrt(fmax(b->above - b->floor.above, 0.1 * b->above)) : most;
    if (!(b->above > 0))
        least = most;
    if (!(b->above > 0) || is_within(b, &b->floor))
        search(b, least, most, first > most ? most : first > least ? (unsigned)first : least, close);
    if (by_default && !b->best)
        b->best = b->table;
    if (!b->best && b->table)
        refuse_size(b);
    if (!b->best && !vndf_guard_stopped(b->profile->guard))
        refuse_moments(b);
}

/* ---- the call ---- */

static vndf_status check_request(const vndf_source *source, const builder *b, double max_tv, vndf_error *error)
{
    if (!source)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "no source: NULL was given");
    if (b->max_bytes < BYTES_LEAST || b->max_bytes > BYTES_MOST)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "max_bytes is %lu; from %d to %d is possible",
                         (unsigned long)b->max_bytes, BYTES_LEAST, BYTES_MOST);
    if (!(max_tv >= 0.0 && max_tv < 1.0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "max_tv is %g; it is a total variation, from 0 (none) to below 1", max_tv);
    if (b->moments < 2 || b->moments > 4)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "moments is %d; 2, 3 and 4 are possible", (int)b->moments);
    return VNDF_OK;
}

vndf_distribution *vndf_build(const vndf_source *source, const vndf_build_options *options,
                              vndf_certificate *certificate, vndf_error *error)
{
    const vndf_build_options none = {0}, given = options ? *options : none;
    builder b = {.max_bytes = given.max_bytes ? given.max_bytes : BYTES_DEFAULT,
                 .moments = (unsigned)(given.moments ? given.moments : MOMENTS_DEFAULT)};
    if (check_request(source, &b, given.max_tv, error) != VNDF_OK)
        return NULL;
    vndf_guard guard = vndf_guard_from(given.progress, given.progress_user);
    vndf_guard_stage(&guard, 0, "the source");
    vndf_profile *profile = vndf_profile_from(source, &guard, error);
    if (!profile)
        return NULL;
    b.profile = profile;
    vndf_guard_stage(&guard, 0.5, "knots and certificate");
    make_table(&b, given.max_tv, !given.max_bytes && !(given.max_tv > 0.0));
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
    vndf_floor floor = {0, 0};
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
             !vndf_floor_measure(&floor, profile, (unsigned)distribution->moments))
        vndf_guard_starve(&guard);
    else
        put_floor(certificate, &floor);
    vndf_profile_free(profile);
    return vndf_guard_status(&guard, error);
}
