/* One scattering event, made of a choice of lobes, of normals, of a Fresnel term and of masking. The callers
 * (reflection.c, dielectric.c) pass their choices as constants, so the compiler drops the rest.
 *
 * With q = D(wm) (wi.wm)/p, p the density of wm, and V = G2/(cos_i cos_o), the weight of a reflection is F V
 * cos_o q and that of a transmission (1 - F) V cos_o q, over r^2 for radiance: the Jacobians cancel (Walter et
 * al. 2007, equations 20 and 21),
 *
 *     reflection    dwm/dwo = 1/(4 wi.wm),        transmission    dwm/dwo = r^2 |wo.wm|/|wi + r wo|^2.
 *
 * |wi + r wo| = (r^2 - 1)/(wi.wm + r |wo.wm|) does not cancel where r is near 1. */
#ifndef VNDF_BSDF_LOBES_SCATTER_H
#define VNDF_BSDF_LOBES_SCATTER_H

#include "bsdf/terms/facet.h"
#include "bsdf/terms/fresnel.h"
#include "bsdf/terms/normals.h"
#include "bsdf/trust.h"

VNDF_INLINE vndf_vec3 vndf_vec3_from(vndf_normal n)
{
    return vndf_vec3_of((float)n.x, (float)n.y, (float)n.z);
}

VNDF_INLINE vndf_vec3 vndf_mirrored(vndf_vec3 w, float side)
{
    return vndf_vec3_of(w.x, w.y, side * w.z);
}

VNDF_INLINE void vndf_scatter_nothing(vndf_scattered *s)
{
    const vndf_scattered none = {{0.0f, 0.0f, 1.0f}, {0.0f}, 0.0f, VNDF_LOBE_NONE, {0.0f, 0.0f, 0.0f}};
    *s = none;
}

VNDF_INLINE void vndf_set_value(const vndf_bsdf *b, float *value, double f)
{
    for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
        value[i] = vndf_density_from(f);
}

/* Each wavelength has its part of `shape`: f, or what f leaves of 1. */
VNDF_INLINE void vndf_set_values(const vndf_bsdf *b, float *value, double shape, const double f[VNDF_WAVELENGTHS],
                                 int transmits)
{
    for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
        value[i] = vndf_density_from(shape * (transmits ? 1.0 - f[i] : f[i]));
}

VNDF_INLINE void vndf_see_nothing(const vndf_bsdf *b, float *value, float *pdf)
{
    if (value)
        vndf_set_value(b, value, 0.0);
    if (pdf)
        *pdf = 0.0f;
}

/* ---- the frame of a hit, and its principal axes ---- */

/* Turned by the angle of (c, s). */
VNDF_INLINE vndf_normal vndf_turned_by(double c, double s, vndf_normal w)
{
    vndf_normal turned = {c * w.x - s * w.y, c * w.y + s * w.x, w.z};
    return turned;
}

/* In the axes, and not rounded there. */
VNDF_INLINE vndf_normal vndf_to_axes(const vndf_bsdf *b, vndf_vec3 w, vndf_choice choice)
{
    vndf_normal n = vndf_normal_of(w);
    return choice.turned ? vndf_turned_by(b->axes.cosine, -b->axes.sine, n) : n;
}

/* Back from them, rounded once. */
VNDF_INLINE vndf_vec3 vndf_from_axes(const vndf_bsdf *b, vndf_normal w, vndf_choice choice)
{
    return vndf_vec3_from(choice.turned ? vndf_turned_by(b->axes.cosine, b->axes.sine, w) : w);
}

/* ---- a normal and a direction give the other direction ---- */

/* A sampled direction, turned up: in the frame of the hit, where its rounding counts, and in the axes. */
typedef struct vndf_leaving {
    vndf_vec3 wo, in_axes;
} vndf_leaving;

VNDF_INLINE vndf_leaving vndf_leave(const vndf_bsdf *b, vndf_normal in_axes, vndf_choice choice)
{
    vndf_leaving to = {vndf_from_axes(b, in_axes, choice), vndf_vec3_from(in_axes)};
    return to;
}

/* The same in float, in place: a copy would be waited for. */
VNDF_INLINE void vndf_turn_nearly(const vndf_bsdf *b, vndf_vec3 *w)
{
    float c = b->axes.near_cosine, s = b->axes.near_sine, x = w->x;
    w->x = c * x - s * w->y;
    w->y = c * w->y + s * x;
}

/* A drawn normal as it leaves. */
VNDF_INLINE vndf_vec3 vndf_leaving_normal(const vndf_bsdf *b, vndf_vec3 wm, vndf_choice choice)
{
    if (choice.turned) {
        vndf_turn_nearly(b, &wm);
        wm = vndf_packed(wm);
    }
    return wm;
}

