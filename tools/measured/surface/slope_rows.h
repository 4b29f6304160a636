/* The rows of P22 whose curve has the masses of bins. */
#ifndef TOOLS_MEASURED_SURFACE_SLOPE_ROWS_H
#define TOOLS_MEASURED_SURFACE_SLOPE_ROWS_H

#include "measured/surface/slope_bins.h"

/* Slopes that end abruptly have no tail: there the curve has an end, and so has the last bin. *left: the largest part
 * of the whole by which a bin is wrong; *beyond: what the curve has beyond the longest slope. 0 and the reason if there
 * is no such curve. */
int slope_rows_find(slope_bins *b, const char *name, profile *rows, double *left, double *beyond, refusal *why);

#endif
