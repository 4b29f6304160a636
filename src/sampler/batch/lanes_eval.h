/* Batches of D, densities of given normals, areas, Lambda and G1, in lanes of doubles. One source, lanes_eval.c, is
 * compiled for each instruction set. Densities of a table that are not trusted (density.h) are left to the scalar
 * call. */
#ifndef VNDF_SAMPLER_BATCH_LANES_EVAL_H
#define VNDF_SAMPLER_BATCH_LANES_EVAL_H

#include <stdint.h>

#include "vndf.h"

enum { VNDF_EVAL_BLOCK = 256 };

typedef enum vndf_question {
    VNDF_ASK_PDF,
    VNDF_ASK_VISIBLE,
    VNDF_ASK_NDF,
    VNDF_ASK_AREA,
    VNDF_ASK_LAMBDA,
    VNDF_ASK_G1
} vndf_question;

/* Whether the answer needs no normal. */
static inline int vndf_question_is_of_direction(vndf_question question)
{
    return question == VNDF_ASK_AREA || question == VNDF_ASK_LAMBDA || question == VNDF_ASK_G1;
}

/* The inputs of a block: the members of vndf_query, in their order. */
enum {
    VNDF_EVAL_ALPHA_X,
    VNDF_EVAL_ALPHA_Y,
    VNDF_EVAL_WI_X,
    VNDF_EVAL_WI_Y,
    VNDF_EVAL_WI_Z,
    VNDF_EVAL_X,
    VNDF_EVAL_Y,
    VNDF_EVAL_Z,
    VNDF_EVAL_INPUTS
};

/* The arrays that the question needs; lanes may read each to the end of the last group. Where there are normals in
 * double, of any length, those of `of` are not read, and `facing` holds wi.wm. */
typedef struct vndf_eval_inputs {
    const float *of[VNDF_EVAL_INPUTS];
    const double *normal[3], *facing; /* or NULL */
} vndf_eval_inputs;

typedef struct vndf_eval_block {
    vndf_eval_inputs in;
    uint32_t count, left_count;
    uint32_t left[VNDF_EVAL_BLOCK]; /* indices without an answer */
    float value[VNDF_EVAL_BLOCK];   /* the answers, */
    double *exact;                  /* and the same not rounded, of questions for a normal; or NULL */
} vndf_eval_block;

#if VNDF_HAS_LANES
void vndf_eval_block_avx2(const vndf_distribution *d, vndf_question question, vndf_eval_block *block);
void vndf_eval_block_avx512(const vndf_distribution *d, vndf_question question, vndf_eval_block *block);
#endif

#endif
