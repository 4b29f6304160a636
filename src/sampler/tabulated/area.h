/* The projected area A(-|w|) of a table (sampler/area.h), in double from the caller's own numbers, for one or for
 * lanes. The direction (alpha_x w.x, alpha_y w.y, w.z) is not made unit: an area grows with its length, and
 * quotients of areas drop the length. With its level length S and U = |w.z| the area is
 *
 *     2 (S + U) M(S/(S + U)),    M the mass of half the wedge below (sampler/tabulated/theory.h). */
#ifndef VNDF_SAMPLER_TABULATED_AREA_H
#define VNDF_SAMPLER_TABULATED_AREA_H

#include "math/elementary.h"
#include "sampler/tabulated/wedge.h"

/* Roughness times the table's scale, and a direction. */
typedef struct vndf_direction {
    doubles ax, ay, x, y, z;
} vndf_direction;

/* Whether roughness is in range and the direction is finite and not zero. Elsewhere all answers are 0. */
VNDF_INLINE doubles_m vndf_direction_is_valid(const vndf_direction *w)
{
    const doubles least = doubles_set(1e-18), most = doubles_set(1e18);
    doubles square = w->x * w->x + w->y * w->y + w->z * w->z;
    doubles_m low = doubles_both(doubles_at_most(least, w->ax), doubles_at_most(least, w->ay));
    doubles_m high = doubles_both(doubles_at_most(w->ax, most), doubles_at_most(w->ay, most));
    doubles_m usable =
        doubles_both(doubles_less(doubles_set(0.0), square), doubles_less(square, doubles_set(HUGE_VAL)));
    return doubles_both(doubles_both(low, high), usable);
}

/* The level length S. */
VNDF_INLINE doubles vndf_direction_across(const vndf_direction *w)
{
    doubles x = w->ax * w->x, y = w->ay * w->y;
    return doubles_root(x * x + y * y);
}

VNDF_INLINE doubles vndf_area_below_table(const vndf_distribution *d, doubles across, doubles up, doubles_m valid)
{
    doubles sum = across + up, y = doubles_pick(valid, across / sum, doubles_set(0.5)); /* to be looked up */
    return 2.0 * sum * vndf_wedge_mass(&d->below, y);
}

#endif
