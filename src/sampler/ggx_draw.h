/* GGX where all is of plain size and nothing cancels: ggx.h in float, for one or for lanes. With h = (w + cap),
 * of which the normal is the direction, and w . n = |h|/2 (Dupuy & Benyoub 2023)
 *
 *     density of n = (w . n) 4/(2 pi (1 + c)) = |h|/(pi (1 + c)),
 *     of the stretched normal m/|m|, m = (ax hx, ay hy, hz):   |m|^3/(ax ay pi (1 + c) |h|^2).
 *
 * |h|^2 is above 0.005 (else ggx.h has it in double); the density is within 6e-6. */
#ifndef VNDF_SAMPLER_GGX_DRAW_H
#define VNDF_SAMPLER_GGX_DRAW_H

#include "math/half_turn.h"
#include "sampler/draw.h"

/* Good where *plain stays. The normal is that of vndf_ggx_sample, but for roundings; all is multiplied by r = S + T,
 * by which S - T would have to be divided. With plain roughness and r above 1e-3 nothing overflows or underflows. */
VNDF_INLINE vndf_drawn vndf_ggx_draw(const vndf_incidence *w, lanes_f u1, lanes_f u2, lanes_m *plain)
{
    vndf_turn turn = vndf_half_turn(u1);
    lanes_f one = 1.0f + w->c, v = 1.0f - u2, up = v * one; /* up: height of cap, plus c */
    lanes_f s2 = w->s * w->s, t = lanes_root(u2 * (s2 + one * up)), r = w->s + t, twice = 2.0f * (t * r) * turn.sine;
    lanes_f x = v * (s2 - u2 * (one * one)) + twice * turn.sine, y = twice * turn.cosine, z = up * r;
    lanes_f mx = w->ax * (w->cos_phi * x + w->sin_phi * y), my = w->ay * (w->sin_phi * x - w->cos_phi * y);
    lanes_f h2 = (x * x + y * y) + z * z, m2 = (mx * mx + my * my) + z * z, length = lanes_root(m2);
    lanes_f below = 6.28318531f * (w->spread * (h2 * r)), both = 1.0f / (length * below), per = below * both;
    *plain = lanes_both(w->plain, lanes_less(0.005f * lanes_most(r * r, lanes_set(1e-6f)), h2));
    vndf_drawn n = {mx * per, my * per, z * per, m2 * m2 * both};
    return n;
}

#endif
