/* Bins of the sphere of directions, even in the cosine and the azimuth, and one for what is in none of them: samples of
 * a BSDF against the integrals of its density. Normals have tools/evidence/measure/bins.h. */
#ifndef TESTS_BSDF_SPHERE_H
#define TESTS_BSDF_SPHERE_H

#include "evidence/measure/quadrature.h"
#include "evidence/measure/statistics.h"
#include "oracle/oracle_bsdf.h"

enum { SPHERE_ROWS = 24, SPHERE_COLUMNS = 40, SPHERE_BINS = SPHERE_ROWS * SPHERE_COLUMNS };

static inline size_t sphere_bin(vndf_vec3 w)
{
    const double row = 0.5 * ((double)w.z + 1), column = 0.5 * (atan2((double)w.y, (double)w.x) / PI + 1);
    return (size_t)fmin(fmax(row, 0) * SPHERE_ROWS, SPHERE_ROWS - 1) * SPHERE_COLUMNS +
           (size_t)fmin(column * SPHERE_COLUMNS, SPHERE_COLUMNS - 1);
}

static inline int sphere_answer(void *of, quadrature_point *at, size_t count)
{
    for (quadrature_point *p = at; p < at + count; p++)
        p->value = (double)vndf_bsdf_pdf(of, oracle_toward(p->x, p->y));
    return 1;
}

/* The integral of the density over every bin, and what they leave of 1 for the last; returns that of all. A cell may
 * err by `allowed`, or a hundred-thousandth. The first are quarters of bins, since a peak may be narrow; next to the
 * horizon, where rough grazing facets gather what they scatter, those in a narrow belt are apart. */
static inline double sphere_integrate(const vndf_bsdf *bsdf, double allowed, double probability[SPHERE_BINS + 1])
{
    static const double BELT = 0.01;
    static quadrature_cell cells[4 * SPHERE_BINS];
    static quadrature_sum sum[SPHERE_BINS];
    const quadrature q = {sphere_answer, (void *)bsdf, allowed, 1e-5, 0, 1024, 24};
    double mass = 0;
    memset(sum, 0, sizeof sum);
    for (size_t i = 0; i < 4 * SPHERE_BINS; i++) {
        const size_t row = i / 4 / SPHERE_COLUMNS, column = i / 4 % SPHERE_COLUMNS;
        const double z = 2.0 * (double)row / SPHERE_ROWS - 1, high = 2.0 / SPHERE_ROWS;
        const double part = row + 1 == SPHERE_ROWS / 2 ? high - BELT : row == SPHERE_ROWS / 2 ? BELT : 0.5 * high;
        const double wide = PI / SPHERE_COLUMNS, phi = -PI + wide * (double)(2 * column + i / 2 % 2);
        cells[i] =
            (quadrature_cell){i / 4, {i % 2 ? z + part : z, i % 2 ? z + high : z + part}, {phi, phi + wide}, 0};
    }
    if (!TEST(quadrature_run(&q, cells, 4 * SPHERE_BINS, sum)))
        return NAN;
    for (size_t i = 0; i < SPHERE_BINS; i++)
        mass += probability[i] = sum[i].value;
    probability[SPHERE_BINS] = fmax(1 - mass, 0);
    return mass;
}

#endif
