/* Hard cases: what a renderer hands to vndf.h on a bad day. First the product of incident directions along the
 * axes, a hair beside them, at and beyond the horizon, of length 1 and nearly 1; of roughnesses from 1e-8 to 1e4
 * in all pairs up to a ratio of 1e8; and of uniform numbers at their ends and at 1/2 in all pairs, and random ones
 * (stress.c lists them). Then random surfaces: matrices of either sign with singular values from 1e-5 to 10 and a
 * condition of up to 1e4, mean slopes up to 2, seen also from the mean plane. Each property is a number that is 0
 * at best and must not exceed its limit. */
#ifndef TOOLS_EVIDENCE_MEASURE_STRESS_H
#define TOOLS_EVIDENCE_MEASURE_STRESS_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

typedef enum stress_id {
    /* of a sample */
    STRESS_UNIT,
    STRESS_ABOVE,
    STRESS_FACING,
    STRESS_POSITIVE,
    STRESS_RETURNED,
    /* of a direction */
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

/* One input, whole: nine digits of each number give it again. */
typedef struct stress_point {
    vndf_affine surface;
    vndf_vec3 wi, wo; /* wo: of G2 */
    float u1, u2;
} stress_point;

typedef struct stress_finding {
    size_t checked, failed;
    double worst;    /* infinite for NaN */
    stress_point at; /* where the worst was */
} stress_finding;

typedef struct stress_result {
    size_t views, samples;
    size_t outside; /* views left out, whose roughness times the scale of the table they leave [1e-15, 1e15] */
    stress_finding found[STRESS_COUNT];
} stress_result;

/* Every `every`-th view of the product (1: all, some 23000 of 80 samples each; a number prime to 12 and 21 does
 * not favour any direction), and `random` views of 16 samples. */
stress_result stress_run(const vndf_distribution *distribution, size_t every, size_t random, uint64_t seed);

/* Notes a number for a property; returns whether it is within the limit. */
int stress_note(stress_result *result, stress_id id, double value, const stress_point *at);

/* Do sample, pdf and invert agree? At random views - incident directions over the whole sphere, roughness from
 * 0.02 to 1 of the median slope along each axis, projected area above 1e-12 - and random numbers. */
typedef enum stress_pair {
    /* |pdf(sample) / density returned - 1|, where D is no steeper than a lobe a tenth of its slope wide */
    STRESS_ABOVE_HORIZON,
    STRESS_BELOW_HORIZON,
    /* distance of unit normals, slopes over alpha, between a normal and sample(invert(normal)); 0 if the u's
     * come back within 8 steps of 2^-24: near the ends of heavy tails one such step moves the normal farther */
    STRESS_INVERTED,
    STRESS_AGREEMENTS
} stress_pair;

/* What 99.9% and 99.99% of the differences do not exceed. */
typedef struct stress_agreement {
    size_t measured;
    double usual, rare;
} stress_agreement;

/* Returns 0 if there is no memory. */
int stress_agree(const vndf_distribution *distribution, size_t points, uint64_t seed,
                 stress_agreement found[STRESS_AGREEMENTS]);

#endif
