/* The front half circle, cos a >= 0, above the horizon: the density of the azimuth is A + B cos a with A = c F0 and B
 * = s F1, and needs no table of D. With b = pi/2 - a its mass beyond a is
 *
 *     A b + B (1 - cos b) = 2 A asin(y) + 2 B y^2,      y = sin(b/2),
 *
 * To find the b with a given mass R is Kepler's equation. With k for asin(y)/y its root is y = R/(A k + sqrt((A k)^2 +
 * 2 B R)). For A = 0 this is exact; where A dominates, k = 1 + 0.1107 (R/whole)^2 leaves b within 4.3e-3. (The code
 * multiplies all by whole^2, which spares a division.) One step of Halley's method in b, made by turning (sin b, cos
 * b), leaves an error of 7.4e-9 of the mass, so A + B cos a is the density of the sample to float precision. A
 * polynomial in y^2 replaces asin(y)/y up to y^2 = 0.505; its largest error is 1.8e-8. */
#ifndef VNDF_SAMPLER_TABULATED_FRONT_H
#define VNDF_SAMPLER_TABULATED_FRONT_H

#include "sampler/tabulated/azimuth.h"

static const float VNDF_QUARTER_TURN = 1.57079633f; /* integral of 1 over the front; that of cos a is 1 */

/* A and B of a view. */
typedef struct vndf_front {
    lanes_f even, odd;
} vndf_front;

VNDF_INLINE vndf_front vndf_front_of(const vndf_distribution *d, lanes_f s, lanes_f c)
{
    vndf_front front = {c * d->f0_total, s * d->f1_total};
    return front;
}

VNDF_INLINE lanes_f vndf_front_density(vndf_front front, lanes_f cos_phi)
{
    return front.even + front.odd * cos_phi;
}

/* The mass of the whole front. */
VNDF_INLINE lanes_f vndf_front_mass(vndf_front front)
{
    return front.even * VNDF_QUARTER_TURN + front.odd;
}

/* Mass beyond the azimuth with y = sin(b/2), y2 = y^2. */
VNDF_INLINE lanes_f vndf_front_beyond(vndf_front front, lanes_f y, lanes_f y2)
{
    lanes_f y4 = y2 * y2, low = 0.99999998f + 0.16667076f * y2 + y4 * (0.074840751f + 0.046982405f * y2);
    lanes_f high = 0.013773087f + 0.084478642f * y2 + y4 * (-0.10345663f + 0.11751909f * y2);
    return 2.0f * (front.even * y * (low + y4 * y4 * high) + front.odd * y2);
}

/* Mass between an azimuth and the side. */
VNDF_INLINE lanes_f vndf_front_rest(vndf_front front, lanes_f cos_phi, lanes_f sin_phi)
{
    lanes_f y = cos_phi / lanes_root(2.0f * (1.0f + sin_phi));
    return vndf_front_beyond(front, y, y * y);
}

/* An approximate y of the azimuth with the mass `rest` beyond it; `whole` is the mass of the front. */
VNDF_INLINE lanes_f vndf_front_start(vndf_front front, lanes_f rest, lanes_f whole)
{
    const float tiny = 1e-30f; /* quotients of nothing become 0, here and below */
    lanes_f rest2 = rest * rest, whole2 = whole * whole, scaled = rest * whole2;
    lanes_f k = (front.even + tiny) * (whole2 + 0.1107f * rest2);
    return scaled / (k + lanes_root(k * k + 2.0f * front.odd * (scaled * whole2)));
}

/* The azimuth, one step from such a y. The third power of the step is 1e-8. *near is the cosine before that step,
 * within 0.6%: a search can begin with it early. */
VNDF_INLINE vndf_azimuth vndf_front_step(vndf_front front, lanes_f rest, lanes_f y, lanes_f *near)
{
    lanes_f y2 = y * y, sine = 2.0f * y * lanes_root(1.0f - y2), cosine = 1.0f - 2.0f * y2;
    *near = sine;
    lanes_f density = vndf_front_density(front, sine) + 1e-18f;
    lanes_f miss = rest - vndf_front_beyond(front, y, y2);
    lanes_f step = miss * density / (density * density + miss * (0.5f * front.odd * cosine));
    lanes_f half_step2 = 0.5f * (step * step);
    lanes_f c = (sine + cosine * step) - sine * half_step2, s = (cosine - sine * step) - cosine * half_step2;
    vndf_azimuth at = {lanes_positive(c), lanes_positive(s), lanes_set(1.0f), lanes_set(0.0f)};
    at.density = vndf_front_density(front, at.c);
    return at;
}

VNDF_INLINE vndf_azimuth vndf_front_draw(vndf_front front, lanes_f rest, lanes_f whole, lanes_f *near)
{
    return vndf_front_step(front, rest, vndf_front_start(front, rest, whole), near);
}

#endif
