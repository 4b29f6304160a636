/* Makes the sums up to each knot, the cubics of the cells, whether cells are smooth, the blocks, how steep P22 is,
 * the windows and the guide of slopes. */
#include "table/derive.h"

#include <math.h>
#include <stdlib.h>

#include "table/guide.h"
#include "table/layout.h"
#include "table/moment_cubic.h"
#include "table/steep.h"
#include "table/window.h"

/* X1 Z0 - X0 Z1. */
static double width_of(const vndf_knots *k, uint32_t j)
{
    return (double)k->at[j + 1].x * k->at[j].z - (double)k->at[j].x * k->at[j + 1].z;
}

/* Whether (|e1 - e0| + 3 |e0 + e1 - 2 mass|) X1 Z0 <= VNDF_STEEP_CELL min(e0, e1, mass) width for W1/W0 = ratio. This
 * is convex in the ratio, so it holds between two ratios where it holds at both. */
static int is_smooth_at(const vndf_radial_cell *cell, double reach, double ratio)
{
    double e0 = cell->f0, e1 = cell->f1 * ratio, mass = cell->mu0 + cell->mu1 * ratio;
    double change = fabs(e1 - e0) + 3.0 * fabs(e0 + e1 - 2.0 * mass);
    return reach <= VNDF_NARROW * cell->width &&
           change * reach <= VNDF_STEEP_CELL * fmin(fmin(e0, e1), mass) * cell->width;
}

static void derive_cells(vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        vndf_radial_cell *cell = &table->cells[j];
        vndf_moment_cubic cubic = vndf_moment_cubic_from(cell->f0, cell->f1, cell->mu0, cell->mu1);
        table->bends[j].a = (float)cubic.a;
        table->bends[j].b = (float)cubic.b;
        cell->width = (float)width_of(&table->knots, j);
        double x0 = table->knots.at[j].x, x1 = table->knots.at[j + 1].x;
        double z0 = table->knots.at[j].z, z1 = table->knots.at[j + 1].z;
        cell->smooth =
            x0 > 0.0 && z1 > 0.0 && is_smooth_at(cell, x1 * z0, z1 / z0) && is_smooth_at(cell, x1 * z0, x1 / x0);
    }
}

/* Whether a cell and the next are smooth, and D the same on both sides of the knot between them. */
static int is_smooth_after(const vndf_radial_cell *cell)
{
    double left = cell[0].f1 / (double)cell[0].width, right = cell[1].f0 / (double)cell[1].width;
    return cell[0].smooth > 0.0f && cell[1].smooth > 0.0f && fabs(left - right) <= VNDF_STEEP_KNOT * right;
}

static void derive_smooth(vndf_distribution *table)
{
    int before = 0;
    for (uint32_t j = 0; j + 1 < table->radial_count; j++) {
        int after = is_smooth_after(&table->cells[j]);
        if (before && after)
            table->cells[j].smooth = 2.0f;
        before = after;
    }
}

/* Each cell repeats two sums of its first knot. */
static void derive_copies(vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        table->cells[j].before0 = table->knots.f0[j];
        table->cells[j].before1 = table->knots.f1[j];
    }
}

/* F1 and E = F0 - F1 z/x from the pole outwards; every term is positive, so nothing cancels. */
static void derive_pole(vndf_distribution *table)
{
    vndf_knots *k = &table->knots;
    double e = 0.0, f0 = 0.0, f1 = 0.0;
    for (uint32_t j = 0; j < table->radial_count; j++) {
        double mu0 = table->cells[j].mu0, mu1 = table->cells[j].mu1, width = width_of(k, j);
        vndf_knot from = k->at[j], to = k->at[j + 1];
        double x1 = to.x;
        e += (j ? f1 * width / (from.x * x1) : 0.0) + mu0 * width / x1;
        f0 += from.z * mu0 + to.z * mu1;
        f1 += from.x * mu0 + x1 * mu1;
        k->pole[j + 1].e = (float)e;
        k->pole[j + 1].g = (float)(f1 / x1);
        k->f0[j + 1] = (float)f0;
        k->f1[j + 1] = (float)f1;
    }
    table->f0_total = (float)f0;
    table->f1_total = (float)f1;
}

/* T0 and S = T1 - T0 x/z from infinity inwards. */
static void derive_tail(vndf_distribution *table)
{
    vndf_knots *k = &table->knots;
    double s = 0.0, t0 = 0.0;
    for (uint32_t j = table->radial_count; j-- > 0;) {
        double mu0 = table->cells[j].mu0, mu1 = table->cells[j].mu1;
        double z0 = k->at[j].z, z1 = k->at[j + 1].z, width = width_of(k, j);
        s += (z1 > 0 ? t0 * width / (z0 * z1) : 0.0) + mu1 * width / z0;
        t0 += z0 * mu0 + z1 * mu1;
        k->tail[j].s = (float)s;
        k->tail[j].t = (float)(t0 / z0);
    }
}

