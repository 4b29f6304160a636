/* Scenes built in C for tests of the renderer, and means over all samples of a film with their standard
 * deviation: for films all of whose pixels see the same. */
#ifndef TESTS_RENDER_PATH_CASE_H
#define TESTS_RENDER_PATH_CASE_H

#include <math.h>
#include <stdlib.h>

#include "render/film.h"
#include "harness/test.h"

enum { CASE_MATERIALS = 8 };

typedef struct render_case {
    scene scene;
    material materials[CASE_MATERIALS];
} render_case;

typedef struct case_mean {
    double value, sigma;
} case_mean;

/* Nothing yet, seen from `from` towards `to` through a field so narrow that all pixels see one point. */
static inline void case_begin(render_case *c, vndf_vec3 from, vndf_vec3 to)
{
    *c = (render_case){.scene = {.width = 16, .height = 16}};
    c->scene.camera = (camera){from, to, vec(0.0f, 1.0f, 0.013f), 0.01f};
    c->scene.integrator = (integrator){.depth = 16, .roulette = 4, .samples = 1, .exposure = 1.0f};
    c->scene.materials = c->materials;
}

static inline material *case_material(render_case *c, material_kind kind, float r, float g, float b)
{
    material *m = &c->materials[c->scene.material_count++];
    *m = (material){.name = "material", .kind = kind, .colour = {r, g, b}};
    m->alpha_x.value = m->alpha_y.value = 1.0f;
    return m;
}

/* GGX; the effects are those of `is`. */
static inline material *case_rough(render_case *c, float alpha_x, float alpha_y, vndf_description is)
{
    material *m = case_material(c, MATERIAL_MICROFACET, 1.0f, 1.0f, 1.0f);
    m->is = is;
    m->is.distribution = vndf_ggx();
    m->is.alpha_x = m->alpha_x.value = alpha_x;
    m->is.alpha_y = m->alpha_y.value = alpha_y;
    return m;
}

/* The material that was added last. */
static inline int case_last(const render_case *c)
{
    return (int)c->scene.material_count - 1;
}

static inline void case_constant(render_case *c, float light)
{
    for (int i = 0; i < 3; i++)
        c->scene.environment.constant[i] = light;
}

static inline path_plan *case_plan(const render_case *c, path_sampler sampler, unsigned without)
{
    char message[512] = "";
    path_plan *plan = path_prepare(&c->scene, sampler, without, message, sizeof message);
    if (!TEST(plan != NULL))
        fprintf(stderr, "    %s\n", message);
    return plan;
}

static inline case_mean case_mean_of(const film *f)
{
    double pixels = (double)f->width * f->height, sum = 0, square = 0, count = pixels * (double)f->samples;
    for (int i = 0; i < f->width * f->height; i++) {
        sum += 0.2126 * f->sum[3 * i] + 0.7152 * f->sum[3 * i + 1] + 0.0722 * f->sum[3 * i + 2];
        square += f->square[i];
    }
    sum /= count;
    case_mean mean = {sum, sqrt(fmax(square / count - sum * sum, 0) / count)};
    return mean;
}

/* The mean luminance of `samples` samples of each of the 256 pixels, a quarter of them in quick mode. */
static inline case_mean case_render(const render_case *c, path_sampler sampler, unsigned without, unsigned samples,
                                    uint64_t seed)
{
    path_plan *plan = case_plan(c, sampler, without);
    film f;
    film_run run = {.samples = test_quick() ? (samples + 3) / 4 : samples, .threads = 1, .seed = seed};
    TEST(film_make(&f, c->scene.width, c->scene.height));
    TEST(film_render(&f, plan, &run));
    TEST(f.counts.samples_lost == 0);
    case_mean mean = case_mean_of(&f);
    film_free(&f);
    path_free(plan);
    return mean;
}

/* Two estimates of the same, independent of each other, within 4.5 sigma: 7e-6 for each to fail by chance. */
static inline void case_agree(const char *what, case_mean a, case_mean b)
{
    double sigma = sqrt(a.sigma * a.sigma + b.sigma * b.sigma);
    if (!TEST(fabs(a.value - b.value) <= 4.5 * sigma + 1e-5 * fabs(b.value)))
        fprintf(stderr, "    %s: %.6g +- %.2g and %.6g +- %.2g\n", what, a.value, a.sigma, b.value, b.sigma);
}

static inline void case_is(const char *what, case_mean a, double truth)
{
    case_mean b = {truth, 0};
    case_agree(what, a, b);
}

static inline void case_free(render_case *c)
{
    geometry_free(&c->scene.geometry);
}

#endif
