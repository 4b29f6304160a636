/* What the layers above the sampler share with it, beside the public calls of vndf.h. All densities are per steradian,
 * floats, and those of the normal as it is given; a normal is unit within rounding, wm.z >= 0. */
#ifndef VNDF_SAMPLER_SAMPLER_H
#define VNDF_SAMPLER_SAMPLER_H

#include "vndf.h"

/* vndf_affine_view_from in place: a view that is copied after it was written costs the time of the stores. `plain`: the
 * surface has roughness alone, and gets the bits of vndf_view_from. */
void vndf_view_make(vndf_view *view, const vndf_affine *affine, vndf_vec3 wi, int plain);

/* Of the surface of a view: D(wm), and the projected area of any direction w (unit), by the same numbers as the
 * view. */
float vndf_view_ndf(const vndf_view *view, vndf_vec3 wm);
float vndf_view_area(const vndf_view *view, vndf_vec3 w);

/* That of its own wi; and that of what is drawn, which for tables is within the certificate's TV of it. */
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

/* Visible normals that reflect wi to above the horizon (wi.z > 0); no sample is lost. Surfaces without a mean slope. */
vndf_drawn_normal vndf_sample_bounded(const vndf_view *view, float u1, float u2);
float vndf_pdf_bounded(const vndf_view *view, vndf_vec3 wm);

/* All normals, density D cos(theta_m); `weight` is (visible density)/density. Surfaces without a mean slope. */
vndf_drawn_normal vndf_sample_all(const vndf_view *view, float u1, float u2);
float vndf_pdf_all(const vndf_view *view, vndf_vec3 wm);

/* Visible normals of V-cavities: density D G1 max(0, wi.wm)/cos_i, G1 = min(1, 2 cos_m cos_i/(wi.wm)); wi.z >= 0.
 * `weight` is D (wi.wm)/A(wi) over the density. Surfaces without a mean slope. */
vndf_drawn_normal vndf_sample_v_cavity(const vndf_view *view, float u1, float u2);
float vndf_pdf_v_cavity(const vndf_view *view, vndf_vec3 wm);

/* G2 from both G1. */
float vndf_g2_of(float gi, float go, vndf_g2_model model);

/* A mixture's D, area and cosine from its view, likewise. */
float vndf_mixture_view_ndf(const vndf_mixture_view *view, vndf_vec3 wm);
float vndf_mixture_view_area(const vndf_mixture_view *view, vndf_vec3 w);
float vndf_mixture_view_cosine(const vndf_mixture_view *view, vndf_vec3 w);

#endif
