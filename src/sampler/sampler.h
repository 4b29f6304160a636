/* What the layers above the sampler share with it, beside the public calls of vndf.h. All densities are per steradian,
 * floats, and those of the normal as it is given; a normal is unit within rounding, wm.z >= 0. */
#ifndef VNDF_SAMPLER_SAMPLER_H
#define VNDF_SAMPLER_SAMPLER_H

#include "core/inline.h"
#include "vndf_bsdf.h"

/* Makes the view of vndf_view_from where it stays: an assignment would copy it. */
void vndf_view_make(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

/* Of the surface of a view: D(wm), and the projected area of any direction w (unit), by the same numbers as the
 * view. */
float vndf_view_ndf(const vndf_view *view, vndf_vec3 wm);
float vndf_view_area(const vndf_view *view, vndf_vec3 w);

/* Projected area along the view's wi: the true one, and that of the drawn law, which is within a table's TV of it. */
float vndf_view_own_area(const vndf_view *view);
float vndf_view_drawn_area(const vndf_view *view);

/* The projection of w on the mean plane: w.z without a mean slope. G1(w) = that over vndf_view_area. */
float vndf_view_cosine(const vndf_view *view, vndf_vec3 w);

/* A drawn normal with its density and the quotient (visible density)/density. */
typedef struct vndf_drawn_normal {
    vndf_vec3 wm;
    float density, weight;
} vndf_drawn_normal;

/* Visible normals: vndf_sample_weight; the density is vndf_pdf. */
vndf_drawn_normal vndf_sample_visible(const vndf_view *view, float u1, float u2);

/* The other normals of vndf_bsdf.h; `weight` is (visible density)/density. All normals have the density D
 * cos(theta_m), those of V-cavities D G1 max(0, wi.wm)/cos_i with G1 = min(1, 2 cos_m cos_i/(wi.wm)). Of valid views of
 * surfaces without a mean slope, wi.z > 0. */
vndf_drawn_normal vndf_sample_by(const vndf_view *view, vndf_normals_drawn law, float u1, float u2);
float vndf_pdf_by(const vndf_view *view, vndf_normals_drawn law, vndf_vec3 wm);

/* Surface i of a batch. */
VNDF_INLINE vndf_surface vndf_surface_at(const vndf_surface_batch *b, size_t i)
{
    const vndf_surface s = {b->distribution,
                            b->xx[i],
                            b->xy ? b->xy[i] : 0.0f,
                            b->yx ? b->yx[i] : 0.0f,
                            b->yy[i],
                            b->mean_x ? b->mean_x[i] : 0.0f,
                            b->mean_y ? b->mean_y[i] : 0.0f};
    return s;
}

/* G2 from both G1. */
float vndf_g2_of(float gi, float go, vndf_g2_model model);

/* A mixture's D, area and cosine from its view, likewise. */
float vndf_mixture_view_ndf(const vndf_mixture_view *view, vndf_vec3 wm);
float vndf_mixture_view_area(const vndf_mixture_view *view, vndf_vec3 w);
float vndf_mixture_view_cosine(const vndf_mixture_view *view, vndf_vec3 w);

#endif
