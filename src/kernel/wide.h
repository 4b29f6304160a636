/* The types of the kernel as one double: for what scatters light, since refraction where the index ratio is near 1, and
 * Fresnel's terms beside total reflection, want more digits of directions than floats have; and for certificates, which
 * compare what the run time draws with what is seen. Files that include this page do not include kernel/one.h. */
#ifndef VNDF_KERNEL_WIDE_H
#define VNDF_KERNEL_WIDE_H

#include <math.h>

#include "core/inline.h"

#define HERE VNDF_INLINE

typedef double real;
typedef int mask;

#include "kernel/plain.h"

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

#endif
