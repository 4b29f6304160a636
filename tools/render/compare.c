#include "render/compare.h"

#include <stdlib.h>

enum { TURNS = 16, BLOCK = 16, GAP = 4 };

/* Deviations that chance does not bring: 1 in 3e5 for all light; for the worst block, 1 in 5e8 times the blocks,
 * since the noise of a block with fireflies is underestimated. */
static const double whole_most = 4.5, block_most = 6, mean_square_most = 1.5;

const char *const verdict_names[3] = {"same", "differs", "unknown"};

/* ---- rendering ---- */

/* How far all ways are, whatever is done of a pass of one of several. */
static int tell(double done, void *user)
{
    const comparison *c = user;
    double whole = 0;
    if (c->count == 1)
        return c->progress ? c->progress(done, c->user) : 0;
    for (size_t i = 0; i < c->count; i++)
        whole += fmin((double)c->way[i].film.samples / (double)c->samples, 1) / (double)c->count;
    return c->progress ? c->progress(whole, c->user) : 0;
}

static int render_some(comparison *c, way *one, uint64_t samples)
{
    const uint64_t own = (uint64_t)(one - c->way) * 0x9E3779B97F4A7C15u;
    const film_run run = {
        .samples = samples, .threads = c->threads, .seed = c->seed + own, .progress = tell, .user = c};
    return film_render(&one->film, one->plan, &run);
}

int comparison_run(comparison *c)
{
    way *first = &c->way[0];
    const uint64_t part = c->count == 1 ? c->samples : c->samples < TURNS ? 1 : c->samples / TURNS;
    while (first->film.samples < c->samples) {
        const uint64_t left = c->samples - first->film.samples, step = part < left ? part : left;
        if (!render_some(c, first, step))
            return 0;
        for (size_t i = 1; i < c->count; i++) {
            const film *f = &c->way[i].film;
            while (c->has_equal_time ? f->processor < first->film.processor : f->samples < first->film.samples)
                if (!render_some(c, &c->way[i], c->has_equal_time ? film_pass_samples(f) : step))
                    return 0;
        }
    }
    return 1;
}

