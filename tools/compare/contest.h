/* One scene rendered in several ways, side by side: with equal samples, and in equal time.
 *
 *   contest.c       renders the ways in turns, so that a busy machine slows all of them alike
 *   error.c         how far a film is from another one
 *   pictures.c      films, error maps and crops as PNG
 *   comparison.c    tables and page; comparison_page.c, comparison_pictures.c
 *   ways.c          the ways, from a scene file
 *   run.c           all of it in order
 *   ../commands/compare.c  the words of the command
 *
 * The first way is the measure: all others are rendered as long as it takes (equal time), and with as many samples
 * (equal samples). Time is processor time, which a shared machine disturbs least. */
#ifndef COMPARE_CONTEST_H
#define COMPARE_CONTEST_H

#include "render/film.h"

enum { WAYS_MAX = 8, POINTS_MAX = 40, WAY_NAME_MAX = 32 };

/* Of an image against the reference. Relative: an error of a pixel over the light of the reference there. */
typedef struct film_error {
    double relative;  /* root of the mean of (I - R)^2 / (R^2 + floor^2), of luminance, less the noise of R */
    double trimmed;   /* the same without the thousandth part of the pixels that are worst: fireflies */
    double spread[2]; /* standard deviations of the squares of the two, as parts of them; rather too large, as
                       * pixels differ in how noisy they are, too */
} film_error;

typedef struct contest_point {
    uint64_t samples;
    double seconds;
    film_error error;
} contest_point;

typedef struct way {
    char name[WAY_NAME_MAX];
    const scene *scene;
    path_plan *plan;                 /* not owned */
    film film;                       /* as it grows */
    film at_samples, at_time;        /* as it was with `samples` samples, and after the time of the first way */
    contest_point point[POINTS_MAX]; /* at powers of two of samples, and with `samples` of them */
    size_t points;
    contest_point by_samples, by_time;
    uint64_t next; /* samples at the next point */
} way;

typedef struct contest {
    way way[WAYS_MAX];
    size_t count;
    const film *reference;
    uint64_t samples, seed;
    unsigned threads;
    int (*progress)(double done, void *user); /* other than 0 stops */
    void *user;
} contest;

/* Names, scenes, plans, reference, samples, seed and threads are set; makes the films. 0 if it was stopped or
 * there is no memory; contest_free is due in any case. */
int contest_run(contest *c);
void contest_free(contest *c);

/* As many samples more, one way after the other, into films of the same size; for a second opinion with other
 * numbers. */
int contest_repeat(const contest *c, uint64_t seed, film more[WAYS_MAX]);

/* ---- errors ---- */

/* Where the reference is dark a pixel's error is divided by this part of the mean instead. */
#define ERROR_FLOOR 0.05

film_error error_between(const film *of, const film *reference);

/* Whether two films, independent of each other, show the same: squares of their difference over its variance,
 * summed over blocks of pixels. */
typedef struct agreement {
    size_t blocks;
    double mean_square; /* of the blocks' differences in their standard deviations: 1 but for chance */
    double beyond;      /* part of the blocks beyond 3 of them: 0.0027 but for chance */
    double whole;       /* difference of all light, in its standard deviations */
    double ratio;       /* of all light: film over reference */
} agreement;

agreement agreement_between(const film *of, const film *reference);

/* The relative error that two films share beside two others that saw the same numbers: its square is the mean of
 * the product of two independent differences, to which noise adds nothing; 0 where that is negative. `noise` gets
 * the standard deviation of that mean as an error: a smaller error cannot be told from 0. */
double common_error(const film of[2], const film exact[2], double *noise);

/* Errors of every pixel for a map: |I - R| / (R + floor). */
void error_map(const film *of, const film *reference, float *relative);

/* Luminance of the mean of a pixel. */
double film_light(const film *f, size_t pixel);

/* Mean luminance of all pixels. */
double film_mean(const film *f);

#endif
