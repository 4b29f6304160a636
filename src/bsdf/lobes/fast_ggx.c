/* Bare reflection of GGX, the least that a material can be: visible normals, height-correlated masking. All of it
 * in one function, since a call is a tenth of what it costs. The same bits as reflection.c gives. */
#include "bsdf/lobes/fast_ggx.h"
#include "bsdf/lobes/reflection.h"
#include "bsdf/lobes/turned.h"

static int prepare(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_prepare_fast_ggx(b, r, wi) || vndf_prepare_visible(b, r, wi);
}

VNDF_INLINE void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s, vndf_choice choice)
{
    const vndf_routines *any = &vndf_routines_bare[choice.turned][VNDF_NORMALS_VISIBLE];
    if (!b->view.trusted) {
        any->sample(b, u, s);
        return;
    }
    vndf_ggx_incidence w = vndf_ggx_incidence_of(&b->view);
    lanes_m trusted;
    vndf_drawn drawn = vndf_ggx_draw(&w, vndf_clamp_unit(u[0]), vndf_clamp_unit(u[1]), &trusted);
    if (!trusted) {
        any->sample(b, u, s);
        return;
    }
    vndf_vec3 wi = b->view.wi, wm = {drawn.x, drawn.y, drawn.z};
    float facing = vndf_dot(wi, wm);
    vndf_vec3 wo = vndf_reflected(wi, wm, facing);
    if (!(wo.z > 0.0f)) {
        vndf_scatter_nothing(s);
        return;
    }
    if (!(facing > VNDF_TRUST_GGX_FACING)) {
        if (choice.turned)
            any->sample(b, u, s);
        else
            any->scatter(b, wm, drawn.density, 1.0f, u, s);
        return;
    }
    vndf_vec3 to = wo; /* turned in float: the density is that of the rounded wo */
    if (choice.turned) {
        vndf_turn_nearly(b, &to);
        vndf_turn_nearly(b, &wm);
    }
    float weight = wo.z * b->area / vndf_fast_ggx_unmasked(b, wo);
    vndf_set_bare(s, to, wm, weight,
                  !choice.turned && vndf_is_fast_ggx_drawn(b, facing)
                      ? 0.25f * drawn.density / facing
                      : vndf_fast_ggx_density(b, vndf_sum_towards(b, to, choice)));
}

/* Whether float is trusted for both directions and h, their sum. */
VNDF_INLINE int is_trusted(const vndf_bsdf *b, vndf_vec3 wo, vndf_vec3 h)
{
    return b->view.trusted && wo.z > 0.0f && vndf_is_near_unit(wo) &&
           vndf_dot(h, h) > 4.0f * VNDF_TRUST_GGX_FACING * VNDF_TRUST_GGX_FACING;
}

VNDF_INLINE void eval(const vndf_bsdf *b, vndf_vec3 wo, float *value, float *pdf, vndf_choice choice)
{
    vndf_vec3 h = vndf_sum_towards(b, wo, choice);
    if (!is_trusted(b, wo, h)) {
        vndf_routines_bare[choice.turned][VNDF_NORMALS_VISIBLE].eval(b, wo, 0, value, pdf);
        return;
    }
    float density = vndf_fast_ggx_density(b, h);
    float f =
        vndf_finite(density * (b->area / vndf_fast_ggx_unmasked(b, vndf_vec3_from(vndf_to_axes(b, wo, choice)))));
    for (int i = 0; i < b->material->is.wavelengths; i++)
        value[i] = f;
    if (pdf)
        *pdf = vndf_positive(density);
}

VNDF_INLINE float pdf(const vndf_bsdf *b, vndf_vec3 wo, vndf_choice choice)
{
    vndf_vec3 h = vndf_sum_towards(b, wo, choice);
    return is_trusted(b, wo, h) ? vndf_positive(vndf_fast_ggx_density(b, h))
                                : vndf_routines_bare[choice.turned][VNDF_NORMALS_VISIBLE].pdf(b, wo);
}

static void scatter(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight, const float u[3],
                    vndf_scattered *s)
{
    vndf_routines_bare[VNDF_FRAME_ALIGNED][VNDF_NORMALS_VISIBLE].scatter(b, wm, density, weight, u, s);
}

static int prepare_turned(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_turn_hit(b, r, &wi) && prepare(b, r, wi);
}

#define ROUTINES(frame, turned)                                                                       \
  static void sample_##frame(const vndf_bsdf *b, const float u[3], vndf_scattered *s)                 \
  {                                                                                                   \
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1, turned};                                     \
    sample(b, u, s, choice);                                                                          \
  }                                                                                                   \
  static void eval_##frame(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf) \
  {                                                                                                   \
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1, turned};                                     \
    (void)seed;                                                                                       \
    eval(b, wo, value, pdf, choice);                                                                  \
  }                                                                                                   \
  static float pdf_##frame(const vndf_bsdf *b, vndf_vec3 wo)                                          \
  {                                                                                                   \
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1, turned};                                     \
    return pdf(b, wo, choice);                                                                        \
  }

ROUTINES(aligned, 0)
ROUTINES(turned, 1)

const vndf_routines vndf_routines_bare_ggx[VNDF_FRAMES] = {
    {prepare, sample_aligned, eval_aligned, pdf_aligned, scatter, VNDF_BLOCK_BARE},
    {prepare_turned, sample_turned, eval_turned, pdf_turned, NULL, VNDF_BLOCK_NONE},
};
