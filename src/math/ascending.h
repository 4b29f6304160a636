/* The order of numbers, for qsort. */
#ifndef VNDF_MATH_ASCENDING_H
#define VNDF_MATH_ASCENDING_H

static inline int vndf_ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
