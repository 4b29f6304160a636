/* The exported C as methods of tools/bench, compiled twice: as other scalar methods are, and as a renderer that wants
 * all its processor has. KERNEL_FILE is a kernel that fetches its numbers; METHOD names what is made here. */
#include "bench/methods/vector.h"
#include "export/bench_method.h"

#include KERNEL_FILE

static inline kernel_view view_from(const method *m, vndf_vec3 wi, float alpha)
{
    const bench_exported *is = m->state;
    kernel_surface surface = kernel_surface_of(is->numbers ? 0 : KERNEL_GGX, alpha, alpha);
    return kernel_view_of(is->numbers, surface, kernel_vec3_of(wi.x, wi.y, wi.z));
}

static inline vndf_vec3 draw(const method *m, kernel_view view, float u1, float u2, float *pdf)
{
    const bench_exported *is = m->state;
    kernel_sampled s = kernel_sample(is->numbers, view, u1, u2);
    vndf_vec3 wm = {s.wm.x, s.wm.y, s.wm.z};
    *pdf = s.pdf;
    return wm;
}

static inline vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    return draw(m, view_from(m, in->wi, in->alpha), in->u1, in->u2, pdf);
}

static void each(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one, m, in, out);
}

static void shared(const method *m, const method_inputs *in, const method_outputs *out)
{
    kernel_view view = view_from(m, in->at[0].wi, in->at[0].alpha);
    for (size_t i = 0; i < in->count; i++) {
        float pdf;
        vndf_vec3 wm = draw(m, view, in->at[i].u1, in->at[i].u2, &pdf);
        method_put(out, i, wm, pdf);
    }
}

method METHOD(const bench_exported *is)
{
    return (method){.instructions = "scalar", .state = is, .one = one, .each = each, .shared = shared};
}
