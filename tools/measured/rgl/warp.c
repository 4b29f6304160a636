#include "measured/rgl/warp.h"

#include <math.h>
#include <stdlib.h>

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
