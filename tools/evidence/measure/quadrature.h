/* Integrals over bins of two numbers x and y. The caller divides the bins into cells, which are rectangles, and answers
 * for many points at once, so that a process may be who answers. */
#ifndef TOOLS_EVIDENCE_MEASURE_QUADRATURE_H
#define TOOLS_EVIDENCE_MEASURE_QUADRATURE_H

#include <stddef.h>

typedef struct quadrature_cell {
    size_t bin;
    double x[2], y[2];
    int halvings; /* 0 */
} quadrature_cell;

typedef struct quadrature_point {
    size_t bin;
    double x, y, value;
} quadrature_point;

typedef struct quadrature_sum {
    double value, error;
    double change; /* along x, from point to point, integrated over y */
} quadrature_sum;

typedef struct quadrature {
    int (*answer)(void *of, quadrature_point *at, size_t count); /* fills values, which are 0; 0: it gives up */
    void *of;
    double absolute, relative; /* what a cell may err, whichever is larger; relative: to its first integral */
    double rounding;           /* of x: a cell may err by its change times this, too */
    size_t at_once;            /* cells whose points are asked for together */
    int halvings;              /* of a cell */
} quadrature;

/* Adds the integrals over cells to sum[bin]. 0 if `answer` gave up or there was no memory. */
int quadrature_run(const quadrature *q, const quadrature_cell *cells, size_t count, quadrature_sum *sum);

#endif
