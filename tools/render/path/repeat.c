/* Measures the time that paths spend in the library without a clock in the loop: each routine of a rough material
 * runs twice, the first time for nothing; the extra time is the time of one run. Paths stay the same to the bit.
 * The second run finds its data in the cache, so the result is too low. The few lines of rough.c about each call -
 * a multiplication by a colour, the look-up of a mapped roughness - count as the library's, so it is too high.
 * Maps of colours do not count. With perfect sampling its own tables count as the library's. */
#include "render/path/parts.h"

static int begin_twice(path_point *p)
{
    p->material->once.begin_plain(p);
    return p->material->once.begin_plain(p);
}

static int sample_twice(const path_point *p, const float u[3], bounce *b)
{
    bounce for_nothing;
    p->material->once.sample(p, u, &for_nothing);
    return p->material->once.sample(p, u, b);
}

static float eval_twice(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3])
{
    float for_nothing[3];
    p->material->once.eval(p, wo, seed, for_nothing);
    return p->material->once.eval(p, wo, seed, value);
}

static float pdf_twice(const path_point *p, vndf_vec3 wo)
{
    p->material->once.pdf(p, wo);
    return p->material->once.pdf(p, wo);
}

void path_repeat(path_plan *plan)
{
    static const path_routines twice = {begin_twice, begin_twice, sample_twice, eval_twice, pdf_twice};
    for (size_t i = 0; i < plan->scene->material_count; i++) {
        path_material *m = &plan->materials[i];
        if (!m->run.eval || m->is->kind != MATERIAL_MICROFACET)
            continue;
        m->once = m->run;
        m->run = twice;
        if (m->once.begin != m->once.begin_plain)
            m->run.begin = m->once.begin; /* a map of colours: begin calls begin_plain, which runs twice */
    }
}
