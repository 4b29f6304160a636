/* Is a sampler of visible normals right? What it answers at fourteen directions, by its own density: samples are unit
 * and face wi, their density is the one that is asked for, its integral is 1, and they follow it over bins.
 *
 * Of the directions three are exactly from above, one is close to that, one at 89.99 degrees and one just before; eight
 * are drawn from strata of the angle, each in another octant of the azimuth, so that no seed leaves an octant out. The
 * bins of a direction are intervals of theta, 0 to 90 degrees, times intervals of the azimuth from wi: 64 x 64, and
 * from above 1024 x 4 and 4 x 1024 as well, which see thin rings and wedges. Their borders are quantiles of samples
 * drawn before, of which a fifth is even, so that a region without samples has bins too. */
#pragma once

#include <stdint.h>

#include "cli/progress.h"
#include "evidence/measure/measure.h"
#include "vndf.h"

/* Behind the bins of a direction comes one for samples that are in none. */
enum { JUDGE_VIEWS = 14, JUDGE_BINS = 4096, JUDGE_SIDE = 1024, JUDGE_EACH = JUDGE_BINS + 1 };
enum { JUDGE_STRATA = 64, JUDGE_ASKED = 1000, JUDGE_TESTS = JUDGE_VIEWS + 4 };

/* ---- questions ----------------------------------------------------------------------------------- */

typedef struct judge_task {
    const char *who, *command; /* who complains; what process_ask runs */
    double timeout;            /* seconds in which it has to write something */
    size_t samples;            /* of each direction */
    uint64_t seed;
    vndf_surface surface; /* whose visible normals are meant; without a distribution none are */
} judge_task;

/* A sampler is a command of the shell that reads queries from stdin, one a line, to its end, and answers each by a line
 * on stdout: "s wi.x wi.y wi.z u1 u2 u3" by "wm.x wm.y wm.z pdf", "p wi.x wi.y wi.z wm.x wm.y wm.z" by "pdf". */
typedef struct query {
    char kind;       /* 's' or 'p' */
    vndf_vec3 wi, x; /* x: u1 u2 u3, or wm */
} query;

typedef struct answer {
    double x, y, z, pdf; /* of 'p' the density alone; NaN and infinity are numbers */
} answer;

typedef struct exchange {
    query asked;
    answer got;
} exchange;

/* Runs the command once. The answers are to be freed. NULL after a complaint: the command does not run, ends with a
 * status other than 0, or writes nothing for too long, whereupon it is ended with its children; a line is no answer,
 * there are too few lines or too many, or queries is NULL, for want of memory. */
answer *process_ask(const judge_task *task, const query *queries, size_t count);

/* The line that asks, without its end. `text` may hold the line `before`, whose wi is not printed again: printing
 * numbers is what takes time. */
enum { JUDGE_LINE = 512 };
void process_line(char text[JUDGE_LINE], const query *q, const query *before);

/* ---- answers ------------------------------------------------------------------------------------- */

/* Numbers that are 0 at best, but for the last. */
typedef enum judge_id {
    JUDGE_UNIT,   /* the most of | |wm| - 1 | */
    JUDGE_FACING, /* the most by which a sample is turned away from wi, or lies below the surface: a cosine */
    JUDGE_VALID,  /* densities that are not finite, are negative, or are 0 for a sample */
    JUDGE_MOVES, /* the part of the pairs of samples that are one, though u1 or u2 differs by some 1e-3 at an end */
    JUDGE_AGREES,     /* |density of a sample / density asked for - 1|, which 99% do not exceed */
    JUDGE_MASS,       /* |integral of the density - 1|, less what the quadrature may err */
    JUDGE_COVERS,     /* the part of the true visible normals where the density is 0; 0 if none are meant */
    JUDGE_NORMALS,    /* the total variation to the true visible normals; 0 if none are meant */
    JUDGE_CHI_SQUARE, /* the least p of the counts, which is 1 at best */
    JUDGE_NUMBERS
} judge_id;

/* The worst of a number over all directions, and who shows it; beside: what the density should have been, or NaN. */
typedef struct judge_fault {
    double worst, beside;
    exchange shown;
} judge_fault;

/* The neighbouring bins whose count is the least likely, and a bound of its p among all blocks of all directions. */
typedef struct judge_block {
    size_t ring[2], sector[2]; /* from, to */
    double expected, observed, p;
} judge_block;

typedef struct judge_view {
    double theta, phi; /* of wi, degrees */
    int is_first;      /* wi is not that of the direction before, which has told the mass */
    vndf_vec3 wi;
    double turn;                                         /* the azimuth of wi, radians */
    size_t rings, sectors;                               /* at most JUDGE_BINS together, and JUDGE_SIDE each */
    double ring[JUDGE_SIDE + 1], sector[JUDGE_SIDE + 1]; /* borders, radians; azimuths from wi */
    double *observed, stratified[JUDGE_EACH];            /* ring by ring */
    quadrature_sum *sum;                                 /* of the density, beside the true visible normals */
    double total, error;                                 /* of all bins; four standard deviations of it */
    exchange sample[JUDGE_EACH], density[JUDGE_BINS];    /* one of a bin, and the greatest */
    exchange first[JUDGE_ASKED];                         /* samples whose density is asked for as well */
    pearson bins;
    judge_block block;
    double left_out;       /* the part of the mass in bins whose integral errs more than counts do */
    double scatter;        /* squared, of 64 x 64 stratified samples over the bins, over that of random ones */
    double tv, efficiency; /* beside the true visible normals: total variation, 1/integral Dv^2/p */
    double uncovered;      /* the part of them where the density is 0 */
} judge_view;

typedef struct judgement {
    judge_view view[JUDGE_VIEWS];
    double observed[JUDGE_VIEWS * JUDGE_EACH]; /* of all directions */
    quadrature_sum sum[JUDGE_VIEWS * JUDGE_EACH];
    judge_fault fault[JUDGE_NUMBERS];
    double fits[2]; /* the roughness whose normals are nearest, and the total variation to them */
    double fits_tv;
} judgement;

int judge_sampler(const judge_task *task, progress *bar, judgement *j);

/* What the counts say of the integrals over bins, by JUDGE_TESTS tests. */
void judge_counts(judgement *j, size_t samples);
