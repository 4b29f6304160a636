/* The distance between films, by luminance. Films keep its sums of squares, which give the noise of every pixel. */
#include "compare/contest.h"

#include <math.h>
#include <stdlib.h>

enum { BLOCK = 16 };

double film_light(const film *f, size_t pixel)
{
    const double *sum = f->sum + 3 * pixel;
    return (0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]) / (double)f->samples;
}

/* Of the mean of a pixel; 0 for one sample, and for an image that was read. */
static double film_variance(const film *f, size_t pixel)
{
    double n = (double)f->samples, mean = film_light(f, pixel);
    return f->samples < 2 ? 0 : fmax(f->square[pixel] / n - mean * mean, 0) / (n - 1);
}

double film_mean(const film *f)
{
    double sum = 0;
    for (size_t i = 0; i < film_pixels(f); i++)
        sum += film_light(f, i);
    return sum / (double)film_pixels(f);
}

/* ---- an error ---- */

static int descending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* The root of the mean of squares, less `noise` each; *spread: the standard deviation of that mean beside it. */
static double root_mean(const double *squares, size_t count, double noise, double *spread)
{
    double sum = 0, fourth = 0, n = (double)count;
    for (size_t i = count; i-- > 0;) { /* the smallest first */
        sum += squares[i];
        fourth += squares[i] * squares[i];
    }
    double mean = sum / n, left = fmax(mean - noise, 0);
    *spread = left > 0 ? sqrt(fmax(fourth / n - mean * mean, 0) / n) / left : 0;
    return sqrt(left);
}

/* `squares` of all pixels, changed; `noise`: the part of their mean that is the reference's. */
static film_error summarise(double *squares, size_t count, double noise)
{
    film_error e;
    size_t trimmed = count / 1000;
    qsort(squares, count, sizeof *squares, descending);
    e.relative = root_mean(squares, count, noise, &e.spread[0]);
    e.trimmed = root_mean(squares + trimmed, count - trimmed, noise, &e.spread[1]);
    return e;
}

film_error error_between(const film *of, const film *reference)
{
    size_t count = film_pixels(of);
    double floor = ERROR_FLOOR * film_mean(reference), noise = 0;
    double *squares = malloc(count * sizeof *squares);
    film_error e = {(double)NAN, (double)NAN, {0, 0}};
    if (!squares)
        return e;
    for (size_t i = 0; i < count; i++) {
        double light = film_light(reference, i), off = film_light(of, i) - light;
        double scale = 1 / (light * light + floor * floor);
        squares[i] = off * off * scale;
        noise += film_variance(reference, i) * scale;
    }
    e = summarise(squares, count, noise / (double)count);
    free(squares);
    return e;
}

void error_map(const film *of, const film *reference, float *relative)
{
    double floor = ERROR_FLOOR * film_mean(reference);
    for (size_t i = 0; i < film_pixels(of); i++) {
        double light = film_light(reference, i);
        relative[i] = (float)(fabs(film_light(of, i) - light) / (light + floor));
    }
}

/* ---- agreement ---- */

typedef struct block_sum {
    double off, variance;
} block_sum;

static block_sum sum_block(const film *of, const film *reference, int left, int top)
{
    block_sum sum = {0, 0};
    for (int y = top; y < top + BLOCK && y < of->height; y++)
        for (int x = left; x < left + BLOCK && x < of->width; x++) {
            size_t i = (size_t)y * (size_t)of->width + (size_t)x;
            sum.off += film_light(of, i) - film_light(reference, i);
            sum.variance += film_variance(of, i) + film_variance(reference, i);
        }
    return sum;
}

static void add_block(agreement *a, const block_sum *sum, block_sum *whole)
{
    whole->off += sum->off;
    whole->variance += sum->variance;
    if (!(sum->variance > 0))
        return;
    double square = sum->off * sum->off / sum->variance;
    a->blocks++;
    a->mean_square += square;
    a->beyond += square > 9;
}

agreement agreement_between(const film *of, const film *reference)
{
    agreement a = {0, 0, 0, 0, film_mean(of) / film_mean(reference)};
    block_sum whole = {0, 0};
    for (int y = 0; y < of->height; y += BLOCK)
        for (int x = 0; x < of->width; x += BLOCK) {
            block_sum sum = sum_block(of, reference, x, y);
            add_block(&a, &sum, &whole);
        }
    a.mean_square /= a.blocks ? (double)a.blocks : 1;
    a.beyond /= a.blocks ? (double)a.blocks : 1;
    a.whole = whole.variance > 0 ? whole.off / sqrt(whole.variance) : 0;
    return a;
}

/* ---- errors that are no noise ---- */

double common_error(const film of[2], const film exact[2], double *noise)
{
    size_t count = film_pixels(of);
    double floor = ERROR_FLOOR * film_mean(exact), sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++) {
        double light = film_light(exact, i);
        double product = (film_light(&of[0], i) - film_light(&exact[0], i)) *
                         (film_light(&of[1], i) - film_light(&exact[1], i)) / (light * light + floor * floor);
        sum += product;
        squares += product * product;
    }
    double mean = sum / (double)count, spread = sqrt(fmax(squares / (double)count - mean * mean, 0));
    *noise = sqrt(spread / sqrt((double)count));
    return sqrt(fmax(mean, 0));
}
