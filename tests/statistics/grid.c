#include "statistics/grid.h"

#include <math.h>
#include <string.h>

#include "cli/sort.h"

static void place_evenly(double *border, size_t parts, double low, double high)
{
    for (size_t i = 0; i <= parts; i++)
        border[i] = low + (high - low) * (double)i / (double)parts;
}

void grid_even(grid *g, size_t rows, double x0, double x1, size_t columns, double y0, double y1)
{
    memset(g, 0, sizeof *g);
    g->rows = rows;
    g->columns = columns;
    place_evenly(g->x, rows, x0, x1);
    place_evenly(g->y, columns, y0, y1);
}

/* From the least to the largest: beyond them a quadrature that looks at few places may find nothing. */
void grid_quantiles(double *border, size_t parts, double *pilot, size_t count)
{
    size_t steps = (parts - 1) / 2 - 1;
    sort_numbers(pilot, count);
    for (size_t i = 2; i < parts && count; i += 2)
        border[i] = pilot[(count - 1) * (i / 2 - 1) / steps];
    sort_numbers(border, parts + 1);
}

size_t grid_bin(const grid *g, double x, double y)
{
    return bins_interval(g->x, g->rows, x) * g->columns + bins_interval(g->y, g->columns, y);
}

size_t grid_elsewhere(const grid *g)
{
    return g->rows * g->columns;
}

/* ---- integrals ---- */

typedef struct integrand {
    grid_density *density;
    const void *of;
} integrand;

/* Gauss-Legendre with three points in both. */
static double rule(const integrand *f, const double x[2], const double y[2])
{
    static const double node[3] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[3] = {5, 8, 5};
    double sum = 0, mx = (x[0] + x[1]) / 2, hx = (x[1] - x[0]) / 2, my = (y[0] + y[1]) / 2, hy = (y[1] - y[0]) / 2;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum += weight[i] * weight[j] * f->density(mx + hx * node[i], my + hy * node[j], f->of);
    return sum * hx * hy / 81;
}

enum { DEPTH = 8 };

static double adaptive(const integrand *f, const double x[2], const double y[2], double whole, double allowed,
                       int depth)
{
    double mx = (x[0] + x[1]) / 2, my = (y[0] + y[1]) / 2, part[4], sum = 0;
    const double xs[2][2] = {{x[0], mx}, {mx, x[1]}}, ys[2][2] = {{y[0], my}, {my, y[1]}};
    for (int i = 0; i < 4; i++)
        sum += part[i] = rule(f, xs[i / 2], ys[i % 2]);
    if (depth == 0 || (depth < DEPTH && fabs(sum - whole) <= allowed))
        return sum;
    sum = 0;
    for (int i = 0; i < 4; i++)
        sum += adaptive(f, xs[i / 2], ys[i % 2], part[i], allowed / 2, depth - 1);
    return sum;
}

/* Where a bin is cut first: towards neighbours that are much narrower, and where nothing was found in it towards those
 * that hold something, more finely. What is there may reach into it by less than the points of a rule are apart.
 * Returns how many parts there are. */
enum { CUTS = 7, WIDE = 8 };

static size_t cut_bin(double cut[CUTS + 1], const double *border, size_t i, int before, int after, int finely)
{
    double from = border[i], to = border[i + 1], width = to - from;
    size_t parts = 0;
    cut[parts++] = from;
    if (before) {
        if (finely)
            cut[parts++] = from + width / 8192;
        cut[parts++] = from + width / 512;
        cut[parts++] = from + width / 32;
    }
    if (after) {
        cut[parts++] = to - width / 32;
        cut[parts++] = to - width / 512;
        if (finely)
            cut[parts++] = to - width / 8192;
    }
    cut[parts] = to;
    return parts;
}

/* The sides of a bin that it is cut towards. */
typedef struct sides {
    int below, above, left, right;
} sides;

static int is_wide_before(const double *border, size_t i)
{
    return i > 0 && border[i + 1] - border[i] > WIDE * (border[i] - border[i - 1]);
}

static int is_wide_after(const double *border, size_t i, size_t count)
{
    return i + 1 < count && border[i + 1] - border[i] > WIDE * (border[i + 2] - border[i + 1]);
}

static sides narrow_sides(const grid *g, size_t row, size_t column)
{
    return (sides){is_wide_before(g->x, row), is_wide_after(g->x, row, g->rows), is_wide_before(g->y, column),
                   is_wide_after(g->y, column, g->columns)};
}

static sides held_sides(const grid *g, size_t row, size_t column)
{
    const double *here = g->expected + row * g->columns + column;
    return (sides){row > 0 && here[-(ptrdiff_t)g->columns] > 0, row + 1 < g->rows && here[g->columns] > 0,
                   column > 0 && here[-1] > 0, column + 1 < g->columns && here[1] > 0};
}

static double expect_bin(const grid *g, const integrand *f, size_t i, sides towards, int finely, double allowed)
{
    double x[CUTS + 1], y[CUTS + 1], sum = 0;
    size_t row = i / g->columns, column = i % g->columns;
    size_t rows = cut_bin(x, g->x, row, towards.below, towards.above, finely),
           columns = cut_bin(y, g->y, column, towards.left, towards.right, finely);
    for (size_t part = 0; part < rows * columns; part++) {
        const double *at = x + part / columns, *along = y + part % columns;
        sum += adaptive(f, at, along, rule(f, at, along), allowed, DEPTH);
    }
    return sum;
}

double grid_expect(grid *g, grid_density *density, const void *of, double samples, double allowed)
{
    const integrand f = {density, of};
    double mass = 0;
    for (int again = 0; again < 2; again++)
        for (size_t i = 0; i < grid_elsewhere(g); i++) {
            size_t row = i / g->columns, column = i % g->columns;
            sides towards = again ? held_sides(g, row, column) : narrow_sides(g, row, column);
            int is_empty = !(g->x[row] < g->x[row + 1] && g->y[column] < g->y[column + 1]);
            int is_missed = again && (towards.below || towards.above || towards.left || towards.right);
            if (!is_empty && (!again || (g->expected[i] <= 0 && is_missed)))
                g->expected[i] = samples * expect_bin(g, &f, i, towards, again, allowed);
        }
    for (size_t i = 0; i < grid_elsewhere(g); i++)
        mass += g->expected[i] / samples;
    g->expected[grid_elsewhere(g)] = fmax(1 - mass, 0) * samples;
    return mass;
}

pearson grid_test(const grid *g)
{
    return pearson_of(g->expected, g->observed, NULL, grid_elsewhere(g) + 1, 5);
}
