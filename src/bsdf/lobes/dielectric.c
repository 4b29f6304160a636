/* Transmission, alone and with reflection: one routine for each way to draw normals, in the principal axes and turned
 * from them. */
#include "bsdf/lobes/dielectric.h"

#include "bsdf/lobes/scatter.h"
#include "bsdf/lobes/turned.h"

/* A reflection that `part` of the samples take. */
VNDF_INLINE void set_reflected(const vndf_bsdf *b, vndf_vec3 wo, vndf_vec3 wm, const vndf_outcome *out,
                               const double *f, double part, vndf_scattered *s)
{
    s->wo = vndf_mirrored(wo, b->side);
    s->wm = vndf_mirrored(wm, b->side);
    s->density = vndf_positive(out->density * (float)part);
    s->lobe = VNDF_LOBE_REFLECTION;
    for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
        s->weight[i] = vndf_finite(out->weight * (float)(f[i] / part));
}

VNDF_INLINE void set_refracted(const vndf_bsdf *b, vndf_vec3 wo, vndf_vec3 wm, const vndf_outcome *out,
                               const double *f, double part, vndf_scattered *s)
{
    int straight = b->eta == 1.0;
    s->wo = vndf_mirrored(wo, b->side);
    s->wm = vndf_mirrored(wm, b->side);
    s->density = straight ? 1.0f : vndf_positive(out->density * (float)part);
    s->lobe = straight ? VNDF_LOBE_STRAIGHT : VNDF_LOBE_TRANSMISSION;
    for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
        s->weight[i] = vndf_finite(out->weight * (float)(b->carried * ((1.0 - f[i]) / part)));
}

VNDF_INLINE void scatter_through(const vndf_bsdf *b, const vndf_bsdf_normal *n, vndf_scattered *s,
                                 vndf_choice choice)
{
    vndf_meeting at = vndf_meeting_of(b->view.wi, n->wm);
    double f[VNDF_WAVELENGTHS], square = vndf_refracted_square(at.facing, b->eta), beyond = sqrt(square);
    vndf_outcome out;
    vndf_leaving to = vndf_leave_refracted(b, &at, beyond, choice);
    if (!(square > 0.0) || !vndf_refract(b, n, &at, beyond, to, choice, &out)) { /* reflected totally, or masked */
        vndf_scatter_nothing(s);
        return;
    }
    vndf_reflectance(b, out.facing, f);
    set_refracted(b, to.wo, vndf_leaving_normal(b, n->wm, choice), &out, f, 1.0, s);
}

/* The drawn normal chooses the lobe. Density and weight then take F at the same cosine as the outcome. */
VNDF_INLINE void scatter_both(const vndf_bsdf *b, const vndf_bsdf_normal *n, float u3, vndf_scattered *s,
                              vndf_choice choice)
{
    vndf_meeting at = vndf_meeting_of(b->view.wi, n->wm);
    vndf_outcome out;
    double f[VNDF_WAVELENGTHS];
    vndf_reflectance(b, at.facing, f);
    double square = vndf_refracted_square(at.facing, b->eta);
    double part = vndf_mean_of(b, f); /* numbers outside [0, 1] do not choose what never happens */
    int reflects = (part > 0.0 && u3 < part) || !(part < 1.0 && square > 0.0);
    int settled = vndf_keeps_reflectance(b, at.facing);
    double beyond = reflects ? 0.0 : sqrt(square);
    vndf_leaving to = reflects ? vndf_leave_reflected(b, n, choice) : vndf_leave_refracted(b, &at, beyond, choice);
    if (!(reflects ? vndf_reflect(b, n, to, choice, settled, &out)
                   : vndf_refract(b, n, &at, beyond, to, choice, &out))) {
        vndf_scatter_nothing(s);
        return;
    }
    if (!out.settled) {
        vndf_reflectance(b, out.facing, f);
        part = vndf_mean_of(b, f);
    }
    vndf_vec3 wm = vndf_leaving_normal(b, n->wm, choice);
    if (reflects)
        set_reflected(b, to.wo, wm, &out, f, part, s);
    else if (part < 1.0)
        set_refracted(b, to.wo, wm, &out, f, 1.0 - part, s);
    else
        vndf_scatter_nothing(s);
}

