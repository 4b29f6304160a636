/* Sine and cosine of pi u for u in [0, 1], without branch or call: + - * and fabsf only.
 *
 * sin(pi f) on [0, 1/2] is one odd polynomial of degree 9 (relative error 5.3e-9 before rounding, fitted for the
 * least largest relative error), and both values come from it: sin(pi u) = sin(pi f) with f = min(u, 1 - u), and
 * |cos(pi u)| = sin(pi g) with g = |u - 1/2|. Both reductions are exact near their zeros, so the sine keeps its
 * relative precision at u = 0 and 1, and the cosine at u = 1/2. Over all multiples of 2^-25 in [0, 1] the absolute
 * errors are at most 2.0e-7, a turn of u by 6e-8. */
#ifndef VNDF_MATH_HALF_TURN_H
#define VNDF_MATH_HALF_TURN_H

#include "simd/lanes.h"

typedef struct vndf_turn {
    lanes_f sine, cosine;
} vndf_turn;

/* sin(pi f), f in [0, 1/2]. */
VNDF_INLINE lanes_f vndf_sine_quarter(lanes_f f)
{
    lanes_f q = f * f;
    return f * (3.14159263696f +
                q * (-5.1677096882f + q * (2.55006977348f + q * (-0.598242370689f + q * 0.0775608117772f))));
}

VNDF_INLINE vndf_turn vndf_half_turn(lanes_f u)
{
    vndf_turn turn;
    turn.sine = vndf_sine_quarter(lanes_least(u, 1.0f - u));
    turn.cosine = lanes_sign(vndf_sine_quarter(lanes_abs(u - 0.5f)), 0.5f - u);
    return turn;
}

#endif
