#include "sampler/tabulated/law.h"

#include <math.h>

enum { PLACES = 4 };

/* In cell j, at xi: P22 = f Z^4/(X width), dR = width/Z^2 dxi, and the mass is f Z dxi. */
static double steepness_at(const vndf_distribution *d, uint32_t j, double xi)
{
    const vndf_radial_cell *cell = &d->cells[j];
    const vndf_knot *from = &d->knots.at[j], *to = from + 1;
    double eta = 1.0 - xi, w = xi * eta, bend = d->bends[j].a + (double)d->bends[j].b * xi;
    double f = cell->f0 * eta + cell->f1 * xi + w * bend;
    double rise = ((double)cell->f1 - cell->f0) + (eta - xi) * bend + w * d->bends[j].b;
    double x = from->x * eta + to->x * xi, z = from->z * eta + to->z * xi;
    if (!(f * z > 1e-8 * d->f0_total))
        return 0.0;
    double fall = rise / f + 4.0 * ((double)to->z - from->z) / z - ((double)to->x - from->x) / x;
    return fabs(fall) * (z * z) / cell->width;
}

double vndf_table_steepness(const vndf_distribution *d)
{
    double most = 0.0;
    for (uint32_t j = 0; j < d->radial_count; j++)
        for (int i = 0; i < PLACES; i++) {
            double steepness = steepness_at(d, j, (i + 0.5) / PLACES);
            most = steepness > most ? steepness : most;
        }
    return most;
}
