/* Whole numbers and the rows of a table. With doubles it is included where a table is read. */
#ifndef VNDF_KERNEL_ROWS_H
#define VNDF_KERNEL_ROWS_H

#include <stdint.h>
#include <string.h>

#include "table/table.h"

typedef int32_t whole;

HERE whole set_whole(int i)
{
    return i;
}

HERE whole pick_whole(mask m, whole yes, whole no)
{
    return no + ((yes - no) & -any(m));
}

HERE real to_real(whole i)
{
    return (real)i;
}

/* The whole part of x, |x| < 2^31. */
HERE whole to_whole(real x)
{
    return (whole)x;
}

HERE whole least_whole(whole a, whole b)
{
    return a < b ? a : b;
}

HERE whole most_whole(whole a, whole b)
{
    return a > b ? a : b;
}

/* Of the nearest float, and back. */
HERE whole bits(real x)
{
    float narrow = (float)x;
    whole i;
    memcpy(&i, &narrow, sizeof i);
    return i;
}

HERE real of_bits(whole i)
{
    float x;
    memcpy(&x, &i, sizeof x);
    return x;
}

/* Four numbers of a table that stand side by side. */
typedef struct quad {
    real a, b, c, d;
} quad;

/* A table as the kernel reads it (table/table.h). */
typedef struct table {
    const float *numbers, *columns;
    const vndf_layout *layout;
    int cells, moments, squarings, highest, steps; /* highest: the highest power of two <= cells, 2^(steps - 1) */
    int column, pivots;                            /* table/table.h */
} table;

HERE table table_of(const vndf_distribution *d)
{
    table t = {d->numbers + VNDF_HEAD, d->columns, d->layout, d->cells,  d->moments,
               d->squarings,           d->highest, d->steps,  d->column, d->pivots};
    return t;
}

HERE whole look_first(table t, whole eighth)
{
    return t.layout->first[eighth];
}

/* A row of knot i. */
HERE quad look(table t, int group, whole i)
{
    const float *row = t.numbers + VNDF_STRIDE * (size_t)(unsigned)i + 4 * group;
    quad q = {row[0], row[1], row[2], row[3]};
    return q;
}

#endif
