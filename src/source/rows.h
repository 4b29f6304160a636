/* A curve known at rows, of which there are too many for all to be breaks. Between two places: how far it strays
 * from the chord. */
#ifndef VNDF_SOURCE_ROWS_H
#define VNDF_SOURCE_ROWS_H

#include <stddef.h>

/* f over u at rows, ascending in u; between row i and the next f is within bend[i] of the chord there. */
typedef struct vndf_rows {
    double *u, *f, *bend; /* one allocation, owned: u */
    size_t count;
} vndf_rows;

/* Room for count rows, 0 if there is no memory. */
int vndf_rows_allocate(vndf_rows *rows, size_t count);
void vndf_rows_free(vndf_rows *rows);

/* A bound of the integral of |f - chord| over [u0, u1]; f0 and f1 are f at the ends. It is 0 within one pair of
 * rows, where the rows say nothing more about the curve. */
double vndf_rows_stray(const vndf_rows *rows, double u0, double f0, double u1, double f1);

#endif
