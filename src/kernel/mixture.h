/* Mixtures of lobes on one surface (Heitz & d'Eon 2014 are linear in D; d'Eon et al. 2023): a lobe is chosen by its
 * share of the area, the density is the sum over all, Dv = sum of (w_i A_i/A) Dv_i.
 *
 * Who includes this says what a `view` is, with sample, pdf and visible, and a `mixture_view`, with its_count(m), of
 * lobe i its_view(m, i) and its_share(m, i), and of all its_weights(m) and its_areas(m). Some languages index no
 * parameter: it is copied. */
#ifndef VNDF_KERNEL_MIXTURE_H
#define VNDF_KERNEL_MIXTURE_H

#include "kernel/shares.h"

/* A normal, the density of the whole, and the lobe. */
typedef struct mixed {
    vec3 wm;
    real pdf;
    int lobe;
} mixed;

/* u1 picks a lobe; its part of [0, 1] is stretched to [0, 1]. */
KERNEL mixed mixture_sample(mixture_view given, real w1, real u2)
{
    mixture_view m = given;
    const int count = its_count(m);
    const real u1 = unit_number(w1);
    view lobe = its_view(m, 0);
    real begin = 0.0f, end = 0.0f, share = 1.0f, sum = 0.0f, largest = 0.0f;
    int at = 0;
    for (int i = 0; i < lobe_end(count); i++)
        if (i < count && its_share(m, i) > 0.0f && u1 >= end) { /* the last one takes what rounding leaves */
            at = i;
            lobe = its_view(m, i);
            share = its_share(m, i);
            begin = end;
            end = end + share;
        }
    const sampled one = sample(lobe, (u1 - begin) / share, u2);
    for (int j = 0; j < lobe_end(count); j++)
        if (j < count) {
            real density = one.pdf;
            if (j != at)
                density = pdf(its_view(m, j), one.wm);
            sum = sum + its_share(m, j) * density;
            largest = max(largest, density);
        }
    const mixed n = {one.wm, select(lt(0.0f, one.pdf), lobe_density(sum, largest), 0.0f), at};
    return n;
}

KERNEL real mixture_pdf(mixture_view given, vec3 wm)
{
    mixture_view m = given;
    const int count = its_count(m);
    real sum = 0.0f, largest = 0.0f;
    for (int i = 0; i < lobe_end(count); i++)
        if (i < count) {
            const real density = pdf(its_view(m, i), wm);
            sum = sum + its_share(m, i) * density;
            largest = max(largest, density);
        }
    return lobe_density(sum, largest);
}

KERNEL real mixture_visible(mixture_view given, vec3 wm)
{
    mixture_view m = given;
    const int count = its_count(m);
    lobe_numbers share = lobe_shares(its_weights(m), its_areas(m), count);
    real sum = 0.0f;
    for (int i = 0; i < lobe_end(count); i++)
        if (i < count)
            sum = sum + share.lobe[i] * visible(its_view(m, i), wm);
    return min(sum, 3.4028234e38f);
}

#endif
