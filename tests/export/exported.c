/* A kernel of `vndf export` behind calls of the tests. It is compiled as C99 and as C++11, by several compilers:
 * KERNEL_FILE is what was exported with the prefix `kernel`; where it has no numbers, KERNEL_RAW is the file that
 * has them. */
#include "exported.h"

#include KERNEL_FILE

#ifdef KERNEL_RAW
#  include <stdio.h>
#  include <stdlib.h>

/* Read once, and never freed. */
static const float *numbers_read(void)
{
    static float *numbers;
    FILE *file = numbers ? NULL : fopen(KERNEL_RAW, "rb");
    if (!file)
        return numbers;
    numbers = (float *)calloc(1u << 20, sizeof *numbers);
    if (!numbers || fread(numbers, sizeof *numbers, 1u << 20, file) == 0)
        abort();
    fclose(file);
    return numbers;
}
#  define AT numbers_read(),
#else
#  define AT
#endif

static kernel_vec3 vector(const float v[3])
{
    return kernel_vec3_of(v[0], v[1], v[2]);
}

static void put(float to[3], kernel_vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

#ifdef KERNEL_SCATTERS /* the file is a BSDF; the word says which optics its material has */

static kernel_material material_of(const exported_hit *q)
{
    kernel_surface surface = {
        (int)q->of.distribution, q->of.xx, q->of.xy, q->of.yx, q->of.yy, q->of.mean_x, q->of.mean_y};
    const float f0[] = EXPORTED_F0, n[] = EXPORTED_CONDUCTOR_ETA, k[] = EXPORTED_CONDUCTOR_K;
    kernel_material m;
    memset(&m, 0, sizeof m);
    m.surface = surface;
    (void)f0;
    (void)n;
    (void)k;
#  ifdef KERNEL_INDEXED
    m.eta = EXPORTED_ETA;
#  endif
#  ifdef KERNEL_SCHLICK
    m.f0 = vector(f0);
#  endif
#  ifdef KERNEL_CONDUCTOR
    m.conductor_eta = vector(n);
    m.conductor_k = vector(k);
#  endif
    return m;
}

void exported_scatter_at(const exported_hit *q, exported_scattered *a)
{
    kernel_bsdf b = kernel_bsdf_of(AT material_of(q), vector(q->wi));
    kernel_scattered s = kernel_bsdf_sample(AT b, vector(q->u));
    put(a->wo, s.wo);
    put(a->weight, s.weight);
    a->sampled = s.pdf;
    a->lobe = (float)s.lobe;
    put(a->f, kernel_bsdf_eval(AT b, vector(q->wo)));
    a->pdf = kernel_bsdf_pdf(AT b, vector(q->wo));
    put(a->own_f, kernel_bsdf_eval(AT b, s.wo));
    a->own_pdf = kernel_bsdf_pdf(AT b, s.wo);
}

#else

static kernel_surface surface_of(const exported_question *q)
{
    kernel_surface surface = {
        (int)q->of.distribution, q->of.xx, q->of.xy, q->of.yx, q->of.yy, q->of.mean_x, q->of.mean_y};
    return surface;
}

static void answer_mixture(const exported_question *q, exported_answer *a)
{
    kernel_mixture mixture = {2, {surface_of(q), kernel_surface_of(KERNEL_GGX, 0.3f, 0.3f)}, {0.6f, 0.4f}};
    kernel_mixture_view view = kernel_mixture_view_of(AT mixture, vector(q->wi));
    kernel_sampled drawn = kernel_mixture_sample(AT view, q->u1, q->u2);
    put(a->mixed, drawn.wm);
    a->mixed_sampled = drawn.pdf;
    a->mixed_pdf = kernel_mixture_pdf(AT view, drawn.wm);
}

void exported_answer_to(const exported_question *q, exported_answer *a)
{
    kernel_surface surface = surface_of(q);
    kernel_vec3 wi = vector(q->wi);
    kernel_view view = kernel_view_of(AT surface, wi);
    kernel_sampled drawn = kernel_sample(AT view, q->u1, q->u2);
    put(a->wm, drawn.wm);
    a->sampled = drawn.pdf;
    a->pdf = kernel_pdf(AT view, drawn.wm);
    a->visible = kernel_visible(AT view, drawn.wm);
    a->ndf = kernel_ndf(AT surface, drawn.wm);
    a->lambda = kernel_lambda(AT surface, wi);
    a->g1 = kernel_g1(AT surface, wi);
    a->g2 = kernel_g2(AT surface, wi, drawn.wm);
    a->area = kernel_projected_area(view);
    answer_mixture(q, a);
}

#endif
