/* Cosine and sine of an angle in turns, of any size: by their series to an eighth of a turn, doubled twice. */
#ifndef VNDF_MATH_TURN_H
#define VNDF_MATH_TURN_H

#include <math.h>

#include "core/inline.h"

static inline void vndf_turn_of(double turns, double *cosine, double *sine)
{
    double x = (turns - floor(turns + 0.5)) * 1.5707963267948966, x2 = x * x, c = 1.0, s = 1.0;
    for (int n = 16; n > 0; n -= 2) {
        c = 1.0 - x2 / (n * (n - 1)) * c;
        s = 1.0 - x2 / (n * (n + 1)) * s;
    }
    s *= x;
    for (int i = 0; i < 2; i++) {
        double twice = 2.0 * s * c;
        c = 1.0 - 2.0 * (s * s);
        s = twice;
    }
    *cosine = c;
    *sine = s;
}

#endif
