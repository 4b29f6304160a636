/* Code that calls of a view and calls of a surface share: the distribution under a stretch. */
#ifndef VNDF_SAMPLER_SURFACE_H
#define VNDF_SAMPLER_SURFACE_H

#include <math.h>

#include "core/inline.h"
#include "table/table.h"
#include "vndf.h"

/* The scale of slopes at alpha = 1, in the unit problem. */
VNDF_INLINE double vndf_unit_scale(const vndf_distribution *d)
{
    return vndf_is_table(d) ? d->scale : 1.0;
}

/* The same in float, or 0 where float would lose digits: draws use alpha times it. */
VNDF_INLINE float vndf_unit_scale_float(const vndf_distribution *d)
{
    double scale = vndf_unit_scale(d);
    return scale > 1e-30 && scale < 1e30 ? (float)scale : 0.0f;
}

/* Roughness times the table's scale; 0 unless both are within [1e-18, 1e18] and there is a distribution. */
VNDF_INLINE int vndf_surface_scaled(const vndf_surface *surface, double *ax, double *ay)
{
    if (!surface || !surface->distribution)
        return 0;
    const vndf_distribution *d = surface->distribution;
    double scale = vndf_unit_scale(d);
    *ax = surface->alpha_x * scale;
    *ay = surface->alpha_y * scale;
    return *ax >= 1e-18 && *ax <= 1e18 && *ay >= 1e-18 && *ay <= 1e18;
}

/* Projected area of the unit problem for the direction (s, 0, c). */
double vndf_unit_area(const vndf_distribution *d, double s, double c);

/* A(w) of the surface with this roughness times the distribution's scale. */
float vndf_area_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 w);

/* G2 from both G1: 1/(1 + Lambda_i + Lambda_o), with 1 + Lambda = 1/G1, is the smaller G1 times a factor that is 1/2 at
 * least, since a product of two small ones would underflow. */
VNDF_INLINE float vndf_g2_of(float gi, float go, vndf_g2_model model)
{
    float least = gi < go ? gi : go, most = gi < go ? go : gi;
    if (model == VNDF_G2_SEPARABLE || least == 0.0f)
        return gi * go;
    return least * (most / (most + least * (1.0f - most)));
}

/* vndf_view_from for a view inside another object: an assigned view would be copied, and waited for. */
void vndf_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

/* Whether w is not zero, infinite or NaN: squares of floats neither overflow nor vanish in double. */
VNDF_INLINE int vndf_is_usable_direction(vndf_vec3 w)
{
    double square = (double)w.x * w.x + (double)w.y * w.y + (double)w.z * w.z;
    return square > 0.0 && square < HUGE_VAL;
}

VNDF_INLINE vndf_view vndf_invalid_view(void)
{
    vndf_view view = {0};
    return view;
}

/* A valid view turned to another usable direction, in place. */
void vndf_view_turn(vndf_view *view, vndf_vec3 wi);

/* The view of a usable direction for roughness times the distribution's scale (ax, ay). */
vndf_view vndf_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi);

/* Writes the members of a view that densities of given normals read, in place; the view is as valid as that of
 * vndf_view_from. */
void vndf_view_bare(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

/* vndf_sample of a valid view, for samples that float may not draw. */
vndf_vec3 vndf_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf);

/* The weight of a sample of a table (vndf_sample_weight) with the density `pdf`. */
float vndf_weight_of(const vndf_view *view, vndf_vec3 wm, float pdf);

#endif
