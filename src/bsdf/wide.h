/* The types of the kernel as one double, for what scatters light: refraction where the index ratio is near 1, and
 * Fresnel's terms beside total reflection, want more digits of directions than floats have. Files that include
 * this page do not include kernel/one.h. */
#ifndef VNDF_BSDF_WIDE_H
#define VNDF_BSDF_WIDE_H

#include <math.h>

#include "core/inline.h"
#include "math/exp_log.h"

#define HERE VNDF_INLINE

typedef double real;
typedef int mask;

#include "kernel/plain.h"

HERE real set(double x)
{
    return x;
}

/* x as the calls of vndf.h take it. */
HERE real narrow(real x)
{
    return (real)(float)x;
}

HERE real least(real a, real b)
{
    return a < b ? a : b;
}

HERE real most(real a, real b)
{
    return a > b ? a : b;
}

HERE real root(real x)
{
    return sqrt(x);
}

HERE real size(real x)
{
    return fabs(x);
}

/* |x| with the sign of y. */
HERE real with_sign(real x, real y)
{
    return copysign(x, y);
}

HERE real exp_of(real x)
{
    return vndf_exp(x);
}

HERE real log_of(real x)
{
    return vndf_log(x);
}

/* log(1 + x). */
HERE real log_beyond(real x)
{
    return vndf_log1p(x);
}

#include "kernel/lobes.h"

#endif
