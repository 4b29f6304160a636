/* Renders a film in passes over all pixels: threads take rows, and a complete pass is added to the film. The
 * random numbers of a sample depend on its pixel and index alone, and samples are summed in order, so the sums are
 * the same to the bit for any number of threads. Small films take several samples in a pass, so that starting
 * threads does not dominate the time. */
#define _POSIX_C_SOURCE 200809L
#include "render/film.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef VNDF_TOOLS_PTHREADS
#  include <pthread.h>
#endif

#include "cli/clock.h"

enum { THREADS_MAX = 256, PASS_PATHS = 32768 };

/* ---- one pass ---- */

typedef struct pass {
    const path_plan *plan;
    const film_run *run;
    int width, height;
    double *sum, *square;         /* of this pass */
    uint64_t first, samples;      /* a pixel */
    double done, part;            /* of the run: before this pass, and this pass */
    atomic_int next_row, stopped; /* shared by the threads */
} pass;

typedef struct worker {
    pass *of;
    path_counts counts;
    int tells; /* how far it is: the thread that called film_render */
#ifdef VNDF_TOOLS_PTHREADS
    pthread_t thread;
#endif
} worker;

static void render_pixel(const pass *p, int x, int y, path_counts *counts)
{
    size_t at = (size_t)y * (size_t)p->width + (size_t)x;
    double sum[3] = {0, 0, 0}, square = 0;
    for (uint64_t i = 0; i < p->samples; i++) {
        float rgb[3];
        path_trace(p->plan, x, y, p->first + i, p->run->seed, counts, rgb);
        square += luminance(rgb) * luminance(rgb);
        for (int k = 0; k < 3; k++)
            sum[k] += (double)rgb[k];
    }
    memcpy(p->sum + 3 * at, sum, sizeof sum);
    p->square[at] = square;
}

static void *render_rows(void *user)
{
    worker *w = user;
    pass *p = w->of;
    for (int row; !p->stopped && (row = atomic_fetch_add(&p->next_row, 1)) < p->height;) {
        for (int x = 0; x < p->width; x++)
            render_pixel(p, x, row, &w->counts);
        if (w->tells && p->run->progress)
            p->stopped = p->run->progress(p->done + p->part * (row + 1) / p->height, p->run->user) != 0;
    }
    return NULL;
}

static void add_counts(path_counts *to, const path_counts *more)
{
    to->rays += more->rays;
    to->lost += more->lost;
}

/* Goes on with fewer threads if the system gives no more. */
static path_counts render_pass(pass *p)
{
    worker workers[THREADS_MAX] = {{.of = p, .tells = 1}};
#ifdef VNDF_TOOLS_PTHREADS
    unsigned count = 1, wanted = p->run->threads < THREADS_MAX ? p->run->threads : THREADS_MAX;
    for (; count < wanted; count++) {
        workers[count].of = p;
        if (pthread_create(&workers[count].thread, NULL, render_rows, &workers[count]) != 0)
            break;
    }
    render_rows(&workers[0]);
    while (--count) {
        pthread_join(workers[count].thread, NULL);
        add_counts(&workers[0].counts, &workers[count].counts);
    }
#else
    render_rows(&workers[0]);
#endif
    return workers[0].counts;
}

/* ---- passes ---- */

uint64_t film_pass_samples(const film *f)
{
    uint64_t samples = PASS_PATHS / film_pixels(f);
    return samples > 1 ? samples : 1;
}

static int render_passes(film *f, pass *p)
{
    const film_run *run = p->run;
    const uint64_t start = f->samples, end = start + run->samples, most = film_pass_samples(f);
    const double begun = f->seconds - clock_seconds(), processor = f->processor - clock_processor_seconds();
    while (f->samples < end) {
        p->first = f->samples;
        p->samples = most < end - f->samples ? most : end - f->samples;
        p->done = (double)(f->samples - start) / (double)run->samples;
        p->part = (double)p->samples / (double)run->samples;
        p->next_row = 0;
        const path_counts counts = render_pass(p);
        if (p->stopped)
            return 0;
        for (size_t i = 0; i < 3 * film_pixels(f); i++)
            f->sum[i] += p->sum[i];
        for (size_t i = 0; i < film_pixels(f); i++)
            f->square[i] += p->square[i];
        f->samples += p->samples;
        add_counts(&f->counts, &counts);
        f->seconds = begun + clock_seconds();
        f->processor = processor + clock_processor_seconds();
    }
    return 1;
}

unsigned film_processors(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : (unsigned)count;
}

int film_render(film *f, const path_plan *plan, const film_run *run)
{
    size_t count = film_pixels(f);
    pass p = {.plan = plan, .run = run, .width = f->width, .height = f->height};
    p.sum = malloc(3 * count * sizeof *p.sum);
    p.square = malloc(count * sizeof *p.square);
    int good = p.sum && p.square && render_passes(f, &p);
    free(p.sum);
    free(p.square);
    return good;
}

/* ---- the film ---- */

int film_make(film *f, int width, int height)
{
    size_t count = (size_t)width * (size_t)height;
    *f = (film){.width = width, .height = height};
    f->sum = calloc(3 * count, sizeof *f->sum);
    f->square = calloc(count, sizeof *f->square);
    if (f->sum && f->square)
        return 1;
    film_free(f);
    return 0;
}

void film_free(film *f)
{
    free(f->sum);
    free(f->square);
    f->sum = f->square = NULL;
}

double film_light(const film *f, size_t pixel)
{
    const double *sum = f->sum + 3 * pixel;
    return (0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]) / (double)f->samples;
}

double film_variance(const film *f, size_t pixel)
{
    double n = (double)f->samples, mean = film_light(f, pixel);
    return f->samples < 2 ? (double)NAN : fmax(f->square[pixel] / n - mean * mean, 0) / (n - 1);
}

int film_image(const film *f, image *made)
{
    if (!image_make(made, f->width, f->height))
        return 0;
    for (size_t i = 0; i < 3 * film_pixels(f) && f->samples; i++)
        made->rgb[i] = (float)(f->sum[i] / (double)f->samples);
    return 1;
}
