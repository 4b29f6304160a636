/* Stage 2 of the engine: the slope length R = X/Z for a given azimuth, density f(xi) (c Z + k X) dxi in each
 * cell of the radial table, where c Z + k X > 0.
 *
 * The weight W = c Z + k X is linear in xi. Masses come from the moments of a cell, W0 mu0 + W1 mu1, sums from
 * the prefix of the side where nothing cancels. The cell that holds the cut W = 0 is used on its visible
 * part alone, with a mass integrated from the cell's cubic and with density 0 at the cut. */
#ifndef VNDF_SAMPLER_RADIAL_H
#define VNDF_SAMPLER_RADIAL_H

#include "math/rational_cell.h"
#include "table/guide.h"
#include "table/table.h"

/* The law of R: everything that does not depend on the uniform number. */
typedef struct vndf_radial_law {
    const vndf_distribution *table;
    float c, k;       /* weights of Z and X */
    float total;      /* mass of the law */
    uint32_t cut;     /* the cell that holds the cut; radial_count if there is none */
    float part;       /* visible part of that cell's xi */
    float part_mass;  /* its mass */
    float part_end;   /* relative density at the end of that cell away from the cut */
} vndf_radial_law;

/* A place in the table. */
typedef struct vndf_radius {
    uint32_t cell;
    float xi;
} vndf_radius;

static inline float vndf_radial_weight(const vndf_radial_law *law, uint32_t j)
{
    float w = law->c * law->table->pole[j].z + law->k * law->table->pole[j].x;
    return w > 0.0f ? w : 0.0f; /* rounding may bring a weight at the cut below 0 */
}

/* Mass from the pole to knot j (c > 0). */
static inline float vndf_radial_before(const vndf_radial_law *law, uint32_t j)
{
    return law->c * law->table->pole[j].e + vndf_radial_weight(law, j) * law->table->pole[j].g;
}

/* Mass beyond knot j (k > 0). */
static inline float vndf_radial_beyond(const vndf_radial_law *law, uint32_t j)
{
    return law->k * law->table->tail[j].s + vndf_radial_weight(law, j) * law->table->tail[j].t;
}

/* integral_0^1 f(h t) (1 - t) dt for the cubic that starts with f0 and ends with f1; never below half of
 * what the straight line gives: where the cubic is good the floor is far away, and a density stays positive where it is not. */
static inline float vndf_radial_part(float f0, float f1, float a, float b, float h)
{
    float slope = f1 - f0;
    float cubic = f0 / 2.0f + h * ((slope + a) / 6.0f + h * ((b - a) / 12.0f - h * b / 20.0f));
    float line = f0 / 2.0f + h * slope / 6.0f;
    float least = 1e-3f * line;
    return cubic > least ? cubic : least;
}

static inline void vndf_radial_cut_above(vndf_radial_law *law)
{
    const vndf_distribution *d = law->table;
    uint32_t j = vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, law->c / -law->k);
    float w0 = vndf_radial_weight(law, j), w1 = law->c * d->pole[j + 1].z + law->k * d->pole[j + 1].x;
    const vndf_radial_cell *cell = &d->cells[j];
    law->part = w1 < 0.0f ? w0 / (w0 - w1) : 1.0f;
    float mean = vndf_radial_part(cell->f0, cell->f1, cell->a, cell->b, law->part);
    law->cut = j;
    law->part_mass = w0 * law->part * mean;
    law->part_end = mean > 0.0f ? cell->f0 / mean : 0.0f;
    law->total = vndf_radial_before(law, j) + law->part_mass;
}

static inline void vndf_radial_cut_below(vndf_radial_law *law)
{
    const vndf_distribution *d = law->table;
    uint32_t j = vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, -law->c / law->k);
    float w0 = law->c * d->pole[j].z + law->k * d->pole[j].x, w1 = vndf_radial_weight(law, j + 1);
    const vndf_radial_cell *cell = &d->cells[j];
    law->part = w0 < 0.0f ? w1 / (w1 - w0) : 1.0f;
    float mean = vndf_radial_part(cell->f1, cell->f0, cell->a + cell->b, -cell->b, law->part);
    law->cut = j;
    law->part_mass = w1 * law->part * mean;
    law->part_end = mean > 0.0f ? cell->f1 / mean : 0.0f;
    law->total = vndf_radial_beyond(law, j + 1) + law->part_mass;
}

/* The law for the weights (c, k), at least one of them positive. */
static inline vndf_radial_law vndf_radial_law_for(const vndf_distribution *table, float c, float k)
{
    vndf_radial_law law = {table, c, k, 0.0f, table->radial_count, 1.0f, 0.0f, 0.0f};
    if (c > 0.0f && k < 0.0f)
        vndf_radial_cut_above(&law);
    else if (c < 0.0f && k > 0.0f)
        vndf_radial_cut_below(&law);
    else if (c >= 0.0f && k >= 0.0f)
        law.total = vndf_radial_before(&law, table->radial_count);
    return law;
}

static inline float vndf_radial_mass(const vndf_radial_law *law, uint32_t j)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    return vndf_radial_weight(law, j) * cell->mu0 + vndf_radial_weight(law, j + 1) * cell->mu1;
}

