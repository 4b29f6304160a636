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
    float area, front, wedge, mix, aspect_p, aspect_r;
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

VNDF_INLINE const vndf_wedge *vndf_wedge_of(const vndf_distribution *d, float c)
{
    return c >= 0.0f ? &d->above : &d->below;
}

/* One piece of the mass at t in [0, 1] (table/area_piece.h). */
VNDF_INLINE float vndf_wedge_bezier(const float *b, float t)
{
    float u = 1.0f - t, uu = u * u, ut = u * t, tt = t * t;
    return uu * u * (uu * b[0] + (ut * b[1] + tt * b[2])) + tt * t * (uu * b[3] + (ut * b[4] + tt * b[5]));
}

/* Mass of half a wedge at y, per (s + |c|). */
VNDF_INLINE float vndf_wedge_mass(const vndf_wedge *wedge, float y)
{
    uint32_t i = vndf_guide_find(&wedge->knot_guide, y);
    const float *b = wedge->bezier + (size_t)VNDF_BEZIER * i;
    return vndf_wedge_bezier(b, (y - wedge->knot_y[i]) * b[VNDF_AREA_ORDER]);
}

/* For s + |c| = 1. */
VNDF_INLINE vndf_wedge_view vndf_wedge_view_at(const vndf_distribution *d, float s, float c)
{
    const vndf_wedge *wedge = vndf_wedge_of(d, c);
    float y = c >= 0.0f ? c : s, mass = vndf_wedge_mass(wedge, y);
    float front = c >= 0.0f ? vndf_front_mass(vndf_front_of(d, s, c)) : 0.0f;
    uint32_t i = vndf_guide_find(&wedge->row_guide, y);
    float mix = (y - wedge->row_y[i]) / (wedge->row_y[i + 1] - wedge->row_y[i]);
    vndf_row_weights w = vndf_row_weights_at(mix);
    const float *p = wedge->aspect_p + 2 * (size_t)i, *r = wedge->aspect_r + 2 * (size_t)i;
    /* below the horizon the wedge is all there is: its part is 1, and its mass may underflow */
    vndf_wedge_view view = {2.0f * (front + mass), front, c >= 0.0f ? mass : s > 0.0f ? 1.0f : 0.0f, mix, w.first * p[0] + w.middle * p[1] + w.last * p[2],
                            w.first * r[0] + w.middle * r[1] + w.last * r[2], 2 * i};
    return view;
}

/* The wedge: away from wi above the horizon, towards it below. Its mass is 1. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row(const vndf_view *view)
{
    const vndf_wedge *w = vndf_wedge_of(view->distribution, view->c);
    vndf_row_weights share = vndf_row_weights_at(view->mix);
    size_t cells = w->stride, ends = w->cell_count + 1, a = (size_t)view->row * cells, end = (size_t)view->row * ends;
    vndf_azimuth_row row = {{w->cdf + a, w->cell_mass + a, w->density + end, share.first},
                            {w->cdf + a + cells, w->cell_mass + a + cells, w->density + end + ends, share.middle},
                            {w->cdf + a + 2 * cells, w->cell_mass + a + 2 * cells, w->density + end + 2 * ends, share.last},
                            w->q, w->cell_count, w->stride, view->aspect_p, view->aspect_r};
    return row;
}

#endif
