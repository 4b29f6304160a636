/* What the closed forms share: normals in double. Floats are exact in it, and so are products of two of them; that
 * is where densities at the terminator and inverses in far tails get their digits from. */
#ifndef VNDF_SAMPLER_CLOSED_H
#define VNDF_SAMPLER_CLOSED_H

#include "core/inline.h"
#include "vndf.h"

typedef struct vndf_normal {
    double x, y, z;
} vndf_normal;

VNDF_INLINE vndf_normal vndf_normal_of(vndf_vec3 wm)
{
    vndf_normal n = {wm.x, wm.y, wm.z};
    return n;
}

/* wi . wm */
VNDF_INLINE double vndf_facing(const vndf_view *view, vndf_normal wm)
{
    return view->wi.x * wm.x + view->wi.y * wm.y + view->wi.z * wm.z;
}

/* wm taken back to the unit problem, in the turned frame, as if cos_phi^2 + sin_phi^2 were 1: not of unit length. */
VNDF_INLINE vndf_normal vndf_normal_to_unit(const vndf_view *view, vndf_vec3 wm)
{
    double a = view->cos_phi, b = view->sin_phi, per = 1.0 / (a * a + b * b);
    double x = wm.x * per / view->alpha_x, y = wm.y * per / view->alpha_y;
    vndf_normal n = {a * x + b * y, a * y - b * x, wm.z};
    return n;
}

#endif