/* wi mirrored at wm. What is turned is rounded no more than what is not: its level part is turned first. */
VNDF_INLINE vndf_leaving vndf_leave_mirrored(const vndf_bsdf *b, vndf_vec3 wm, float facing, vndf_choice choice)
{
    vndf_vec3 wi = b->view.wi, wo = vndf_packed(vndf_reflected(wi, wm, facing));
    vndf_leaving to = {wo, wo};
    if (choice.turned) {
        double twice = 2.0 * facing;
        vndf_normal level = {twice * wm.x - wi.x, twice * wm.y - wi.y, 0.0};
        vndf_vec3 turned = vndf_from_axes(b, level, choice);
        to.wo = vndf_vec3_of(turned.x, turned.y, wo.z);
    }
    return to;
}

/* wi + wo, of which vndf_ggx_density_of is the density; wo is in the frame of the hit. */
VNDF_INLINE vndf_vec3 vndf_sum_towards(const vndf_bsdf *b, vndf_vec3 wo, vndf_choice choice)
{
    vndf_vec3 wi = b->view.wi;
    if (!choice.turned)
        return vndf_sum(wi, wo);
    vndf_normal o = vndf_to_axes(b, wo, choice);
    vndf_vec3 sum = {(float)(wi.x + o.x), (float)(wi.y + o.y), wi.z + wo.z};
    return sum;
}

VNDF_INLINE vndf_normal vndf_unit(vndf_vec3 w)
{
    return vndf_unit_of(vndf_normal_of(w));
}

VNDF_INLINE vndf_meeting vndf_meeting_of(vndf_vec3 wi, vndf_vec3 wm)
{
    return vndf_meet(vndf_normal_of(wi), vndf_normal_of(wm));
}

/* ---- two directions give the normal ---- */

/* A microfacet that takes wi to wo; facing_i <= 0 if there is none. Both are in the axes, wo is turned up. */
typedef struct vndf_half {
    vndf_normal wm;
    vndf_event event;
    double jacobian; /* dwm/dwo */
} vndf_half;

VNDF_INLINE vndf_half vndf_half_of(const vndf_facet *f, vndf_vec3 wo)
{
    vndf_event e = {wo, f->cos_i, f->cos_o, f->facing_i, f->facing_o, f->wm.z};
    vndf_half half = {f->wm, e, f->jacobian};
    return half;
}

VNDF_INLINE vndf_half vndf_half_reflected(vndf_vec3 wi, vndf_normal wo)
{
    vndf_facet f = vndf_facet_reflecting(vndf_normal_of(wi), wo);
    return vndf_half_of(&f, vndf_vec3_from(wo));
}

VNDF_INLINE vndf_half vndf_half_refracted(vndf_vec3 wi, vndf_normal wo, double eta)
{
    vndf_facet f = vndf_facet_refracting(vndf_normal_of(wi), wo, eta);
    return vndf_half_of(&f, vndf_mirrored(vndf_vec3_from(wo), -1.0f));
}

/* ---- densities of two directions ---- */

VNDF_INLINE int vndf_is_refraction(const vndf_half *half)
{
    return half->event.facing_i > 0.0 && half->event.facing_o > 0.0;
}

VNDF_INLINE double vndf_half_density(const vndf_bsdf *b, const vndf_half *half, vndf_normals_drawn normals)
{
    return vndf_bsdf_density(b, half->wm, normals) * half->jacobian;
}

/* ---- samples ---- */

VNDF_INLINE void vndf_reflectance(const vndf_bsdf *b, double cosine, double f[VNDF_WAVELENGTHS])
{
    b->material->fresnel->reflectance(&b->material->is, cosine, b->eta, f);
}

/* A sample without its direction and its Fresnel term. */
typedef struct vndf_outcome {
    double facing;
    float density, weight;
    int settled;
} vndf_outcome;

VNDF_INLINE int vndf_keeps_reflectance(const vndf_bsdf *b, double facing)
{
    return !vndf_loses_reflectance(facing, b->eta);
}

/* Of a rounded wo, in the axes. 0 if no microfacet does that. */
int vndf_reflect_exactly(const vndf_bsdf *b, const vndf_normal *wo, vndf_outcome *out);
int vndf_refract_exactly(const vndf_bsdf *b, const vndf_normal *wo, vndf_outcome *out);

/* Where a drawn normal reflects to: bounded ones to above the horizon, but for rounding. */
VNDF_INLINE vndf_leaving vndf_leave_reflected(const vndf_bsdf *b, const vndf_bsdf_normal *n, vndf_choice choice)
{
    vndf_leaving to = vndf_leave_mirrored(b, n->wm, n->facing, choice);
    if (choice.normals == VNDF_NORMALS_BOUNDED && !(to.wo.z > FLT_MIN))
        to.wo.z = to.in_axes.z = FLT_MIN;
    return to;
}

