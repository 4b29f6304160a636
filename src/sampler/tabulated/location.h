/* A place in the radial table, found from the slope of a given normal, and D at that place; in double, for one or for
 * lanes. X and Z, both >= 0, have any length: with
 *
 *     inner = X z0 - Z x0,   outer = Z x1 - X z1        for the knots (x0, z0), (x1, z1) of the cell
 *
 * xi = inner/(inner + outer) and eta = outer/(inner + outer) are each exact where they are small. Knots have
 * x + z = 1 but for their rounding, so a density for the normal needs x + z of the place. */
#ifndef VNDF_SAMPLER_TABULATED_LOCATION_H
#define VNDF_SAMPLER_TABULATED_LOCATION_H

#include "simd/doubles.h"
#include "table/guide.h"
#include "table/table.h"

typedef struct vndf_radial_location {
    doubles_u cell;
    doubles inner, outer;
    doubles x0, x1, z0, z1; /* the knots */
} vndf_radial_location;

/* The step to the next cell: inwards where `inner` is below 0, outwards where `outer` is not above 0. No lane steps
 * both ways. */
VNDF_INLINE doubles_u vndf_radial_location_step(doubles_u cell, doubles inner, doubles outer, uint32_t count)
{
    const doubles nothing = doubles_set(0.0);
    const doubles_u one = doubles_set_u(1), zero = doubles_set_u(0);
    doubles_m in = doubles_both(doubles_less(inner, nothing), doubles_at_most_u(one, cell));
    doubles_m more = doubles_at_most_u(cell + 2u, doubles_set_u(count));
    doubles_m out = doubles_both(doubles_at_most(outer, nothing), more);
    return doubles_pick_u(out, one, zero) - doubles_pick_u(in, one, zero);
}

/* The place of (X, Z), looked for from a cell that is near. */
VNDF_INLINE vndf_radial_location vndf_radial_location_near(const vndf_distribution *d, doubles x, doubles z,
                                                           doubles_u cell)
{
    const doubles_u none = doubles_set_u(0);
    vndf_radial_location at;
    at.cell = cell;
    for (;;) {
        doubles_lines line = doubles_lines_at(&d->knots.at->x, 2, at.cell);
        doubles_four knots = doubles_load_four(&line, 0); /* x0, z0, x1, z1 */
        doubles inner = x * knots.b - z * knots.a, outer = z * knots.c - x * knots.d;
        doubles_u step = vndf_radial_location_step(at.cell, inner, outer, d->radial_count);
        if (doubles_differ_u(step, none)) {
            at.cell += step;
            continue;
        }
        at.inner = inner;
        at.outer = outer;
        at.x0 = knots.a;
        at.z0 = knots.b;
        at.x1 = knots.c;
        at.z1 = knots.d;
        return at;
    }
}

/* The place of (X, Z). The guide finds the cell or one near it; numbers too small for a float lead it far away. */
VNDF_INLINE vndf_radial_location vndf_radial_location_at(const vndf_distribution *d, doubles x, doubles z)
{
    return vndf_radial_location_near(d, x, z,
                                     vndf_guide_about(&d->slope_guide, doubles_narrow(x) / doubles_narrow(z)));
}

/* f0, f1, mu0, mu1 of the cell. */
VNDF_INLINE doubles_four vndf_radial_location_cell(const vndf_distribution *d, const vndf_radial_location *at)
{
    doubles_lines line = doubles_lines_at(&d->cells->f0, sizeof *d->cells / sizeof(float), at->cell);
    return doubles_load_four(&line, 0);
}

/* A number at the place, times inner + outer, from the numbers at the inner and the outer knot. */
VNDF_INLINE doubles vndf_radial_location_between(const vndf_radial_location *at, doubles in, doubles out)
{
    return at->outer * in + at->inner * out;
}

/* The length of the cell: R = X/Z grows by width/Z^2 as xi grows. */
VNDF_INLINE doubles vndf_radial_location_width(const vndf_radial_location *at)
{
    return at->x1 * at->z0 - at->x0 * at->z1;
}

/* Whether it is the first cell, where X begins at 0. */
VNDF_INLINE doubles_m vndf_radial_location_is_first(const vndf_radial_location *at)
{
    return doubles_at_most_u(at->cell, doubles_set_u(0));
}

/* The bump of a cell's cubic (table/moment_cubic.h), computed from its moments. A bump rounded to float would show
 * where f nearly vanishes. */
typedef struct vndf_bump {
    doubles a, b;
} vndf_bump;

VNDF_INLINE vndf_bump vndf_bump_of(doubles_four f)
{
    vndf_bump bump = {36.0 * f.c - 24.0 * f.d - (8.0 * f.a - 2.0 * f.b), 60.0 * (f.d - f.c) + 10.0 * (f.a - f.b)};
    return bump;
}

/* P22/Z^4 at X + Z = 1 as above/below; above may be less than 0. f begins at 0 as X does. */
typedef struct vndf_quotient {
    doubles above, below;
} vndf_quotient;

VNDF_INLINE vndf_quotient vndf_radial_location_p22(const vndf_distribution *d, const vndf_radial_location *at)
{
    doubles_four f = vndf_radial_location_cell(d, at);
    vndf_bump bump = vndf_bump_of(f);
    doubles per = 1.0 / (at->inner + at->outer), xi = at->inner * per, eta = at->outer * per;
    doubles rise = f.b + eta * (bump.a + bump.b * xi);
    doubles sum = eta * (at->x0 + at->z0) + xi * (at->x1 + at->z1), square = sum * sum;
    doubles_m first = vndf_radial_location_is_first(at);
    doubles above = doubles_pick(first, rise, f.a * eta + xi * rise);
    doubles x = doubles_pick(first, at->x1, at->x0 * eta + at->x1 * xi);
    vndf_quotient p22 = {above * (square * square), x * vndf_radial_location_width(at)};
    return p22;
}

#endif
