/* Knots and the sums beyond them, each in a column, for searches that compare four numbers at once: R, then the four
 * sums of VNDF_TAIL. A search counts pivots, every eighth knot from the eighth on, then the knots of one block of
 * eight. Padding fails every comparison of a search. */
#ifndef VNDF_TABLE_COLUMNS_H
#define VNDF_TABLE_COLUMNS_H

#include "core/inline.h"

enum { VNDF_COLUMNS = 5, VNDF_COLUMN_STEP = 8 };

/* Floats of a column: up to the end of the last block. Pivots of a column: a multiple of four. */
VNDF_INLINE int vndf_column_size(int cells)
{
    return cells / VNDF_COLUMN_STEP * VNDF_COLUMN_STEP + VNDF_COLUMN_STEP + 1;
}

VNDF_INLINE int vndf_pivot_count(int cells)
{
    return (cells / VNDF_COLUMN_STEP + 3) / 4 * 4;
}

#endif
