/* Surfaces beyond two roughnesses: view, sample and density of affine surfaces and of two lobes; only timed. */
#include <stdio.h>

#include "bench/methods/vector.h"

static vndf_affine straight(const vndf_distribution *d, float alpha)
{
    return (vndf_affine){d, alpha, 0, 0, alpha, 0, 0};
}

/* Turned, sheared, and with a mean slope. */
static vndf_affine oblique(const vndf_distribution *d, float alpha)
{
    return (vndf_affine){d, 0.9f * alpha, -0.5f * alpha, 0.3f * alpha, 0.8f * alpha, 0.1f, -0.05f};
}

/* A core and a haze three times as rough. */
static vndf_mixture two_lobes(const vndf_distribution *d, float alpha)
{
    return (vndf_mixture){2, {{straight(d, alpha), 0.7f}, {straight(d, 3 * alpha), 0.3f}}};
}

/* ---- a direction each ---- */

static inline vndf_vec3 draw_affine(const vndf_affine *surface, const method_input *in, float *pdf)
{
    vndf_affine_view view = vndf_affine_view_from(surface, in->wi);
    return vndf_affine_sample(&view, in->u1, in->u2, pdf);
}

static inline vndf_vec3 one_diagonal(const method *m, const method_input *in, float *pdf)
{
    vndf_affine surface = straight(m->state, in->alpha);
    return draw_affine(&surface, in, pdf);
}

static inline vndf_vec3 one_affine(const method *m, const method_input *in, float *pdf)
{
    vndf_affine surface = oblique(m->state, in->alpha);
    return draw_affine(&surface, in, pdf);
}

static inline vndf_vec3 one_two_lobes(const method *m, const method_input *in, float *pdf)
{
    vndf_mixture mixture = two_lobes(m->state, in->alpha);
    vndf_mixture_view view = vndf_mixture_view_from(&mixture, in->wi);
    return vndf_mixture_sample(&view, in->u1, in->u2, pdf, NULL);
}

static void each_diagonal(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one_diagonal, m, in, out);
}

static void each_affine(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one_affine, m, in, out);
}

static void each_two_lobes(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one_two_lobes, m, in, out);
}

/* ---- many samples of one direction ---- */

static vndf_vec3 draw_from_affine(const void *view, float u1, float u2, float *pdf)
{
    return vndf_affine_sample(view, u1, u2, pdf);
}

static vndf_vec3 draw_from_mixture(const void *view, float u1, float u2, float *pdf)
{
    return vndf_mixture_sample(view, u1, u2, pdf, NULL);
}

static void shared_diagonal(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_affine surface = straight(m->state, in->at[0].alpha);
    vndf_affine_view view = vndf_affine_view_from(&surface, in->at[0].wi);
    method_shared_loop(draw_from_affine, &view, in, out);
}

static void shared_affine(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_affine surface = oblique(m->state, in->at[0].alpha);
    vndf_affine_view view = vndf_affine_view_from(&surface, in->at[0].wi);
    method_shared_loop(draw_from_affine, &view, in, out);
}

static void shared_two_lobes(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_mixture mixture = two_lobes(m->state, in->at[0].alpha);
    vndf_mixture_view view = vndf_mixture_view_from(&mixture, in->at[0].wi);
    method_shared_loop(draw_from_mixture, &view, in, out);
}

method method_ours_surface(const vndf_distribution *distribution, const char *name, method_surface surface)
{
    static const struct {
        const char *name;
        method_one *one;
        method_run *each, *shared;
    } surfaces[METHOD_SURFACES] = {{"diagonal", one_diagonal, each_diagonal, shared_diagonal},
                                   {"affine", one_affine, each_affine, shared_affine},
                                   {"two lobes", one_two_lobes, each_two_lobes, shared_two_lobes}};
    vndf_info info = vndf_distribution_info(distribution);
    method m = {.instructions = method_instructions_name(VNDF_INSTRUCTIONS_BEST), .kind = BENCH_CALL};
    m.state = distribution;
    m.memory = info.memory;
    m.file_bytes = info.bytes;
    m.one = surfaces[surface].one;
    m.each = surfaces[surface].each;
    m.shared = surfaces[surface].shared;
    snprintf(m.name, sizeof m.name, "%s: %s", name, surfaces[surface].name);
    return m;
}
