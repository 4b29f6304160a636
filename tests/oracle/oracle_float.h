/* The run time, in float, held against oracle_table.h, in double: which quantities, at which point, how far
 * apart; points that are hard; and a search for the hardest near a given one. */
#ifndef TESTS_ORACLE_ORACLE_FLOAT_H
#define TESTS_ORACLE_ORACLE_FLOAT_H

#include <stddef.h>

#include "oracle/oracle_table.h"
#include "vndf.h"

/* DRAWN is the density that vndf_sample returns against the oracle's at the normal that it returns; WEIGHT is what
 * vndf_sample_weight returns, times the area, against D (wi.wm) over the density there. */
typedef enum float_quantity {
    FLOAT_DENSITY,
    FLOAT_DRAWN,
    FLOAT_WEIGHT,
    FLOAT_AREA,
    FLOAT_LAMBDA,
    FLOAT_G1,
    FLOAT_NDF,
    FLOAT_COUNT
} float_quantity;

const char *float_quantity_name(float_quantity quantity);

/* One table, both ways. */
typedef struct float_subject {
    char name[64];
    vndf_distribution *table;
    oracle_table reference;
} float_subject;

/* `name` is a file of tables/ or tests/corpus/table/, or "BYTES SLOPE" or "BYTES family NAME": the table of P22 =
 * SLOPE, or of a family, of at most so many bytes, written to `scratch` and read again. 0 after a message if
 * there is none. */
int float_subject_open(float_subject *subject, const char *name, const char *scratch);
void float_subject_close(float_subject *subject);

/* One input of any quantity; of DRAWN and WEIGHT, wm holds u1 and u2. */
typedef struct float_point {
    vndf_vec3 wi;
    float alpha_x, alpha_y;
    vndf_vec3 wm;
} float_point;

/* |got/true - 1|, infinite for NaN. Negative where nothing is promised: the true value is 1e-30 or less, the view
 * is not valid. *aside tells whether the value of the other side of a jump had to be taken. */
double float_error(const float_subject *subject, float_quantity quantity, const float_point *at, int *aside);

/* A point from the whole domain: wi over the sphere, the horizon and the depths below it, roughness 1e-6 to 1e4,
 * normals from samples and of any slope. */
float_point float_point_random(const float_subject *subject, unsigned long long *state);

/* A point beside a border: of the unit square, the horizon of wi, the pole, z = 0, a knot, the cut at a knot, the
 * seam, rows and area knots, denormal cosines. */
float_point float_point_hard(const float_subject *subject, unsigned long long *state);

/* Uniform numbers instead of the normal, at and beside the corners in one of two. */
float_point float_point_drawn(float_point at, unsigned long long *state);

/* What was found of one quantity. */
typedef struct float_worst {
    size_t checked, aside, missed; /* missed: more than FLOAT_LIMIT */
    double error;
    float_point at;
} float_worst;

/* What the issue asks for, and what this library promises. */
#define FLOAT_LIMIT 1e-5

void float_note(float_worst worst[FLOAT_COUNT], const float_subject *subject, float_quantity quantity,
                const float_point *at);

/* Random local search for a larger error: `steps` steps of the point found worst. */
void float_climb(float_worst *worst, const float_subject *subject, float_quantity quantity, size_t steps,
                 unsigned long long *state);

/* So many points of either kind, each for all quantities, then a climb from the worst of each. */
void float_run(float_worst worst[FLOAT_COUNT], const float_subject *subject, size_t random, size_t hard,
               size_t climb, unsigned long long seed);

/* One line of tests/corpus/float/worst.csv, and back: name, quantity, wi, roughness, wm (or u1, u2 and 0), error.
 * float_scan returns 0 if it is none. */
void float_print(const float_subject *subject, float_quantity quantity, const float_worst *worst);
int float_scan(const char *line, char name[64], float_quantity *quantity, float_point *at);

#endif
