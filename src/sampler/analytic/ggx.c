/* GGX: the inverse of ggx.h's sampler. */
#include "sampler/analytic/ggx.h"

#include "sampler/analytic/inverse.h"

void vndf_ggx_invert(float s, float c, vndf_normal n, float *u1, float *u2)
{
    const vndf_unit_query q = {s, c, n};
    vndf_uniforms u = vndf_ggx_inverse(&q);
    *u1 = u.u1;
    *u2 = u.u2;
}
