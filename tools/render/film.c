/* Films, whose rows threads take, and what the noise in them says. The random numbers of a sample depend on its
 * pixel and index alone, and samples are summed in order, so the sums are the same to the bit for any number of
 * threads. */
#define _POSIX_C_SOURCE 200809L
#include "render/film.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/progress.h"

enum { THREADS_MAX = 256, TURNS = 16, PASS_PATHS = 32768, BLOCK = 16, GAP = 4 };

/* Deviations that chance does not bring: 1 in 3e5 for all light; for the worst block, 1 in 5e8 times the blocks,
 * since the noise of a block with fireflies is underestimated. */
static const double whole_most = 4.5, block_most = 6, mean_square_most = 1.5;

const char *const verdict_names[3] = {"same", "differs", "unknown"};

/* ---- a pass over all pixels ---- */

typedef struct pass {
    film *film;
    const path_plan *plan;
    uint64_t samples, seed; /* a pixel */
    atomic_int next_row;    /* shared by the threads, as are counts */
    atomic_ullong rays, lost;
} pass;

static void *render_rows(void *user)
{
    pass *p = user;
    film *f = p->film;
    path_counts counts = {0, 0};
    for (int row; (row = atomic_fetch_add(&p->next_row, 1)) < f->height;)
        for (int x = 0; x < f->width; x++) {
            const size_t at = (size_t)row * (size_t)f->width + (size_t)x;
            for (uint64_t i = 0; i < p->samples; i++) {
                float rgb[3];
                path_trace(p->plan, x, row, f->samples + i, p->seed, &counts, rgb);
                f->square[at] += luminance(rgb) * luminance(rgb);
                for (size_t k = 0; k < 3; k++)
                    f->sum[3 * at + k] += (double)rgb[k];
            }
        }
    atomic_fetch_add(&p->rays, counts.rays);
    atomic_fetch_add(&p->lost, counts.lost);
    return NULL;
}

/* Adds samples to each pixel; goes on with fewer threads if the system gives no more. */
static void film_add(film *f, const path_plan *plan, uint64_t samples, unsigned threads, uint64_t seed)
{
    const double begun = clock_seconds(), processor = clock_processor_seconds();
    pass p = {.film = f, .plan = plan, .samples = samples, .seed = seed};
    pthread_t thread[THREADS_MAX];
    unsigned count = 0;
    while (count + 1 < threads && pthread_create(&thread[count], NULL, render_rows, &p) == 0)
        count++;
    render_rows(&p);
    while (count > 0)
        pthread_join(thread[--count], NULL);
    f->counts.rays += p.rays;
    f->counts.lost += p.lost;
    f->samples += samples;
    f->seconds += clock_seconds() - begun;
    f->processor += clock_processor_seconds() - processor;
}

unsigned film_processors(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : (unsigned)count;
}

double film_light(const film *f, size_t pixel)
{
    const double *sum = f->sum + 3 * pixel;
    return (0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]) / (double)f->samples;
}

/* Of that mean: not known (NaN) of less than two samples. */
static double film_variance(const film *f, size_t pixel)
{
    const double n = (double)f->samples, mean = film_light(f, pixel);
    return f->samples < 2 ? (double)NAN : fmax(f->square[pixel] / n - mean * mean, 0) / (n - 1);
}

/* ---- rendering ---- */

int comparison_begin(comparison *c, const scene *s)
{
    const size_t pixels = (size_t)s->width * (size_t)s->height;
    for (size_t i = 0; i < c->count; i++) {
        film *f = &c->way[i].film;
        if (!(c->way[i].plan = path_prepare(s, c->way[i].sampler)))
            return 0;
        *f = (film){.width = s->width, .height = s->height};
        f->sum = calloc(3 * pixels, sizeof *f->sum);
        f->square = calloc(pixels, sizeof *f->square);
        if (!f->sum || !f->square)
            return complain("vndf render", "there is no memory for %d x %d pixels", s->width, s->height), 0;
    }
    return 1;
}

void comparison_end(comparison *c)
{
    for (size_t i = 0; i < c->count; i++) {
        free(c->way[i].plan);
        free(c->way[i].film.sum);
        free(c->way[i].film.square);
    }
}

int comparison_run(comparison *c)
{
    const film *first = &c->way[0].film;
    const uint64_t part = c->samples < TURNS ? 1 : c->samples / TURNS;
    /* in a pass, so that starting threads does not dominate the time of small films */
    const uint64_t most = PASS_PATHS > film_pixels(first) ? PASS_PATHS / film_pixels(first) : 1;
    for (uint64_t until = 0; until < c->samples;) {
        until = part < c->samples - until ? until + part : c->samples;
        for (size_t i = 0; i < c->count; i++) {
            film *f = &c->way[i].film;
            const int by_time = i && c->has_equal_time;
            while (by_time ? f->processor < first->processor : f->samples < until) {
                const uint64_t samples = by_time || most < until - f->samples ? most : until - f->samples;
                double done = 0;
                film_add(f, c->way[i].plan, samples, c->threads, c->seed + i * 0x9E3779B97F4A7C15u);
                for (size_t k = 0; k < c->count; k++)
                    done += fmin((double)c->way[k].film.samples / (double)c->samples, 1) / (double)c->count;
                if (c->progress && c->progress(done, NULL, c->user) && done < 1)
                    return 0;
            }
        }
    }
    return 1;
}

/* ---- noise ---- */

static double mean_light(const film *f)
{
    double sum = 0;
    for (size_t i = 0; i < film_pixels(f); i++)
        sum += film_light(f, i);
    return sum / (double)film_pixels(f);
}

