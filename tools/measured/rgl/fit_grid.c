#include "measured/rgl/fit_grid.h"

#include <string.h>

enum { SWEEPS = 80, NEIGHBOURS = 9 };

static const double SMOOTH = 1e-4; /* of a cell's weight: what ties a point to its neighbours */

/* The normal equations: a row for each point, over it and its neighbours. */
typedef struct equations {
    int side;
    double matrix[FIT_SIDE_MAX * FIT_SIDE_MAX][NEIGHBOURS], right[FIT_SIDE_MAX * FIT_SIDE_MAX];
} equations;

/* Corner k of a cell. */
static int corner(int row, int column, int k, int side)
{
    return (row + k / 2) * side + column + k % 2;
}

/* Where in the row of corner i corner k stands. */
static int place(int i, int k)
{
    return (k / 2 - i / 2 + 1) * 3 + (k % 2 - i % 2 + 1);
}

static void add_place(equations *e, int row, int column, double v, double u, double value, double weight)
{
    const double hat[4] = {(1 - v) * (1 - u), (1 - v) * u, v * (1 - u), v * u};
    for (int i = 0; i < 4; i++) {
        int point = corner(row, column, i, e->side);
        e->right[point] += weight * hat[i] * value;
        for (int k = 0; k < 4; k++)
            e->matrix[point][place(i, k)] += weight * hat[i] * hat[k];
    }
}

static void add_places(equations *e, const float *value, const float *weight, int points)
{
    int fine = (e->side - 1) * points;
    double share = 1.0 / (points * points);
    for (int y = 0; y < fine; y++)
        for (int x = 0; x < fine; x++)
            add_place(e, y / points, x / points, (y % points + 0.5) / points, (x % points + 0.5) / points,
                      (double)value[y * fine + x], share * (double)weight[y * fine + x]);
}

/* Every point is tied to those beside it, above it and below it. */
static void tie(equations *e)
{
    static const int beside[4][3] = {{-1, 0, 1}, {1, 0, 7}, {0, -1, 3}, {0, 1, 5}}; /* row, column, place */
    for (int row = 0; row < e->side; row++)
        for (int column = 0; column < e->side; column++)
            for (int k = 0; k < 4; k++) {
                int y = row + beside[k][0], x = column + beside[k][1];
                if (y < 0 || x < 0 || y >= e->side || x >= e->side)
                    continue;
                e->matrix[row * e->side + column][4] += SMOOTH;
                e->matrix[row * e->side + column][beside[k][2]] -= SMOOTH;
            }
}

/* One sweep of Gauss and Seidel. */
static void sweep(const equations *e, double *grid)
{
    for (int row = 0; row < e->side; row++)
        for (int column = 0; column < e->side; column++) {
            int point = row * e->side + column;
            double sum = e->right[point];
            for (int k = 0; k < NEIGHBOURS; k++) {
                int y = row + k / 3 - 1, x = column + k % 3 - 1;
                if (k != 4 && y >= 0 && x >= 0 && y < e->side && x < e->side)
                    sum -= e->matrix[point][k] * grid[y * e->side + x];
            }
            grid[point] = sum / e->matrix[point][4];
        }
}

void fit_grid(const float *value, const float *weight, int side, int points, double *grid)
{
    equations e;
    memset(&e, 0, sizeof e);
    e.side = side;
    add_places(&e, value, weight, points);
    tie(&e);
    memset(grid, 0, (size_t)(side * side) * sizeof *grid);
    for (int i = 0; i < SWEEPS; i++)
        sweep(&e, grid);
}
