/* The part of a view that draws read, in float, for one or for lanes: the stretched direction (s, 0, c) with s + |c| =
 * 1, its azimuth, and the masses of half a turn. Densities of given normals start from wi itself (exact.c).
 *
 * This file serves directions above the horizon, of ordinary size. A dozen roundings leave s, c, cos_phi and
 * sin_phi within 4e-7, and masses within 1e-6. view.c makes the others from doubles. */
#ifndef VNDF_SAMPLER_TABULATED_STRETCHED_VIEW_H
#define VNDF_SAMPLER_TABULATED_STRETCHED_VIEW_H

#include "sampler/tabulated/front.h"
#include "sampler/tabulated/wedge.h"

typedef struct vndf_stretched_view {
    lanes_f s, c, cos_phi, sin_phi;
    lanes_f front, wedge; /* masses; below the horizon 0 and 1 */
    lanes_f area;         /* of the unit problem */
} vndf_stretched_view;

/* From the stretched direction (x, y, z), without masses. Clears *trusted where float does not do. */
VNDF_INLINE vndf_stretched_view vndf_stretched_view_towards(lanes_f x, lanes_f y, lanes_f z, lanes_m *trusted)
{
    lanes_f across2 = x * x + y * y, across = lanes_root(across2), sum = across + z, none = lanes_set(0.0f);
    lanes_f per = 1.0f / sum, per_across = 1.0f / across;
    *trusted = lanes_both(*trusted, vndf_trusts_direction(across2, z, sum));
    lanes_f s = across * per, c = lanes_pick(*trusted, z * per, lanes_set(0.5f)); /* to be looked up */
    vndf_stretched_view stretched = {s, c, x * per_across, y * per_across, none, none, none};
    return stretched;
}

/* Adds the masses and the area. */
VNDF_INLINE void vndf_stretched_view_weigh(const vndf_distribution *d, vndf_stretched_view *stretched,
                                           lanes_m *trusted)
{
    lanes_f per_width;
    stretched->front = vndf_front_mass(vndf_front_of(d, stretched->s, stretched->c));
    stretched->wedge = vndf_wedge_quick(&d->above, stretched->c, &per_width);
    stretched->area = 2.0f * (stretched->front + stretched->wedge);
    *trusted = lanes_both(*trusted, vndf_trusts_area_piece(per_width));
}

VNDF_INLINE vndf_stretched_view vndf_stretched_view_at(const vndf_distribution *d, lanes_f x, lanes_f y, lanes_f z,
                                                       lanes_m *trusted)
{
    vndf_stretched_view stretched = vndf_stretched_view_towards(x, y, z, trusted);
    vndf_stretched_view_weigh(d, &stretched, trusted);
    return stretched;
}

#endif
