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

/* Good where *plain stays. The normal is that of vndf_ggx_sample, but for roundings. */
VNDF_INLINE vndf_drawn vndf_ggx_draw(const vndf_incidence *w, lanes_f u1, lanes_f u2, lanes_m *plain)
{
    vndf_turn turn = vndf_half_turn(u1);
    lanes_f one = 1.0f + w->c, v = 1.0f - u2, up = v * one; /* up: height of cap, plus c */
    lanes_f s2 = w->s * w->s, t = lanes_root(u2 * (s2 + one * up)), twice = 2.0f * t * turn.sine;
    lanes_f x = v * (s2 - u2 * (one * one)) / (w->s + t) + twice * turn.sine, y = -twice * turn.cosine;
    lanes_f square = x * x + y * y + up * up;
    vndf_level h = {w->ax * (w->cos_phi * x - w->sin_phi * y), w->ay * (w->sin_phi * x + w->cos_phi * y), square};
    h.square = h.x * h.x + h.y * h.y;
    *plain = lanes_both(*plain, lanes_both(w->plain, lanes_less(lanes_set(0.005f), square)));
    *plain = lanes_both(*plain, lanes_less(lanes_abs(u2 - 0.5f), lanes_set(0.4999f)));
    vndf_place at = {lanes_set(1.0f), up, lanes_set(1.0f), lanes_set(1.0f), 6.28318531f * (w->spread * square)};
    return vndf_drawn_at(&h, &at, plain);
}

#endif
