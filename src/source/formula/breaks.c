/* Finds where a formula is not smooth. Each call of step, abs, min or max has a quantity that changes sign where
 * the call has its kink or jump, and that quantity is the value of a prefix of the program. So the search runs the
 * prefix of each call over a grid of slopes, and bisects every change of sign down to two neighbouring doubles.
 * The grid of a call holds the breaks of the calls before it, hence of all calls inside it: step(w - abs(r - r0))
 * is found however small w is. */
#include "source/formula/expression.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/ascending.h"

enum { GRID = 2048 };                /* grid points per call: 2% apart */
static const size_t work = 10000000; /* instructions that all scans together may cost: about 0.1 s */

static const double grid_first = 1e-9, grid_last = 1e9;

/* One call: the program up to it, and its kind of kink. */
typedef struct call {
    const vndf_expression *expression;
    vndf_variables_of_slope *variables;
    size_t prefix;
    vndf_kink kink;
    size_t *done; /* instructions that were run for all calls */
} call;

/* The sides of up to VNDF_SOURCE_MANY slopes. */
static void find_sides(const call *c, const double *r, size_t count, char *side)
{
    vndf_points variables[VNDF_VARIABLES], top, below;
    *c->done += count * c->prefix;
    c->variables(r, count, variables);
    vndf_expression_run(c->expression, c->prefix, variables, count, top, below);
    for (size_t i = 0; i < count; i++)
        side[i] = c->kink == VNDF_KINK_EQUAL ? below[i] >= top[i] : top[i] >= 0;
}

/* The last double between low and high that is on the side of low, which is `before`. */
static double bisect(const call *c, double low, double high, char before)
{
    for (;;) {
        char side;
        double middle = low + (high - low) / 2;
        if (!(middle > low && middle < high))
            return low;
        find_sides(c, &middle, 1, &side);
        if (side == before)
            low = middle;
        else
            high = middle;
    }
}

/* Sorts, and drops breaks that differ by rounding alone: min and step of the same argument break together. */
static size_t sort_and_thin(double *breaks, size_t count)
{
    size_t kept = 0;
    qsort(breaks, count, sizeof *breaks, vndf_ascending);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || breaks[i] > breaks[kept - 1] * (1 + 1e-14))
            breaks[kept++] = breaks[i];
    return kept;
}

/* Adds the breaks of one call. points has room for the grid and for two points beside each break. */
static size_t scan(const call *c, double *points, double *breaks, size_t count, size_t limit)
{
    size_t total = GRID, found = count;
    for (int i = 0; i < GRID; i++)
        points[i] = grid_first * exp(log(grid_last / grid_first) * i / (GRID - 1));
    for (size_t i = 0; i < count; i++) {
        points[total++] = breaks[i];
        points[total++] = nextafter(breaks[i], INFINITY);
    }
    qsort(points, total, sizeof *points, vndf_ascending);
    char side[VNDF_SOURCE_MANY], before = 0;
    for (size_t i = 0; i < total && found < limit && *c->done < work; i++) {
        size_t k = i % VNDF_SOURCE_MANY, left = total - i;
        if (k == 0)
            find_sides(c, points + i, left < VNDF_SOURCE_MANY ? left : VNDF_SOURCE_MANY, side);
        if (i > 0 && side[k] != before)
            breaks[found++] = bisect(c, points[i - 1], points[i], before);
        before = side[k];
    }
    return sort_and_thin(breaks, found);
}

int vndf_expression_breaks(const vndf_expression *expression, vndf_variables_of_slope *variables, double *breaks,
                           size_t limit, size_t *count)
{
    double *points = malloc((GRID + 2 * limit) * sizeof *points);
    size_t done = 0;
    *count = 0;
    for (size_t i = 0; points && i < expression->count && done < work; i++) {
        const vndf_instruction *at = &expression->program[i];
        if (at->operation != VNDF_CALL || at->function->kink == VNDF_KINK_NONE)
            continue;
        call c = {expression, variables, i, at->function->kink, &done};
        *count = scan(&c, points, breaks, *count, limit);
    }
    free(points);
    return points != NULL;
}
