/* The ways take turns: in each turn the first goes on by a few samples, then every other one for as long as that
 * took. When the first has all its samples, the others have had its time; at the end they render the samples that they
 * lack.
 *
 * These turns are not those of measure/turns.h, which repeats a run and takes medians: here every sample stays in a
 * film, and the time that counts is that of all processors together. */
#include "compare/contest.h"

#include <math.h>
#include <string.h>

enum { TURNS = 24 };

/* ---- films ---- */

static void copy_film(film *made, const film *of)
{
    size_t count = film_pixels(of);
    double *sum = made->sum, *square = made->square;
    memcpy(sum, of->sum, 3 * count * sizeof *sum);
    memcpy(square, of->square, count * sizeof *square);
    *made = *of;
    made->sum = sum;
    made->square = square;
}

static int make_films(way *w)
{
    return film_make(&w->film, w->scene->width, w->scene->height) &&
           film_make(&w->at_samples, w->scene->width, w->scene->height) &&
           film_make(&w->at_time, w->scene->width, w->scene->height);
}

void contest_free(contest *c)
{
    for (size_t i = 0; i < c->count; i++) {
        film_free(&c->way[i].film);
        film_free(&c->way[i].at_samples);
        film_free(&c->way[i].at_time);
    }
}

/* ---- points ---- */

static contest_point point_of(const contest *c, const film *f)
{
    contest_point p = {f->samples, f->processor, error_between(f, c->reference)};
    return p;
}

/* Keeps errors at powers of two of samples, and at the final count. 0 if there is no memory. */
static int keep_point(const contest *c, way *w)
{
    const film *f = &w->film;
    if (f->samples != c->samples && f->samples != w->next)
        return 1;
    contest_point p = point_of(c, f);
    if (f->samples == c->samples) {
        copy_film(&w->at_samples, f);
        w->by_samples = p;
    }
    if (f->samples == w->next)
        w->next *= 2;
    if (w->points < POINTS_MAX)
        w->point[w->points++] = p;
    return !isnan(p.error.relative);
}

/* ---- rendering ---- */

static double done_part(const contest *c)
{
    double done = 0;
    for (size_t i = 0; i < c->count; i++) {
        double part = (double)c->way[i].film.samples / (double)c->samples;
        done += part < 1 ? part : 1;
    }
    return done / (double)c->count;
}

static int watch(double done, void *user)
{
    const contest *c = user;
    (void)done; /* of a pass */
    return c->progress ? c->progress(done_part(c), c->user) : 0;
}

/* Renders up to `samples` at once, but not beyond the next point. */
static int render_some(contest *c, way *w, uint64_t samples)
{
    uint64_t at = w->film.samples;
    uint64_t to_point = w->next - at, to_all = at < c->samples ? c->samples - at : to_point;
    samples = samples < to_point ? samples : to_point;
    film_run run = {.samples = samples < to_all ? samples : to_all,
                    .threads = c->threads,
                    .seed = c->seed,
                    .progress = watch,
                    .user = c};
    return film_render(&w->film, w->plan, &run) && keep_point(c, w);
}

static int render_to_samples(contest *c, way *w, uint64_t samples)
{
    while (w->film.samples < samples)
        if (!render_some(c, w, samples - w->film.samples))
            return 0;
    return 1;
}

/* A pass at a time; a film of few pixels takes several samples in one. */
static int render_to_time(contest *c, way *w, double seconds)
{
    uint64_t samples = film_pass_samples(&w->film);
    while (w->film.processor < seconds)
        if (!render_some(c, w, samples))
            return 0;
    return 1;
}

static int take_turn(contest *c, uint64_t samples)
{
    if (!render_to_samples(c, &c->way[0], samples))
        return 0;
    for (size_t i = 1; i < c->count; i++)
        if (!render_to_time(c, &c->way[i], c->way[0].film.processor))
            return 0;
    return 1;
}

/* Their first touch of tables and images is not timed. */
static int warm_up(contest *c)
{
    for (size_t i = 0; i < c->count; i++) {
        film f;
        film_run run = {.samples = 1, .threads = c->threads, .seed = c->seed + 1};
        int good = film_make(&f, c->way[i].scene->width, c->way[i].scene->height) &&
                   film_render(&f, c->way[i].plan, &run);
        film_free(&f);
        if (!good)
            return 0;
    }
    return 1;
}

int contest_run(contest *c)
{
    for (size_t i = 0; i < c->count; i++) {
        c->way[i].next = 1;
        if (!make_films(&c->way[i]))
            return 0;
    }
    if (!warm_up(c))
        return 0;
    for (uint64_t turn = 1; turn <= TURNS; turn++)
        if (!take_turn(c, (c->samples * turn + TURNS - 1) / TURNS))
            return 0;
    for (size_t i = 0; i < c->count; i++) {
        way *w = &c->way[i];
        copy_film(&w->at_time, &w->film);
        w->by_time = point_of(c, &w->film);
        if (!render_to_samples(c, w, c->samples))
            return 0;
    }
    return 1;
}

typedef struct repeated {
    const contest *contest;
    size_t way;
} repeated;

static int watch_repeated(double done, void *user)
{
    const repeated *r = user;
    const contest *c = r->contest;
    return c->progress ? c->progress(((double)r->way + done) / (double)c->count, c->user) : 0;
}

int contest_repeat(const contest *c, uint64_t seed, film more[WAYS_MAX])
{
    for (size_t i = 0; i < c->count; i++) {
        repeated r = {c, i};
        film_run run = {
            .samples = c->samples, .threads = c->threads, .seed = seed, .progress = watch_repeated, .user = &r};
        if (!film_make(&more[i], c->way[i].scene->width, c->way[i].scene->height) ||
            !film_render(&more[i], c->way[i].plan, &run))
            return 0;
    }
    return 1;
}
