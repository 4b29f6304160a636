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

static int side(const call *c, double r)
{
    vndf_points variables[VNDF_VARIABLES];
    double below, top;
    *c->done += c->prefix;
    c->variables(&r, 1, variables);
    vndf_expression_run(c->expression, c->prefix, variables, 1, &top, &below);
    return c->kink == VNDF_KINK_EQUAL ? below >= top : top >= 0;
}

/* The last double between low and high that is on the side of low. */
static double bisect(const call *c, double low, double high)
{
    int before = side(c, low);
    for (;;) {
        double middle = low + (high - low) / 2;
        if (!(middle > low && middle < high))
            return low;
        if (side(c, middle) == before)
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
    int before = side(c, points[0]);
    for (size_t i = 1; i < total && found < limit && *c->done < work; i++) {
        int here = side(c, points[i]);
        if (here != before)
            breaks[found++] = bisect(c, points[i - 1], points[i]);
        before = here;
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
