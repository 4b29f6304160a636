/* Memory of a table: one block for the arrays of the file and the numbers that follow from them. */
#ifndef VNDF_TABLE_LAYOUT_H
#define VNDF_TABLE_LAYOUT_H

#include <math.h>

#include "table/table.h"

typedef struct vndf_table_size {
    uint32_t radial;
    uint32_t above_cells, above_rows, above_knots;
    uint32_t below_cells, below_rows, below_knots;
} vndf_table_size;

/* Azimuth rows for so many knots, and back: every second row stands at a knot, the others between two. */
static inline uint32_t vndf_row_count(uint32_t knots)
{
    return 2 * knots - 1;
}

static inline uint32_t vndf_row_knots(uint32_t rows)
{
    return rows / 2 + 1;
}

/* X/Z at a knot, infinite at the last. */
static inline float vndf_knot_slope(const vndf_distribution *table, uint32_t j)
{
    vndf_knot k = table->knots.at[j];
    return k.z > 0.0f ? k.x / k.z : HUGE_VALF;
}

/* An empty table with room for everything, zeroed; NULL if there is no memory. */
vndf_distribution *vndf_table_allocate(vndf_table_size size);

/* After the arrays of the file are filled (knots.at, cells' f0 f1 mu0 mu1, row_y, aspects, row_cell,
 * area splines): prefix sums, coefficients of cubics and area pieces, windows, guides. In double where
 * sums are long. 0 if there is no memory. */
int vndf_table_derive(vndf_distribution *table);

/* Bytes of all allocations of a table that is derived. */
size_t vndf_table_memory(const vndf_distribution *table);

#endif
