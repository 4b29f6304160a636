/* A bilinear function on a grid over the unit square that is nearest to a function known in the middles of cells. */
#ifndef TOOLS_MEASURED_RGL_FIT_GRID_H
#define TOOLS_MEASURED_RGL_FIT_GRID_H

enum { FIT_SIDE_MAX = 64 };

/* Least squares over the places with weight[] above 0, of which every cell of the grid has points x points; value and
 * weight are ((side - 1) points)^2 numbers, grid side^2. Interpolating the function at the points of the grid would
 * halve it in the cells where it ends: here it may go on beyond its end as it likes. Points that no place sees go on
 * smoothly from their neighbours. */
void fit_grid(const float *value, const float *weight, int side, int points, double *grid);

#endif
