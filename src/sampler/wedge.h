/* The part of the circle that the horizon of wi cuts: its mass, its rows, and what a view holds of them. */
#ifndef VNDF_SAMPLER_WEDGE_H
#define VNDF_SAMPLER_WEDGE_H

#include <math.h>

#include "sampler/azimuth.h"
#include "sampler/front.h"
#include "table/area_piece.h"
#include "table/guide.h"

/* The members of a view that belong to the engine; vndf.h says what they are. */
typedef struct vndf_wedge_view {
    float area, front;
    double wedge, mix, aspect_p, aspect_r;
    uint32_t row;
} vndf_wedge_view;

/* Shares of three neighbouring rows `mix` of the way from the first to the last. */
typedef struct vndf_row_weights {
    float first, middle, last;
} vndf_row_weights;

VNDF_INLINE vndf_row_weights vndf_row_weights_at(float mix)
{
    float rest = 1.0f - mix;
    vndf_row_weights w = {rest * rest, 2.0f * rest * mix, mix * mix};
    return w;
}

VNDF_INLINE const vndf_wedge *vndf_wedge_of(const vndf_distribution *d, double c)
{
    return c >= 0.0 ? &d->above : &d->below;
}

/* One piece of the mass at t in [0, 1] (table/area_piece.h). In double: near the horizon the mass above it falls as c^3, and a
 * narrow lobe makes up for that. */
VNDF_INLINE double vndf_wedge_bezier(const float *b, double t)
{
    double u = 1.0 - t, uu = u * u, ut = u * t, tt = t * t;
    return uu * u * (uu * b[0] + (ut * b[1] + tt * b[2])) + tt * t * (uu * b[3] + (ut * b[4] + tt * b[5]));
}

/* The last of ascending knots at or below y <= 1. Where D falls fast a rounding of y to float would show. */
VNDF_INLINE uint32_t vndf_wedge_find(const vndf_guide *guide, const float *knots, double y)
{
    uint32_t i = vndf_guide_find(guide, (float)y);
    return i - (i > 0 && y < knots[i]);
}

/* Mass of half a wedge at y, per (s + |c|). */
VNDF_INLINE double vndf_wedge_mass(const vndf_wedge *wedge, double y)
{
    uint32_t i = vndf_wedge_find(&wedge->knot_guide, wedge->knot_y, y);
    const float *b = wedge->bezier + (size_t)VNDF_BEZIER * i;
    return vndf_wedge_bezier(b, (y - wedge->knot_y[i]) * b[VNDF_AREA_ORDER]);
}

/* For s + |c| = 1. */
VNDF_INLINE vndf_wedge_view vndf_wedge_view_at(const vndf_distribution *d, double s, double c)
{
    const vndf_wedge *wedge = vndf_wedge_of(d, c);
    double y = c >= 0.0 ? c : s;
    double mass = vndf_wedge_mass(wedge, y), front = c >= 0.0 ? c * (d->f0_total * VNDF_QUARTER_TURN) + s * d->f1_total : 0.0;
    uint32_t i = vndf_wedge_find(&wedge->row_guide, wedge->row_y, y);
    double mix = (y - wedge->row_y[i]) / (wedge->row_y[i + 1] - wedge->row_y[i]), rest = 1.0 - mix;
    double first = rest * rest, middle = 2.0 * rest * mix, last = mix * mix;
    const float *p = wedge->aspect_p + 2 * (size_t)i, *r = wedge->aspect_r + 2 * (size_t)i;
    /* below the horizon the wedge is all there is: its part is 1, and its mass may underflow */
    vndf_wedge_view view = {(float)(2.0 * (front + mass)), (float)front, c >= 0.0 ? mass : s > 0.0 ? 1.0 : 0.0, mix,
                            first * p[0] + middle * p[1] + last * p[2], first * r[0] + middle * r[1] + last * r[2], 2 * i};
    return view;
}

/* The half circle towards wi, above the horizon. */
VNDF_INLINE vndf_azimuth_row vndf_front_row(const vndf_view *view)
{
    const vndf_distribution *d = view->distribution;
    vndf_azimuth_row row = {
        {vndf_front_even_cdf, vndf_front_even_mass, vndf_front_even_density, (float)view->c * d->f0_total},
        {vndf_front_cosine_cdf, vndf_front_cosine_mass, vndf_front_cosine_density, (float)view->s * d->f1_total},
        {NULL, NULL, NULL, 0.0f}, 2, vndf_front_q, VNDF_FRONT_CELLS, VNDF_FRONT_CELLS, 1.0f, 1.0f, 1};
    return row;
}

/* The wedge: away from wi above the horizon, towards it below. Its mass is 1. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row(const vndf_view *view)
{
    const vndf_wedge *w = vndf_wedge_of(view->distribution, view->c);
    vndf_row_weights share = vndf_row_weights_at((float)view->mix);
    size_t cells = w->stride, ends = w->cell_count + 1, a = (size_t)view->row * cells, end = (size_t)view->row * ends;
    vndf_azimuth_row row = {{w->cdf + a, w->cell_mass + a, w->density + end, share.first},
                            {w->cdf + a + cells, w->cell_mass + a + cells, w->density + end + ends, share.middle},
                            {w->cdf + a + 2 * cells, w->cell_mass + a + 2 * cells, w->density + end + 2 * ends, share.last},
                            3, w->q, w->cell_count, w->stride, (float)view->aspect_p, (float)view->aspect_r, 0};
    return row;
}

#endif
