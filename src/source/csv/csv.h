/* Measured curves: D or P22 against angle or slope, as CSV or as rows of numbers (read.c); the curve is in curve.c.
 *
 * The first line that is neither blank nor a comment (#) names two columns: theta_deg, theta (radians) or
 * slope (= tan theta), then ndf (D) or p22. Each line after it holds two numbers, the first ascending from 0
 * or above, the second finite and not negative. 90 degrees is allowed for ndf: D may be anything there.
 *
 * Between the rows: a shape-preserving cubic. It interpolates the logarithm of the second column if all
 * values are positive, so that a curve over many decades keeps its shape in each; if there are zeros, the column
 * itself. The abscissa is asinh(x/s), x the first column: linear for x << s, logarithmic beyond.
 * s = last x * first step/last step makes the first step as wide as the last: even rows are joined almost as they
 * stand (s >= last x), rows that double are joined in log x. s stays within 1e-12 and 1e3 of the last x.
 *
 * Below the first row: the second column keeps its first value.
 *
 * Beyond the last row: P22 falls as r^-k, k fitted to the last two rows, but never slower than r^-4, for which
 * D is constant: finite at 90 degrees. (k is 4 too if the last two rows give none: P22 rises, or the last row but
 * one is at slope 0.) If the last value is 0, P22 is 0 beyond it: end with 0 for a support that ends. Rows may fall to
 * 0 at 90 degrees, too; D keeps all its digits there, which differences of angles would lose. */
#ifndef VNDF_SOURCE_CSV_CSV_H
#define VNDF_SOURCE_CSV_CSV_H

#include "vndf_build.h"

#define VNDF_RIGHT_ANGLE 1.57079632679489661923

/* Rows that have been checked: at least two. Angles are in radians; the last may be pi/2. */
typedef struct vndf_csv_rows {
    vndf_rows_over over;
    vndf_rows_of of;
    double *x, *value; /* owned */
    size_t count;
} vndf_csv_rows;

/* The curve through rows that have been checked; it copies them and takes description, also where it fails. */
vndf_source *vndf_csv_source(const vndf_csv_rows *rows, char *description, vndf_error *error);

#endif
