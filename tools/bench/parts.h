/* The parts of the benchmark, for its own files and its tests:
 *
 *     list.c       which methods, made ready; the tables are built here
 *     block.c      inputs and outputs of BENCH_BLOCK samples
 *     verify.c     whether the results of a method are right, before it is timed
 *     time.c       time, in turns
 *     integrals.c  error, variance and bias of one method for one direction
 *     run.c        all of these in order, into rows */
#ifndef TOOLS_BENCH_PARTS_H
#define TOOLS_BENCH_PARTS_H

#include <stdint.h>
#include <stdio.h>

#include "bench/bench.h"
#include "bench/methods/method.h"

/* ---- when to stop ------------------------------------------------------------------------------ */

typedef struct bench_clock {
    const bench_plan *plan;
    double start; /* seconds */
} bench_clock;

/* Reports progress; 0 if the caller wants to stop. */
int bench_go_on(const bench_clock *at, const char *what);

/* ---- methods ----------------------------------------------------------------------------------- */

enum { BENCH_ENTRIES_MAX = 160, BENCH_TABLES = 10 };

typedef enum bench_subject { BENCH_GGX, BENCH_BECKMANN, BENCH_USER, BENCH_SUBJECTS } bench_subject;

typedef struct bench_entry {
    method m;
    bench_subject subject;
    int shown; /* 0: needed as a yardstick alone */
    bench_row row;
} bench_entry;

typedef struct bench_list {
    size_t count, table_count;
    vndf_distribution *table[BENCH_TABLES];
    const char *name[BENCH_SUBJECTS];
    method_reference reference[BENCH_SUBJECTS]; /* distribution NULL where nothing of it is wanted */
    bench_entry entry[BENCH_ENTRIES_MAX];
} bench_list;

/* Everything the plan asks for. An empty list and an error if a table cannot be built or `only` fits nothing. */
vndf_status bench_list_make(bench_list *list, const bench_clock *at, vndf_error *error);
void bench_list_free(bench_list *list);

/* The first entry of that subject and method; NULL if there is none. */
const bench_entry *bench_list_find(const bench_list *list, bench_subject subject, const char *name,
                                   const char *instructions);

/* ---- inputs and outputs ------------------------------------------------------------------------ */

enum { BENCH_BLOCK = 1024 };

typedef struct bench_block {
    float alpha[BENCH_BLOCK], wi_x[BENCH_BLOCK], wi_y[BENCH_BLOCK], wi_z[BENCH_BLOCK];
    float u1[BENCH_BLOCK], u2[BENCH_BLOCK], wm_x[BENCH_BLOCK], wm_y[BENCH_BLOCK], wm_z[BENCH_BLOCK];
    float x[BENCH_BLOCK], y[BENCH_BLOCK], z[BENCH_BLOCK], pdf[BENCH_BLOCK];
    method_input at[BENCH_BLOCK]; /* the inputs once more: bench_block_inputs */
    vndf_vec3 wm[BENCH_BLOCK];
} bench_block;

/* Copies the arrays into at[] and wm[]. */
method_inputs bench_block_inputs(bench_block *block);
method_outputs bench_block_outputs(bench_block *block);

/* Directions uniform over the hemisphere, roughness uniform in [0.05, 0.95] of slopes at the scale of the reference,
 * uniform numbers, and normals drawn for them from the reference. */
void bench_block_fill(bench_block *block, const method_reference *reference, uint64_t seed);

/* One direction and roughness for all. */
void bench_block_aim(bench_block *block, vndf_vec3 wi, float alpha);

/* Hammersley's points, shifted by two random numbers of the stream, instead of independent uniform numbers. */
void bench_block_spread(bench_block *block, uint64_t seed);

/* ---- measuring --------------------------------------------------------------------------------- */

/* Whether the method's results are right: unit normals above the surface that face wi (where the method says so),
 * densities positive and finite, the same bits as the scalar call where that is promised. */
int bench_verify(const method *m, const method_reference *reference, bench_block *block, uint64_t seed);

/* Fills the times of all entries that are not wrong: turns until the plan's seconds are spent, some at least.
 * VNDF_ERROR_ARGUMENT: stopped by the progress. */
vndf_status bench_time(bench_list *list, const bench_clock *at);

/* One method, one direction, roughness 1/2 at the scale of the reference. */
typedef struct bench_findings {
    double albedo, albedo_noise; /* mean, and its standard error */
    double variance;             /* of one sample */
    double light_variance;
    double tv, max_weight;
} bench_findings;

/* `replicates` blocks of BENCH_BLOCK samples. 0: no memory. */
int bench_integrate(const method *m, const method_reference *reference, double theta, size_t replicates,
                    bench_findings *findings);

/* Index of refraction n + ik, cosine of the angle to the microfacet: reflectance of unpolarised light. */
double bench_fresnel(double cosine, double n, double k);

#endif
