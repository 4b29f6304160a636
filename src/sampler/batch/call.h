/* A call for many elements, as the dispatcher (batch.c) hands it to the lanes (lanes_block.c). */
#ifndef VNDF_SAMPLER_BATCH_CALL_H
#define VNDF_SAMPLER_BATCH_CALL_H

#include "vndf.h"

typedef enum vndf_task {
    VNDF_TASK_SAMPLE,
    VNDF_TASK_PDF,
    VNDF_TASK_VISIBLE,
    VNDF_TASK_INVERT,
    VNDF_TASK_NDF,
    VNDF_TASK_AREA,
    VNDF_TASK_DRAWN_AREA, /* of lobes, for their shares */
    VNDF_TASK_LAMBDA,
    VNDF_TASK_G1
} vndf_task;

/* Arrays that are read: matrix, mean slope, direction, the two numbers of a sample or the given normal, and the weight
 * of a lobe. */
enum {
    VNDF_READ_XX,
    VNDF_READ_XY,
    VNDF_READ_YX,
    VNDF_READ_YY,
    VNDF_READ_MEAN_X,
    VNDF_READ_MEAN_Y,
    VNDF_READ_WI_X,
    VNDF_READ_WI_Y,
    VNDF_READ_WI_Z,
    VNDF_READ_A,
    VNDF_READ_B,
    VNDF_READ_C,
    VNDF_READ_WEIGHT,
    VNDF_READS
};

/* Arrays that are written: normal, density and weight of a sample; two numbers of an inverse; else one. */
enum { VNDF_WRITES = 5 };

typedef struct vndf_call {
    vndf_task task;
    const vndf_distribution *distribution;
    size_t count;
    int diagonal;                  /* roughness: xx and yy have to be above 0 */
    unsigned shared;               /* bit i: read[i] points to one number for all */
    const float *read[VNDF_READS]; /* NULL for zeros */
    float *write[VNDF_WRITES];     /* NULL for what is not asked for */
} vndf_call;

/* Mixtures: what each lobe reads, a distribution among it, and what is written: two numbers of an inverse, or a normal
 * and its density, or else one. */
typedef struct vndf_mixture_call {
    vndf_task task;
    size_t count;
    int lobes; /* 1 to VNDF_MIXTURE_LOBES */
    vndf_call lobe[VNDF_MIXTURE_LOBES];
    const int *asked; /* of an inverse; NULL for -1 */
    float *write[VNDF_WRITES];
    int *drawn; /* the lobe; or NULL */
} vndf_mixture_call;

/* Element i of what it writes equals, to the bit, the call for one element. The distribution is not NULL. */
typedef void vndf_lanes(const vndf_call *call);
typedef void vndf_mixture_lanes(const vndf_mixture_call *call);

#if defined(__GNUC__)
vndf_lanes vndf_lanes_4;
vndf_mixture_lanes vndf_mixture_lanes_4;
#endif
#if VNDF_HAS_WIDE_LANES /* the build compiles them */
vndf_lanes vndf_lanes_8, vndf_lanes_16;
vndf_mixture_lanes vndf_mixture_lanes_8, vndf_mixture_lanes_16;
#endif

#endif
