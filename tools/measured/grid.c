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

void grid_fit(const float *value, const float *is_known, int side, int points, int steps, double *grid)
{
    double sum[FIT_SIDE_MAX * FIT_SIDE_MAX], whole[FIT_SIDE_MAX * FIT_SIDE_MAX];
    int fine = (side - 1) * points;
    memset(grid, 0, (size_t)(side * side) * sizeof *grid);
    for (int step = 0; step < steps; step++) {
        memset(sum, 0, sizeof sum);
        memset(whole, 0, sizeof whole);
        for (int i = 0; i < fine * fine; i++) {
            int y = i / fine, x = i % fine, corner = y / points * side + x / points;
            double v = (y % points + 0.5) / points, u = (x % points + 0.5) / points, left = (double)value[i];
            const int at[4] = {corner, corner + 1, corner + side, corner + side + 1};
            const double hat[4] = {(1 - v) * (1 - u), (1 - v) * u, v * (1 - u), v * u};
            if (is_known && !(is_known[i] > 0))
                continue;
            for (int k = 0; k < 4; k++)
                left -= hat[k] * grid[at[k]];
            for (int k = 0; k < 4; k++) {
                sum[at[k]] += hat[k] * left;
                whole[at[k]] += hat[k];
            }
        }
        for (int i = 0; i < side * side; i++)
            grid[i] += whole[i] > 0 ? sum[i] / whole[i] : 0;
    }
}
