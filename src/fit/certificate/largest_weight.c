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

/* A ratio of at least 1 + beyond above which a little more than VNDF_VALIDATION_LEFT_OUT of the mass lies, or 0. */
static double least_beyond(const vndf_points *p, double beyond)
{
    double mass[BUCKETS] = {0}, sum = 0.0, least = 1 + beyond;
    for (size_t i = 0; i < p->count; i++)
        if (p->reference[i] > least * p->drawn[i])
            mass[bucket_of(vndf_weight_ratio(p->reference[i], p->drawn[i]) - 1)] += p->reference[i];
    for (size_t i = BUCKETS - 1; i > bucket_of(beyond); i--) {
        sum += mass[i];
        if (sum > 1.01 * VNDF_VALIDATION_LEFT_OUT)
            return (1 + beyond_of(i)) * (1 - 1e-12);
    }
    return 0.0;
}

/* The same, 0 if no ratio above 1 is. Begins near what the last direction had: the fewer points are beyond that, the
 * faster it is. */
static double least_that_counts(const vndf_points *p, double last)
{
    double beyond = last / 4, least = 0.0;
    while (least == 0.0 && beyond > 1e-12) {
        least = least_beyond(p, beyond);
        beyond /= 32;
    }
    return least;
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

double vndf_largest_weight(vndf_weights *w, const vndf_points *p, int *starved)
{
    double least = least_that_counts(p, w->beyond);
    size_t n = 0;
    for (size_t i = 0; i < p->count; i++)
        if (p->reference[i] >= least * p->drawn[i] && has_room(w, n, starved)) {
            vndf_weight one = {vndf_weight_ratio(p->reference[i], p->drawn[i]), p->reference[i]};
            w->that_count[n++] = one;
        }
    double weight = weight_among(w->that_count, n);
    w->beyond = fmax(fmin(weight, 1e6) - 1, 1e-6);
    return weight;
}
