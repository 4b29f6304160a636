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

/* What a surface, or a lobe of mixtures, reads. */
typedef struct vndf_lobe_call {
    const vndf_distribution *distribution;
    unsigned shared;               /* bit i: read[i] points to one number for all */
    const float *read[VNDF_READS]; /* NULL for zeros */
} vndf_lobe_call;

typedef struct vndf_call {
    vndf_task task;
    const float *given[3];     /* numbers, or a normal: what each lobe reads from VNDF_READ_A on */
    float *write[VNDF_WRITES]; /* NULL for what is not asked for */
    const int *asked;          /* the lobes of an inverse of mixtures; NULL for -1 */
    int *drawn;                /* the lobes that mixtures drew from, or NULL */
    size_t count;
    int diagonal; /* roughness: xx and yy have to be above 0 */
    int mixed;    /* mixtures of `lobes` lobes, 1 to VNDF_MIXTURE_LOBES; else the surface is the one lobe */
    int lobes;
    const vndf_lobe_call *lobe;
} vndf_call;

/* Element i of what it writes equals, to the bit, the call for one element. No distribution is NULL. */
typedef void vndf_lanes(const vndf_call *call);

#if defined(__GNUC__)
vndf_lanes vndf_lanes_4;
#endif
#if VNDF_HAS_WIDE_LANES /* the build compiles them */
vndf_lanes vndf_lanes_8, vndf_lanes_16;
#endif

/* The same by the calls for one (elements.c): distributions may be NULL, and the number of lobes any. */
vndf_lanes vndf_one_by_one;

#endif
