/* All pixels, rendered by threads: sums of samples, whose mean is the image. The sums do not depend on the number
 * of threads. */
#ifndef RENDER_FILM_H
#define RENDER_FILM_H

#include "render/path/path.h"

typedef struct film {
    int width, height;
    double *sum;      /* width * height * 3 */
    double *square;   /* of the luminance: its variance; width * height */
    uint64_t samples; /* a pixel, so far */
    double seconds;   /* spent rendering, all threads at once */
    double processor; /* processor time of all threads together */
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
    double seconds;   /* stop after so many, between passes; 0: no limit */
    unsigned threads;
    uint64_t seed;
    int (*progress)(double done, void *user); /* a result other than 0 stops between rows; may be NULL */
    void *user;
} film_run;

/* Adds samples. Returns 0 if it was stopped early; the film then holds the complete passes. */
int film_render(film *f, const path_plan *plan, const film_run *run);

/* Samples a pixel in one pass. */
uint64_t film_pass_samples(const film *f);

/* The number of threads that the machine runs at once, 1 to 256. */
unsigned film_processors(void);

/* The mean. 0 if there is no memory. */
int film_image(const film *f, image *made);

#endif
