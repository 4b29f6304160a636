/* Normals drawn without a look at what wi sees (Walter et al., "Microfacet Models for Refraction through Rough
 * Surfaces", EGSR 2007), and those that it sees in V-cavities (Cook & Torrance 1981; Heitz & d'Eon, EGSR 2014), which
 * are made of them: a slope length from u2, an azimuth from u1.
 *
 * V-cavities: at a slope length R = x/z a normal sees wi by p + q cos a, a from the azimuth of wi, p = vz z, q = s x >=
 * 0, and its mirror twin by p - q cos a. Of the two one is taken by what it sees, so a has the density
 *
 *     1/pi where only the normal sees wi,     (1 + t cos a)/(2 pi) where both do, |t cos a| <= 1, t = q/p,
 *
 * and 0 elsewhere. With h = asin(min(1, 1/t))/pi and g = 1/2 + h - a/pi in [0, 2 h] the mass beyond a, of half a turn,
 * is
 *
 *     F(g) = g - (2 t/pi) sin(pi g/2) sin(pi (h - g/2)),      F' = 1 - t sin(pi (h - g)),                    (1)
 *
 * Kepler's equation at h = 1/2. The product of sines stands for a difference of cosines, without which t > 1e3 would
 * lose F. It is solved from two rational cells (Gregory & Delbourgo 1982) by two steps of Halley's method, or four; F
 * is convex. */
#ifndef VNDF_KERNEL_NORMALS_H
#define VNDF_KERNEL_NORMALS_H

#include "kernel/math.h"

/* A slope length x/z and K of D cos(theta_m): with any azimuth a that is uniform, (x cos a, x sin a, z) has it. */
typedef struct any_slope {
    real x, z, density;
} any_slope;

/* R^2 = u/(1 - u). */
HERE any_slope ggx_slope(real u2)
{
    real z = root(most(1.0f - u2, set(1.49011612e-8f)));
    const any_slope r = {root(u2), z, 0.318309886f * z};
    return r;
}

/* R^2 = -log(1 - u), with its digits where u is small. */
HERE any_slope beckmann_slope(real u2)
{
    real rest = most(1.0f - u2, set(1.49011612e-8f));
    real square = -pick(less(u2, set(0.25f)), log_near(-least(u2, set(0.25f))), log_of(rest));
    const any_slope r = {root(square), set(1.0f), 0.318309886f * rest};
    return r;
}

/* u1 turns, once about z, from -x (0) through x (1/2) and round. */
HERE drawn all_normals_draw(any_slope r, real u1)
{
    real half = 2.0f * u1 - 1.0f;
    turn a = half_turn(size(half));
    const drawn n = {r.x * a.cosine, r.x * with_sign(a.sine, half), r.z, r.density};
    return n;
}

/* t and h; then F, F' and F''. */
typedef struct v_cavity {
    real t, h;
} v_cavity;

typedef struct v_cavity_mass {
    real mass, density, bend;
} v_cavity_mass;

HERE v_cavity v_cavity_of(real p, real q)
{
    real t = least(q / most(p, 1e-15f * q + 1e-37f), set(1e15f)), over = most(t, set(1.0f));
    real tangent = 1.0f / (over + root((over - 1.0f) * (over + 1.0f))), t2 = tangent * tangent;
    const v_cavity k = {t, 0.636619772f * (tangent - tangent * t2 * arc_rest(t2))};
    return k;
}

HERE v_cavity_mass v_cavity_beyond(v_cavity k, real g)
{
    real away = k.h - g, sine = with_sign(sine_quarter(size(away)), away);
    real product = sine_quarter(0.5f * g) * sine_quarter(size(k.h - 0.5f * g));
    const v_cavity_mass f = {g - 0.636619772f * k.t * product, 1.0f - k.t * sine,
                             3.14159265f * k.t * sine_quarter(most(0.5f - size(away), set(0.0f)))};
    return f;
}

