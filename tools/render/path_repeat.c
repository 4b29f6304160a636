/* The time that paths spend in the library, without a clock in the loop: each of its calls is made twice, the
 * first time for nothing, and what that costs more is the time of one. Paths stay the same to the bit. (The
 * second call finds what it reads in the cache, so this is a little less than the truth.) */
#include "render/path_parts.h"

static int begin_twice(path_point *p)
{
    vndf_bsdf for_nothing;
    vndf_bsdf_at(&for_nothing, &p->material->bsdf, p->wi);
    return p->material->once.begin_plain(p);
}

static int sample_twice(const path_point *p, const float u[3], bounce *b)
{
    vndf_scattered for_nothing;
    vndf_bsdf_sample(&p->bsdf, u, &for_nothing);
    return p->material->once.sample(p, u, b);
}

static void eval_twice(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3])
{
    float for_nothing[3];
    vndf_bsdf_eval(&p->bsdf, wo, seed, for_nothing);
    p->material->once.eval(p, wo, seed, value);
}

static float pdf_twice(const path_point *p, vndf_vec3 wo)
{
    vndf_bsdf_pdf(&p->bsdf, wo);
    return p->material->once.pdf(p, wo);
}

/* ---- perfect sampling: its own tables count as the library's ---- */

static int perfect_begin_twice(path_point *p)
{
    perfect_hit for_nothing;
    path_perfect_begin(&for_nothing, p->material->perfect, &p->material->roughness, p->wi);
    return p->material->once.begin_plain(p);
}

static int perfect_sample_twice(const path_point *p, const float u[3], bounce *b)
{
    vndf_scattered for_nothing;
    path_perfect_sample(&p->perfect, u, &for_nothing);
    return p->material->once.sample(p, u, b);
}

static void perfect_eval_twice(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3])
{
    float for_nothing[3];
    path_perfect_eval(&p->perfect, wo, for_nothing);
    p->material->once.eval(p, wo, seed, value);
}

static float perfect_pdf_twice(const path_point *p, vndf_vec3 wo)
{
    path_perfect_pdf(&p->perfect, wo);
    return p->material->once.pdf(p, wo);
}

/* ---- all ---- */

void path_repeat(path_plan *plan)
{
    static const path_routines twice = {begin_twice, begin_twice, sample_twice, eval_twice, pdf_twice};
    static const path_routines perfect_twice = {perfect_begin_twice, perfect_begin_twice, perfect_sample_twice,
                                                perfect_eval_twice, perfect_pdf_twice};
    for (size_t i = 0; i < plan->scene->material_count; i++) {
        path_material *m = &plan->materials[i];
        if (m->is->kind != MATERIAL_MICROFACET || !m->run.eval)
            continue;
        m->once = m->run;
        m->run = m->perfect ? perfect_twice : twice;
        if (m->once.begin != m->once.begin_plain)
            m->run.begin = m->once.begin;
    }
}
