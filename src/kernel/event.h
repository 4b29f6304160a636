/* One scattering event as a material wants it: what Fresnel's term and masking make of a microfacet (lobes.h), and
 * which lobe takes a sample. With G = G2/(wi' wo'), primes for projections on the mean plane, f is F G D (wi.wm)
 * dwm/dwo and (1 - F) of it; with q = A(wi) (visible density)/(density of wm) the weight of a sample is F G wo' q or
 * (1 - F) G |wo'| q.
 *
 * Effects are conditions of a whole material, which exports fold: reflects_of(m) and transmits_of(m), whether it has
 * that lobe; fresnel_of(m), masking_of(m). Who includes this says what a `material` and a `bsdf` are, a hit of one: its
 * material_of(b) and hit_of(b), cosine_at(b, w), the projection on the mean plane, and area_at(b, w). */
#ifndef VNDF_KERNEL_EVENT_H
#define VNDF_KERNEL_EVENT_H

#include "kernel/lobes.h"

/* ---- Fresnel ---- */

/* Of one wavelength. Where light may pass Schlick's term takes the cosine in the thinner medium, so that reflection is
 * total where that has none, and the bare shape reflects what total reflection does. */
KERNEL real reflectance(material m, optics o, seen_cosine c, real eta)
{
    if (fresnel_of(m) == VNDF_FRESNEL_DIELECTRIC)
        return dielectric(c.facing, eta);
    if (fresnel_of(m) == VNDF_FRESNEL_CONDUCTOR)
        return conductor(c.facing, o.n, o.k);
    if (fresnel_of(m) == VNDF_FRESNEL_SCHLICK) {
        real rest = c.rest;
        if (transmits_of(m) && eta < 1.0f)
            rest = refracted_rest(rest, eta);
        return schlick(rest, o.f0);
    }
    if (transmits_of(m) && refracted_square(c.facing, eta) > 0.0f)
        return 0.0f;
    return 1.0f;
}

/* The part of the samples that a lobe takes, if the mean over the wavelengths is reflected. */
KERNEL real part_of(material m, real mean, const int reflects)
{
    real part = 1.0f;
    if (reflects_of(m) && transmits_of(m)) {
        part = mean;
        if (reflects == 0)
            part = 1.0f - mean;
    }
    return part;
}

/* Numbers outside [0, 1] do not choose what never happens. */
KERNEL int chooses_reflection(material m, real mean, real u)
{
    if (!reflects_of(m))
        return 0;
    if (transmits_of(m) && mean < 1.0f && !(mean > 0.0f && u < mean))
        return 0;
    return 1;
}

/* ---- events ---- */

/* At a drawn normal. */
KERNEL event event_at(bsdf b, direction wm, seen_cosine c, const int reflects)
{
    const hit h = hit_of(b);
    event e;
    if (reflects_of(material_of(b)) && reflects != 0)
        e = reflected_at(h.wi, wm, c);
    else if (transmits_of(material_of(b)))
        e = refracted_at(h.wi, wm, c, h.eta);
    e.rise = cosine_at(b, e.up);
    e.met = both(e.met, lt(0.0f, e.rise));
    return e;
}

/* Of two directions; `rise` is the projection of wo, above 0 where light is reflected. */
KERNEL event event_of(bsdf b, direction wo, real rise, const int reflects)
{
    const hit h = hit_of(b);
    event e;
    if (reflects_of(material_of(b)) && reflects != 0) {
        e = reflecting(h.wi, wo);
        if (fresnel_of(material_of(b)) == VNDF_FRESNEL_SCHLICK)
            e.rest = reflecting_rest(e, h.wi, wo);
    } else if (transmits_of(material_of(b))) {
        direction up;
        up.x = -wo.x;
        up.y = -wo.y;
        up.z = -wo.z;
        e = refracting(h.wi, up, h.eta);
    }
    e.rise = abs(rise);
    e.met = both(e.met, lt(0.0f, h.rise));
    return e;
}

/* G; of transmission with what the transport asks for. */
KERNEL real masked(bsdf b, event e, const int reflects)
{
    const hit h = hit_of(b);
    real g = 0.0f, carried = 1.0f;
    if (transmits_of(material_of(b)) && reflects == 0)
        carried = h.carried;
    if (masking_of(material_of(b)) == VNDF_MASKING_V_CAVITIES) {
        if (transmits_of(material_of(b)) && reflects == 0)
            g = passed_in_cavities(h.rise, e.rise, e.facing, e.beyond, e.wm.z);
        else
            g = masked_in_cavities(h.rise, e.rise, e.facing, e.wm.z);
    } else if (masking_of(material_of(b)) == VNDF_MASKING_NONE) {
        g = 1.0f / (h.rise * e.rise);
    } else {
        const real area_o = area_at(b, e.up);
        if (masking_of(material_of(b)) == VNDF_MASKING_SEPARABLE)
            g = masked_apart(h.area, area_o);
        else if (transmits_of(material_of(b)) && reflects == 0)
            g = passed_by_height(h.rise, e.rise, h.area, area_o);
        else
            g = masked_by_height(h.rise, e.rise, h.area, area_o);
    }
    return g * carried;
}

/* f |cosine|/density of a normal with this weight, for F = 1. */
KERNEL real event_weight(bsdf b, event e, real weight, const int reflects)
{
    return masked(b, e, reflects) * e.rise * (hit_of(b).area * weight);
}

/* f for F = 1, of G and D(wm). */
KERNEL real event_value(bsdf b, event e, real g, real ndf)
{
    return hit_of(b).tilt * ndf * e.facing * e.jacobian * g;
}

#endif
