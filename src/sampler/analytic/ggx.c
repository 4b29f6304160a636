/* GGX: the inverse of ggx.h's sampler. */
#include "sampler/analytic/ggx.h"

#include "math/elementary.h"
#include "math/vector.h"

/* The sum, with the factor of S and C, is mu wm with mu = 2 (w . wm)/C; then T and phi are polar coordinates of
 * its first two components about (S, 0), and the third is v C. u2 = T^2/(S^2 + v C^2) keeps the digits of a small
 * u2, and 1 - v those of a small 1 - u2, where one step of 2^-24 moves the normals of the far tail by 1e-4. */
void vndf_ggx_invert(float s, float c, vndf_normal n, float *u1, float *u2)
{
    vndf_half_angle h = vndf_half_angle_of(s, c);
    double s2 = h.sine * h.sine, c2 = h.cosine * h.cosine;
    double per_cosine = h.cosine > 0.0 ? 1.0 / h.cosine : 0.0;
    double facing = h.sine * h.cosine * n.x + 0.5 * (c2 - s2) * n.z; /* the w that the sampler uses */
    double scale = 2.0 * facing * per_cosine / (n.x * n.x + n.y * n.y + n.z * n.z);
    double across = scale * n.x - h.sine, aside = scale * n.y, v = scale * n.z * per_cosine;
    double from_top = (across * across + aside * aside) / (s2 + v * c2);
    *u2 = vndf_clamp_unit((float)(v < 0.5 ? 1.0 - v : from_top));
    *u1 = vndf_clamp_unit((float)(0.5 + 0.5 * vndf_inverse_pi * vndf_atan2(aside, across)));
}
