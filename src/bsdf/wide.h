/* The kernel for one double, with functions of src/math. */
#ifndef VNDF_BSDF_WIDE_H
#define VNDF_BSDF_WIDE_H

#include "kernel/wide.h"
#include "math/exp_log.h"

/* x as the calls of vndf.h take it. */
HERE real narrow(real x)
{
    return (real)(float)x;
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
