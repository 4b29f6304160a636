/* A call for many elements, as the dispatcher (batch.c) hands it to the lanes (lanes_block.c). Batches of mixtures
 * (mixtures.c) are made of such calls for their lobes. */
#ifndef VNDF_SAMPLER_BATCH_CALL_H
#define VNDF_SAMPLER_BATCH_CALL_H

#include "vndf.h"

typedef enum vndf_task {
    VNDF_TASK_SAMPLE,
    VNDF_TASK_PDF,
    VNDF_TASK_VISIBLE,
    VNDF_TASK_NDF,
    VNDF_TASK_AREA,
    VNDF_TASK_DRAWN_AREA, /* of lobes, for their shares */
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

typedef struct vndf_call {
    vndf_task task;
    const vndf_distribution *distribution;
    unsigned shared;               /* bit i: read[i] points to one number for all */
    const float *read[VNDF_READS]; /* NULL for zeros */
    float *write[VNDF_WRITES];     /* NULL for what is not asked for */
    size_t count;
    const int *at;   /* which elements of the arrays; NULL: the first */
    int is_diagonal; /* surfaces are matrices of xx and yy alone */
} vndf_call;

/* Element i of what it writes equals, to the bit, the call for one element. No distribution is NULL in lanes; those of
 * 8 and 16 are there where the build compiles them. */
typedef void vndf_lanes(const vndf_call *call);
vndf_lanes vndf_lanes_4, vndf_lanes_8, vndf_lanes_16;

/* The same by the calls for one: the distribution may be NULL. */
vndf_lanes vndf_one_by_one;

/* The best lanes up to `limit` for so many elements. */
vndf_lanes *vndf_lanes_for(size_t count, vndf_instructions limit);

/* These surfaces, and the directions of a batch. */
vndf_call vndf_call_of(const vndf_batch *batch, const vndf_surface_batch *surface);

/* What is read beside the surface, numbers u1 and u2 or a normal, and what is written. */
typedef struct vndf_arrays {
    const float *given[3];
    float *write[VNDF_WRITES];
} vndf_arrays;

/* A task on mixtures. */
void vndf_run_mixtures(const vndf_batch *batch, vndf_task task, vndf_arrays arrays);

/* Number `which` of element i, and its surface. */
static inline float vndf_call_number(const vndf_call *call, int which, size_t i)
{
    const float *array = call->read[which];
    return array ? array[call->shared >> which & 1 ? 0 : i] : 0.0f;
}

static inline vndf_surface vndf_call_surface(const vndf_call *call, size_t i)
{
    float of[VNDF_READ_WI_X];
    for (int r = 0; r < VNDF_READ_WI_X; r++)
        of[r] = vndf_call_number(call, r, i);
    return (vndf_surface){call->distribution, of[0], of[1], of[2], of[3], of[4], of[5]};
}

static inline vndf_vec3 vndf_call_vec3(const vndf_call *call, int first, size_t i)
{
    return (vndf_vec3){vndf_call_number(call, first, i), vndf_call_number(call, first + 1, i),
                       vndf_call_number(call, first + 2, i)};
}

#endif
