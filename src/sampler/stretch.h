/* The stretched direction of a view in double, from wi and the roughness as they were given: no length or
 * roughness is out of range, and the digits are there that an area takes which falls as fast as the normals of
 * a Beckmann do. */
#ifndef VNDF_SAMPLER_STRETCH_H
#define VNDF_SAMPLER_STRETCH_H

#include <math.h>

#include "core/inline.h"
#include "table/table.h"

/* (alpha_x wi.x, alpha_y wi.y, wi.z): across, along z, and what brings it there. s + |c| = 1 for tables, s^2 +
 * c^2 = 1 for the closed forms. */
typedef struct vndf_stretched {
    double x, y; /* before */
    double s, c, per_length;
} vndf_stretched;

VNDF_INLINE vndf_stretched vndf_stretch(vndf_vec3 wi, double ax, double ay, int table)
{
    double x = ax * wi.x, y = ay * wi.y, across2 = x * x + y * y, across = sqrt(across2);
    double per = 1.0 / (table ? across + fabs((double)wi.z) : sqrt(across2 + (double)wi.z * wi.z));
    /* -0 becomes +0: the horizon is seen from above */
    vndf_stretched w = {x, y, across * per, wi.z * per + 0.0, per};
    return w;
}

VNDF_INLINE vndf_stretched vndf_stretched_of(const vndf_view *view)
{
    return vndf_stretch(view->wi, view->alpha_x, view->alpha_y, view->distribution->kind == VNDF_KIND_TABLE);
}

/* Whether a view's direction is below the horizon. */
VNDF_INLINE int vndf_is_below(const vndf_view *view)
{
    return view->wi.z < 0.0f;
}

#endif
