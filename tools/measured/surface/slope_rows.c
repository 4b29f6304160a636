#include "measured/surface/slope_rows.h"

#include <math.h>
#include <stdlib.h>

static const double LEFT_MOST = 0.01;
static const double BEYOND_MOST = 0.25; /* what a tail may have beyond the data, of the last bin's mass */
static const double SHORT_MOST = 0.2;   /* what may lack of that mass */

static int make_rows(const slope_bins *b, const char *name, profile *rows, refusal *why)
{
    int has_end = isfinite(b->edge[b->count]);
    if (profile_make(rows, VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, b->count + (has_end ? 2 : 0)))
        rows->error = calloc(rows->count, sizeof *rows->error);
    if (!rows->error)
        return refuse_data(why, name, "there is no memory for %zu rows", rows->count);
    for (size_t i = 0; i < b->count; i++) {
        double next = isfinite(b->edge[i + 1]) ? b->edge[i + 1] : 2 * b->middle[i] - b->edge[i];
        rows->x[i] = b->middle[i];
        rows->error[i] = b->error[i];
        rows->value[i] = b->mass[i] / (next * next - b->edge[i] * b->edge[i]);
    }
    return 1;
}

/* The last bin ends at the longest slope. */
static void end_bins(slope_bins *b)
{
    double from = b->edge[b->count - 1];
    b->edge[b->count] = b->longest;
    b->middle[b->count - 1] = sqrt((from * from + b->longest * b->longest) / 2);
}

/* The curve is even to the longest slope, and 0 after a step that has the mass of half a slope. */
static void end_rows(const slope_bins *b, profile *rows)
{
    size_t last = b->count - 1;
    double step = (b->longest - b->edge[last]) / (b->mass[last] * (double)b->samples);
    rows->x[last + 1] = b->longest;
    rows->x[last + 2] = b->longest + fmax(step, 1e-9 * b->longest);
    rows->value[last + 1] = rows->value[last];
    rows->error[last + 1] = rows->error[last];
}

/* The mass of the curve in the last bin, and beyond the longest slope. All bins together have 1. */
typedef struct tail {
    double last, beyond;
} tail;

static int find_tail(const slope_bins *b, const profile *rows, const char *name, tail *found, refusal *why)
{
    vndf_source *source = profile_source(rows, name, why);
    if (!source)
        return 0;
    size_t last = b->count - 1;
    int has_end = isfinite(b->edge[b->count]);
    found->last = profile_mass(source, b->edge[last], b->edge[b->count]);
    found->beyond = profile_mass(source, b->longest, has_end ? rows->x[rows->count - 1] : INFINITY);
    vndf_source_free(source);
    return 1;
}

static int fit_rows(const slope_bins *b, const char *name, profile *rows, double *left, tail *found, refusal *why)
{
    const profile_bins wanted = {b->edge, b->mass, b->count};
    if (!make_rows(b, name, rows, why))
        return 0;
    if (isfinite(b->edge[b->count]))
        end_rows(b, rows);
    return profile_match(rows, &wanted, name, left, why) && find_tail(b, rows, name, found, why);
}

/* Whether a tail has the mass of the last bin, and little of it beyond the data. Of n independent slopes in the bin, a
 * right tail has the mass of one beyond the longest, and seldom that of four; the error says how large n is. */
static int is_tail(const slope_bins *b, const tail *found)
{
    size_t last = b->count - 1;
    double most = fmin(4 * b->error[last] * b->error[last], BEYOND_MOST);
    return found->beyond <= most * b->mass[last] && found->last >= (1 - SHORT_MOST) * b->mass[last];
}

int slope_rows_find(slope_bins *b, const char *name, profile *rows, double *left, double *beyond, refusal *why)
{
    tail found = {0, 0};
    int good = fit_rows(b, name, rows, left, &found, why);
    if (good && (*left >= LEFT_MOST || !is_tail(b, &found))) {
        profile_free(rows);
        end_bins(b);
        good = fit_rows(b, name, rows, left, &found, why);
    }
    *beyond = found.beyond;
    return good && (*left < LEFT_MOST || refuse_data(why, name,
                                                     "no smooth curve has the masses of %zu bins; %.2g of all is "
                                                     "wrong",
                                                     b->count, *left));
}
