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

static kernel_surface surface_of(const exported_question *q)
{
    kernel_surface surface = {(int)q->distribution, q->xx, q->xy, q->yx, q->yy, q->mean_x, q->mean_y};
    return surface;
}

static void put(float to[3], kernel_vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
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
