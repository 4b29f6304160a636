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
        return vndf_area_few_at(wedge->few, wedge->knot_count, y, per_width);
#endif
    return vndf_area_quick_at(wedge->quick, vndf_guide_lanes(&wedge->knot_guide, y), y, per_width);
}

/* The wedge's coordinate of a direction with s + |c| = 1. */
VNDF_INLINE double vndf_wedge_y(double s, double c)
{
    return c >= 0.0 ? c : s;
}

/* Between which knots of rows y is. */
VNDF_INLINE lanes_u vndf_wedge_span(const vndf_wedge *wedge, lanes_f y)
{
#if VNDF_LANES > 1
    if (wedge->row_count <= 4 * VNDF_FEW)
        return vndf_guide_count(wedge->row_y, (wedge->row_count + 1) / 2, y);
#endif
    return vndf_guide_lanes(&wedge->row_guide, y);
}

/* The row for the coordinate y in span i, from where it is to be loaded. Its mass is 1. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row_from(const vndf_wedge *wedge, lanes_f y, lanes_u i,
                                                 const lanes_lines *lines)
{
    lanes_four a = lanes_load_four(lines, 0), b = lanes_load_four(lines, 4); /* begin, per_width, p, r */
    lanes_f mix = (y - a.a) * a.b, rest = 1.0f - mix;
    lanes_f u = rest * rest, v = 2.0f * rest * mix, t = mix * mix;
    lanes_f p = u * a.c + v * a.d + t * b.a, r = u * b.b + v * b.c + t * b.d;
    vndf_azimuth_row made = {wedge, i * 2u, u, v, t, p, r, a.b};
    return made;
}

enum { VNDF_ROW_SPAN_FLOATS = sizeof(vndf_row_span) / sizeof(float) };

/* Not part of the view, since most samples are in front. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row(const vndf_wedge *wedge, lanes_f y)
{
    lanes_u i = vndf_wedge_span(wedge, y);
    lanes_lines lines = lanes_lines_at(&wedge->row_span->begin, VNDF_ROW_SPAN_FLOATS, i);
    return vndf_wedge_row_from(wedge, y, i, &lines);
}

/* Whether rows are not so close that a rounding of y changes their shares: lobes hundreds of times apart have
 * such, and such pieces of areas. */
VNDF_INLINE lanes_m vndf_wedge_is_plain(const vndf_azimuth_row *row)
{
    return lanes_less(row->per_width, lanes_set(250.0f));
}

/* Part of the wedge's mass between the far side, a = pi, and the azimuth with the mass `apart` between the side of
 * wi and it. */
VNDF_INLINE lanes_f vndf_wedge_part(lanes_f apart, lanes_f mass)
{
    lanes_f rest = apart / mass;
    return lanes_keep(lanes_less(rest, lanes_set(1.0f)), 1.0f - rest);
}

#endif