/* The mean of 3 x 3 pixels in the films of all other ways; of one alone, in its own. */
static double light_of_others(const comparison *c, const film *f, size_t pixel)
{
    const int column = (int)(pixel % (size_t)f->width), row = (int)(pixel / (size_t)f->width);
    double sum = 0, samples = 0;
    for (int y = row > 0 ? row - 1 : row; y <= row + 1 && y < f->height; y++)
        for (int x = column > 0 ? column - 1 : column; x <= column + 1 && x < f->width; x++)
            for (size_t i = 0; i < c->count; i++) {
                const film *other = &c->way[i].film;
                const double weight = other != f || c->count == 1 ? (double)other->samples : 0;
                sum += weight * film_light(other, (size_t)y * (size_t)f->width + (size_t)x);
                samples += weight;
            }
    return sum / samples;
}

static measured noise_of(const comparison *c, const film *f)
{
    const double n = (double)film_pixels(f), least = 0.05 * mean_light(f);
    double sum = 0, square = 0;
    for (size_t i = 0; i < film_pixels(f); i++) {
        const double here = light_of_others(c, f, i), part = film_variance(f, i) / (here * here + least * least);
        sum += part;
        square += part * part;
    }
    const double variance = (square / n - sum * sum / (n * n)) / n;
    return (measured){sum / n, sqrt(variance < 0 ? 0 : variance)}; /* NaN where nothing is known */
}

/* a/b, times a factor. */
static measured ratio_of(const measured *a, const measured *b, double factor)
{
    const double ratio = a->value / b->value * factor;
    const double spread = a == b ? 0 : hypot(a->spread / a->value, b->spread / b->value);
    return (measured){ratio, ratio * spread};
}

/* ---- verdict ---- */

/* How far a square of one film is off the other, in standard deviations; of 1e-5 of the light at least, which nobody
 * sees. */
static double deviation(const film *a, const film *b, int left, int top, int side)
{
    double off = 0, variance = 0, light = 0;
    for (int y = top; y < a->height && y - top < side; y++)
        for (int x = left; x < a->width && x - left < side; x++) {
            const size_t pixel = (size_t)y * (size_t)a->width + (size_t)x;
            off += film_light(a, pixel) - film_light(b, pixel);
            variance += film_variance(a, pixel) + film_variance(b, pixel);
            light += fabs(film_light(b, pixel));
        }
    return off == 0 ? 0 : off / sqrt(variance + 1e-10 * light * light);
}

static void judge(const film *a, const film *b, finding *made)
{
    double blocks = 0, squares = 0;
    for (int top = 0; top < a->height; top += BLOCK)
        for (int left = 0; left < a->width; left += BLOCK, blocks++) {
            const double block = deviation(a, b, left, top, BLOCK);
            squares += block * block;
            if (fabs(block) <= fabs(made->worst))
                continue;
            made->worst = block;
            made->x = left;
            made->y = top;
        }
    made->ratio = mean_light(a) / mean_light(b);
    made->whole = deviation(a, b, 0, 0, IMAGE_SIDE_MAX);
    made->mean_square = squares / blocks;
    if (fabs(made->whole) > whole_most || fabs(made->worst) > block_most ||
        made->mean_square > mean_square_most + 5 * sqrt(2 / blocks))
        made->is = VERDICT_DIFFERS;
    if (a->samples < VERDICT_SAMPLES || b->samples < VERDICT_SAMPLES) {
        made->whole = made->worst = made->mean_square = (double)NAN;
        made->is = VERDICT_UNKNOWN;
    }
}

void comparison_find(const comparison *c, finding found[SAMPLERS])
{
    const film *first = &c->way[0].film;
    for (size_t i = 0; i < c->count; i++) {
        const film *f = &c->way[i].film;
        finding *made = &found[i];
        *made = (finding){.is = VERDICT_SAME, .noise = noise_of(c, f)};
        made->samples = ratio_of(&made->noise, &found->noise, (double)f->samples / (double)first->samples);
        made->efficiency = ratio_of(&found->noise, &made->noise, first->processor / f->processor);
        judge(f, first, made);
    }
}

/* ---- a picture ---- */

int comparison_image(const comparison *c, float exposure, image *made)
{
    const film *of = &c->way[0].film;
    const int rows = c->count > 1 ? 2 * of->height + GAP : of->height; /* of one film the noise is not shown */
    if (!image_make(made, (of->width + GAP) * (int)c->count - GAP, rows))
        return 0;
    for (size_t i = 0; i < 3 * (size_t)made->width * (size_t)made->height; i++)
        made->rgb[i] = 1.0f; /* the gaps */
    for (size_t i = 0; i < c->count; i++) {
        const film *f = &c->way[i].film;
        const double least = 0.05 * mean_light(f);
        for (size_t at = 0; at < film_pixels(f); at++) {
            const int x = (int)(at % (size_t)f->width) + (int)i * (f->width + GAP),
                      y = (int)(at / (size_t)f->width);
            const double error = sqrt(film_variance(f, at)) / (fabs(film_light(f, at)) + least);
            const double grey = 0.5 * log10(fmax(100 * error, 1)); /* of one sample NaN, and black */
            for (size_t k = 0; k < 3; k++) {
                image_pixel(made, x, y)[k] = exposure * (float)(f->sum[3 * at + k] / (double)f->samples);
                if (c->count > 1)
                    image_pixel(made, x, f->height + GAP + y)[k] =
                        (float)fmin(grey * grey, 1); /* even to the eye */
            }
        }
    }
    return 1;
}