/* Gives the padding sums that no target reaches: from the pole they are large, from the tail they stay 0. */
static void pad_knots(vndf_knots *k, uint32_t from)
{
    for (uint32_t j = from; j < k->count; j++) {
        k->at[j].x = 1.0f;
        k->pole[j].e = k->pole[j].g = k->f0[j] = k->f1[j] = 1e30f;
    }
}

static void derive_few_sums(vndf_distribution *table)
{
    const uint32_t steps = vndf_step_count(table);
    float *to = table->few_sums;
    for (uint32_t t = 1; to && t < VNDF_STEP; t++)
        for (uint32_t i = 0; i < steps; i++, to++) {
            to[0] = table->knots.f0[VNDF_STEP * i + t];
            to[(VNDF_STEP - 1) * steps] = table->knots.f1[VNDF_STEP * i + t];
        }
}

static void derive_blocks(vndf_distribution *table)
{
    const vndf_knots *k = &table->knots;
    vndf_knots *b = &table->blocks;
    for (uint32_t i = 0; i < b->count; i++) {
        uint32_t j = i * VNDF_BLOCK;
        b->at[i].x = 1.0f; /* beyond the last as in pad_knots */
        if (j <= table->radial_count) {
            b->at[i] = k->at[j];
            b->tail[i] = k->tail[j];
        }
    }
}

/* X/Z of the knots, ascending, the last infinite: only their guide stays. */
static int derive_slopes(vndf_distribution *table)
{
    uint32_t count = table->radial_count + 1;
    float *slope = malloc(count * sizeof *slope);
    if (!slope)
        return 0;
    for (uint32_t j = 0; j < count; j++)
        slope[j] = vndf_knot_slope(table, j);
    int made = vndf_guide_make(&table->slope_guide, slope, count);
    free(slope);
    return made;
}

enum { STEEP_PLACES = 4 };

/* In cell j, at xi: P22 = f Z^4/(X width), dR = width/Z^2 dxi, and the mass is f Z dxi. */
static void add_steepness(vndf_distribution *d, uint32_t j, double xi)
{
    const vndf_radial_cell *cell = &d->cells[j];
    const vndf_knot *from = &d->knots.at[j], *to = from + 1;
    double eta = 1.0 - xi, w = xi * eta, bend = d->bends[j].a + (double)d->bends[j].b * xi;
    double f = cell->f0 * eta + cell->f1 * xi + w * bend;
    double rise = ((double)cell->f1 - cell->f0) + (eta - xi) * bend + w * d->bends[j].b;
    double x = from->x * eta + to->x * xi, z = from->z * eta + to->z * xi;
    if (!(f * z > 1e-8 * d->f0_total))
        return;
    if (!(d->steep_from > 0.0))
        d->steep_from = x / z;
    double fall = rise / f + 4.0 * ((double)to->z - from->z) / z - ((double)to->x - from->x) / x;
    double steepness = fabs(fall) * (z * z) / cell->width, fold = steepness * x / z;
    d->steepness = steepness > d->steepness ? steepness : d->steepness;
    d->fold_steepness = fold > d->fold_steepness ? fold : d->fold_steepness;
}

/* Brings the mass of most cells near 1. With more than 2^12, masses near 1 would overflow. */
static void derive_lift(vndf_distribution *table)
{
    table->lift = 4.0f;
    while (table->lift < 4096.0f && table->lift < 4.0f * (float)table->radial_count)
        table->lift *= 2.0f;
}

static void derive_steepness(vndf_distribution *table)
{
    table->steepness = table->fold_steepness = table->steep_from = 0.0;
    for (uint32_t j = 0; j < table->radial_count; j++)
        for (int i = 0; i < STEEP_PLACES; i++)
            add_steepness(table, j, (i + 0.5) / STEEP_PLACES);
}

int vndf_derive_radial(vndf_distribution *table)
{
    derive_cells(table);
    derive_smooth(table);
    derive_pole(table);
    derive_tail(table);
    derive_copies(table);
    pad_knots(&table->knots, table->radial_count + 1);
    derive_few_sums(table);
    derive_blocks(table);
    derive_steepness(table);
    derive_lift(table);
    return vndf_windows_make(table) && derive_slopes(table);
}
