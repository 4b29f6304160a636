/* The order of numbers: for qsort, and to find a place among them. */
#ifndef VNDF_MATH_ASCENDING_H
#define VNDF_MATH_ASCENDING_H

#include <stddef.h>

static inline int vndf_ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The last of `count` ascending numbers, some `stride` bytes apart, that is at or before r; else the first. */
static inline size_t vndf_last_before(const double *first, size_t stride, size_t count, double r)
{
    size_t low = 0, high = count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        const void *at = (const char *)first + middle * stride;
        if (*(const double *)at <= r)
            low = middle;
        else
            high = middle;
    }
    return low;
}

#endif
