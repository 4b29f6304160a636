/* Renders a film in passes over all pixels, whose rows threads take. The random numbers of a sample depend on its
 * pixel and index alone, and samples are summed in order, so the sums are the same to the bit for any number of
 * threads. Small films take several samples in a pass, so that starting threads does not dominate the time. */
#define _POSIX_C_SOURCE 200809L
#include "render/film.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>
#ifdef VNDF_TOOLS_PTHREADS
#  include <pthread.h>
#endif

#include "cli/progress.h"

enum { THREADS_MAX = 256, PASS_PATHS = 32768 };

/* ---- one pass ---- */

typedef struct pass {
    film *film;
    const path_plan *plan;
    const film_run *run;
    uint64_t samples;             /* a pixel */
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

static void *render_rows(void *user)
{
    worker *w = user;
    pass *p = w->of;
    film *f = p->film;
    for (int row; (row = atomic_fetch_add(&p->next_row, 1)) < f->height;) {
        for (int x = 0; x < f->width; x++) {
            const size_t at = (size_t)row * (size_t)f->width + (size_t)x;
            for (uint64_t i = 0; i < p->samples; i++) {
                float rgb[3];
                path_trace(p->plan, x, row, f->samples + i, p->run->seed, &w->counts, rgb);
                f->square[at] += luminance(rgb) * luminance(rgb);
                for (size_t k = 0; k < 3; k++)
                    f->sum[3 * at + k] += (double)rgb[k];
            }
        }
        if (w->tells && p->run->progress &&
            p->run->progress(p->done + p->part * (row + 1) / f->height, NULL, p->run->user))
            p->stopped = 1;
    }
    return NULL;
}

/* Goes on with fewer threads if the system gives no more. */
static void render_pass(pass *p)
{
    worker workers[THREADS_MAX] = {{.of = p, .tells = 1}};
    unsigned count = 1;
#ifdef VNDF_TOOLS_PTHREADS
    for (; count < p->run->threads && count < THREADS_MAX; count++) {
        workers[count].of = p;
        if (pthread_create(&workers[count].thread, NULL, render_rows, &workers[count]) != 0)
            break;
    }
#endif
    render_rows(&workers[0]);
    for (unsigned i = 0; i < count; i++) {
#ifdef VNDF_TOOLS_PTHREADS
        if (i > 0)
            pthread_join(workers[i].thread, NULL);
#endif
        p->film->counts.rays += workers[i].counts.rays;
        p->film->counts.lost += workers[i].counts.lost;
    }
}

/* ---- the film ---- */

uint64_t film_pass_samples(const film *f)
{
    const uint64_t samples = PASS_PATHS / film_pixels(f);
    return samples > 1 ? samples : 1;
}

unsigned film_processors(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : (unsigned)count;
}

int film_render(film *f, const path_plan *plan, const film_run *run)
{
    const uint64_t start = f->samples, end = start + run->samples, most = film_pass_samples(f);
    const double begun = f->seconds - clock_seconds(), processor = f->processor - clock_processor_seconds();
    pass p = {.film = f, .plan = plan, .run = run};
    while (f->samples < end && !p.stopped) {
        p.samples = most < end - f->samples ? most : end - f->samples;
        p.done = (double)(f->samples - start) / (double)run->samples;
        p.part = (double)p.samples / (double)run->samples;
        p.next_row = 0;
        render_pass(&p);
        f->samples += p.samples;
        f->seconds = begun + clock_seconds();
        f->processor = processor + clock_processor_seconds();
    }
    return f->samples == end;
}

int film_make(film *f, int width, int height)
{
    const size_t count = (size_t)width * (size_t)height;
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
    const double n = (double)f->samples, mean = film_light(f, pixel);
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
