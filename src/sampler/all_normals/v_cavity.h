/* The azimuth of V-cavities (Cook & Torrance, "A Reflectance Model for Computer Graphics", SIGGRAPH 1981; Heitz &
 * d'Eon 2014): at a given slope length a normal sees wi by p + q cos a, a from the azimuth of wi, p, q >= 0, and
 * its mirror twin by p - q cos a. Of the two one is taken by what it sees, so a has the density
 *
 *     (p + q cos a)+ / ((p + q cos a)+ + (p - q cos a)+) / pi
 *         = 1/pi                     where only the normal sees wi,
 *         = (1 + t cos a)/(2 pi)     where both do, |t cos a| <= 1, t = q/p,
 *         = 0                        where only the twin does.
 *
 * No third uniform number picks the twin: this is inverted as it stands, and u1 remains a continuous, monotone
 * coordinate. Let h = asin(min(1, 1/t))/pi (1/2 where t <= 1): both see wi for a/pi between 1/2 - h and 1/2 + h,
 * and with g = 1/2 + h - a/pi, the distance from the far end of that, the mass beyond a, of half a turn, is
 *
 *     F(g) = g - (2 t/pi) sin(pi g/2) sin(pi (h - g/2)),      F' = 1 - t sin(pi (h - g)),    0 <= g <= 2 h
 *
 * Kepler's equation at h = 1/2. The product of sines stands for a difference of cosines: without it t > 1e3 would
 * lose F. Start: rational cells (math/rational_cell.h) with the masses and densities at 0, h and 2 h; then
 * steps of Halley's method, of which F convex lets none go astray, until F is within 1.2e-7. Worst are t near 1,
 * where F begins as a cube: four steps; elsewhere there are one or two. */
#ifndef VNDF_SAMPLER_ALL_NORMALS_V_CAVITY_H
#define VNDF_SAMPLER_ALL_NORMALS_V_CAVITY_H

#include "math/elementary.h"
#include "math/half_turn.h"
#include "math/rational_cell.h"

/* t as a factor of F, and h. */
typedef struct vndf_v_cavity {
    float factor, h;
} vndf_v_cavity;

/* p, q >= 0, not both 0. t beyond 1e15 is 1e15: what both see is then beyond the digits of u1. */
VNDF_INLINE vndf_v_cavity vndf_v_cavity_from(float p, float q)
{
    vndf_v_cavity twin = {q < 1e15f * p ? q / p : 1e15f, 0.5f};
    if (twin.factor > 1.0f) {
        double t = twin.factor;
        twin.h = (float)(0.31830988618379067 * vndf_atan_unit(1.0 / (t + sqrt((t - 1.0) * (t + 1.0)))) * 2.0);
    }
    return twin;
}

/* F(g) and its derivatives. */
typedef struct vndf_v_cavity_mass {
    float mass, density, bend;
} vndf_v_cavity_mass;

VNDF_INLINE vndf_v_cavity_mass vndf_v_cavity_beyond(const vndf_v_cavity *twin, float g)
{
    const float pi = 3.14159265f, per_pi = 0.318309886f;
    float v = twin->h - g, near = vndf_sine_quarter(0.5f * g), far = vndf_sine_quarter(twin->h - 0.5f * g);
    vndf_v_cavity_mass at = {g - (2.0f * per_pi * twin->factor) * (near * far), 1.0f, 0.0f};
    at.density = 1.0f - twin->factor * copysignf(vndf_sine_quarter(fabsf(v)), v);
    at.bend = pi * twin->factor * vndf_sine_quarter(0.5f - fabsf(v));
    return at;
}

/* A g with about the mass `rest` beyond, by two rational cells. */
VNDF_INLINE float vndf_v_cavity_start(const vndf_v_cavity *twin, float rest)
{
    float h = twin->h, half = vndf_sine_quarter(0.5f * h);
    float mass = h - 0.636619772f * twin->factor * (half * half);
    float rise = twin->factor < 1.0f ? twin->factor : 1.0f;
    int beyond = rest > mass;
    vndf_rational_cell cell = {beyond ? h : (1.0f - rise) * h, beyond ? (1.0f + rise) * h : h,
                               beyond ? 2.0f * h - mass : mass};
    vndf_rational_place in = vndf_rational_invert(&cell, beyond ? rest - mass : rest);
    float xi = in.over / (in.under + 1e-30f);
    return h * (beyond ? 1.0f + xi : xi);
}

/* a/pi in [0, 1] with the mass `rest` in [0, 1] of half a turn beyond it. */
VNDF_INLINE float vndf_v_cavity_draw(const vndf_v_cavity *twin, float rest)
{
    const float whole = 2.0f * twin->h;
    if (rest >= whole)
        return 0.5f - 0.5f * rest;
    float g = vndf_v_cavity_start(twin, rest);
    for (int i = 0; i < 8; i++) {
        vndf_v_cavity_mass at = vndf_v_cavity_beyond(twin, g);
        float miss = at.mass - rest, below = at.density * at.density - 0.5f * miss * at.bend;
        if (fabsf(miss) < 1.2e-7f || !(below > 0.0f))
            break;
        g -= miss * at.density / below;
        g = g > 0.0f ? (g < whole ? g : whole) : 0.0f;
    }
    return (0.5f - g) + twin->h;
}

#endif
