#include "statistics/grid.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "evidence/measure/quadrature.h"

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

typedef struct asked {
    grid_density *density;
    const void *of;
} asked;

static int answer(void *state, quadrature_point *at, size_t count)
{
    const asked *a = state;
    for (size_t i = 0; i < count; i++)
        at[i].value = a->density(at[i].x, at[i].y, a->of);
    return 1;
}

double grid_expect(grid *g, grid_density *density, const void *of, double samples, double allowed)
{
    static quadrature_cell cells[4 * GRID_BINS];
    static quadrature_sum sum[GRID_BINS];
    asked state = {density, of};
    const quadrature q = {answer, &state, allowed, 1e-5, 0, 1024, 24};
    double mass = 0;
    memset(sum, 0, sizeof sum);
    for (size_t i = 0; i < 4 * g->elsewhere; i++) {
        const double *x = g->x + i / 4 / g->columns, *y = g->y + i / 4 % g->columns;
        const double middle[2] = {(x[0] + x[1]) / 2, (y[0] + y[1]) / 2};
        cells[i] = (quadrature_cell){i / 4,
                                     {i & 1 ? middle[0] : x[0], i & 1 ? x[1] : middle[0]},
                                     {i & 2 ? middle[1] : y[0], i & 2 ? y[1] : middle[1]},
                                     0};
    }
    if (!quadrature_run(&q, cells, 4 * g->elsewhere, sum))
        return NAN;
    for (size_t i = 0; i < g->elsewhere; i++) {
        g->expected[i] = samples * sum[i].value;
        mass += sum[i].value;
    }
    g->expected[g->elsewhere] = fmax(1 - mass, 0) * samples;
    return mass;
}

pearson grid_test(const grid *g)
{
    return pearson_of(g->expected, g->observed, g->elsewhere + 1);
}
