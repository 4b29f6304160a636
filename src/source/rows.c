/* See rows.h. */
#include "source/rows.h"

#include <math.h>
#include <stdlib.h>

int vndf_rows_allocate(vndf_rows *rows, size_t count)
{
    rows->count = 0;
    rows->u = count < (size_t)-1 / (3 * sizeof *rows->u) ? malloc(3 * count * sizeof *rows->u) : NULL;
    rows->f = rows->u ? rows->u + count : NULL;
    rows->bend = rows->u ? rows->u + 2 * count : NULL;
    return rows->u != NULL;
}

void vndf_rows_free(vndf_rows *rows)
{
    free(rows->u);
    *rows = (vndf_rows){NULL, NULL, NULL, 0};
}

/* The first row beyond u. */
static size_t row_beyond(const vndf_rows *rows, double u)
{
    size_t low = 0, high = rows->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (rows->u[middle] > u)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

double vndf_rows_stray(const vndf_rows *rows, double u0, double f0, double u1, double f1)
{
    double slope = (f1 - f0) / (u1 - u0), from = u0, off = 0.0, sum = 0.0, margin = 1e-9 * (u1 - u0) + 1e-13;
    size_t first = row_beyond(rows, u0 + margin), end = row_beyond(rows, u1 - margin);
    for (size_t i = first; i < end; i++) {
        double here = fabs(rows->f[i] - f0 - slope * (rows->u[i] - u0));
        sum += (rows->u[i] - from) * (fmax(off, here) + (i > 0 ? rows->bend[i - 1] : 0.0));
        off = here;
        from = rows->u[i];
    }
    return end > first ? sum + (u1 - from) * (off + rows->bend[end - 1]) : 0.0;
}
