/* The stretched direction of a view in double, from the caller's wi and roughness: no length or roughness is out of
 * range, and there are digits enough for an area that falls as fast as Beckmann's. */
#ifndef VNDF_SAMPLER_STRETCH_H
#define VNDF_SAMPLER_STRETCH_H

#include <math.h>

#include "core/inline.h"
#include "vndf.h"

/* The length of the stretched direction. */
typedef enum vndf_length {
    VNDF_LENGTH_SUM, /* s + |c| = 1: tables */
    VNDF_LENGTH_ROOT /* s^2 + c^2 = 1: closed forms */
} vndf_length;

/* (alpha_x wi.x, alpha_y wi.y, wi.z) times per_length is s across and c along z. */
typedef struct vndf_stretched {
    double x, y; /* without per_length */
    double s, c, per_length;
} vndf_stretched;

/* `length` is a constant. */
VNDF_INLINE vndf_stretched vndf_stretch(vndf_vec3 wi, double ax, double ay, vndf_length length)
{
    double x = ax * wi.x, y = ay * wi.y, across2 = x * x + y * y, across = sqrt(across2);
    double sum = across + fabs((double)wi.z), root = sqrt(across2 + (double)wi.z * wi.z);
    double per = 1.0 / (length == VNDF_LENGTH_SUM ? sum : root);
    /* -0 becomes +0: the horizon is seen from above */
    vndf_stretched w = {x, y, across * per, wi.z * per + 0.0, per};
    return w;
}

/* The direction of a view of a table. */
VNDF_INLINE vndf_stretched vndf_stretched_of(const vndf_view *view)
{
    return vndf_stretch(view->wi, view->alpha_x, view->alpha_y, VNDF_LENGTH_SUM);
}

/* The direction of a view of a closed form. */
VNDF_INLINE vndf_stretched vndf_stretched_analytic(const vndf_view *view)
{
    return vndf_stretch(view->wi, view->alpha_x, view->alpha_y, VNDF_LENGTH_ROOT);
}

/* Cosine and sine of the azimuth to turn to; a direction along z turns to x. */
typedef struct vndf_heading {
    double cosine, sine;
} vndf_heading;

VNDF_INLINE vndf_heading vndf_heading_of(const vndf_stretched *w)
{
    double across = sqrt(w->x * w->x + w->y * w->y), per = across > 0.0 ? 1.0 / across : 0.0;
    vndf_heading heading = {across > 0.0 ? w->x * per : 1.0, w->y * per};
    return heading;
}

/* Whether a view's direction is below the horizon. */
VNDF_INLINE int vndf_is_below(const vndf_view *view)
{
    return view->wi.z < 0.0f;
}

#endif
