/* The wedge, the part of the circle that the horizon of wi cuts: its mass, its row for a direction, and what a
 * view holds of the two masses of a half turn. */
#ifndef VNDF_SAMPLER_WEDGE_H
#define VNDF_SAMPLER_WEDGE_H

#include "sampler/azimuth.h"
#include "sampler/front.h"
#include "table/area_piece.h"
#include "table/guide.h"

/* The members of a view that belong to the engine; vndf.h says what they are. */
typedef struct vndf_wedge_view {
    float area, front;
    double wedge;
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

/* Mass of half a wedge at y, per (s + |c|). In double: near the horizon the mass above it falls as c^3, and a
 * narrow lobe makes up for that; and where D falls fast a rounding of y to the float of the guide would show. */
VNDF_INLINE double vndf_wedge_mass(const vndf_wedge *wedge, double y)
{
    const vndf_area_span *span = wedge->piece + vndf_guide_find(&wedge->knot_guide, (float)y);
    span -= y < span->begin;
    return vndf_area_piece_at(span->coefficient, (y - span->begin) * span->per_width);
}

/* The wedge's coordinate of a direction with s + |c| = 1. */
VNDF_INLINE double vndf_wedge_y(double s, double c)
{
    return c >= 0.0 ? c : s;
}

VNDF_INLINE vndf_wedge_view vndf_wedge_view_at(const vndf_distribution *d, double s, double c)
{
    double mass = vndf_wedge_mass(vndf_wedge_of(d, c), vndf_wedge_y(s, c));
    double front = c >= 0.0 ? c * (d->f0_total * VNDF_QUARTER_TURN) + s * d->f1_total : 0.0;
    /* below the horizon the wedge is all there is: its part is 1, and its mass may underflow */
    vndf_wedge_view view = {(float)(2.0 * (front + mass)), (float)front, c >= 0.0 ? mass : s > 0.0 ? 1.0 : 0.0};
    return view;
}

/* The wedge: away from wi above the horizon, towards it below. Its mass is 1. Not part of the view, since three
 * of four samples are in front. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row(const vndf_view *view)
{
    const vndf_wedge *w = vndf_wedge_of(view->distribution, view->c);
    float y = (float)vndf_wedge_y(view->s, view->c);
    uint32_t i = vndf_guide_find(&w->row_guide, y);
    vndf_row_weights share = vndf_row_weights_at((y - w->row_y[i]) / (w->row_y[i + 1] - w->row_y[i]));
    size_t cells = w->stride, ends = w->cell_count + 1, a = 2 * (size_t)i * cells, end = 2 * (size_t)i * ends;
    const float *p = w->aspect_p + 2 * (size_t)i, *r = w->aspect_r + 2 * (size_t)i;
    vndf_azimuth_row row = {{w->cdf + a, w->cell_mass + a, w->density + end, share.first},
                            {w->cdf + a + cells, w->cell_mass + a + cells, w->density + end + ends, share.middle},
                            {w->cdf + a + 2 * cells, w->cell_mass + a + 2 * cells, w->density + end + 2 * ends,
                             share.last},
                            w->q, w->cell_count, w->stride,
                            share.first * p[0] + share.middle * p[1] + share.last * p[2],
                            share.first * r[0] + share.middle * r[1] + share.last * r[2]};
    return row;
}

#endif
