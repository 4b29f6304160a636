/* Integers, and the table as the kernel reads it. A kernel of doubles includes it where it reads a table. */
#ifndef VNDF_KERNEL_ROWS_H
#define VNDF_KERNEL_ROWS_H

#include <stdint.h>
#include <string.h>

#include "table/table.h"

typedef int32_t integer;

KERNEL integer set_int(int i)
{
    return i;
}

KERNEL integer select_int(mask m, integer yes, integer no)
{
    return no + ((yes - no) & -any(m));
}

KERNEL real to_real(integer i)
{
    return (real)i;
}

/* The whole part of x, |x| < 2^31. */
KERNEL integer to_int(real x)
{
    return (integer)x;
}

KERNEL integer min_int(integer a, integer b)
{
    return a < b ? a : b;
}

KERNEL integer max_int(integer a, integer b)
{
    return a > b ? a : b;
}

/* Bit pattern of x rounded to float, and its inverse. */
KERNEL integer bits(real x)
{
    float narrow = (float)x;
    integer i;
    memcpy(&i, &narrow, sizeof i);
    return i;
}

KERNEL real of_bits(integer i)
{
    float x;
    memcpy(&x, &i, sizeof x);
    return x;
}

/* Four numbers of a table that stand side by side. */
typedef struct quad {
    real x, y, z, w;
} quad;

/* A table as the kernel reads it (table/table.h). */
typedef struct table {
    const float *numbers, *columns;
    const vndf_layout *layout;
    int cells, moments, squarings, highest, steps; /* highest: the highest power of two <= cells, 2^(steps - 1) */
    int column, pivots;                            /* table/table.h */
} table;

KERNEL table table_of(const vndf_distribution *d)
{
    table t = {d->numbers + VNDF_HEAD, d->columns, d->layout, d->cells,  d->moments,
               d->squarings,           d->highest, d->steps,  d->column, d->pivots};
    return t;
}

KERNEL integer first_knot(table t, integer eighth)
{
    return t.layout->first[eighth];
}

/* A row of knot i. */
KERNEL quad load_row(table t, int group, integer i)
{
    const float *row = t.numbers + VNDF_STRIDE * (size_t)(unsigned)i + 4 * group;
    quad q = {row[0], row[1], row[2], row[3]};
    return q;
}

#endif
