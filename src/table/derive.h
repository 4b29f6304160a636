/* Numbers that follow from the arrays of the file: the parts of vndf_table_derive (table/layout.h). */
#ifndef VNDF_TABLE_DERIVE_H
#define VNDF_TABLE_DERIVE_H

#include "table/table.h"

/* From knots.at and f0, f1, mu0, mu1 of the cells: all other numbers of the radial cells, the windows and the guide of
 * slopes. 0 if there is no memory. */
int vndf_derive_radial(vndf_distribution *table);

/* From q, row_y, the aspects, row_cell and the area spline: the rest of a wedge, with its guides. 0 if there is no
 * memory. */
int vndf_derive_wedge(vndf_wedge *wedge);

/* From all these: the copies of a wedge that lanes read. */
void vndf_derive_lanes(vndf_wedge *wedge);

#endif
