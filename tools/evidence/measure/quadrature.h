/* Integrals over bins of two numbers x and y, of any function, without bias, with an error that is measured. The caller
 * divides the bins into cells, which are rectangles, and answers for all points of a round at once, so that a process
 * may be who answers. */
#ifndef TOOLS_EVIDENCE_MEASURE_QUADRATURE_H
#define TOOLS_EVIDENCE_MEASURE_QUADRATURE_H

#include <stddef.h>
#include <stdint.h>

typedef struct quadrature_point {
    size_t bin;
    double x, y, part; /* of the area in which it stands for the function; of most points 0 */
    double value[2];   /* of the function, and of another one that it is compared with, or 0 */
} quadrature_point;

typedef struct quadrature_sum {
    double value, variance;             /* the integral, and its error squared */
    double distance, square, uncovered; /* of the other one g: half of |f - g|, g^2/f, and of g where f is 0 */
} quadrature_sum;

typedef struct quadrature_cell {
    size_t bin;
    double x[2], y[2];
    int is_asked; /* from here on 0 to begin with: quadrature_run fills it */
    quadrature_sum sum;
    double urgency, along[2]; /* what it may err, of both functions; by how much they vary along x, and along y */
} quadrature_cell;

typedef struct quadrature {
    int (*answer)(void *of, quadrature_point *at, size_t count); /* fills values, which are 0; 0: it gives up */
    void *of;
    size_t bins, most;    /* how many bins, and at most cells */
    double close, finest; /* what a cell may err, and the width along x below which it may err more */
    int rounds;           /* times that points are asked for: a cell is halved less often */
    uint64_t seed;        /* of the points */
    const double
        *observed;  /* NULL or, of each bin, how many of `samples` fell into it: where they are too many or */
    double samples; /* too few, it is looked at more closely */
} quadrature;

/* The integrals over bins. `count` cells are there, and room for `most`. 0 if `answer` gave up or there was no
 * memory. */
int quadrature_run(const quadrature *q, quadrature_cell *cells, size_t count, quadrature_sum *sum);

#endif
