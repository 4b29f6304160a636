/* family FAMILY.vndfs: an exported family at a parameter is the library's mixture:
 * one sample of it is the same within 1e-5. Below the first knot, at knots, between them, above the last. */
#include <stdio.h>

#include "vndf.h"

#include "tails.h"

int main(int argc, char **argv)
{
    vndf_error error;
    vndf_family *family = argc == 2 ? vndf_family_load(argv[1], &error) : NULL;
    const vndf_family_facts facts = vndf_family_info(family);
    int checks = 0, bad = 0;
    for (int i = -8; i <= 200 && family; i++) {
        const float middle = facts.low + (facts.high - facts.low) * (float)i / 192.0f;
        const float p = i >= 0 && (size_t)i < facts.count ? vndf_family_parameter(family, (size_t)i) : middle;
        const vndf_affine shape = {NULL, 0.3f, 0.1f, 0.0f, 0.2f, 0.1f, 0.0f};
        const kernel_surface same = {0, 0.3f, 0.1f, 0.0f, 0.2f, 0.1f, 0.0f};
        vndf_mixture own;
        vndf_family_at(family, p, &shape, &own);
        const kernel_mixture mixture = kernel_family_at(KERNEL_TAILS, p, same);
        const kernel_mixed drawn =
            kernel_mixture_sample(kernel_mixture_view_of(mixture, kernel_vec3_of(0.6f, 0.0f, 0.8f)), 0.3f, 0.7f);
        const vndf_mixture_view view = vndf_mixture_view_from(&own, (vndf_vec3){0.6f, 0.0f, 0.8f});
        float pdf;
        const vndf_vec3 wm = vndf_mixture_sample(&view, 0.3f, 0.7f, &pdf, NULL);
        const double off = (double)(drawn.pdf / pdf) - 1 + (double)(drawn.wm.x - wm.x);
        bad += !(off < 1e-5 && off > -1e-5);
        checks++;
    }
    printf("%d parameters of %zu knots, %d wrong\n", checks, facts.count, bad);
    vndf_family_free(family);
    return !checks || bad;
}