/* A cell away from the cut. */
static inline vndf_rational_cell vndf_radial_whole(const vndf_radial_law *law, uint32_t j)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    float mass = vndf_radial_mass(law, j), per_mass = mass > 0.0f ? 1.0f / mass : 0.0f;
    vndf_rational_cell shape = {cell->f0 * vndf_radial_weight(law, j) * per_mass,
                                cell->f1 * vndf_radial_weight(law, j + 1) * per_mass};
    return shape;
}

/* u of mass / total as a number that a cell can invert. */
static inline float vndf_radial_fraction(float mass, float total)
{
    float u = total > 0.0f ? mass / total : 0.5f;
    return u < 1.0f ? (u > 0.0f ? u : 0.0f) : 1.0f;
}

/* Place where a part u of the mass lies before it, for c >= 0. */
static inline vndf_radius vndf_radial_invert_above(const vndf_radial_law *law, float u)
{
    float target = u * law->total;
    uint32_t j = 0, n = law->cut < law->table->radial_count ? law->cut + 1 : law->table->radial_count;
    while (n > 1) {
        uint32_t half = n / 2;
        j = vndf_radial_before(law, j + half) <= target ? j + half : j;
        n -= half;
    }
    float rest = target - vndf_radial_before(law, j);
    vndf_radius at = {j, 0.0f};
    if (j == law->cut) {
        vndf_rational_cell shape = {law->part_end, 0.0f};
        at.xi = law->part * vndf_rational_invert(shape, vndf_radial_fraction(rest, law->part_mass));
    } else
        at.xi = vndf_rational_invert(vndf_radial_whole(law, j), vndf_radial_fraction(rest, vndf_radial_mass(law, j)));
    return at;
}

/* The same for c < 0, counted from infinity inwards. */
static inline vndf_radius vndf_radial_invert_below(const vndf_radial_law *law, float u)
{
    float target = (1.0f - u) * law->total;
    uint32_t j = law->cut, n = law->table->radial_count - law->cut;
    while (n > 1) { /* the last cell j with mass beyond its inner knot > target; the cut cell holds the rest */
        uint32_t half = n / 2;
        j = vndf_radial_beyond(law, j + half) > target ? j + half : j;
        n -= half;
    }
    float rest = target - vndf_radial_beyond(law, j + 1);
    vndf_radius at = {j, 0.0f};
    if (j == law->cut) {
        vndf_rational_cell mirrored = {law->part_end, 0.0f};
        at.xi = 1.0f - law->part * vndf_rational_invert(mirrored, vndf_radial_fraction(rest, law->part_mass));
    } else {
        vndf_rational_cell whole = vndf_radial_whole(law, j), mirrored = {whole.d1, whole.d0};
        at.xi = 1.0f - vndf_rational_invert(mirrored, vndf_radial_fraction(rest, vndf_radial_mass(law, j)));
    }
    return at;
}

static inline vndf_radius vndf_radial_invert(const vndf_radial_law *law, float u)
{
    return law->c < 0.0f ? vndf_radial_invert_below(law, u) : vndf_radial_invert_above(law, u);
}

/* The part of the cut cell at xi, from the end away from the cut: 0 to 1. */
static inline float vndf_radial_part_at(const vndf_radial_law *law, float xi)
{
    float from_end = (law->c < 0.0f ? 1.0f - xi : xi) / law->part;
    return from_end < 1.0f ? from_end : 1.0f;
}

/* Part of the mass before a place. */
static inline float vndf_radial_cdf(const vndf_radial_law *law, vndf_radius at)
{
    vndf_rational_cell part = {law->part_end, 0.0f};
    float before;
    if (at.cell != law->cut) {
        float in_cell = vndf_radial_mass(law, at.cell);
        vndf_rational_cell whole = vndf_radial_whole(law, at.cell), mirrored = {whole.d1, whole.d0};
        if (law->c < 0.0f)
            return 1.0f - (vndf_radial_beyond(law, at.cell + 1) + in_cell * vndf_rational_cdf(mirrored, 1.0f - at.xi)) / law->total;
        before = vndf_radial_before(law, at.cell) + in_cell * vndf_rational_cdf(whole, at.xi);
    } else {
        float in_part = law->part_mass * vndf_rational_cdf(part, vndf_radial_part_at(law, at.xi));
        if (law->c < 0.0f)
            return 1.0f - (vndf_radial_beyond(law, at.cell + 1) + in_part) / law->total;
        before = vndf_radial_before(law, at.cell) + in_part;
    }
    return before / law->total;
}

/* Part of the mass per unit of xi, divided by X at that place (finite at the pole, where both vanish). */
static inline float vndf_radial_density_over_x(const vndf_radial_law *law, vndf_radius at)
{
    const vndf_pole_knot *knot = &law->table->pole[at.cell];
    int cut = at.cell == law->cut;
    float mass = cut ? law->part_mass / law->part : vndf_radial_mass(law, at.cell);
    vndf_rational_cell shape = {law->part_end, 0.0f};
    float xi = at.xi;
    if (cut)
        xi = vndf_radial_part_at(law, xi);
    else
        shape = vndf_radial_whole(law, at.cell);
    if (at.cell == 0 && law->c >= 0.0f) /* X = xi X1 and the density begins at 0 */
        return mass / law->total * vndf_rational_density_over_xi(shape, xi) / (knot[1].x * (cut ? law->part : 1.0f));
    float x = knot[0].x + at.xi * (knot[1].x - knot[0].x);
    return mass / law->total * vndf_rational_density(shape, xi) / x;
}

#endif