/* A g with about the mass `rest` beyond: a cell before h and one after it, in units of h. */
HERE real v_cavity_start(v_cavity k, real rest)
{
    real half = sine_quarter(0.5f * k.h), middle = 1.0f - 0.636619772f * k.t * (half * half) / k.h;
    real target = rest / k.h, rise = least(k.t, set(1.0f));
    mask beyond = less(middle, target);
    real m = pick(beyond, 2.0f - middle, middle), left = most(target - pick(beyond, middle, set(0.0f)), set(0.0f));
    real e0 = pick(beyond, set(1.0f), 1.0f - rise), sum = 1.0f + pick(beyond, 1.0f + rise, 1.0f - rise),
         v = least(left, m);
    real twice = 2.0f * v * m, turned = e0 * m - v * sum,
         discriminant = root(turned * turned + 2.0f * twice * m * (m - v));
    mask rising = at_most(set(0.0f), turned + twice);
    real over = pick(rising, twice, discriminant - turned),
         under = pick(rising, discriminant + turned, 2.0f * m * (m - v));
    return k.h * (pick(beyond, set(1.0f), set(0.0f)) + over / (over + under + 1e-30f));
}

HERE real v_cavity_step(v_cavity k, real g, real rest)
{
    v_cavity_mass f = v_cavity_beyond(k, g);
    real miss = f.mass - rest, below = f.density * f.density - 0.5f * miss * f.bend;
    real step = pick(less(set(0.0f), below), miss * f.density / most(below, set(1e-30f)), set(0.0f));
    return least(most(g - step, set(0.0f)), 2.0f * k.h);
}

/* Sine and cosine of the azimuth from that of wi; p and q not both 0. u1 turns from behind wi (0) through its azimuth
 * (1/2) and round; it is met within 8e-8, measured. */
HERE turn v_cavity_azimuth(real p, real q, real u1)
{
    v_cavity k = v_cavity_of(p, q);
    real rest = 2.0f * least(u1, 1.0f - u1), end = 2.0f * k.h, g = v_cavity_start(k, least(rest, end));
    g = v_cavity_step(k, v_cavity_step(k, g, rest), rest);
    mask rare = both(less(size(k.t - 1.0f), set(0.15f)), less(rest, set(0.06f))); /* F begins as a cube */
    if (any(rare))
        g = pick(rare, v_cavity_step(k, v_cavity_step(k, g, rest), rest), g);
    real part = pick(at_most(end, rest), 0.5f - 0.5f * rest, (0.5f - g) + k.h);
    turn a = half_turn(least(most(part, set(0.0f)), set(1.0f)));
    a.sine = with_sign(a.sine, u1 - 0.5f);
    return a;
}

/* What V-cavities draw a normal more often than all normals do: 2 f/(f + f'), f = up + level and f' = up - level what
 * it and its twin see of wi, not below 0. */
HERE real v_cavity_share(real level, real up)
{
    real facing = most(up + level, set(0.0f));
    return pick(less(level, up), facing / most(up, set(1e-37f)), set(2.0f));
}

/* A normal that w sees in V-cavities, vz >= 0. */
HERE drawn v_cavity_draw(any_slope r, real vx, real vy, real vz, real u1)
{
    real across2 = vx * vx + vy * vy, s = root(across2), per = 1.0f / most(s, set(1e-15f));
    mask leans = less(set(1e-30f), across2);
    real cosine = pick(leans, vx * per, set(1.0f)), sine = pick(leans, vy * per, set(0.0f));
    turn a = v_cavity_azimuth(vz * r.z, s * r.x, u1);
    real x = r.x * (cosine * a.cosine - sine * a.sine), y = r.x * (sine * a.cosine + cosine * a.sine);
    real level = s * r.x * a.cosine, up = vz * r.z,
         side = pick(less(set(0.0f), up + level), set(1.0f), set(-1.0f));
    const drawn n = {side * x, side * y, r.z, r.density * v_cavity_share(side * level, up)};
    return n;
}
#endif
