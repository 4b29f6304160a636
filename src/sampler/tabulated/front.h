/* The front half circle, cos a >= 0, above the horizon: the density of the azimuth is A + B cos a with A = c F0 and B
 * = s F1, and needs no table of D. With b = pi/2 - a its mass beyond a is
 *
 *     A b + B (1 - cos b).
 *
 * To find the b with a given mass R is Kepler's equation. With g b^2/2 for 1 - cos b its root is
 * b = 2 R/(A + sqrt(A^2 + 2 B g R)); g = 1 - 0.185 R/whole leaves b within 8e-3. (The code multiplies all by the whole
 * mass, which spares a division.) One step of Halley's method in b, made by turning (sin b, cos b), leaves an error of
 * 1.2e-8 of the mass, so A + B cos a is the density of the sample to float precision.
 *
 * Polynomials in b^2 stand for sin b and 1 - cos b. The inverse, which is given an azimuth, has y = sin(b/2), and
 *
 *     A b + B (1 - cos b) = 2 A asin(y) + 2 B y^2:
 *
 * a polynomial in y^2 replaces asin(y)/y up to y^2 = 0.505; its largest error is 1.8e-8. */
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

/* sin b over b and 1 - cos b over b^2, for b in [0, pi/2 + 0.01], within 6e-9 and 6e-10 but for rounding. */
VNDF_INLINE lanes_f vndf_front_sine(lanes_f b2, lanes_f b4)
{
    return (1.0f - 0.166666597f * b2) + b4 * ((0.00833306648f - 0.000198093738f * b2) + 2.60480601e-6f * b4);
}

VNDF_INLINE lanes_f vndf_front_versine(lanes_f b2, lanes_f b4)
{
    return (0.5f - 0.0416666605f * b2) + b4 * ((0.00138886541f - 2.47739772e-5f * b2) + 2.62738013e-7f * b4);
}

static const float vndf_front_tiny = 1e-18f; /* quotients of nothing become 0 */

/* An approximate b of the azimuth with the mass `rest` beyond it; `whole` is the mass of the front. */
VNDF_INLINE lanes_f vndf_front_start(vndf_front front, lanes_f rest, lanes_f whole)
{
    lanes_f level = (front.even + vndf_front_tiny) * whole, twice = 2.0f * whole * rest;
    lanes_f square = level * level + front.odd * twice * (whole - 0.185f * rest);
    return twice / (level + lanes_root(square));
}

/* The azimuth, one step from such a b. The third power of the step is 1e-8. *near is the cosine before that step,
 * within 0.6%: a search can begin with it early. */
VNDF_INLINE vndf_azimuth vndf_front_step(vndf_front front, lanes_f rest, lanes_f b, lanes_f *near)
{
    lanes_f even = front.even + vndf_front_tiny, odd = front.odd, b2 = b * b, b4 = b2 * b2;
    lanes_f sine_per = vndf_front_sine(b2, b4), versine_per = vndf_front_versine(b2, b4);
    lanes_f sine = b * sine_per, cosine = 1.0f - b2 * versine_per;
    *near = sine;
    lanes_f density = even + (odd * b) * sine_per, miss = (rest - even * b) - (odd * b2) * versine_per;
    lanes_f step = miss * density / (density * density + miss * (0.5f * odd * cosine));
    lanes_f c = sine + step * (cosine - step * (0.5f * sine)), s = cosine - step * (sine + step * (0.5f * cosine));
    vndf_azimuth at = {lanes_positive(c), lanes_positive(s), lanes_set(1.0f), lanes_set(0.0f)};
    at.density = vndf_front_density(front, at.c);
    return at;
}

VNDF_INLINE vndf_azimuth vndf_front_draw(vndf_front front, lanes_f rest, lanes_f whole, lanes_f *near)
{
    return vndf_front_step(front, rest, vndf_front_start(front, rest, whole), near);
}

#endif
