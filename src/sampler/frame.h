/* From a surface to its unit problem and back. A normal n = (X cos a, X sin a, Z) of the unit problem belongs to the
 * real normal  wm ~ (alpha_x n'_x, alpha_y n'_y, n_z),  where n' is n turned by the azimuth of the stretched
 * direction. */
#ifndef VNDF_SAMPLER_FRAME_H
#define VNDF_SAMPLER_FRAME_H

#include "math/vector.h"
#include "sampler/analytic_density.h"
#include "sampler/stretch.h"

#if VNDF_LANES == 1

/* A view's direction and roughness, the stretched direction, and its azimuth. */
typedef struct vndf_frame {
    vndf_vec3 wi;
    double alpha_x, alpha_y;
    float s, c, cos_phi, sin_phi;
} vndf_frame;

VNDF_INLINE vndf_frame vndf_table_frame(const vndf_view *view)
{
    const struct vndf_table_view *of = &view->of.table;
    vndf_frame f = {view->wi, view->alpha_x, view->alpha_y, of->s, of->c, of->cos_phi, of->sin_phi};
    return f;
}

VNDF_INLINE vndf_frame vndf_analytic_frame(const vndf_view *view)
{
    vndf_stretched w = vndf_stretched_analytic(view);
    vndf_heading to = vndf_heading_of(&w);
    vndf_frame f = {view->wi,   view->alpha_x,    view->alpha_y, (float)w.s,
                    (float)w.c, (float)to.cosine, (float)to.sine};
    return f;
}

/* Takes wm back to the unit problem, in the turned frame; the result is not of unit length. */
VNDF_INLINE vndf_vec3 vndf_to_unit(const vndf_frame *f, vndf_vec3 wm)
{
    float x = wm.x / (float)f->alpha_x, y = wm.y / (float)f->alpha_y;
    vndf_vec3 n = {f->cos_phi * x + f->sin_phi * y, f->cos_phi * y - f->sin_phi * x, wm.z};
    return n;
}

/* The real normal for a normal of the unit problem; the result is not of unit length. */
VNDF_INLINE vndf_vec3 vndf_from_unit(const vndf_frame *f, vndf_vec3 n)
{
    vndf_vec3 wm = {(float)f->alpha_x * (f->cos_phi * n.x - f->sin_phi * n.y),
                    (float)f->alpha_y * (f->sin_phi * n.x + f->cos_phi * n.y), n.z};
    return wm;
}

/* Turns a normal back that rounding has turned away from wi (frame.c). */
vndf_vec3 vndf_turn_to_face(const vndf_frame *f, vndf_vec3 wm);

/* Whether wi sees wm. */
VNDF_INLINE int vndf_is_facing(const vndf_view *view, vndf_vec3 wm)
{
    return view->distribution && wm.z >= 0.0f && vndf_exact_dot(view->wi, wm) > 0.0;
}

#endif
#endif
