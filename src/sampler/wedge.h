/* The wedge, the part of the circle that the horizon of wi cuts: its mass, and its row for a direction. */
#ifndef VNDF_SAMPLER_WEDGE_H
#define VNDF_SAMPLER_WEDGE_H

#include "sampler/azimuth.h"
#include "table/area_piece.h"
#include "table/guide.h"

VNDF_INLINE const vndf_wedge *vndf_wedge_of(const vndf_distribution *d, double c)
{
    return c >= 0.0 ? &d->above : &d->below;
}

/* Mass of half a wedge at y, per (s + |c|). In double: near the horizon the mass above it falls as c^3, and a
 * narrow lobe makes up for that; and where D falls fast a rounding of y to the float of the guide would show. */
VNDF_INLINE double vndf_wedge_mass(const vndf_wedge *wedge, double y)
{
    const vndf_area_span *span = wedge->piece + vndf_guide_find(&wedge->knot_guide, (float)y);
    span -= y < span->begin;
    return vndf_area_piece_at(span->coefficient, (y - span->begin) * span->per_width);
}

/* The same in float, where that is good enough: for drawing, and for densities where it is no small part and
 * *per_width, one over the width of its piece, is not above VNDF_QUICK_PER_WIDTH. */
static const float VNDF_QUICK_PER_WIDTH = 500.0f;

VNDF_INLINE lanes_f vndf_wedge_quick(const vndf_wedge *wedge, lanes_f y, lanes_f *per_width)
{
#if VNDF_LANES > 1
    if (wedge->knot_count <= VNDF_FEW + 1)
        return vndf_area_few_at(wedge->few, wedge->knot_count - 1, y, per_width);
#endif
    return vndf_area_quick_at(wedge->quick, vndf_guide_lanes(&wedge->knot_guide, y), y, per_width);
}

/* The wedge's coordinate of a direction with s + |c| = 1. */
VNDF_INLINE double vndf_wedge_y(double s, double c)
{
    return c >= 0.0 ? c : s;
}

/* The row for the coordinate y. Its mass is 1. Not part of the view, since most samples are in front. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row(const vndf_wedge *wedge, lanes_f y)
{
    lanes_u i = vndf_guide_lanes(&wedge->row_guide, y), row = i * 2u;
    lanes_f from = lanes_gather(wedge->row_y, i), to = lanes_gather(wedge->row_y + 1, i);
    lanes_f width = to - from, mix = (y - from) / width, rest = 1.0f - mix;
    vndf_azimuth_row made = {wedge, row, rest * rest, 2.0f * rest * mix, mix * mix, rest, rest, width};
    made.p = vndf_azimuth_mix(&made, wedge->aspect_p);
    made.r = vndf_azimuth_mix(&made, wedge->aspect_r);
    return made;
}

/* Whether rows are not so close that a rounding of y changes their shares: lobes hundreds of times apart have
 * such, and such pieces of areas. */
VNDF_INLINE lanes_m vndf_wedge_is_plain(const vndf_azimuth_row *row)
{
    return lanes_less(lanes_set(4e-3f), row->width);
}

/* Part of the wedge's mass between the far side, a = pi, and the azimuth with the mass `apart` between the side of
 * wi and it. */
VNDF_INLINE lanes_f vndf_wedge_part(lanes_f apart, lanes_f mass)
{
    lanes_f rest = apart / mass;
    return lanes_keep(lanes_less(rest, lanes_set(1.0f)), 1.0f - rest);
}

#endif
