/* vndf_build: resolves the source, refines the fits as far as the size allows, cuts the table that meets the target,
 * and measures it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/assemble.h"
#include "fit/certificate/certificate.h"
#include "core/error.h"
#include "table/file.h"

enum { BYTES_DEFAULT = 16384, BYTES_LEAST = 2048, BYTES_MOST = 1 << 20 };

/* If the caller gives no size: the first of these whose table reaches this total variation; if none does, the
 * smallest that can be built. */
static const size_t BYTES_TRIED[] = {BYTES_DEFAULT, 24576, 32768};
static const double TV_DEFAULT = 1e-3;

/* The error of the coarsest table. Fits that err by more leave a total variation near 1, its maximum. */
static const double ERROR_MOST = 2.0, ERROR_STEP = 1.25;

static const char TOOL[] = "vndf " VNDF_VERSION;

/* What a table is asked to be. */
typedef struct request {
    size_t max_bytes;
    double max_tv;
    int quick, sphere;
} request;

static char *copy(const char *text)
{
    size_t n = strlen(text) + 1;
    char *made = malloc(n);
    return made ? memcpy(made, text, n) : NULL;
}

/* Bytes of the file for counts and texts (table/file.h). */
static size_t file_bytes(vndf_table_size s, const char *source)
{
    size_t floats = 2 * ((size_t)s.radial + 1) + 4 * (size_t)s.radial;
    floats += (size_t)s.above_rows * (2 * s.above_cells + 3) + vndf_row_knots(s.above_rows) + s.above_cells + 1;
    floats += (size_t)s.below_rows * (2 * s.below_cells + 3) + vndf_row_knots(s.below_rows) + s.below_cells + 1;
    floats += 4 * ((size_t)s.above_knots + s.below_knots);
    return 16 + 16 + VNDF_CERTIFICATE_BYTES + 28 + 4 * floats + 8 + strlen(source) + strlen(TOOL) + 4;
}

static int fits(vndf_plan *plan, double error, size_t max_bytes)
{
    return file_bytes(vndf_plan_size(plan, error), plan->profile->description) <= max_bytes;
}

/* The least error for which the table is small enough, or 0. A smaller error costs more to look at: this begins with
 * large ones, and looks at none that is less than one whose table is too large. */
static double error_for_bytes(vndf_plan *plan, size_t max_bytes)
{
    double low = log(plan->finest), high = log(ERROR_MOST), fit = ERROR_MOST, misfit = ERROR_MOST;
    if (!fits(plan, ERROR_MOST, max_bytes))
        return 0.0;
    for (int good = 1; good && misfit > plan->finest; fit = good ? misfit : fit) {
        misfit = fmax(misfit / ERROR_STEP, plan->finest);
        good = fits(plan, misfit, max_bytes) && !vndf_guard_stopped(plan->profile->guard);
    }
    if (fit == plan->finest)
        return plan->finest;
    for (int i = 0; i < 40; i++) {
        double middle = (low + high) / 2, error = exp(middle);
        if (error >= fit || (error > misfit && fits(plan, error, max_bytes)))
            high = middle;
        else
            low = middle;
    }
    return exp(high);
}

/* The table for an error target as it would be read back from its file: certificate and texts included. */
static vndf_distribution *finish(vndf_plan *plan, double error, int quick, vndf_error *why)
{
    const char *source = plan->profile->description;
    vndf_distribution *draft = vndf_plan_assemble(plan, vndf_plan_size(plan, error)), *table = NULL;
    unsigned char *bytes = NULL;
    size_t size = 0;
    vndf_error inner = {VNDF_OK, ""};
    if (draft && (draft->source = copy(source)) && (draft->tool = copy(TOOL)))
        bytes = malloc(size = vndf_table_encode(draft, NULL, 0));
    if (bytes) {
        vndf_table_encode(draft, bytes, size);
        table = vndf_load_memory(bytes, size, &inner);
        if (!table)
            vndf_fail(why, VNDF_ERROR_DISTRIBUTION, "the distribution cannot be held in a table of floats: %s",
                      inner.message);
    }
    free(bytes);
    vndf_free(draft);
    if (!bytes || inner.status == VNDF_ERROR_MEMORY ||
        (table && !vndf_certificate_measure(&table->certificate, table, plan->profile, quick)))
        plan->profile->guard->starved = 1;
    if (!vndf_guard_stopped(plan->profile->guard))
        return table;
    vndf_guard_status(plan->profile->guard, why);
    vndf_free(table);
    return NULL;
}

/* A quick certificate decides where it is clear of `tv`: it finds at least half of what the full one finds, and the
 * full one finds all but a tenth of what there is. Between, the full one is measured, and stays. So either kind of
 * certificate leads to the same table. */
static const double CLEARLY_LESS = 2.0, CLEARLY_MORE = 1.15;

/* Whether the total variation of a table is at most tv. */
static int reaches(const vndf_profile *profile, vndf_distribution *table, double tv)
{
    vndf_certificate *c = &table->certificate;
    if (c->quick > 0 && c->tv > tv / CLEARLY_LESS && c->tv < tv * CLEARLY_MORE &&
        !vndf_certificate_measure(c, table, profile, 0))
        profile->guard->starved = 1;
    return c->tv <= tv;
}

