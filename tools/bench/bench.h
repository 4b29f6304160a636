/* The cost of a visible normal, method by method: rows that `vndf bench` prints and `vndf report` draws.
 *
 * Three distributions are sampled: GGX and Beckmann by their closed forms, and one that the caller brings by
 * tables and by the other published ways for any D. All methods run in one process and take turns; each is
 * verified before its time counts. bench_row says what is measured, and how. */
#ifndef TOOLS_BENCH_BENCH_H
#define TOOLS_BENCH_BENCH_H

#include <stddef.h>

#include "cli/figures.h"
#include "vndf_build.h"

typedef enum bench_kind {
    BENCH_PUBLISHED, /* others' methods, written from the publications */
    BENCH_CLOSED,    /* our closed forms */
    BENCH_TABLE,     /* our tables */
    BENCH_EXPORTED,  /* the exported kernel in C */
    BENCH_CALL,      /* other calls of a table of ours (pdf, invert, ndf, lambda): times alone, the rest is NaN */
    BENCH_MOVE       /* moving the bytes of a batch: times alone */
} bench_kind;

/* NaN: does not apply, or was not measured. */
typedef struct bench_row {
    char method[64];       /* "spherical caps (2023)", "table 8 KiB, 4 moments" ... */
    char distribution[64]; /* what it samples: "ggx", "beckmann", the caller's name for the source */
    char instructions[16]; /* "scalar", "portable", "avx2", "avx512" */
    bench_kind kind;
    size_t memory;              /* bytes that its tables take when loaded; 0 for closed forms */
    size_t file_bytes;          /* of a table of ours; 0 for all others */
    int moments;                /* the same */
    int wrong;                  /* 1: its results failed verification, so nothing was timed */
    double ns, ns_low, ns_high; /* per sample, a direction each (view, sample, density): median and quartiles */
    double shared_ns;           /* many samples for one direction; NaN if the method has no such use */
    double latency_ns;          /* each sample's input depends on the last one's output; NaN for batches */
    double ratio;               /* ns over that of scalar spherical caps of the same run */
    double tv, tv_theta;        /* largest total variation to the true visible normals from above the horizon, and
                                   the angle, degrees */
    double tv_below;            /* of tables of ours: the same from all directions */
    double max_weight;          /* largest true/drawn density that was met; infinity where there are holes */
    double efficiency[2];       /* 1/(variance time) over that of all normals of the same distribution: albedo of
                                   a conductor at 60 and 85 degrees */
    double efficiency_light;    /* the same of the radiance reflected from a small light */
    double bias[2];             /* relative error of the albedo at 60 and 85 degrees; 0 if within its noise */
    double stratified;          /* of ours: RMSE under 64 Owen-scrambled Sobol' points over that of spherical caps
                                   (tools/measure/stratified.h) */
} bench_row;

typedef struct bench_rows {
    bench_row *row;
    size_t count;
} bench_rows;

typedef struct bench_plan {
    const vndf_source *source; /* of the tables */
    const char *name;          /* what to call it */
    double seconds;            /* to spend in all, roughly; building the tables may take longer */
    const char *only;          /* NULL, or a part of the method, distribution or instructions of the rows wanted */
    vndf_progress *progress;   /* may be NULL; asked every few milliseconds */
    void *progress_user;
} bench_plan;

/* Runs the plan. VNDF_OK and rows that the caller frees, or the status and error that stopped it
 * (VNDF_ERROR_ARGUMENT "interrupted" where the progress said so; *rows is empty then). */
vndf_status bench_run(const bench_plan *plan, bench_rows *rows, vndf_error *error);
void bench_rows_free(bench_rows *rows);

/* Of bench_rows. */
int bench_print(FILE *file, const void *rows, figures_form form);

#endif
