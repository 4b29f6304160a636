/* Scenes from text for tests of the renderer, and the mean over all samples of a film with its standard deviation:
 * for films all of whose pixels see the same. */
#pragma once

#include "harness/test.h"
#include "render/film.h"

enum { CASE_TEXT = 8192 };

/* A scene from text, which has to be good. */
static inline scene *case_scene(const char *text)
{
    const size_t length = strlen(text);
    scene *s = scene_read_text("x.scene", strcpy(malloc(length + 1), text), length);
    return s ? s : (exit(1), NULL);
}

/* The same seen through a field so narrow that all 16 x 16 pixels see one point. */
static inline scene *case_point(const char *text)
{
    scene *s = case_scene(text);
    s->field = 1e-6;
    s->width = s->height = 16;
    return s;
}

/* Adds samples to a film, which is made if it has no pixels. */
static inline void case_render(film *f, const scene *s, path_sampler sampler, uint64_t samples, uint64_t seed)
{
    vndf_error error;
    path_plan *plan = path_prepare(s, sampler, &error);
    if (!TEST(plan != NULL))
        fprintf(stderr, "    %s\n", error.message);
    else if (TEST(f->sum || film_make(f, s->width, s->height)))
        film_add(f, plan, samples, 2, seed);
    free(plan);
}

typedef struct case_mean {
    double value, sigma, variance; /* variance: of one sample */
} case_mean;

static inline case_mean case_mean_of(const film *f)
{
    double sum = 0, square = 0, count = (double)film_pixels(f) * (double)f->samples;
    for (size_t i = 0; i < film_pixels(f); i++) {
        sum += film_light(f, i) * (double)f->samples;
        square += f->square[i];
    }
    double variance = fmax(square / count - sum * sum / (count * count), 0);
    return (case_mean){sum / count, sqrt(variance / count), variance};
}

/* The mean light of a point. */
static inline case_mean case_light(const scene *s, path_sampler sampler, uint64_t samples)
{
    film f = {.sum = NULL};
    case_render(&f, s, sampler, samples, 1);
    case_mean mean = case_mean_of(&f);
    TEST(f.counts.lost == 0);
    film_free(&f);
    return mean;
}

/* 4.5 sigma: 7e-6 by chance. */
static inline int case_agrees(case_mean mean, double want, double slack)
{
    return TEST_NEAR(mean.value, want, 4.5 * mean.sigma + slack * want);
}
