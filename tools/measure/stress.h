/* Hard cases: what a renderer hands to vndf.h on a bad day. The product of
 *
 *     incident directions   exactly along z and 1e-7, 1e-4, 0.01 degrees from it; 30 to 89.9999 degrees; cosines
 *                           1e-7, 1e-20, 1e-42 (a denormal), 0 and -0, and the negative ones; 91, 130, 179.9 and
 *                           exactly 180 degrees; each along x, along y, diagonally and at 200 degrees; each of
 *                           length 1 and 1 +- 1e-6
 *     roughness             1e-8 1e-6 1e-4 0.01 0.1 0.5 1 2 10 1e4 in all pairs up to a ratio of 1e8
 *     uniform numbers       0, the least float, 2^-24, 1/2 and its neighbours, 1 - 2^-24, 1 in all pairs, and
 *                           random
 *
 * is run through sample, pdf, invert, area, lambda, g1 and g2 of one distribution. Each property (stress_property)
 * is a number that is 0 at best and must not exceed its limit; kept are how often it did and the worst input. */
#ifndef TOOLS_MEASURE_STRESS_H
#define TOOLS_MEASURE_STRESS_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

/* One input, whole: nine digits of each number give it again. */
typedef struct stress_point {
    vndf_vec3 wi;
    float alpha_x, alpha_y, u1, u2;
    vndf_vec3 wo; /* the second direction, where there is one */
} stress_point;

typedef enum stress_id {
    /* of a sample */
    STRESS_UNIT,
    STRESS_ABOVE,
    STRESS_FACING,
    STRESS_POSITIVE,
    STRESS_REPEATED,
    STRESS_INVERTED,
    /* of a direction */
    STRESS_AREA,
    STRESS_MIRRORED,
    STRESS_LAMBDA,
    STRESS_G1,
    STRESS_G2,
    /* of neighbouring directions */
    STRESS_MONOTONE,
    STRESS_COUNT
} stress_id;

typedef struct stress_property {
    const char *name, *meaning; /* a word; what the number is, and in which unit */
    double limit;
} stress_property;

const stress_property *stress_property_of(stress_id id);

typedef struct stress_finding {
    size_t checked, failed;
    double worst;    /* infinite for NaN */
    stress_point at; /* where the worst was; what does not matter is 0 */
} stress_finding;

typedef struct stress_result {
    size_t views, samples;
    size_t outside; /* roughnesses left out, since times the scale of the table they leave [1e-18, 1e18] */
    stress_finding found[STRESS_COUNT];
} stress_result;

/* Every `every`-th view of the product (1: all, some 23000 of 80 samples each; a number prime to 12 and 21 does
 * not favour any direction). The result is added to, so it begins as zeros. */
void stress_run(const vndf_distribution *distribution, size_t every, uint64_t seed, stress_result *result);

/* How many properties failed. */
size_t stress_failed(const stress_result *result);

/* ---- the parts, stress_measure.c ---- */

/* Notes a number for a property; returns whether it is within the limit. */
int stress_note(stress_result *result, stress_id id, double value, const stress_point *at);

/* What is noted of a sample: the length of a normal; how far it is turned away from wi, in 2^-24; whether the density
 * is none. */
double stress_length(vndf_vec3 w);
double stress_turned_away(vndf_vec3 wi, vndf_vec3 wm);
int stress_wrong_density(vndf_vec3 wi, float pdf);

/* The properties of a sample; those of the direction alone, with wo as the other one of G2; and those of two unit
 * directions of one azimuth, wo farther from z. */
void stress_measure_sample(const vndf_surface *surface, const vndf_view *view, const stress_point *at,
                           stress_result *result);
void stress_measure_direction(const vndf_surface *surface, const stress_point *at, stress_result *result);
void stress_measure_step(const vndf_surface *surface, const stress_point *at, stress_result *result);

#endif
