/* Hard cases: what a renderer hands to vndf.h on a bad day. It is the product of incident directions along the axes, a
 * hair beside them, at and beyond the horizon, of length 1 and nearly 1; of roughnesses from 1e-8 to 1e4 in all pairs
 * up to a ratio of 1e8; and of uniform numbers at their ends and at 1/2 in all pairs, and random ones (stress.c lists
 * them). Each property is a number that is 0 at best and must not exceed its limit. */
#pragma once

#include <stdint.h>

#include "vndf.h"

/* Of a sample; from STRESS_AREA on, of a direction. */
typedef enum stress_id {
    STRESS_UNIT,
    STRESS_ABOVE,
    STRESS_FACING,
    STRESS_POSITIVE,
    STRESS_RETURNED,
    STRESS_AREA,
    STRESS_MIRRORED,
    STRESS_LAMBDA,
    STRESS_G1,
    STRESS_G2,
    STRESS_COUNT
} stress_id;

typedef struct stress_property {
    const char *name, *meaning; /* a word; what the number is, and in which unit */
    double limit;
} stress_property;

extern const stress_property stress_properties[STRESS_COUNT];

/* One input, whole: alpha, wi, wo of G2, u; nine digits of each number give it again. Their names. */
enum { STRESS_NUMBERS = 10 };
extern const char *const stress_numbers[STRESS_NUMBERS];

typedef struct stress_finding {
    size_t checked, failed;
    double worst;                 /* infinite for NaN */
    float number[STRESS_NUMBERS]; /* where the worst was */
} stress_finding;

typedef struct stress_result {
    size_t views, samples;
    size_t outside; /* views left out, whose roughness times the scale of the table they leave [1e-15, 1e15] */
    stress_finding found[STRESS_COUNT];
} stress_result;

/* Every `every`-th view of the product (1: all, some 23000 of 80 samples each; a number prime to 12 and 22 does
 * not favour any direction). */
stress_result stress_run(const vndf_distribution *distribution, size_t every, uint64_t seed);

/* Notes a number for a property; returns whether it is within the limit. */
int stress_note(stress_result *result, stress_id id, double value, const float at[STRESS_NUMBERS]);
