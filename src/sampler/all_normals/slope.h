/* A slope length as all normals draw it (all_normals.c): the law of each distribution, and that of a table. */
#ifndef VNDF_SAMPLER_ALL_NORMALS_SLOPE_H
#define VNDF_SAMPLER_ALL_NORMALS_SLOPE_H

#include "sampler/analytic_density.h"
#include "sampler/tabulated/draw.h"

/* X and Z at any scale, P22/Z^3 at that scale, and whether that is good for the rounded normal. */
typedef struct vndf_slope {
    float x, z, p22_over_z3;
    int trusted;
} vndf_slope;

/* Bounds the slopes that u2 = 1 stands for; far below the step of a float u2 < 1. */
static const float VNDF_LEAST_REST = 0x1p-26f;

#if VNDF_LANES == 1

/* For the last cells and the border of the unit square; slope.c. */
vndf_slope vndf_table_slope_exactly(const vndf_distribution *d, float u);

/* Of a table. */
VNDF_INLINE vndf_slope vndf_table_slope(const vndf_distribution *d, float u)
{
    float target = u * d->f0_total;
    uint32_t j = vndf_radial_find_one(d, vndf_window_of(d, 1.0f, 0.0f, u), 1.0f, 0.0f, target, 1);
    if (j + 3 > d->radial_count)
        return vndf_table_slope_exactly(d, u);
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    float z0 = d->lift * cell.z0, z1 = d->lift * cell.z1;
    vndf_rational_cell mass = {cell.f0 * z0, cell.f1 * z1, z0 * cell.mu0 + z1 * cell.mu1};
    vndf_rational_place in = vndf_rational_invert(&mass, lanes_positive(d->lift * (target - cell.before0)));
    vndf_place at = vndf_place_in(&cell, &in);
    if (!vndf_trusts_place_in_cell(&cell, &mass, &in) || !vndf_trusts_root(in.root))
        return vndf_table_slope_exactly(d, u);
    float per = 1.0f / in.under, x = at.x * per;
    vndf_slope r = {x, at.z * per, in.root * (in.under * in.under) / (in.below * (d->lift * cell.width) * x), 1};
    return r;
}

/* D cos(theta_m) as a table draws with it. */
double vndf_table_pdf_all(const vndf_distribution *d, double ax, double ay, vndf_normal wm);

#endif
#endif