/* 0 if the sample is lost; `settled` is 0 where it has to be evaluated at wo in any case. The half vector of wi
 * and wo is wm, whatever length wm has by rounding. */
VNDF_INLINE int vndf_reflect(const vndf_bsdf *b, const vndf_bsdf_normal *n, vndf_leaving to, vndf_choice choice,
                             int settled, vndf_outcome *out)
{
    vndf_incident at = vndf_incident_of(b);
    vndf_vec3 wo = to.in_axes;
    if (!(wo.z > 0.0f)) /* as where facing < 0 */
        return 0;
    vndf_reflection_trust trust = vndf_trust_reflection(&at, n, choice);
    int trusted = settled & trust.trusted;
    if (!trusted) {
        vndf_normal reflected = vndf_to_axes(b, to.wo, choice);
        if (vndf_reflect_exactly(b, &reflected, out))
            return 1;
        if (choice.normals != VNDF_NORMALS_BOUNDED)
            return 0;
    }
    /* A bounded normal is never lost, not even where the density of the rounded direction underflows. */
    float density =
        !trusted ? FLT_MIN : vndf_reflected_density(&at, n, vndf_sum_towards(b, to.wo, choice), trust.as_drawn);
    out->facing = n->facing;
    out->settled = 1;
    if (choice.bare) {
        out->weight = wo.z * n->quotient / vndf_unmasked(&at, wo, vndf_bsdf_area(b, wo));
        out->density = density;
        return 1;
    }
    vndf_event e = {wo, at.wi.z, wo.z, n->facing, n->facing, n->wm.z};
    out->weight = (float)(b->material->masking->reflection(b, &e) * e.cos_o * n->quotient);
    out->density = density;
    return 1;
}

/* Where a facet refracts to; `beyond` is the cosine to wm on the other side. */
VNDF_INLINE vndf_leaving vndf_leave_refracted(const vndf_bsdf *b, const vndf_meeting *at, double beyond,
                                              vndf_choice choice)
{
    return vndf_leave(b, vndf_bent(at, vndf_bend_along(at, beyond, b->eta), b->eta), choice);
}

/* The same as vndf_reflect. wo turns with wm by along/eta. */
VNDF_INLINE int vndf_refract(const vndf_bsdf *b, const vndf_bsdf_normal *n, const vndf_meeting *at, double beyond,
                             vndf_leaving to, vndf_choice choice, vndf_outcome *out)
{
    double eta = b->eta, along = vndf_bend_along(at, beyond, eta), rise = eta * eta - 1.0;
    vndf_vec3 wi = b->view.wi, wo = to.in_axes;
    if (!(wo.z < 0.0f) || !(n->facing > 0.0f))
        return 0;
    float gain = vndf_refraction_gain((float)fabs(along / eta), n->wm.z);
    vndf_incident from = vndf_incident_of(b);
    int trusted = vndf_trusts_refraction(at, beyond) && vndf_is_settled(&from, n, gain);
    if (rise != 0.0 && !trusted) {
        vndf_normal refracted = vndf_to_axes(b, to.wo, choice);
        return vndf_refract_exactly(b, &refracted, out);
    }
    vndf_event e = {vndf_mirrored(wo, -1.0f), wi.z, -wo.z, at->facing, beyond, n->wm.z};
    out->facing = at->facing;
    out->density = vndf_density_from(vndf_bent_density(at, n->density, beyond, eta));
    out->weight = (float)(b->material->masking->transmission(b, &e) * e.cos_o * n->quotient);
    out->settled = 1;
    return 1;
}

/* ---- values ---- */

/* f of a reflection where F is 1. */
VNDF_INLINE double vndf_reflection_shape(const vndf_bsdf *b, const vndf_half *half)
{
    return 0.25 * vndf_bsdf_ndf(b, half->wm) * b->material->masking->reflection(b, &half->event);
}

/* f of a reflection; `bare` as above. */
VNDF_INLINE void vndf_eval_reflection(const vndf_bsdf *b, const vndf_half *half, float *value, int bare)
{
    double f[VNDF_WAVELENGTHS], shape = vndf_reflection_shape(b, half);
    if (bare) {
        vndf_set_value(b, value, shape);
        return;
    }
    vndf_reflectance(b, half->event.facing_i, f);
    vndf_set_values(b, value, shape, f, 0);
}

/* The part of the samples that is reflected: the mean over the wavelengths. */
VNDF_INLINE double vndf_mean_of(const vndf_bsdf *b, const double f[VNDF_WAVELENGTHS])
{
    int count = b->material->is.wavelengths;
    double sum = f[0];
    for (int i = 1; i < count; i++)
        sum += f[i];
    return sum * b->material->per_wavelength;
}

#endif
