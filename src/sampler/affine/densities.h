/* Densities of views of affine surfaces and mixtures in double, at a normal in double: the half vector of two
 * directions, rounded to float, would lie elsewhere in a narrow lobe. wm is unit, wm.z >= 0, and faces wi. */
#ifndef VNDF_SAMPLER_AFFINE_DENSITIES_H
#define VNDF_SAMPLER_AFFINE_DENSITIES_H

#include "sampler/affine/areas.h"
#include "sampler/analytic_density.h"

/* The density with which wm is drawn, and Dv. */
typedef struct vndf_densities {
    double pdf, visible;
} vndf_densities;

/* `facing` is wi.wm. */
vndf_densities vndf_affine_densities(const vndf_affine_view *view, vndf_normal wm, double facing);
vndf_densities vndf_mixture_densities(const vndf_mixture_view *view, vndf_normal wm, double facing);

/* vndf_mixture_view_from for a view inside another object: an assigned view would be copied. */
void vndf_mixture_view_set(vndf_mixture_view *view, const vndf_mixture *mixture, vndf_vec3 wi);

/* Both areas along any usable direction of the surface that the view is of. */
void vndf_affine_view_areas(const vndf_affine_view *view, vndf_vec3 w, vndf_areas *areas);
void vndf_mixture_view_areas(const vndf_mixture_view *view, vndf_vec3 w, vndf_areas *areas);

#endif