/* The smallest table with a measured TV of at most max_tv, or NULL and the TV that was reached. */
static vndf_distribution *build_to_tv(vndf_plan *plan, double best, const request *asked, vndf_error *error)
{
    double max_tv = asked->max_tv, low = log(best), high = log(fmax(fmin(2 * max_tv, ERROR_MOST), best));
    vndf_distribution *table = finish(plan, best, asked->quick, error);
    if (table && !reaches(plan->profile, table, max_tv)) {
        vndf_fail(error, VNDF_ERROR_TARGET,
                  "a total variation of %g cannot be met within the size: %lu bytes reach %.3g at %g degrees",
                  max_tv, (unsigned long)table->bytes, (double)table->certificate.tv,
                  (double)table->certificate.tv_theta);
        vndf_free(table);
        return NULL;
    }
    for (int i = 0; table && i < 8 && high - low > 0.05; i++) {
        double middle = (low + high) / 2;
        vndf_error ignored;
        /* if floats cannot hold it, the larger table stays */
        vndf_distribution *smaller = finish(plan, exp(middle), asked->quick, &ignored);
        if (smaller && reaches(plan->profile, smaller, max_tv)) {
            vndf_free(table);
            table = smaller;
            low = middle;
        } else {
            vndf_free(smaller);
            high = middle;
        }
    }
    return table;
}

static vndf_distribution *cut_table(vndf_plan *plan, const request *asked, vndf_error *error)
{
    double best = error_for_bytes(plan, asked->max_bytes);
    if (best == 0.0) {
        vndf_fail(error, VNDF_ERROR_TARGET,
                  "%lu bytes are too few: the smallest table of this distribution takes %lu",
                  (unsigned long)asked->max_bytes,
                  (unsigned long)file_bytes(vndf_plan_size(plan, ERROR_MOST), plan->profile->description));
        return NULL;
    }
    vndf_guard_stage(plan->profile->guard, 0.8, "certificate");
    return asked->max_tv > 0.0 ? build_to_tv(plan, best, asked, error) : finish(plan, best, asked->quick, error);
}

/* max_tv bounds all directions, so the table for it serves all of them alike. */
static vndf_distribution *build_within(const vndf_profile *profile, const request *asked, vndf_error *error)
{
    vndf_plan plan;
    vndf_distribution *table = NULL;
    if (vndf_plan_make(&plan, profile, asked->max_bytes, asked->sphere || asked->max_tv > 0.0))
        table = cut_table(&plan, asked, error);
    else if (!vndf_guard_stopped(profile->guard))
        profile->guard->starved = 1;
    vndf_plan_free(&plan);
    return table;
}

static vndf_distribution *build_default(const vndf_profile *profile, int quick, vndf_error *error)
{
    vndf_distribution *table = NULL;
    for (unsigned i = 0; i < sizeof BYTES_TRIED / sizeof *BYTES_TRIED; i++) {
        const request asked = {BYTES_TRIED[i], 0.0, quick, 0};
        vndf_distribution *larger = build_within(profile, &asked, error);
        int good = larger && reaches(profile, larger, TV_DEFAULT), taken = good || !table;
        vndf_free(taken ? table : larger);
        table = taken ? larger : table;
        if (good || vndf_guard_stopped(profile->guard))
            break;
    }
    return table;
}

static vndf_status check_request(const vndf_source *source, const request *asked, vndf_error *error)
{
    size_t max_bytes = asked->max_bytes;
    double max_tv = asked->max_tv;
    if (!source)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "no source: NULL was given");
    if (max_bytes < BYTES_LEAST || max_bytes > BYTES_MOST)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "max_bytes is %lu; from %d to %d is possible",
                         (unsigned long)max_bytes, BYTES_LEAST, BYTES_MOST);
    if (!(max_tv >= 0.0 && max_tv < 1.0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "max_tv is %g; it is a total variation, from 0 (none) to below 1", max_tv);
    if (asked->quick != 0 && asked->quick != 1)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "quick is %d; 0 and 1 are possible", asked->quick);
    if (asked->sphere != 0 && asked->sphere != 1)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "sphere is %d; 0 and 1 are possible", asked->sphere);
    return VNDF_OK;
}

vndf_distribution *vndf_build(const vndf_source *source, const vndf_build_options *options,
                              vndf_certificate *certificate, vndf_error *error)
{
    vndf_build_options none = {0}, given = options ? *options : none;
    const request asked = {given.max_bytes ? given.max_bytes : BYTES_DEFAULT, given.max_tv, given.quick,
                           given.sphere};
    if (check_request(source, &asked, error) != VNDF_OK)
        return NULL;
    vndf_resolution resolution = {given.breaks, given.break_count, given.finest};
    if (vndf_resolution_check(&resolution, error) != VNDF_OK)
        return NULL;
    vndf_guard guard = vndf_guard_from(given.progress, given.progress_user);
    vndf_guard_stage(&guard, 0, "the source");
    vndf_profile *profile = vndf_profile_from(source, &resolution, &guard, error);
    if (!profile)
        return NULL;
    vndf_distribution *table = given.max_bytes || given.max_tv > 0.0 ? build_within(profile, &asked, error)
                                                                     : build_default(profile, given.quick, error);
    if (vndf_guard_status(&guard, error) != VNDF_OK) {
        vndf_free(table);
        table = NULL;
    }
    if (table && certificate)
        *certificate = table->certificate;
    vndf_profile_free(profile);
    return table;
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
    int done = vndf_certificate_measure(certificate, distribution, profile, 0);
    vndf_profile_free(profile);
    if (!done)
        guard.starved = 1;
    return vndf_guard_status(&guard, error);
}
