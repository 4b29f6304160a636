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

#if VNDF_DOUBLES == 8

/* Where there are no more than VNDF_FEW pieces: the one of y is found and read in registers. */
VNDF_INLINE doubles vndf_wedge_mass_few(const vndf_wedge *wedge, doubles y)
{
    const double(*few)[VNDF_FEW] = wedge->few_exact;
    doubles_u i = doubles_set_u(0);
    doubles b[VNDF_AREA_ORDER];
    for (uint32_t step = VNDF_FEW / 2; step > 0; step /= 2)
        i = doubles_pick_u(doubles_at_most(doubles_few(few[VNDF_AREA_ORDER], i + step), y), i + step, i);
    for (int n = 0; n < VNDF_AREA_ORDER; n++)
        b[n] = doubles_few(few[n], i);
    doubles begin = doubles_few(few[VNDF_AREA_ORDER], i), per_width = doubles_few(few[VNDF_AREA_ORDER + 1], i);
    return vndf_area_piece_at(b, (y - begin) * per_width);
}

#endif

/* Mass of half a wedge at y, per (s + |c|). In double: near the horizon the mass above it falls as c^3, and a
 * narrow lobe makes up for that; and where D falls fast a rounding of y to the float of the guide would show. */
VNDF_INLINE doubles vndf_wedge_mass(const vndf_wedge *wedge, doubles y)
{
#if VNDF_DOUBLES == 8
    if (wedge->knot_count <= VNDF_FEW + 1)
        return vndf_wedge_mass_few(wedge, y);
#endif
    doubles_u i = vndf_guide_doubles(&wedge->knot_guide, doubles_narrow(y)), one = doubles_set_u(1);
    for (;;) {
        doubles_long_lines lines = doubles_long_lines_at(wedge->piece->coefficient, VNDF_AREA_SPAN, i);
        doubles_two place = doubles_load_two(&lines, VNDF_AREA_ORDER); /* begin, per_width */
        doubles_m early = doubles_both(doubles_less(y, place.a), doubles_at_most_u(one, i));
        if (doubles_any(early)) {
            i -= doubles_pick_u(early, one, doubles_set_u(0));
            continue;
        }
        doubles_two b0 = doubles_load_two(&lines, 0), b2 = doubles_load_two(&lines, 2);
        doubles_two b4 = doubles_load_two(&lines, 4);
        const doubles b[VNDF_AREA_ORDER] = {b0.a, b0.b, b2.a, b2.b, b4.a, b4.b};
        return vndf_area_piece_at(b, (y - place.a) * place.b);
    }
}

/* The same in float, where that is good enough: for drawing, and for densities where it is no small part and
 * *per_width, one over the width of its piece, is not above VNDF_QUICK_PER_WIDTH. */
static const float VNDF_QUICK_PER_WIDTH = 500.0f;

VNDF_INLINE lanes_f vndf_wedge_quick(const vndf_wedge *wedge, lanes_f y, lanes_f *per_width)
{
#if VNDF_LANES > 1
    if (wedge->knot_count <= VNDF_FEW + 1)
        return vndf_area_few_at(wedge->few, y, per_width);
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

/* Part of the wedge's mass between the far side, a = pi, and the azimuth where the part `half` of a half turn's
 * mass is between the side of wi and it. */
VNDF_INLINE lanes_f vndf_wedge_part(lanes_f half, lanes_f front, lanes_f wedge)
{
    lanes_f rest = (half * (front + wedge) - front) / wedge;
    return lanes_pick(lanes_less(rest, lanes_set(1.0f)), 1.0f - rest, lanes_set(0.0f));
}

#endif
