/* Hard cases of affine surfaces: random matrices of either sign with singular values from 1e-5 to 10 and a condition of
 * up to 1e4, mean slopes up to 2, incident directions of all kinds (also in the mean plane, on the horizon, straight up
 * and down), uniform numbers at their ends. The properties of a sample are those of stress.h. */
#ifndef TOOLS_MEASURE_STRESS_AFFINE_H
#define TOOLS_MEASURE_STRESS_AFFINE_H

#include "measure/stress.h"

typedef struct stress_affine_finding {
    size_t failed;
    double worst; /* infinite for NaN */
    vndf_affine surface;
    vndf_vec3 wi;
    float u1, u2;
} stress_affine_finding;

/* STRESS_UNIT to STRESS_REPEATED. */
enum { STRESS_AFFINE_COUNT = STRESS_REPEATED + 1 };

typedef struct stress_affine_result {
    size_t views, samples;
    stress_affine_finding found[STRESS_AFFINE_COUNT];
} stress_affine_result;

/* So many views of 16 samples; the result is added to, so it begins as zeros. */
void stress_affine_run(const vndf_distribution *distribution, size_t views, uint64_t seed,
                       stress_affine_result *result);

#endif
