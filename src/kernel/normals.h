/* Normals drawn without a look at what wi sees (Walter et al., "Microfacet Models for Refraction through Rough
 * Surfaces", EGSR 2007), and those that it sees in V-cavities (Cook & Torrance 1981; Heitz & d'Eon, EGSR 2014), which
 * are made of them: a slope length from u2, an azimuth from u1.
 *
 * V-cavities: at a slope length R = x/z a normal sees wi by p + q cos a, a from the azimuth of wi, p = vz z, q = s x >=
 * 0, and its mirror twin by p - q cos a. Of the two one is taken by what it sees, so a has the density
 *
 *     1/pi where only the normal sees wi,     (p + q cos a)/(2 pi p) where both do, |q cos a| <= p,
 *
 * and 0 elsewhere. With A the end of the arc where the normal sees wi at all, p + q cos A = 0, both see it from pi - A
 * to A: there the azimuth solves Kepler's equation (arc.h). */
#ifndef VNDF_KERNEL_NORMALS_H
#define VNDF_KERNEL_NORMALS_H

#include "kernel/arc.h"

/* A slope length x/z and K of D cos(theta_m): with any azimuth a that is uniform, (x cos a, x sin a, z) has it. */
typedef struct any_slope {
    real x, z, density;
} any_slope;

/* R^2 = u/(1 - u). */
KERNEL any_slope ggx_slope(real u2)
{
    real z = sqrt(max(1.0f - u2, set(1.49011612e-8f)));
    const any_slope r = {sqrt(u2), z, 0.318309886f * z};
    return r;
}

/* R^2 = -log(1 - u), with its digits where u is small. */
KERNEL any_slope beckmann_slope(real u2)
{
    real rest = max(1.0f - u2, set(1.49011612e-8f));
    real square = -select(lt(u2, set(0.25f)), log_near(-min(u2, set(0.25f))), log_of(rest));
    const any_slope r = {sqrt(square), set(1.0f), 0.318309886f * rest};
    return r;
}

/* u1 turns, once about z, from -x (0) through x (1/2) and round. */
KERNEL normal_sample all_normals_draw(any_slope r, real u1)
{
    real half = 2.0f * u1 - 1.0f;
    turn a = half_turn(abs(half));
    const normal_sample n = {r.x * a.cosine, r.x * with_sign(a.sine, half), r.z, r.density};
    return n;
}

/* Sine and cosine of the azimuth from that of wi; p and q not both 0. u1 turns from behind wi (0) through its azimuth
 * (1/2) and round; it is solved like the azimuth of a table. */
KERNEL turn v_cavity_azimuth(real p, real q, real u1)
{
    real lean = max(q, 1e-6f * p + 1e-37f), rest = arc_half(u1);
    arc k = arc_of(p, lean, lean - p, 0);
    real goal = 3.14159265f * k.cc * rest, per = k.sum / lean;
    azimuth b = arc_step(k, arc_start(k, min(goal / k.mass, set(1.0f)), 0), goal);
    turn front = half_turn(0.5f - 0.5f * rest);
    mask both_see = le(1.57079633f * (1.0f + rest), k.length);
    const turn a = {with_sign(select(both_see, b.sine * per, front.sine), u1 - 0.5f),
                    select(both_see, b.cosine * per, front.cosine)};
    return a;
}

/* Density of V-cavities over that of all normals: 2 f/(f + f') with f = max(up + level, 0) of the normal and
 * f' = max(up - level, 0) of its twin, the visible parts from wi. */
KERNEL real v_cavity_share(real level, real up)
{
    real facing = max(up + level, set(0.0f));
    return select(lt(level, up), facing / max(up, set(1e-37f)), set(2.0f));
}

/* A normal that w sees in V-cavities, vz >= 0. */
KERNEL normal_sample v_cavity_draw(any_slope r, real vx, real vy, real vz, real u1)
{
    real across2 = vx * vx + vy * vy, s = sqrt(across2), per = 1.0f / max(s, set(1e-15f));
    mask leans = lt(set(1e-30f), across2);
    real cosine = select(leans, vx * per, set(1.0f)), sine = select(leans, vy * per, set(0.0f));
    turn a = v_cavity_azimuth(vz * r.z, s * r.x, u1);
    real x = r.x * (cosine * a.cosine - sine * a.sine), y = r.x * (sine * a.cosine + cosine * a.sine);
    real level = s * r.x * a.cosine, up = vz * r.z,
         side = select(lt(set(0.0f), up + level), set(1.0f), set(-1.0f));
    const normal_sample n = {side * x, side * y, r.z, r.density * v_cavity_share(side * level, up)};
    return n;
}
#endif
