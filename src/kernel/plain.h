/* Comparisons and choices of a page whose numbers are the compiler's own: `real` is float or double, `mask` int unless
 * the page has its own. */
#ifndef VNDF_KERNEL_PLAIN_H
#define VNDF_KERNEL_PLAIN_H

HERE real set(real x)
{
    return x;
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. */
HERE real least(real a, real b)
{
    return a < b ? a : b;
}

HERE real most(real a, real b)
{
    return a > b ? a : b;
}

#ifndef VNDF_KERNEL_SSE2

HERE mask less(real a, real b)
{
    return a < b;
}

HERE mask at_most(real a, real b)
{
    return a <= b;
}

HERE mask both(mask a, mask b)
{
    return a & b;
}

HERE mask either(mask a, mask b)
{
    return a | b;
}

HERE int any(mask m)
{
    return m;
}

HERE real pick(mask m, real yes, real no)
{
    return m ? yes : no;
}

#endif
#endif
