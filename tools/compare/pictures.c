#include "compare/pictures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/png.h"

/* ---- whole films ---- */

int picture_of_film(FILE *file, const film *f, float exposure)
{
    image made;
    if (!film_image(f, &made))
        return 0;
    int written = image_write_png(file, &made, exposure);
    image_free(&made);
    return written;
}

/* Dark to bright, so that its order is seen without colours, too. */
void error_colour(double part, unsigned char rgb[3])
{
    static const double stops[5][3] = {{0, 0, 0}, {70, 20, 110}, {190, 50, 90}, {250, 150, 40}, {255, 255, 220}};
    double at = 4 * fmin(fmax(part, 0), 1);
    int below = at < 4 ? (int)at : 3;
    for (int i = 0; i < 3; i++)
        rgb[i] = (unsigned char)(stops[below][i] + (at - below) * (stops[below + 1][i] - stops[below][i]) + 0.5);
}

int picture_of_error(FILE *file, const film *of, const film *reference, double low, double high)
{
    size_t count = film_pixels(of);
    float *relative = malloc(count * sizeof *relative);
    unsigned char *rgb = malloc(3 * count);
    int good = relative && rgb;
    if (good) {
        error_map(of, reference, relative);
        for (size_t i = 0; i < count; i++)
            error_colour(log(fmax((double)relative[i], 1e-30) / low) / log(high / low), rgb + 3 * i);
        good = png_write_rgb(file, rgb, (size_t)of->width, (size_t)of->height);
    }
    free(relative);
    free(rgb);
    return good;
}

/* ---- where to look ---- */

/* Of sums over [0, x) x [0, y), `width` in a row. */
static double window(const double *sums, int width, const crop *w)
{
    size_t stride = (size_t)width, top = (size_t)w->y * stride, bottom = (size_t)(w->y + w->height) * stride;
    size_t left = (size_t)w->x, right = (size_t)(w->x + w->width);
    return sums[bottom + right] - sums[bottom + left] - sums[top + right] + sums[top + left];
}

static void add_up(double *sums, int width, int height)
{
    for (int y = 1; y < height; y++)
        for (int x = 1; x < width; x++) {
            size_t at = (size_t)y * (size_t)width + (size_t)x;
            sums[at] += sums[at - 1] + sums[at - (size_t)width] - sums[at - (size_t)width - 1];
        }
}

/* As people see a pixel, roughly. */
static double shown(const film *f, size_t pixel, double exposure)
{
    return sqrt(fmin(fmax(exposure * film_light(f, pixel), 0), 1));
}

/* `sums` has a row and a column of zeros before the film's. Errors count as people see them. */
static void add_errors(double *sums, const film *of, const film *reference, double exposure, double weight)
{
    for (int y = 0; y < of->height; y++)
        for (int x = 0; x < of->width; x++) {
            size_t to = (size_t)(y + 1) * (size_t)(of->width + 1) + (size_t)(x + 1);
            size_t at = (size_t)y * (size_t)of->width + (size_t)x;
            sums[to] += weight * fabs(shown(of, at, exposure) - shown(reference, at, exposure));
        }
}

static int apart(const crop *a, const crop *b)
{
    return a->x + a->width <= b->x || b->x + b->width <= a->x || a->y + a->height <= b->y ||
           b->y + b->height <= a->y;
}

/* The window with the greatest sum, apart from another one. */
static crop best_window(const double *sums, const film *of, crop size, const crop *other)
{
    crop best = size;
    double most = -HUGE_VAL;
    for (size.y = 0; size.y + size.height <= of->height; size.y += 4)
        for (size.x = 0; size.x + size.width <= of->width; size.x += 4) {
            double sum = window(sums, of->width + 1, &size);
            if (sum > most && (!other || apart(&size, other))) {
                most = sum;
                best = size;
            }
        }
    return best;
}

static crop crop_size(const film *f)
{
    int width = f->width / 7, height = f->width / 10;
    crop size = {0, 0, width < 8 ? 8 : width, height < 6 ? 6 : height};
    size.width = size.width < f->width ? size.width : f->width;
    size.height = size.height < f->height ? size.height : f->height;
    return size;
}

int choose_crops(const contest *c, float exposure, crop crops[CROPS])
{
    const film *of = c->reference;
    int width = of->width + 1, height = of->height + 1;
    size_t count = (size_t)width * (size_t)height;
    double *all = calloc(count, sizeof *all), *beside = calloc(count, sizeof *beside);
    int good = all && beside;
    for (size_t i = 0; i < c->count && good; i++) {
        add_errors(all, &c->way[i].at_time, of, (double)exposure, 1);
        add_errors(beside, &c->way[i].at_time, of, (double)exposure, i ? 1 : -(double)(c->count - 1));
    }
    if (good) {
        add_up(all, width, height);
        add_up(beside, width, height);
        crops[0] = best_window(all, of, crop_size(of), NULL);
        crops[1] = best_window(beside, of, crop_size(of), &crops[0]);
    }
    free(all);
    free(beside);
    return good;
}

/* How often a pixel of a crop is repeated. */
static int crop_factor(const crop *where)
{
    return (CROP_MAGNIFIED + where->width - 1) / where->width;
}

/* ---- crops ---- */

enum { GAP = 6 };

static void put_crop(image *to, int left, int top, const image *from, const crop *w, int factor)
{
    for (int y = 0; y < w->height * factor; y++)
        for (int x = 0; x < w->width * factor; x++)
            image_at(from, w->x + x / factor, w->y + y / factor,
                     to->rgb + 3 * ((size_t)(top + y) * (size_t)to->width + (size_t)(left + x)));
}

static int put_film(image *to, int column, const film *f, const crop crops[CROPS], float exposure)
{
    image of;
    int factor = crop_factor(&crops[0]);
    if (!film_image(f, &of))
        return 0;
    for (size_t i = 0; i < 3 * film_pixels(f); i++)
        of.rgb[i] *= exposure;
    for (int row = 0; row < CROPS; row++)
        put_crop(to, column * (crops[0].width * factor + GAP), row * (crops[0].height * factor + GAP), &of,
                 &crops[row], factor);
    image_free(&of);
    return 1;
}

int picture_of_crops(FILE *file, const contest *c, const crop *crops, float exposure)
{
    image made;
    int factor = crop_factor(&crops[0]), columns = (int)c->count + 1;
    int width = columns * (crops[0].width * factor + GAP) - GAP;
    int height = CROPS * (crops[0].height * factor + GAP) - GAP;
    if (!image_make(&made, width, height))
        return 0;
    for (size_t i = 0; i < 3 * (size_t)width * (size_t)height; i++)
        made.rgb[i] = 1; /* the gaps */
    int good = put_film(&made, 0, c->reference, crops, exposure);
    for (size_t i = 0; i < c->count && good; i++)
        good = put_film(&made, (int)i + 1, &c->way[i].at_time, crops, exposure);
    good = good && image_write_png(file, &made, 1.0f);
    image_free(&made);
    return good;
}
