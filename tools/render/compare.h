/* One scene by several samplers side by side, in equal time or with equal samples; and whether films show the
 * same. */
#ifndef TOOLS_RENDER_COMPARE_H
#define TOOLS_RENDER_COMPARE_H

#include "render/film.h"

typedef struct way {
    path_sampler sampler;
    path_plan *plan;
    film film;
} way;

/* The first way is the measure: the others get as many samples, or as much time of processors. */
typedef struct comparison {
    way way[SAMPLERS];
    size_t count;
    int has_equal_time;
    uint64_t samples; /* of the first way, a pixel */
    unsigned threads;
    uint64_t seed;                            /* each way has its own numbers */
    int (*progress)(double done, void *user); /* as in film_run */
    void *user;
} comparison;

/* Renders the ways in turns, so that a busy machine slows all of them alike. 0 if it was stopped. */
int comparison_run(comparison *c);

/* All samples of all ways in one film, without squares. 0 if there is no memory. */
int comparison_mean(const comparison *c, film *made);

/* ---- noise ---- */

typedef struct measured {
    double value, spread; /* and its standard deviation */
} measured;

/* The mean over pixels of the variance that is left over the square of their light; and the same without
 * fireflies, the worst thousandth of the pixels. NaN of less than two samples, which have no variance. */
typedef struct noise {
    measured all, trimmed;
} noise;

/* Light is that of 3 x 3 pixels in the other films of `all`, if there are some: a firefly brightens its own pixel,
 * and would count the less for it. Dark pixels count as if they had 5% of the mean light. 0 if there is no memory.
 */
int noise_of(const film *f, const film *all, noise *made);

/* How often way i needs the samples of the first for the same noise: the mean square of an error falls as 1/samples.
 * And how much more it gets out of a second: 1 over noise and time. Both are of noises without fireflies as well. */
typedef struct gain {
    measured samples, efficiency;
    double samples_trimmed, efficiency_trimmed;
} gain;

gain gain_of(const comparison *c, const noise *noises, size_t i);

/* ---- verdict ---- */

typedef enum verdict { VERDICT_SAME, VERDICT_DIFFERS, VERDICT_UNKNOWN } verdict;

/* Whether two films with numbers of their own show the same: the differences of all light and of blocks of 16 x 16
 * pixels, in their standard deviations. Films of less than VERDICT_SAMPLES have no variance to judge by: fireflies
 * that they do not have are missing in it. A picture that was read (`is_read`) is taken to be as noisy as the
 * first film. */
enum { VERDICT_SAMPLES = 16 };

typedef struct agreement {
    double ratio;       /* of the light of the first to that of the second */
    double whole;       /* all light; NaN: unknown, as the others */
    double worst;       /* the block that differs most, */
    int x, y;           /* its corner, */
    double mean_square; /* and the mean square of all blocks: 1 but for chance */
    verdict is;
} agreement;

agreement agreement_between(const film *a, const film *b, int is_read);
extern const char *const verdict_names[3];

/* ---- a picture ---- */

/* A sheet: the films of all ways side by side, and below them the noise of each pixel, beside its light, from 1%
 * (black) to 100% (white) by its logarithm. 0 if there is no memory. */
int comparison_image(const comparison *c, float exposure, image *made);

#endif
