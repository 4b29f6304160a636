#include "measured/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int warp_make(warp *made, const double *density, int width, int height)
{
    size_t w = (size_t)width, h = (size_t)height;
    *made = (warp){width, height, density, calloc(w * h, sizeof(double)), calloc(h, sizeof(double))};
    if (!made->along || !made->up) {
        warp_free(made);
        return 0;
    }
    for (size_t y = 0; y < h; y++) {
        const double *row = density + y * w;
        double *sum = made->along + y * w;
        for (size_t x = 1; x < w; x++)
            sum[x] = sum[x - 1] + (row[x - 1] + row[x]) / 2;
        if (y > 0)
            made->up[y] = made->up[y - 1] + (sum[w - 1] + (sum - w)[w - 1]) / 2;
    }
    if (made->up[h - 1] > 0)
        return 1;
    warp_free(made);
    return 0;
}

void warp_free(warp *freed)
{
    free(freed->along);
    free(freed->up);
    freed->along = freed->up = NULL;
}

/* In a cell whose density goes linearly from a to b: the place in [0, 1] with this mass before it. */
static double linear_place(double a, double b, double mass)
{
    double root = sqrt(fmax(a * a + 2 * mass * (b - a), 0)), sum = a + root;
    double place = sum > 0 ? 2 * mass / sum : 0;
    return place < 1 ? place : 1;
}

void warp_sample(const warp *of, double s_x, double s_y, double *x, double *y)
{
    int w = of->width, h = of->height, row = 0, column = 0;
    double mass = s_y * of->up[h - 1];
    while (row < h - 2 && of->up[row + 1] <= mass)
        row++;
    const double *low = of->along + (size_t)row * (size_t)w, *high = low + w;
    double v = linear_place(low[w - 1], high[w - 1], mass - of->up[row]);
    mass = s_x * ((1 - v) * low[w - 1] + v * high[w - 1]);
    while (column < w - 2 && (1 - v) * low[column + 1] + v * high[column + 1] <= mass)
        column++;
    const double *from = of->density + (size_t)row * (size_t)w + (size_t)column, *to = from + w;
    double a = (1 - v) * from[0] + v * to[0], b = (1 - v) * from[1] + v * to[1];
    double u = linear_place(a, b, mass - ((1 - v) * low[column] + v * high[column]));
    *x = (column + u) / (w - 1);
    *y = (row + v) / (h - 1);
}

/* ---- least squares ------------------------------------------------------------------------------- */

enum { SWEEPS = 80, NEIGHBOURS = 9 };

static const double SMOOTH = 1e-4; /* of a cell's weight: what ties a point to its neighbours */

/* The normal equations: a row for each point, over it and its neighbours. */
typedef struct equations {
    int side;
    double matrix[FIT_SIDE_MAX * FIT_SIDE_MAX][NEIGHBOURS], right[FIT_SIDE_MAX * FIT_SIDE_MAX];
} equations;

/* A known value at (u, v) in a cell, whose corners are numbered 0 to 3 along u first. */
static void add_value(equations *e, int row, int column, double v, double u, double value, double weight)
{
    const double hat[4] = {(1 - v) * (1 - u), (1 - v) * u, v * (1 - u), v * u};
    for (int i = 0; i < 4; i++) {
        int point = (row + i / 2) * e->side + column + i % 2;
        e->right[point] += weight * hat[i] * value;
        for (int k = 0; k < 4; k++) /* corner k as a neighbour of corner i */
            e->matrix[point][(k / 2 - i / 2 + 1) * 3 + k % 2 - i % 2 + 1] += weight * hat[i] * hat[k];
    }
}

/* The point that is neighbour k, or -1 outside. */
static int neighbour(const equations *e, int row, int column, int k)
{
    int y = row + k / 3 - 1, x = column + k % 3 - 1;
    return y < 0 || x < 0 || y >= e->side || x >= e->side ? -1 : y * e->side + x;
}

/* Every point is tied to those beside it, above it and below it. */
static void tie(equations *e)
{
    for (int point = 0; point < e->side * e->side; point++)
        for (int k = 1; k < NEIGHBOURS; k += 2)
            if (neighbour(e, point / e->side, point % e->side, k) >= 0) {
                e->matrix[point][4] += SMOOTH;
                e->matrix[point][k] -= SMOOTH;
            }
}

/* By sweeps of Gauss and Seidel. */
static void solve(const equations *e, double *grid)
{
    for (int i = 0; i < SWEEPS; i++)
        for (int point = 0; point < e->side * e->side; point++) {
            double sum = e->right[point];
            for (int k = 0; k < NEIGHBOURS; k++) {
                int other = neighbour(e, point / e->side, point % e->side, k);
                if (k != 4 && other >= 0)
                    sum -= e->matrix[point][k] * grid[other];
            }
            grid[point] = sum / e->matrix[point][4];
        }
}

void grid_fit(const float *value, const float *is_known, int side, int points, double *grid)
{
    equations e;
    memset(&e, 0, sizeof e);
    e.side = side;
    int fine = (side - 1) * points;
    double share = 1.0 / (points * points);
    for (int y = 0; y < fine; y++)
        for (int x = 0; x < fine; x++)
            add_value(&e, y / points, x / points, (y % points + 0.5) / points, (x % points + 0.5) / points,
                      (double)value[y * fine + x], share * (double)is_known[y * fine + x]);
    tie(&e);
    memset(grid, 0, (size_t)(side * side) * sizeof *grid);
    solve(&e, grid);
}