VNDF_INLINE void sample_through(const vndf_bsdf *b, const float u[3], vndf_scattered *s, vndf_choice choice)
{
    vndf_bsdf_normal n = vndf_bsdf_draw(b, u[0], u[1], choice.normals);
    scatter_through(b, &n, s, choice);
}

VNDF_INLINE void sample_both(const vndf_bsdf *b, const float u[3], vndf_scattered *s, vndf_choice choice)
{
    vndf_bsdf_normal n = vndf_bsdf_draw(b, u[0], u[1], choice.normals);
    scatter_both(b, &n, u[2], s, choice);
}

/* ---- values and densities ---- */

VNDF_INLINE void eval_transmission(const vndf_bsdf *b, const vndf_half *half, const double f[VNDF_WAVELENGTHS],
                                   float *value)
{
    double shape = vndf_bsdf_ndf(b, half->wm) * half->event.facing_i * half->jacobian * b->carried *
                   b->material->masking->transmission(b, &half->event);
    vndf_set_values(b, value, shape, f, 1);
}

VNDF_INLINE void look_through(const vndf_bsdf *b, vndf_vec3 wo, float *value, float *pdf, vndf_choice choice)
{
    double f[VNDF_WAVELENGTHS];
    wo.z *= b->side;
    vndf_half half = vndf_half_refracted(b->view.wi, vndf_to_axes(b, wo, choice), b->eta);
    if (!(wo.z < 0.0f) || !vndf_is_refraction(&half)) {
        vndf_see_nothing(b, value, pdf);
        return;
    }
    if (value) {
        vndf_reflectance(b, half.event.facing_i, f);
        eval_transmission(b, &half, f, value);
    }
    if (pdf)
        *pdf = vndf_density_from(vndf_half_density(b, &half, choice.normals));
}

/* The density is that of the lobe times the part of the samples that go this way. */
VNDF_INLINE void look_both(const vndf_bsdf *b, vndf_vec3 wo, float *value, float *pdf, vndf_choice choice)
{
    double f[VNDF_WAVELENGTHS];
    wo.z *= b->side;
    int reflects = wo.z > 0.0f;
    vndf_normal o = vndf_to_axes(b, wo, choice);
    vndf_half half = reflects ? vndf_half_reflected(b->view.wi, o) : vndf_half_refracted(b->view.wi, o, b->eta);
    if (!(wo.z != 0.0f) || !vndf_is_refraction(&half)) { /* or reflection: both cosines are the same there */
        vndf_see_nothing(b, value, pdf);
        return;
    }
    vndf_reflectance(b, half.event.facing_i, f);
    if (value && reflects)
        vndf_set_values(b, value, vndf_reflection_shape(b, &half), f, 0);
    else if (value)
        eval_transmission(b, &half, f, value);
    double part = reflects ? vndf_mean_of(b, f) : 1.0 - vndf_mean_of(b, f);
    if (pdf)
        *pdf = vndf_density_from(part * vndf_half_density(b, &half, choice.normals));
}

/* ---- routines ---- */

/* Of the lobes that are named, with the choices of the name. */
#define ROUTINES(lobes, name, normals, turned)                                                                 \
  static void sample_##lobes##_##name(const vndf_bsdf *b, const float u[3], vndf_scattered *s)                 \
  {                                                                                                            \
    const vndf_choice choice = {normals, 0, turned};                                                           \
    sample_##lobes(b, u, s, choice);                                                                           \
  }                                                                                                            \
  static void eval_##lobes##_##name(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf) \
  {                                                                                                            \
    const vndf_choice choice = {normals, 0, turned};                                                           \
    (void)seed;                                                                                                \
    look_##lobes(b, wo, value, pdf, choice);                                                                   \
  }                                                                                                            \
  static float pdf_##lobes##_##name(const vndf_bsdf *b, vndf_vec3 wo)                                          \
  {                                                                                                            \
    const vndf_choice choice = {normals, 0, turned};                                                           \
    float pdf;                                                                                                 \
    look_##lobes(b, wo, NULL, &pdf, choice);                                                                   \
    return pdf;                                                                                                \
  }

