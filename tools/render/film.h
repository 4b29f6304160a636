/* Light along paths from the eye, through all pixels, by threads: sums of samples, whose mean is the picture; they
 * do not depend on the number of threads, to the bit. And one scene by several samplers side by side, in equal time
 * or with equal samples: how noisy their films are, and whether they show the same. */
#pragma once

#include "render/scene.h"
#include "vndf_build.h" /* vndf_progress */

/* How rough materials draw directions: by normals of the library, or (perfect) as a yardstick by the BSDF itself. */
typedef enum path_sampler { SAMPLER_VISIBLE, SAMPLER_ALL, SAMPLER_PERFECT, SAMPLERS } path_sampler;
extern const char *const path_sampler_names[SAMPLERS + 1]; /* NULL at the end */

/* A scene, which has to outlive it, with a sampler; to be freed. NULL after a complaint: a material cannot have it. */
typedef struct path_plan path_plan;
path_plan *path_prepare(const scene *s, path_sampler sampler);

/* Counters of one thread; lost are paths whose light was not finite. */
typedef struct path_counts {
    uint64_t rays, lost;
} path_counts;

/* The radiance of one path through pixel (x, y): path `index` of the pixel under `seed`, whichever thread asks. */
void path_trace(const path_plan *plan, int x, int y, uint64_t index, uint64_t seed, path_counts *counts,
                float rgb[3]);

typedef struct film {
    int width, height;
    double *sum;      /* width * height * 3, owned */
    double *square;   /* of the luminance: for its variance; width * height, owned */
    uint64_t samples; /* a pixel, so far */
    double seconds;   /* that passed while it was rendered */
    double processor; /* that processors worked for it, all threads together */
    path_counts counts;
} film;

static inline size_t film_pixels(const film *f)
{
    return (size_t)f->width * (size_t)f->height;
}

/* The luminance of a pixel. */
double film_light(const film *f, size_t pixel);

/* The number of threads that the machine runs at once, 1 to 256. */
unsigned film_processors(void);

/* ---- samplers side by side ---- */

/* The first way is the measure: the others get as many samples, or as much time of processors. One alone is rendered
 * as it is. */
typedef struct comparison {
    struct {
        path_sampler sampler;
        path_plan *plan;
        film film;
    } way[SAMPLERS];
    size_t count;
    int has_equal_time;
    uint64_t samples; /* a pixel, of the first way */
    unsigned threads;
    uint64_t seed;           /* each way has its own numbers */
    vndf_progress *progress; /* a result other than 0 stops; may be NULL */
    void *user;
} comparison;

/* Makes plans and films of the ways, of samplers that are given; 0 after a complaint. To be ended in both cases. */
int comparison_begin(comparison *c, const scene *s);
void comparison_end(comparison *c);

/* Renders the ways in turns, so that a busy machine slows all of them alike. 0 if it was stopped: the films then hold
 * the passes that are complete. */
int comparison_run(comparison *c);

typedef struct measured {
    double value, spread; /* and its standard deviation */
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

void comparison_find(const comparison *c, finding found[SAMPLERS]);

/* The film of one way; or a sheet: those of all ways side by side, and below them the noise of each pixel, beside its
 * light, from 1% (black) to 100% (white) by its logarithm. 0 if there is no memory. */
int comparison_image(const comparison *c, float exposure, image *made);
