#include "bsdf/albedo/spline.h"

#include <stdlib.h>

/* The equations: a fourth difference of 0 at either end, and (1 4 1)/6 for each node. */
static void set_equations(double *rows, uint32_t nodes)
{
    static const double ends[5] = {1.0, -4.0, 6.0, -4.0, 1.0};
    uint32_t count = nodes + 2, width = 2 * count;
    for (uint32_t i = 0; i < count * width; i++)
        rows[i] = 0.0;
    for (uint32_t i = 0; i < 5; i++) {
        rows[i] = ends[i];
        rows[(count - 1) * width + count - 5 + i] = ends[i];
    }
    for (uint32_t i = 1; i <= nodes; i++) {
        double *row = rows + i * width + i - 1;
        row[0] = row[2] = 1.0 / 6.0;
        row[1] = 4.0 / 6.0;
    }
    for (uint32_t i = 0; i < count; i++)
        rows[i * width + count + i] = 1.0;
}

/* Gauss and Jordan: the right half becomes the inverse of the left one. No pivot is small, for any count. */
static void invert(double *rows, uint32_t count)
{
    uint32_t width = 2 * count;
    for (uint32_t k = 0; k < count; k++) {
        double *pivot = rows + k * width, per = 1.0 / pivot[k];
        for (uint32_t j = 0; j < width; j++)
            pivot[j] *= per;
        for (uint32_t i = 0; i < count; i++) {
            double *row = rows + i * width, factor = row[k];
            if (i == k || factor == 0.0)
                continue;
            for (uint32_t j = 0; j < width; j++)
                row[j] -= factor * pivot[j];
        }
    }
}

int vndf_spline_of(vndf_spline *spline, uint32_t nodes)
{
    uint32_t count = nodes + 2;
    double *rows = malloc((size_t)count * 2 * count * sizeof *rows);
    spline->nodes = nodes;
    spline->matrix = malloc((size_t)count * nodes * sizeof *rows);
    if (rows && spline->matrix) {
        set_equations(rows, nodes);
        invert(rows, count);
        for (uint32_t i = 0; i < count; i++)
            for (uint32_t j = 0; j < nodes; j++)
                spline->matrix[i * nodes + j] = rows[i * 2 * count + count + 1 + j];
    }
    free(rows);
    return rows && spline->matrix;
}

void vndf_spline_free(vndf_spline *spline)
{
    free(spline->matrix);
    spline->matrix = NULL;
}

void vndf_spline_fit(const vndf_spline *spline, const double *value, size_t stride, double *coefficient,
                     size_t pitch)
{
    for (uint32_t i = 0; i < spline->nodes + 2; i++) {
        const double *row = spline->matrix + (size_t)i * spline->nodes;
        double sum = 0.0;
        for (uint32_t j = 0; j < spline->nodes; j++)
            sum += row[j] * value[j * stride];
        coefficient[i * pitch] = sum;
    }
}
