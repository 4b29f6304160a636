/* Bare reflection of GGX where float is trusted: the functions that fast_ggx.c and fast_ggx_bounded.c share. The
 * same bits as reflection.c gives. */
#ifndef VNDF_BSDF_LOBES_FAST_GGX_H
#define VNDF_BSDF_LOBES_FAST_GGX_H

#include "bsdf/lobes/scatter.h"
#include "sampler/analytic/ggx_law.h"

/* A(w), w.z > 0; it is always ready for a trusted view. */
VNDF_INLINE float vndf_fast_ggx_area(const vndf_bsdf *b, vndf_vec3 w)
{
    int ready;
    return vndf_ggx_area_above(b->view.ax, b->view.ay, w.x, w.y, w.z, &ready);
}

/* Sets view and area. Returns 0 and sets nothing where float is not trusted. */
VNDF_INLINE int vndf_prepare_fast_ggx(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    const vndf_surface surface = {b->material->is.distribution, r->alpha_x, r->alpha_y};
    vndf_ggx_incidence w = vndf_ggx_incidence_from(r->alpha_x, r->alpha_y, wi.x, wi.y, wi.z);
    if (!w.trusted)
        return 0;
    vndf_ggx_view_put(&b->view, &surface, wi, &w);
    b->area = vndf_fast_ggx_area(b, wi);
    return 1;
}

VNDF_INLINE float vndf_fast_ggx_unmasked(const vndf_bsdf *b, vndf_vec3 wo)
{
    vndf_incident at = vndf_incident_of(b);
    return vndf_unmasked(&at, wo, vndf_fast_ggx_area(b, wo));
}

/* h = wi + wo */
VNDF_INLINE float vndf_fast_ggx_density(const vndf_bsdf *b, vndf_vec3 h)
{
    vndf_incident at = vndf_incident_of(b);
    return vndf_ggx_density_of(&at, h);
}

/* Whether the sample takes the density of its normal instead. */
VNDF_INLINE int vndf_is_fast_ggx_drawn(const vndf_bsdf *b, float facing)
{
    return vndf_trusts_drawn_ggx(b->view.ax, b->view.ay, facing);
}

VNDF_INLINE void vndf_set_bare(vndf_scattered *s, vndf_vec3 wo, vndf_vec3 wm, float weight, float density)
{
    s->wo.x = wo.x;
    s->wo.y = wo.y;
    s->wo.z = wo.z;
    s->wm.x = wm.x;
    s->wm.y = wm.y;
    s->wm.z = wm.z;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) /* all: no count is waited for */
        s->weight[i] = weight;
    s->density = vndf_positive(density);
    s->lobe = VNDF_LOBE_REFLECTION;
}

#endif
