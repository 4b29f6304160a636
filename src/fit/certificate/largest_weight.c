/* Only those few weights are sorted that may be the largest: buckets tell where they begin. */
#include "fit/certificate/largest_weight.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

double vndf_weight_ratio(double reference, double drawn)
{
    return drawn > 0 ? reference / drawn : reference > 0 ? HUGE_VAL : 0.0;
}

/* Moves weights of `pivot` or more to the front; their count. */
static size_t split_at(vndf_weight *weights, size_t count, double pivot, double *mass)
{
    size_t n = 0;
    *mass = 0.0;
    for (size_t i = 0; i < count; i++)
        if (weights[i].ratio >= pivot) {
            vndf_weight swap = weights[n];
            *mass += weights[i].mass;
            weights[n++] = weights[i];
            weights[i] = swap;
        }
    return n;
}

static double middle_of_three(double a, double b, double c)
{
    return fmax(fmin(a, b), fmin(fmax(a, b), c));
}

/* The largest ratio, leaving out the largest ones that together hold VNDF_VALIDATION_LEFT_OUT of the mass. Splits the
 * rest until it is one value. */
static double weight_among(vndf_weight *from, size_t count)
{
    double left = VNDF_VALIDATION_LEFT_OUT, mass;
    while (count > 0) {
        double pivot = middle_of_three(from[0].ratio, from[count / 2].ratio, from[count - 1].ratio);
        size_t larger = 0;
        mass = 0.0;
        if (pivot < HUGE_VAL)
            larger = split_at(from, count, nextafter(pivot, HUGE_VAL), &mass);
        if (mass > left) {
            count = larger;
            continue;
        }
        left -= mass;
        from += larger;
        count -= larger;
        size_t equal = split_at(from, count, pivot, &mass);
        if (mass > left)
            return pivot;
        left -= mass;
        from += equal;
        count -= equal;
    }
    return 1.0;
}

/* Buckets for the part of a ratio beyond 1, eight to an octave: its bits without the sign and most of the digits. The
 * first holds all that is less than 2^-40, the last all that is more than 2^40. */
enum { BUCKET_SHIFT = 49, BUCKET_FIRST = (1023 - 40) * 8, BUCKETS = 80 * 8 };

static size_t bucket_of(double beyond)
{
    uint64_t bits;
    memcpy(&bits, &beyond, sizeof bits);
    bits >>= BUCKET_SHIFT;
    return !(beyond > 0) || bits < BUCKET_FIRST ? 0
           : bits < BUCKET_FIRST + BUCKETS      ? (size_t)(bits - BUCKET_FIRST)
                                                : BUCKETS - 1;
}

/* Where a bucket begins. */
static double beyond_of(size_t bucket)
{
    uint64_t bits = (uint64_t)(bucket + BUCKET_FIRST) << BUCKET_SHIFT;
    double beyond;
    memcpy(&beyond, &bits, sizeof beyond);
    return beyond;
}

/* Whether there is room for another weight after n. */
static int has_room(vndf_weights *w, size_t n, int *starved)
{
    if (n < w->capacity)
        return 1;
    size_t capacity = w->capacity ? 2 * w->capacity : 1024;
    vndf_weight *larger = realloc(w->that_count, capacity * sizeof *larger);
    if (!larger) {
        *starved = 1;
        return 0;
    }
    w->that_count = larger;
    w->capacity = capacity;
    return 1;
}

enum { GROUP = 32 };

/* Whether one of GROUP points has a ratio above `least`, by the signs of differences: without a branch, so that
 * compilers make lanes of it. */
static int has_larger(const double *reference, const double *drawn, double least)
{
    uint64_t signs = 0;
    for (size_t i = 0; i < GROUP; i++) {
        double beyond = least * drawn[i] - reference[i];
        uint64_t bits;
        memcpy(&bits, &beyond, sizeof bits);
        signs |= bits;
    }
    return (signs >> 63) > 0;
}

/* Takes the points with a ratio above `least`; their count. Most groups of points have none. */
static size_t take_larger(vndf_weights *w, const vndf_points *p, double least, int *starved)
{
    size_t n = 0;
    for (size_t from = 0; from < p->count; from += GROUP) {
        size_t end = from + GROUP < p->count ? from + GROUP : p->count;
        if (end == from + GROUP && !has_larger(p->reference + from, p->drawn + from, least))
            continue;
        for (size_t i = from; i < end; i++)
            if (p->reference[i] > least * p->drawn[i] && has_room(w, n, starved)) {
                vndf_weight one = {vndf_weight_ratio(p->reference[i], p->drawn[i]), p->reference[i]};
                w->that_count[n++] = one;
            }
    }
    return n;
}

/* A ratio above 1 + beyond beyond which a little more than VNDF_VALIDATION_LEFT_OUT of the mass lies, or 0. */
static double least_beyond(const vndf_weight *weights, size_t count, double beyond)
{
    double mass[BUCKETS] = {0}, sum = 0.0;
    for (size_t i = 0; i < count; i++)
        mass[bucket_of(weights[i].ratio - 1)] += weights[i].mass;
    for (size_t i = BUCKETS - 1; i > bucket_of(beyond); i--) {
        sum += mass[i];
        if (sum > 1.01 * VNDF_VALIDATION_LEFT_OUT)
            return (1 + beyond_of(i)) * (1 - 1e-12);
    }
    return 0.0;
}

/* Moves weights of at least `least` to the front, in their order; their count. */
static size_t keep_from(vndf_weight *weights, size_t count, double least)
{
    size_t n = 0;
    for (size_t i = 0; i < count; i++)
        if (weights[i].ratio >= least)
            weights[n++] = weights[i];
    return n;
}

/* Begins near what the last direction had: the fewer points are beyond that, the faster it is. If no ratio above 1
 * counts, all points are looked at. */
double vndf_largest_weight(vndf_weights *w, const vndf_points *p, int *starved)
{
    double beyond = w->beyond / 4, least = 0.0;
    size_t n = 0;
    for (; least == 0.0 && beyond > 1e-12; beyond /= 32) {
        n = take_larger(w, p, 1 + beyond, starved);
        least = least_beyond(w->that_count, n, beyond);
    }
    n = least > 0.0 ? keep_from(w->that_count, n, least) : take_larger(w, p, -1.0, starved);
    double weight = weight_among(w->that_count, n);
    w->beyond = fmax(fmin(weight, 1e6) - 1, 1e-6);
    return weight;
}
