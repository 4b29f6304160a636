/* All pixels, rendered by threads: sums of samples, whose mean is the picture. The sums do not depend on the
 * number of threads, to the bit. */
#ifndef TOOLS_RENDER_FILM_H
#define TOOLS_RENDER_FILM_H

#include "render/path.h"

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

/* 0 if there is no memory. */
int film_make(film *f, int width, int height);
void film_free(film *f);

typedef struct film_run {
    uint64_t samples; /* a pixel, to add */
    unsigned threads;
    uint64_t seed;
    int (*progress)(double done, void *user); /* a result other than 0 stops after the pass; may be NULL */
    void *user;
} film_run;

/* Adds samples. Returns 0 if it was stopped early; the film then holds the complete passes. */
int film_render(film *f, const path_plan *plan, const film_run *run);

/* Samples a pixel in one pass. */
uint64_t film_pass_samples(const film *f);

/* The number of threads that the machine runs at once, 1 to 256. */
unsigned film_processors(void);

/* The luminance of a pixel, and the variance of that mean: not known (NaN) of less than two samples. */
double film_light(const film *f, size_t pixel);
double film_variance(const film *f, size_t pixel);

/* The mean. 0 if there is no memory. */
int film_image(const film *f, image *made);

#endif
