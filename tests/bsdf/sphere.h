/* Bins of the sphere of directions, even in the cosine and the azimuth, and one for what is in none of them: samples of
 * a BSDF against the integrals of its density. Normals have tools/evidence/measure. */
#ifndef TESTS_BSDF_SPHERE_H
#define TESTS_BSDF_SPHERE_H

#include "evidence/measure/measure.h"
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
        p->value[0] = (double)vndf_bsdf_pdf(of, oracle_toward(p->x, p->y));
    return 1;
}

/* The integral of the density over every bin, and what they leave of 1 for the last; returns that of all. A cell may
 * err by `allowed`. The first are quarters of bins, since a peak may be narrow; next to the horizon, where rough
 * grazing facets gather what they scatter, those in a narrow belt are apart. */
static inline double sphere_integrate(const vndf_bsdf *bsdf, double allowed, double probability[SPHERE_BINS + 1])
{
    enum { ROWS = 2 * SPHERE_ROWS, COLUMNS = 2 * SPHERE_COLUMNS, FINE = ROWS * COLUMNS, CELLS_MAX = 100000 };
    static const double BELT = 0.01;
    static quadrature_cell cells[CELLS_MAX];
    static quadrature_sum sum[FINE];
    const quadrature q = {sphere_answer, (void *)bsdf, FINE, CELLS_MAX, allowed, 0, 20, 1, NULL, 0};
    double mass = 0, z[ROWS + 1], phi[COLUMNS + 1];
    for (int i = 0; i <= ROWS; i++)
        z[i] = abs(i - SPHERE_ROWS) == 1 ? (i - SPHERE_ROWS) * BELT : 2.0 * i / ROWS - 1;
    for (int i = 0; i <= COLUMNS; i++)
        phi[i] = 2 * PI * i / COLUMNS - PI;
    memset(probability, 0, (SPHERE_BINS + 1) * sizeof *probability);
    if (!TEST(quadrature_run(&q, cells, bins_cells(z, ROWS, phi, COLUMNS, 0, cells), sum)))
        return NAN;
    for (size_t i = 0; i < FINE; i++) {
        probability[i / COLUMNS / 2 * SPHERE_COLUMNS + i % COLUMNS / 2] += sum[i].value;
        mass += sum[i].value;
    }
    probability[SPHERE_BINS] = fmax(1 - mass, 0);
    return mass;
}

#endif
