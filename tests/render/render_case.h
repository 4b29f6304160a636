/* Scenes from text for tests of the renderer, and the mean over all samples of a film with its standard deviation:
 * for films all of whose pixels see the same. */
#pragma once

#include "harness/test.h"
#include "render/film.h"

/* A scene from text, which has to be good. */
static inline scene *case_scene(const char *text)
{
    const size_t length = strlen(text);
    scene *s = scene_read("x.scene", strcpy(malloc(length + 1), text), length, 0);
    return s ? s : (exit(1), NULL);
}

/* The film of one sampler, whose comparison is to be ended. */
static inline comparison case_render(const scene *s, path_sampler sampler, uint64_t samples, uint64_t seed)
{
    comparison c = {.count = 1, .samples = samples, .threads = 2, .seed = seed, .way = {{.sampler = sampler}}};
    TEST(comparison_begin(&c, s) && comparison_run(&c));
    return c;
}

typedef struct case_mean {
    double value, sigma, variance; /* variance: of one sample */
} case_mean;

/* The mean light of a text's picture; of a point: through a field so narrow that all pixels see it. */
static inline case_mean case_light(const char *text, int is_point, path_sampler sampler, uint64_t samples)
{
    scene *s = case_scene(text);
    s->field = is_point ? 1e-6 : s->field;
    s->width = s->height = 16;
    comparison c = case_render(s, sampler, samples, 1);
    const film *f = &c.way[0].film;
    double sum = 0, square = 0, count = 256 * (double)samples;
    for (size_t i = 0; i < 256; i++) {
        sum += film_light(f, i) * (double)samples;
        square += f->square[i];
    }
    TEST(f->counts.lost == 0);
    comparison_end(&c);
    scene_free(s);
    const double variance = fmax(square / count - sum * sum / (count * count), 0);
    return (case_mean){sum / count, sqrt(variance / count), variance};
}

/* 4.5 sigma: 7e-6 by chance. */
static inline int case_agrees(const char *text, case_mean mean, double want, double slack)
{
    const int good = TEST_NEAR(mean.value, want, 4.5 * mean.sigma + slack * want);
    return good || (fprintf(stderr, "    %s", text), 0);
}
