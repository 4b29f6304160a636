/* One scene by several samplers side by side, in equal time or with equal samples: how noisy their films are, and
 * whether they show the same. */
#ifndef TOOLS_RENDER_COMPARE_H
#define TOOLS_RENDER_COMPARE_H

#include "render/film.h"

typedef struct way {
    path_sampler sampler;
    path_plan *plan;
    film film;
} way;

/* The first way is the measure: the others get as many samples, or as much time of processors. One alone is rendered
 * as it is. */
typedef struct comparison {
    way way[SAMPLERS];
    size_t count;
    int has_equal_time;
    film_run run; /* of the first way; each way has its own numbers */
} comparison;

/* Renders the ways in turns, so that a busy machine slows all of them alike. 0 if it was stopped. */
int comparison_run(comparison *c);

/* A number for all pixels, and for all but fireflies, the worst thousandth of them. */
typedef struct measured {
    double value, spread; /* and its standard deviation */
    double trimmed;
} measured;

/* Of films of fewer than VERDICT_SAMPLES nothing is known: fireflies that they do not have are missing in their
 * variance. */
typedef enum verdict { VERDICT_SAME, VERDICT_DIFFERS, VERDICT_UNKNOWN } verdict;
extern const char *const verdict_names[3];
enum { VERDICT_SAMPLES = 16 };

/* What a way is beside the first. NaN is what is not known.
 *
 * Noise is the mean over pixels of the variance that is left over the square of their light, which is that of 3 x 3
 * pixels in the other films: a firefly brightens its own pixel, and would count the less for it. Dark pixels count as
 * if they had 5% of the mean light.
 *
 * The verdict asks whether two films with numbers of their own show the same: by the differences of all light and of
 * blocks of 16 x 16 pixels, in their standard deviations. */
typedef struct finding {
    measured noise;
    measured samples;    /* how often it needs the samples of the first for the same noise */
    measured efficiency; /* 1 over noise and time, beside that of the first */
    double ratio;        /* of the light to that of the first */
    double whole;        /* all light, in standard deviations */
    double worst;        /* the block that differs most, */
    int x, y;            /* its corner, */
    double mean_square;  /* and the mean square of all blocks: 1 but for chance */
    verdict is;
} finding;

/* 0 if there is no memory. */
int comparison_find(const comparison *c, finding found[SAMPLERS]);

/* A sheet: the films of all ways side by side, and below them the noise of each pixel, beside its light, from 1%
 * (black) to 100% (white) by its logarithm. 0 if there is no memory. */
int comparison_image(const comparison *c, float exposure, image *made);

#endif
