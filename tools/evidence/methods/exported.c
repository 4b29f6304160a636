/* What `vndf export --language c` writes, as one method beside the library's calls: the build writes the kernel
 * (tools/export/write_kernel.c), vndf_numbers gives the numbers. All of it is inlined, since a view that goes through
 * memory by value costs half as much again. */
#include <stdio.h>
#include <stdlib.h>

#include "evidence/methods/vector.h"

#include "exported_kernel.h"

EXPORTED_FUNCTION exported_view view_at(const float *numbers, const method_input *in)
{
    int distribution = numbers ? 0 : EXPORTED_GGX;
    exported_vec3 wi = {in->wi.x, in->wi.y, in->wi.z};
    return exported_view_of(numbers, exported_surface_of(distribution, in->alpha, in->alpha), wi);
}

EXPORTED_FUNCTION vndf_vec3 draw(const float *numbers, exported_view view, const float u[2], float *pdf)
{
    exported_sampled drawn = exported_sample(numbers, view, u[0], u[1]);
    *pdf = drawn.pdf;
    return (vndf_vec3){drawn.wm.x, drawn.wm.y, drawn.wm.z};
}

static vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    return draw(m->state, view_at(m->state, in), in->u, pdf);
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one, m, b, first, count);
}

static void shared(const method *m, block *b, size_t first, size_t count)
{
    const exported_view view = view_at(m->state, &b->in[first]);
    for (size_t i = first; i < first + count; i++) {
        float pdf;
        vndf_vec3 wm = draw(m->state, view, b->in[i].u, &pdf);
        method_put(b, i, wm, pdf);
    }
}

method method_exported(const vndf_distribution *distribution, const char *name)
{
    method m = {.instructions = "scalar", .kind = ROW_EXPORTED, .one = one, .shared = shared, .each = each};
    size_t count = distribution ? vndf_numbers(distribution, NULL, 0) : 0;
    snprintf(m.name, sizeof m.name, "%s, exported C", name);
    if (!count)
        return m;
    float *numbers = malloc(count * sizeof *numbers);
    m.memory = count * sizeof *numbers;
    m.file_bytes = vndf_distribution_info(distribution).bytes;
    m.state = numbers;
    m.release = free;
    if (numbers)
        vndf_numbers(distribution, numbers, count);
    else
        m.each = NULL;
    return m;
}
