/* What a renderer sees of a sampler's map: the error of light that is reflected, estimated with few Owen-scrambled
 * Sobol points (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995; hashes after Burley, "Practical
 * Hash-based Owen Scrambling", JCGT 2020). A map that folds or jumps loses what the points have over random numbers. */
#pragma once

#include <stdint.h>

#include "vndf.h"

/* Lights: a sky that brightens upwards, and a disc that a glossy surface mirrors, with a soft edge. */
enum { STRATIFIED_BROAD, STRATIFIED_SMALL, STRATIFIED_LIGHTS };

/* The point `index` of a scrambled sequence, of 24 bits each. */
void stratified_point(uint32_t index, uint32_t scramble, float *u1, float *u2);

/* The root mean square error of each light over so many scrambled sequences of so many points, relative to the mean; 0
 * where next to nothing is reflected there. */
void stratified_errors(const vndf_surface *surface, vndf_vec3 wi, size_t points, size_t scrambles, uint64_t seed,
                       double error[STRATIFIED_LIGHTS]);

/* That error over that of GGX by caps, as rough in the median slope, for 64 points: the geometric mean over six
 * views and both lights. */
double stratified_beside_caps(const vndf_distribution *distribution, float alpha, size_t scrambles, uint64_t seed);
