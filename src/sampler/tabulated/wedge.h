/* The wedge is the part of the circle where the horizon of wi cuts the law of the radius. Here are its mass and its row
 * for a direction. */
#ifndef VNDF_SAMPLER_TABULATED_WEDGE_H
#define VNDF_SAMPLER_TABULATED_WEDGE_H

#include "sampler/tabulated/azimuth.h"
#include "sampler/trust.h"
#include "table/area_piece.h"
#include "table/guide.h"

VNDF_INLINE const vndf_wedge *vndf_wedge_of(const vndf_distribution *d, double c)
{
    return c >= 0.0 ? &d->above : &d->below;
}

#if VNDF_DOUBLES == 8

/* For no more than VNDF_FEW pieces: finds the piece of y and reads it in registers. */
VNDF_INLINE doubles vndf_wedge_mass_few(const vndf_wedge *wedge, doubles y)
{
    const uint32_t pitch = wedge->few_pitch;
    const double *few = wedge->few_exact, *from = few + VNDF_AREA_ORDER * pitch;
    doubles_u i = doubles_set_u(0);
    doubles b[VNDF_AREA_ORDER];
    if (pitch == VNDF_FEW)
        i = doubles_pick_u(doubles_at_most(doubles_set(from[VNDF_FEW / 2]), y), doubles_set_u(VNDF_FEW / 2), i);
    for (uint32_t step = VNDF_FEW / 4; step > 0; step /= 2)
        i = doubles_pick_u(doubles_at_most(doubles_few(from, i + step), y), i + step, i);
    for (int n = 0; n < VNDF_AREA_ORDER; n++)
        b[n] = doubles_few(few + (uint32_t)n * pitch, i);
    doubles begin = doubles_few(from, i), per_width = doubles_few(from + pitch, i);
    return vndf_area_piece_at(b, (y - begin) * per_width);
}

#endif

/* Mass of half a wedge at y, per (s + |c|), in double. Near the horizon the mass above it falls as c^3, and a narrow
 * lobe makes up for that; where D falls fast, rounding y to the guide's float would show. */
VNDF_INLINE doubles vndf_wedge_mass(const vndf_wedge *wedge, doubles y)
{
#if VNDF_DOUBLES == 8
    if (wedge->few_exact)
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

/* The same above the horizon in float. Draws may always use it, densities where *per_width, one over the width of the
 * piece, is trusted. */
VNDF_INLINE lanes_f vndf_wedge_quick(const vndf_wedge *wedge, lanes_f y, lanes_f *per_width)
{
#if VNDF_LANES > 1
    if (wedge->few)
        return vndf_area_few_at(wedge->few, wedge->few_pitch, wedge->knot_count, y, per_width);
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

/* The row for the coordinate y in span i, whose numbers are `from`. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row_from(const vndf_wedge *wedge, lanes_f y, lanes_u i,
                                                 const lanes_four from[2])
{
    const lanes_four a = from[0], b = from[1]; /* begin, per_width, p, r */
    lanes_f mix = (y - a.a) * (VNDF_ROW_MASS_ROOT * a.b), rest = VNDF_ROW_MASS_ROOT - mix;
    lanes_f u = rest * rest, v = 2.0f * rest * mix, t = mix * mix;
    lanes_f p = u * a.c + v * a.d + t * b.a, r = u * b.b + v * b.c + t * b.d;
    vndf_azimuth_row made = {wedge, i * 2u, u, v, t, p, r};
    return made;
}

#if VNDF_LANES > 1

/* The same where rows are so few that registers hold them. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row_few(const vndf_wedge *wedge, lanes_f y, lanes_u i)
{
    const uint32_t n = wedge->row_count / 2 + 1;
    const float *p = wedge->few_aspects, *r = p + 2 * n;
    const lanes_four from[2] = {
        {lanes_few(wedge->row_y, n, i), lanes_few(p + 4 * n, n, i), lanes_few(p, n, i), lanes_few(p + n, n, i)},
        {lanes_few(p + 1, n, i), lanes_few(r, n, i), lanes_few(r + n, n, i), lanes_few(r + 1, n, i)}};
    return vndf_wedge_row_from(wedge, y, i, from);
}

#endif

enum { VNDF_ROW_SPAN_FLOATS = sizeof(vndf_row_span) / sizeof(float) };

/* The row is not part of the view, since most samples are in front. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row(const vndf_wedge *wedge, lanes_f y)
{
    lanes_u i = vndf_wedge_span(wedge, y);
    lanes_lines lines = lanes_lines_at(&wedge->row_span->begin, VNDF_ROW_SPAN_FLOATS, i);
    const lanes_four from[2] = {lanes_load_four(&lines, 0), lanes_load_four(&lines, 4)};
    return vndf_wedge_row_from(wedge, y, i, from);
}

/* The mass `apart` is counted from the side of wi to an azimuth. The result is the part of the wedge's mass from that
 * azimuth to the far side, a = pi, of VNDF_ROW_MASS. */
VNDF_INLINE lanes_f vndf_wedge_part(lanes_f apart, lanes_f mass)
{
    lanes_f rest = apart / mass;
    return lanes_keep(lanes_less(rest, lanes_set(1.0f)), VNDF_ROW_MASS - VNDF_ROW_MASS * rest);
}

#endif
