/* A pass over all pixels of a film, whose rows threads take. The random numbers of a sample depend on its pixel and
 * index alone, and samples are summed in order, so the sums are the same to the bit for any number of threads. */
#define _POSIX_C_SOURCE 200809L
#include "render/film.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/progress.h"

enum { THREADS_MAX = 256 };

typedef struct pass {
    film *film;
    const path_plan *plan;
    uint64_t samples, seed; /* a pixel */
    atomic_int next_row;    /* shared by the threads */
} pass;

typedef struct worker {
    pass *of;
    path_counts counts;
    pthread_t thread;
} worker;

static void *render_rows(void *user)
{
    worker *w = user;
    pass *p = w->of;
    film *f = p->film;
    for (int row; (row = atomic_fetch_add(&p->next_row, 1)) < f->height;)
        for (int x = 0; x < f->width; x++) {
            const size_t at = (size_t)row * (size_t)f->width + (size_t)x;
            for (uint64_t i = 0; i < p->samples; i++) {
                float rgb[3];
                path_trace(p->plan, x, row, f->samples + i, p->seed, &w->counts, rgb);
                f->square[at] += luminance(rgb) * luminance(rgb);
                for (size_t k = 0; k < 3; k++)
                    f->sum[3 * at + k] += (double)rgb[k];
            }
        }
    return NULL;
}

/* Goes on with fewer threads if the system gives no more. */
void film_add(film *f, const path_plan *plan, uint64_t samples, unsigned threads, uint64_t seed)
{
    const double begun = clock_seconds(), processor = clock_processor_seconds();
    pass p = {.film = f, .plan = plan, .samples = samples, .seed = seed};
    worker workers[THREADS_MAX] = {{.of = &p}};
    unsigned count = 1;
    for (; count < threads && count < THREADS_MAX; count++) {
        workers[count].of = &p;
        if (pthread_create(&workers[count].thread, NULL, render_rows, &workers[count]) != 0)
            break;
    }
    render_rows(&workers[0]);
    for (unsigned i = 0; i < count; i++) {
        if (i > 0)
            pthread_join(workers[i].thread, NULL);
        f->counts.rays += workers[i].counts.rays;
        f->counts.lost += workers[i].counts.lost;
    }
    f->samples += samples;
    f->seconds += clock_seconds() - begun;
    f->processor += clock_processor_seconds() - processor;
}

unsigned film_processors(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : (unsigned)count;
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