ROUTINES(through, visible, VNDF_NORMALS_VISIBLE, 0)
ROUTINES(through, all, VNDF_NORMALS_ALL, 0)
ROUTINES(through, v_cavity, VNDF_NORMALS_V_CAVITY, 0)
ROUTINES(both, visible, VNDF_NORMALS_VISIBLE, 0)
ROUTINES(both, all, VNDF_NORMALS_ALL, 0)
ROUTINES(both, v_cavity, VNDF_NORMALS_V_CAVITY, 0)

ROUTINES(through, turned_visible, VNDF_NORMALS_VISIBLE, 1)
ROUTINES(through, turned_all, VNDF_NORMALS_ALL, 1)
ROUTINES(through, turned_v_cavity, VNDF_NORMALS_V_CAVITY, 1)
ROUTINES(both, turned_visible, VNDF_NORMALS_VISIBLE, 1)
ROUTINES(both, turned_all, VNDF_NORMALS_ALL, 1)
ROUTINES(both, turned_v_cavity, VNDF_NORMALS_V_CAVITY, 1)

/* After the normals of a batch. */
static void through_drawn(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight, const float u[3],
                          vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0, 0};
    vndf_bsdf_normal n = vndf_bsdf_visible(b, wm, density, weight, u[1]);
    scatter_through(b, &n, s, choice);
}

static void both_drawn(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight, const float u[3],
                       vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0, 0};
    vndf_bsdf_normal n = vndf_bsdf_visible(b, wm, density, weight, u[1]);
    scatter_both(b, &n, u[2], s, choice);
}

#define SET(prepare, name, scatter, kind)                          \
  {                                                                \
    prepare, sample_##name, eval_##name, pdf_##name, scatter, kind \
  }
#define ALIGNED(prepare, name) SET(prepare, name, NULL, VNDF_BLOCK_NONE)
#define TURNED(lobes, name, normals) \
  SET(vndf_prepare_turned_##normals, lobes##_turned_##name, NULL, VNDF_BLOCK_NONE)

const vndf_routines vndf_routines_transmission[VNDF_FRAMES][VNDF_NORMALS_COUNT] = {
    {[VNDF_NORMALS_VISIBLE] = SET(vndf_prepare_visible, through_visible, through_drawn, VNDF_BLOCK_NONE),
     [VNDF_NORMALS_ALL] = ALIGNED(vndf_prepare_all, through_all),
     [VNDF_NORMALS_V_CAVITY] = ALIGNED(vndf_prepare_all, through_v_cavity)},
    {[VNDF_NORMALS_VISIBLE] = TURNED(through, visible, visible),
     [VNDF_NORMALS_ALL] = TURNED(through, all, all),
     [VNDF_NORMALS_V_CAVITY] = TURNED(through, v_cavity, all)},
};

const vndf_routines vndf_routines_both[VNDF_FRAMES][VNDF_NORMALS_COUNT] = {
    {[VNDF_NORMALS_VISIBLE] = SET(vndf_prepare_visible, both_visible, both_drawn, VNDF_BLOCK_BOTH),
     [VNDF_NORMALS_ALL] = ALIGNED(vndf_prepare_all, both_all),
     [VNDF_NORMALS_V_CAVITY] = ALIGNED(vndf_prepare_all, both_v_cavity)},
    {[VNDF_NORMALS_VISIBLE] = TURNED(both, visible, visible),
     [VNDF_NORMALS_ALL] = TURNED(both, all, all),
     [VNDF_NORMALS_V_CAVITY] = TURNED(both, v_cavity, all)},
};
