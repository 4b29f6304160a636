#include "statistics/grid.h"

#include <math.h>
#include <string.h>

void grid_even(grid *g, size_t rows, double x0, double x1, size_t columns, double y0, double y1)
{
    memset(g, 0, sizeof *g);
    g->rows = rows;
    g->columns = columns;
    g->elsewhere = rows * columns;
    for (size_t i = 0; i <= rows; i++)
        g->x[i] = x0 + (x1 - x0) * (double)i / (double)rows;
    for (size_t i = 0; i <= columns; i++)
        g->y[i] = y0 + (y1 - y0) * (double)i / (double)columns;
}

size_t grid_bin(const grid *g, double x, double y)
{
    return bins_interval(g->x, g->rows, x) * g->columns + bins_interval(g->y, g->columns, y);
}

/* ---- integrals ---- */

/* Gauss-Legendre with five points in both. */
static double rule(grid_density *f, const void *of, const double x[2], const double y[2])
{
    static const double node[5] = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                                   0.906179845938664};
    static const double weight[5] = {0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                     0.236926885056189};
    double sum = 0, h = (x[1] - x[0]) / 2, k = (y[1] - y[0]) / 2;
    for (int i = 0; i < 25; i++)
        sum += weight[i / 5] * weight[i % 5] * f(x[0] + h * (1 + node[i / 5]), y[0] + k * (1 + node[i % 5]), of);
    return sum * h * k;
}

static double halve(grid_density *f, const void *of, const double x[2], const double y[2], double whole,
                    double allowed, int halvings)
{
    const double mx = (x[0] + x[1]) / 2, my = (y[0] + y[1]) / 2;
    const double xs[2][2] = {{x[0], mx}, {mx, x[1]}}, ys[2][2] = {{y[0], my}, {my, y[1]}};
    double a[2], b[2];
    for (int i = 0; i < 2; i++)
        a[i] = rule(f, of, xs[i], y), b[i] = rule(f, of, x, ys[i]);
    double by_x = fabs(a[0] + a[1] - whole), by_y = fabs(b[0] + b[1] - whole);
    if (halvings == 0 || fmax(by_x, by_y) <= fmax(1e-5 * whole, allowed))
        return a[0] + a[1] + b[0] + b[1] - whole;
    if (by_x > by_y)
        return halve(f, of, xs[0], y, a[0], allowed, halvings - 1) +
               halve(f, of, xs[1], y, a[1], allowed, halvings - 1);
    return halve(f, of, x, ys[0], b[0], allowed, halvings - 1) +
           halve(f, of, x, ys[1], b[1], allowed, halvings - 1);
}

static double integral(grid_density *f, const void *of, const double x[2], const double y[2], double allowed)
{
    return halve(f, of, x, y, rule(f, of, x, y), allowed, 24);
}

double grid_expect(grid *g, grid_density *density, const void *of, double samples, double allowed)
{
    double mass = 0;
    for (size_t i = 0; i < g->elsewhere; i++) {
        const double *x = g->x + i / g->columns, *y = g->y + i % g->columns;
        const double within = integral(density, of, x, y, allowed);
        g->expected[i] = samples * within;
        mass += within;
    }
    g->expected[g->elsewhere] = fmax(1 - mass, 0) * samples;
    return mass;
}

pearson grid_test(const grid *g)
{
    return pearson_of(g->expected, g->observed, NULL, g->elsewhere + 1, 5);
}