int comparison_mean(const comparison *c, film *made)
{
    if (!film_make(made, c->way[0].film.width, c->way[0].film.height))
        return 0;
    for (size_t k = 0; k < c->count; k++) {
        made->samples += c->way[k].film.samples;
        for (size_t i = 0; i < 3 * film_pixels(made); i++)
            made->sum[i] += c->way[k].film.sum[i];
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

static int descending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

static measured mean_of(const double *values, size_t count)
{
    double sum = 0, square = 0, n = (double)count;
    for (size_t i = count; i-- > 0;) { /* the smallest first */
        sum += values[i];
        square += values[i] * values[i];
    }
    const measured m = {sum / n, sqrt(fmax(square / n - sum * sum / (n * n), 0) / n)};
    return m;
}

/* The mean of 3 x 3 pixels, but for the samples of `f`, if there are others. */
static double light_of_others(const film *all, const film *f, size_t pixel)
{
    const int column = (int)(pixel % (size_t)f->width), row = (int)(pixel / (size_t)f->width);
    const double own = all->samples > f->samples ? (double)f->samples : 0;
    double sum = 0, count = 0;
    for (int y = row > 0 ? row - 1 : row; y <= row + 1 && y < f->height; y++)
        for (int x = column > 0 ? column - 1 : column; x <= column + 1 && x < f->width; x++, count++) {
            const size_t at = (size_t)y * (size_t)f->width + (size_t)x;
            sum += film_light(all, at) * (double)all->samples - film_light(f, at) * own;
        }
    return sum / (count * ((double)all->samples - own));
}

int noise_of(const film *f, const film *all, noise *made)
{
    size_t count = film_pixels(f), trimmed = count / 1000;
    double least = 0.05 * mean_light(all), *part = malloc(count * sizeof *part);
    const measured unknown = {(double)NAN, (double)NAN};
    *made = (noise){unknown, unknown};
    if (!part || f->samples < 2) {
        free(part);
        return f->samples < 2;
    }
    for (size_t i = 0; i < count; i++) {
        double here = light_of_others(all, f, i);
        part[i] = film_variance(f, i) / (here * here + least * least);
    }
    qsort(part, count, sizeof *part, descending);
    made->all = mean_of(part, count);
    made->trimmed = mean_of(part + trimmed, count - trimmed);
    free(part);
    return 1;
}

gain gain_of(const comparison *c, const noise *noises, size_t i)
{
    const film *first = &c->way[0].film, *f = &c->way[i].film;
    const noise *a = &noises[0], *b = &noises[i];
    const double samples = (double)f->samples / (double)first->samples, time = first->processor / f->processor;
    const double spread = i ? hypot(a->all.spread / a->all.value, b->all.spread / b->all.value) : 0;
    gain g = {.samples = {b->all.value / a->all.value * samples, 0},
              .efficiency = {a->all.value / b->all.value * time, 0}};
    g.samples.spread = spread * g.samples.value;
    g.efficiency.spread = spread * g.efficiency.value;
    g.samples_trimmed = b->trimmed.value / a->trimmed.value * samples;
    g.efficiency_trimmed = a->trimmed.value / b->trimmed.value * time;
    return g;
}

/* ---- verdict ---- */

typedef struct difference {
    double off, variance, light;
} difference;

static void add_pixel(difference *d, const film *a, const film *b, size_t pixel)
{
    const double one = film_variance(a, pixel), other = film_variance(b, pixel);
    d->off += film_light(a, pixel) - film_light(b, pixel);
    d->variance += isnan(other) ? 2 * one : one + other;
    d->light += fabs(film_light(b, pixel));
}

/* In standard deviations; of 1e-5 of the light at least, which nobody sees: pictures in files are rounded to
 * float. */
static double deviations(const difference *d)
{
    const double least = 1e-5 * d->light;
    return d->off == 0 ? 0 : d->off / sqrt(d->variance + least * least);
}

agreement agreement_between(const film *a, const film *b, int is_read)
{
    const int is_known = a->samples >= VERDICT_SAMPLES && (is_read || b->samples >= VERDICT_SAMPLES);
    agreement made = {mean_light(a) / mean_light(b), 0, 0, 0, 0, 0, VERDICT_SAME};
    difference all = {0, 0, 0};
    double blocks = 0, squares = 0;
    for (int top = 0; top < a->height; top += BLOCK)
        for (int left = 0; left < a->width; left += BLOCK) {
            difference block = {0, 0, 0};
            for (int y = top; y < top + BLOCK && y < a->height; y++)
                for (int x = left; x < left + BLOCK && x < a->width; x++)
                    add_pixel(&block, a, b, (size_t)y * (size_t)a->width + (size_t)x);
            const double off = deviations(&block);
            all = (difference){all.off + block.off, all.variance + block.variance, all.light + block.light};
            blocks++;
            squares += off * off;
            if (fabs(off) > fabs(made.worst)) {
                made.worst = off;
                made.x = left;
                made.y = top;
            }
        }
    made.whole = deviations(&all);
    made.mean_square = squares / blocks;
    if (fabs(made.whole) > whole_most || fabs(made.worst) > block_most ||
        made.mean_square > mean_square_most + 5 * sqrt(2 / blocks))
        made.is = VERDICT_DIFFERS;
    if (is_known)
        return made;
    made.whole = made.worst = made.mean_square = (double)NAN;
    made.is = VERDICT_UNKNOWN;
    return made;
}

/* ---- a picture ---- */

static void put_film(image *made, int left, const film *f, float exposure)
{
    const double least = 0.05 * mean_light(f);
    for (int y = 0; y < f->height; y++)
        for (int x = 0; x < f->width; x++) {
            const size_t at = (size_t)y * (size_t)f->width + (size_t)x;
            const double error = sqrt(film_variance(f, at)) / (fabs(film_light(f, at)) + least);
            const double grey = 0.5 * log10(fmax(100 * error, 1)); /* of one sample NaN, and black */
            float *above = image_pixel(made, left + x, y),
                  *below = image_pixel(made, left + x, f->height + GAP + y);
            for (size_t i = 0; i < 3; i++) {
                above[i] = exposure * (float)(f->sum[3 * at + i] / (double)f->samples);
                below[i] = (float)fmin(grey * grey, 1); /* even steps for the eye */
            }
        }
}

int comparison_image(const comparison *c, float exposure, image *made)
{
    const film *f = &c->way[0].film;
    if (!image_make(made, (f->width + GAP) * (int)c->count - GAP, 2 * f->height + GAP))
        return 0;
    for (size_t i = 0; i < 3 * (size_t)made->width * (size_t)made->height; i++)
        made->rgb[i] = 1.0f; /* the gaps */
    for (size_t i = 0; i < c->count; i++)
        put_film(made, (int)i * (f->width + GAP), &c->way[i].film, exposure);
    return 1;
}
