/* What `vndf export --language c` writes, as one method beside the library's calls: the build writes the kernel
 * (tools/export/write_kernel.c), vndf_numbers gives the numbers. */
#include <stdio.h>
#include <stdlib.h>

#include "evidence/methods/vector.h"

#include "exported_kernel.h"

static vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    const float *numbers = m->state;
    exported_surface surface = exported_surface_of(numbers ? 0 : EXPORTED_GGX, in->alpha, in->alpha);
    exported_view view = exported_view_of(numbers, surface, (exported_vec3){in->wi.x, in->wi.y, in->wi.z});
    exported_sampled drawn = exported_sample(numbers, view, in->u[0], in->u[1]);
    *pdf = drawn.pdf;
    return (vndf_vec3){drawn.wm.x, drawn.wm.y, drawn.wm.z};
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one, m, b, first, count);
}

method method_exported(const vndf_distribution *distribution, const char *name)
{
    method m = {.kind = ROW_EXPORTED, .each = each};
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
