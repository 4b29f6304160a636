/* Bins of a rectangle, and one bin for what is not in it: samples of two numbers against a density or against
 * expected counts. Normals have tools/evidence/measure/bins.h. */
#ifndef TESTS_STATISTICS_GRID_H
#define TESTS_STATISTICS_GRID_H

#include "evidence/measure/bins.h"
#include "evidence/measure/statistics.h"

enum { GRID_ROWS = 65, GRID_COLUMNS = 130, GRID_BINS = GRID_ROWS * GRID_COLUMNS };

/* Large: keep it static. Bin row * columns + column; the last, `elsewhere`, is of what is in no other. */
typedef struct grid {
    size_t rows, columns, elsewhere;
    double x[GRID_ROWS + 1], y[GRID_COLUMNS + 1]; /* borders, ascending */
    double expected[GRID_BINS + 1], observed[GRID_BINS + 1];
} grid;

/* Empty, with even borders. */
void grid_even(grid *g, size_t rows, double x0, double x1, size_t columns, double y0, double y1);

size_t grid_bin(const grid *g, double x, double y);

/* Writes the integral over every bin, times `samples`, to `expected`, and what they leave of 1 to the last;
 * returns the integral of all. A cell may err by `allowed`, or a hundred-thousandth; the first are quarters of bins,
 * since a peak may be narrow. */
typedef double grid_density(double x, double y, const void *of);
double grid_expect(grid *g, grid_density *density, const void *of, double samples, double allowed);

/* Of all bins together; those that expect less than 5 are pooled with their neighbours. */
pearson grid_test(const grid *g);

#endif
