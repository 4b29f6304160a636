/* Masking functions put to the test that says whether they are physical (Heitz, "Understanding the
 * Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 2014, eq. 15): what is visible of the microsurface
 * from wi has the projected area of the surface itself,
 *
 *     integral G1(wi, wm) max(0, wi.wm) D(wm) dwm = cos_i.
 *
 * Here are the left sides over cos_i, 1 for an exact function, that is the integrals of its visible normals. */
#ifndef TOOLS_MEASURE_MASKING_H
#define TOOLS_MEASURE_MASKING_H

#include "vndf.h"

typedef enum masking_function {
    MASKING_SMITH,         /* vndf_g1 */
    MASKING_V_CAVITIES,    /* min(1, 2 cos(theta_m) cos_i/(wi.wm)) */
    MASKING_IMPLICIT,      /* cos_i */
    MASKING_KELEMEN,       /* cos_i/(wi.wm) */
    MASKING_SCHLICK_SMITH, /* cos_i/(cos_i (1 - k) + k) */
    MASKING_COUNT
} masking_function;

/* k of Schlick's approximation: for Beckmann alpha sqrt(2/pi) (Schlick, "An Inexpensive BRDF Model for
 * Physically-based Rendering", CGF 1994), for all others alpha/2 of the GGX with the same median slope (Karis,
 * "Real Shading in Unreal Engine 4", 2013), at most 1; of the roughness along wi. */
double masking_schlick_k(const vndf_surface *surface, vndf_vec3 wi);

/* The integrals for wi, above the horizon, and that of D cos(theta_m), which is 1 for a good quadrature: absolute
 * error some 2e-6, where the function is 1. */
typedef struct masking_integrals {
    double of[MASKING_COUNT], normals;
} masking_integrals;
masking_integrals masking_integrate(const vndf_surface *surface, vndf_vec3 wi);

#endif
