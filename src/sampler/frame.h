/* Between a surface and its unit problem. Normals of the unit problem n = (X cos a, X sin a, Z) and real ones
 * are related by  wm ~ (alpha_x n'_x, alpha_y n'_y, n_z),  n' = n turned by the azimuth of the stretched
 * direction. */
#ifndef VNDF_SAMPLER_FRAME_H
#define VNDF_SAMPLER_FRAME_H

#include "math/vector.h"

/* wm taken back to the unit problem, in the turned frame: not of unit length. */
VNDF_INLINE vndf_vec3 vndf_to_unit(const vndf_view *view, vndf_vec3 wm)
{
    float x = wm.x / (float)view->alpha_x, y = wm.y / (float)view->alpha_y;
    vndf_vec3 n = {view->cos_phi * x + view->sin_phi * y, view->cos_phi * y - view->sin_phi * x, wm.z};
    return n;
}

/* The real normal of one of the unit problem: not of unit length. */
VNDF_INLINE vndf_vec3 vndf_from_unit(const vndf_view *view, vndf_vec3 n)
{
    vndf_vec3 wm = {(float)view->alpha_x * (view->cos_phi * n.x - view->sin_phi * n.y),
                    (float)view->alpha_y * (view->sin_phi * n.x + view->cos_phi * n.y), n.z};
    return wm;
}

/* A normal that rounding has turned away from wi, turned back: frame.c. */
vndf_vec3 vndf_turn_to_face(const vndf_view *view, vndf_vec3 wm);

#endif
