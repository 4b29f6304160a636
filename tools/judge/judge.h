/* Is a sampler of visible normals right? What it answers at six directions, by its own density: samples
 * are unit and face wi, their density is the one that is asked for, its integral is 1, and they follow it over bins.
 *
 * The bins of a direction are intervals of theta, 0 to 90 degrees, times intervals of the azimuth from wi. Half of the
 * borders are even, so that a hole has bins of its own; half are quantiles of samples drawn before, so that half of the
 * bins lie where the samples do. The density is integrated over each in rounds (evidence/measure/quadrature.h). */
#ifndef TOOLS_JUDGE_JUDGE_H
#define TOOLS_JUDGE_JUDGE_H

#include <stdint.h>

#include "cli/progress.h"
#include "evidence/measure/statistics.h"
#include "vndf.h"

enum { JUDGE_VIEWS = 6, JUDGE_RINGS = 16, JUDGE_SECTORS = 32, JUDGE_BINS = JUDGE_RINGS * JUDGE_SECTORS };
enum { JUDGE_ASKED = 1000 };

/* A sampler is a command of the shell that reads queries from stdin, one a line, to its end, and answers each by a line
 * on stdout: "s wi.x wi.y wi.z u1 u2 u3" by "wm.x wm.y wm.z pdf", "p wi.x wi.y wi.z wm.x wm.y wm.z" by "pdf". */
typedef struct query {
    char kind;       /* 's' or 'p' */
    vndf_vec3 wi, x; /* x: u1 u2 u3, or wm */
} query;

typedef struct answer {
    double x, y, z, pdf; /* of 'p' the density alone; NaN and infinity are numbers */
} answer;

/* Runs the command once. The answers are to be freed. NULL after a complaint of `who`: the command does not run or ends
 * with a status other than 0, a line is no answer, there are too few lines or too many, or queries is NULL, for want of
 * memory. */
answer *process_ask(const char *who, const char *command, const query *queries, size_t count);

/* Numbers that are 0 at best. */
typedef enum judge_id {
    JUDGE_UNIT,   /* the most of | |wm| - 1 | */
    JUDGE_FACING, /* the most by which a sample is turned away from wi, or lies below the surface: a cosine */
    JUDGE_VALID,  /* densities that are not finite, are negative, or are 0 for a sample */
    JUDGE_AGREES, /* |density of a sample / density asked for - 1|, which 99% do not exceed */
    JUDGE_MASS,   /* |integral of the density - 1|, less what the quadrature may err */
    JUDGE_HOLES,  /* bins that expect 20 samples or more and have none */
    JUDGE_COVERS, /* the part of the true visible normals where the density is 0; 0 if none are meant */
    JUDGE_NUMBERS
} judge_id;

typedef struct judge_view {
    double theta, phi; /* of wi, degrees */
    vndf_vec3 wi;
    answer first[JUDGE_ASKED];                                 /* samples whose density is asked for as well */
    double turn;                                               /* the azimuth of wi, radians */
    double ring[JUDGE_RINGS + 1], sector[JUDGE_SECTORS + 1];   /* borders, radians; azimuths from wi */
    double expected[JUDGE_BINS + 1], observed[JUDGE_BINS + 1]; /* ring by ring; the last: samples in no bin */
    double stratified[JUDGE_BINS + 1];
    double found[JUDGE_NUMBERS], mass, mass_error;
    pearson bins, rings, sectors;
    double scatter;        /* squared, of 64 x 64 stratified samples over the bins, over that of random ones */
    double tv, efficiency; /* beside the true visible normals: total variation, 1/integral Dv^2/p */
} judge_view;

typedef struct judge_task {
    const char *who, *command; /* who complains; what process_ask runs */
    size_t samples;            /* of each direction */
    uint64_t seed;
    vndf_surface surface; /* whose visible normals are meant; without a distribution none are */
} judge_task;

/* Returns 1, or 0 after a complaint. */
int judge_views(const judge_task *task, progress *bar, judge_view views[JUDGE_VIEWS]);

int judge_is_hole(const judge_view *view, size_t bin);

/* The least p of the bins of each direction, and of the rings and the sectors of all together: JUDGE_VIEWS + 2. */
double judge_least_p(const judge_view *views);

#endif
