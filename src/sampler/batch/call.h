/* A call for many elements, as the dispatcher (batch.c) hands it to the lanes (lanes_block.c). Batches of mixtures
 * (mixtures.c) are made of such calls for their lobes. */
#ifndef VNDF_SAMPLER_BATCH_CALL_H
#define VNDF_SAMPLER_BATCH_CALL_H

#include <stdint.h>
#include <string.h>

#include "vndf.h"

typedef enum vndf_task {
    VNDF_TASK_SAMPLE,
    VNDF_TASK_PDF,
    VNDF_TASK_VISIBLE,
    VNDF_TASK_NDF,
    VNDF_TASK_AREA,
    VNDF_TASK_DRAWN_AREA, /* of lobes, for their shares */
    VNDF_TASK_COSINE,     /* of lobes, of the direction to the mean plane: for masking */
    VNDF_TASK_LAMBDA,
    VNDF_TASK_G1,
    VNDF_TASK_INVERT /* one by one */
} vndf_task;

/* Arrays that are read: matrix, mean slope, direction, and the two numbers of a sample or the given normal. */
enum { VNDF_READ_XX, VNDF_READ_XY, VNDF_READ_YX, VNDF_READ_YY, VNDF_READ_MEAN_X, VNDF_READ_MEAN_Y };
enum { VNDF_READ_WI_X = VNDF_READ_MEAN_Y + 1, VNDF_READ_WI_Y, VNDF_READ_WI_Z };
enum { VNDF_READ_A = VNDF_READ_WI_Z + 1, VNDF_READ_B, VNDF_READ_C, VNDF_READS };

/* Arrays that are written: normal, density and weight of a sample; an area and 1 if the surface is valid, else 0; two
 * numbers of an inverse; else one. */
enum { VNDF_WRITES = 5 };

enum { VNDF_BLOCK = 64 }; /* elements go in blocks */

typedef struct vndf_call {
    vndf_task task;
    const vndf_distribution *distribution;
    unsigned shared;               /* bit i: read[i] points to one number for all */
    const float *read[VNDF_READS]; /* NULL for zeros */
    float *write[VNDF_WRITES];     /* NULL for what is not asked for */
    size_t count;
    uint64_t which;  /* of the elements of each block, bit by bit */
    int is_diagonal; /* surfaces are matrices of xx and yy alone */
} vndf_call;

/* What is read beside the surface, numbers u1 and u2 or a normal, and what is written. */
typedef struct vndf_arrays {
    const float *given[3];
    float *write[VNDF_WRITES];
} vndf_arrays;

/* The name of what is compiled for each number of lanes. */
#define VNDF_OF_LANES(name) VNDF_JOINED(name, VNDF_LANES)
#define VNDF_JOINED(name, lanes) VNDF_PASTED(name, lanes)
#define VNDF_PASTED(name, lanes) name##lanes

/* Element i of what they write equals, to the bit, the call for one element. No distribution is NULL, and no task an
 * inverse; those of 8 and 16 are there where the build compiles them. */
void vndf_lanes_4(const vndf_call *call), vndf_lanes_8(const vndf_call *call),
    vndf_lanes_16(const vndf_call *call);
void vndf_mixtures_4(const vndf_batch *batch, vndf_task task, const vndf_arrays *arrays);
void vndf_mixtures_8(const vndf_batch *batch, vndf_task task, const vndf_arrays *arrays);
void vndf_mixtures_16(const vndf_batch *batch, vndf_task task, const vndf_arrays *arrays);

/* A task on these surfaces, and the directions of a batch. */
static inline vndf_call vndf_call_of(const vndf_batch *b, const vndf_surface_batch *s, vndf_task task,
                                     const vndf_arrays *a)
{
    const unsigned surface = (1u << VNDF_READ_WI_X) - 1, direction = (1u << VNDF_READ_A) - 1 - surface;
    vndf_call call = {.task = task,
                      .distribution = s->distribution,
                      .count = b->count,
                      .which = ~(uint64_t)0,
                      .shared = (b->shared & VNDF_SHARED_SURFACE ? surface : 0) |
                                (b->shared & VNDF_SHARED_WI ? direction : 0),
                      .read = {s->xx, s->xy, s->yx, s->yy, s->mean_x, s->mean_y, b->wi_x, b->wi_y, b->wi_z},
                      .is_diagonal = !s->xy && !s->yx && !s->mean_x && !s->mean_y};
    memcpy(call.read + VNDF_READ_A, a->given, sizeof a->given);
    memcpy(call.write, a->write, sizeof a->write);
    return call;
}

#endif
