/* The part of the circle that the horizon of wi cuts: its mass, its rows, and what a view holds of them. */
#ifndef VNDF_SAMPLER_WEDGE_H
#define VNDF_SAMPLER_WEDGE_H

#include <math.h>

#include "sampler/azimuth.h"
#include "sampler/front.h"
#include "table/guide.h"

/* The members of a view that belong to the engine; vndf.h says what they are. */
typedef struct vndf_wedge_view {
    float area, front, wedge, mix, aspect_p, aspect_r;
    uint32_t row;
} vndf_wedge_view;

VNDF_INLINE const vndf_wedge *vndf_wedge_of(const vndf_distribution *d, float c)
{
    return c >= 0.0f ? &d->above : &d->below;
}

VNDF_INLINE float vndf_wedge_bezier(const float *b, float t)
{
    float u = 1.0f - t;
    return u * u * (u * b[0] + 3.0f * t * b[1]) + t * t * (3.0f * u * b[2] + t * b[3]);
}

/* Mass of half a wedge at y, per (s + |c|). */
VNDF_INLINE float vndf_wedge_mass(const vndf_wedge *wedge, float y)
{
    uint32_t i = vndf_guide_find(&wedge->knot_guide, y);
    const float *b = wedge->bezier + (size_t)VNDF_BEZIER * i;
    return vndf_wedge_bezier(b, (y - wedge->knot_y[i]) * b[4]);
}

/* For s + |c| = 1. */
VNDF_INLINE vndf_wedge_view vndf_wedge_view_at(const vndf_distribution *d, float s, float c)
{
    const vndf_wedge *wedge = vndf_wedge_of(d, c);
    float y = c >= 0.0f ? c : s, mass = vndf_wedge_mass(wedge, y);
    float front = c >= 0.0f ? c * d->f0_total * VNDF_QUARTER_TURN + s * d->f1_total : 0.0f;
    uint32_t i = vndf_guide_find(&wedge->row_guide, y);
    float mix = (y - wedge->row_y[i]) / (wedge->row_y[i + 1] - wedge->row_y[i]);
    vndf_wedge_view view = {2.0f * (front + mass), front, mass, mix,
                            (1.0f - mix) * wedge->aspect_p[i] + mix * wedge->aspect_p[i + 1],
                            (1.0f - mix) * wedge->aspect_r[i] + mix * wedge->aspect_r[i + 1], i};
    return view;
}

/* The half circle towards wi, above the horizon. */
VNDF_INLINE vndf_azimuth_row vndf_front_row(const vndf_view *view)
{
    const vndf_distribution *d = view->distribution;
    vndf_azimuth_row row = {
        {vndf_front_even_cdf, vndf_front_even_mass, vndf_front_even_density, view->c * d->f0_total},
        {vndf_front_cosine_cdf, vndf_front_cosine_mass, vndf_front_cosine_density, view->s * d->f1_total},
        vndf_front_q, VNDF_FRONT_CELLS, VNDF_FRONT_CELLS, 1.0f, 1.0f, 1};
    return row;
}

/* The wedge: away from wi above the horizon, towards it below. Its mass is 1. */
VNDF_INLINE vndf_azimuth_row vndf_wedge_row(const vndf_view *view)
{
    const vndf_wedge *w = vndf_wedge_of(view->distribution, view->c);
    size_t a = (size_t)view->row * w->stride, b = a + w->stride, end = (size_t)view->row * (w->cell_count + 1);
    vndf_azimuth_row row = {{w->cdf + a, w->cell_mass + a, w->density + end, 1.0f - view->mix},
                            {w->cdf + b, w->cell_mass + b, w->density + end + w->cell_count + 1, view->mix},
                            w->q, w->cell_count, w->stride, view->aspect_p, view->aspect_r, 0};
    return row;
}

#endif
