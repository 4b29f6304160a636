/* What a sample is put together from once its azimuth and radius are drawn (sampler/engine.h), for one or for
 * lanes: the normal, its density in float, and where that is good enough. */
#ifndef VNDF_SAMPLER_DRAW_H
#define VNDF_SAMPLER_DRAW_H

#include "sampler/aim.h"
#include "sampler/radial.h"

/* Part of the wedge's mass between the far side, a = pi, and the azimuth where the part `half` of a half turn's mass
 * is between the side of wi and it. */
VNDF_INLINE lanes_f vndf_aim_wedge_part(lanes_f half, lanes_f front, lanes_f wedge)
{
    lanes_f rest = (half * (front + wedge) - front) / wedge;
    return lanes_pick(lanes_less(rest, lanes_set(1.0f)), 1.0f - rest, lanes_set(0.0f));
}

/* The horizontal unit vector at an azimuth of the turned frame, stretched back; its square, and cos a. */
typedef struct vndf_level {
    lanes_f x, y, square, cosine;
} vndf_level;

/* `half` has the sign of the azimuth. */
VNDF_INLINE vndf_level vndf_level_at(lanes_f ax, lanes_f ay, lanes_f cos_phi, lanes_f sin_phi,
                                     const vndf_azimuth *a, lanes_f half)
{
    lanes_f per = 1.0f / a->n, cosine = a->c * per, sine = lanes_sign(a->s, half) * per;
    vndf_level level = {ax * (cos_phi * cosine - sin_phi * sine), ay * (sin_phi * cosine + cos_phi * sine), cosine,
                        cosine};
    level.square = level.x * level.x + level.y * level.y;
    return level;
}

/* ---- where the density of the place is that of the normal, as it was rounded ---- */

/* Above the horizon, where W = along + up is neither a small difference nor small against what a rounding of the
 * azimuth, a part of `across`, does to it; in a wedge that is no small part, where not all normals have a small W.
 * Rounding must not take the azimuth from the front to the wedge or back either, as the wedge's density is the
 * table's. */
static const float VNDF_PLAIN_SIDE = 1e-6f;

VNDF_INLINE lanes_m vndf_plain_in_front(lanes_f s, lanes_f c, const vndf_azimuth *a, lanes_f x, lanes_f z)
{
    lanes_f across = s * x, along = across * a->c, up = c * z;
    lanes_m unscaled = lanes_at_most(lanes_set(VNDF_RADIAL_MASS_PLAIN), a->density);
    return lanes_both(lanes_both(unscaled, lanes_less(lanes_set(VNDF_PLAIN_SIDE), a->c)),
                      lanes_less(0.05f * across, along + up));
}

VNDF_INLINE lanes_m vndf_plain_in_wedge(lanes_f s, lanes_f c, lanes_f front, lanes_f wedge, lanes_f cosine,
                                        lanes_f x, lanes_f z)
{
    lanes_f across = s * x, along = across * cosine, up = c * z;
    lanes_m large = lanes_both(lanes_less(0.05f * front, wedge), lanes_at_most(lanes_set(0.25f), c));
    return lanes_both(large, lanes_both(lanes_less(cosine, lanes_set(-VNDF_PLAIN_SIDE)),
                                        lanes_less(0.1f * (across + up), along + up)));
}

/* Away from the border of the unit square and from knots, where the density changes little from a normal to its
 * rounded self. */
VNDF_INLINE lanes_m vndf_plain_place(lanes_f half, lanes_f u2, const vndf_radial_lanes *at,
                                     const vndf_rational_cell *cell, lanes_f xi, lanes_m whole)
{
    lanes_m inside = lanes_both(lanes_less(lanes_abs(u2 - 0.5f), lanes_set(0.4999f)),
                                lanes_less(lanes_abs(half), lanes_set(0.9999f)));
    lanes_m calm = lanes_both(whole, lanes_less(lanes_set(0.0f), at->calm));
    lanes_m rough = lanes_without(vndf_radial_is_steep(at, cell, xi), calm);
    return lanes_without(inside, lanes_either(rough, vndf_radial_is_beside_knot(xi)));
}

/* ---- the normal ---- */

typedef struct vndf_drawn {
    lanes_f x, y, z, density;
} vndf_drawn;

/* From X and Z; the density of xi and azimuth is the quotient of `above` and `below` but for dwm = ax ay X Z^2 dR da
 * over the third power of the length. One division. */
VNDF_INLINE vndf_drawn vndf_drawn_at(const vndf_level *level, lanes_f x, lanes_f z, lanes_f above, lanes_f below)
{
    lanes_f square = x * x * level->square + z * z, length = lanes_root(square);
    lanes_f both = 1.0f / (length * below), per = below * both;
    lanes_f density = (above * square) * (length * (length * both));
    vndf_drawn n = {x * level->x * per, x * level->y * per, z * per, density};
    return n;
}

#endif
