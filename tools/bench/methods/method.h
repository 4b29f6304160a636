/* A method to draw normals, as `vndf bench` measures it: direction and roughness in, a normal and its density out. The
 * method prepares everything that depends on the distribution alone; work that depends on the direction is part of each
 * draw, or of the head of `shared`.
 *
 * Scalar methods have `one`, for latency, and `each`, a loop of their own so that the compiler may inline the body;
 * method_*.c are compiled without vector loops. Batches only have `each`. */
#ifndef TOOLS_BENCH_METHODS_METHOD_H
#define TOOLS_BENCH_METHODS_METHOD_H

#include <stddef.h>

#include "bench/bench.h"
#include "vndf.h"

typedef struct method_input {
    vndf_vec3 wi;
    float alpha, u1, u2;
} method_input;

/* The same inputs twice: batches read a structure of arrays, scalar calls whole inputs, as renderers have them. (To
 * make a vndf_vec3 from three arrays and pass it on costs some 40 ns with gcc 12, which stores four bytes at a time and
 * loads eight.) Both axes have the same alpha. A `shared` call reads the first alpha and the first wi. */
typedef struct method_inputs {
    size_t count;
    const float *alpha, *wi_x, *wi_y, *wi_z, *u1, *u2;
    const float *wm_x, *wm_y, *wm_z; /* for calls that are given a normal */
    const method_input *at;
    const vndf_vec3 *wm;
} method_inputs;

typedef struct method_outputs {
    float *x, *y, *z, *pdf;
} method_outputs;

typedef struct method method;
typedef vndf_vec3 method_one(const method *m, const method_input *in, float *pdf);
typedef void method_run(const method *m, const method_inputs *in, const method_outputs *out);

struct method {
    char name[64];
    const char *instructions;
    bench_kind kind;
    size_t memory, file_bytes;          /* as in bench_row */
    int moments;                        /* the same */
    const void *state;                  /* what was prepared */
    const vndf_distribution *certified; /* whose certificate says how far it is from the truth, or NULL */
    void (*release)(void *state);       /* NULL: the state has another owner */
    vndf_instructions limit;            /* for batches of ours */
    method_one *one;                    /* NULL: a batch */
    method_run *each, *shared;          /* shared may be NULL */
    method_run *same_bits;              /* what `each` must equal to the bit, or NULL */
    int biased;                         /* it draws with another density than it tells */
    int turned;                         /* some normals face away from wi */
};

/* The input of methods for any D: a table so fine that it stands for the reference, and the scale that brings its
 * median slope to 1. */
typedef struct method_reference {
    vndf_surface canonical; /* its roughness is 1/scale */
    float scale;
} method_reference;

/* Each makes a method; its `each` is NULL if this machine cannot run it or memory is short. */

/* GGX and Beckmann, from the publications. */
method method_ggx_caps(void);
method method_ggx_2018(void);
method method_ggx_all_normals(void);
method method_beckmann_newton(void);
method method_beckmann_all_normals(void);

/* GGX by caps on vectors, and a method that only moves the bytes; for one of the three instruction sets of vndf.h. */
method method_ggx_caps_batch(vndf_instructions set);
method method_move(vndf_instructions set);

/* Any D, from the publications. Without a reference the method has only a name. */
method method_any_all_normals(const method_reference *reference);
method method_inverse_tables(const method_reference *reference, size_t side);
method method_warp(const method_reference *reference, size_t side);

/* Ours: `limit` 0 stands for the scalar calls. */
method method_ours(const vndf_distribution *distribution, const char *name, vndf_instructions limit);

/* The exported kernel in C, with the numbers of a table, or its GGX. */
method method_exported(const vndf_distribution *distribution, const char *name);

/* Other calls of a table. */
typedef enum method_call {
    METHOD_WEIGHT,
    METHOD_PDF,
    METHOD_INVERT,
    METHOD_NDF,
    METHOD_LAMBDA,
    METHOD_CALLS
} method_call;
method method_ours_call(const vndf_distribution *distribution, const char *name, method_call call,
                        vndf_instructions limit);

/* Samples of a surface with a diagonal matrix, with any matrix and a mean slope, and with two lobes. A diagonal one has
 * no batch of its own. */
typedef enum method_surface { METHOD_DIAGONAL, METHOD_AFFINE, METHOD_TWO_LOBES, METHOD_SURFACES } method_surface;
method method_ours_surface(const vndf_distribution *distribution, const char *name, method_surface surface,
                           vndf_instructions limit);

const char *method_instructions_name(vndf_instructions set);

#endif
