/* Reflection: one routine for each way to draw normals, bare and with whatever Fresnel term and masking. */
#include "bsdf/lobes/reflection.h"

#include "bsdf/lobes/scatter.h"

/* `settled` is 0 where the rounding of wo matters. */
VNDF_INLINE void scatter(const vndf_bsdf *b, const vndf_bsdf_normal *n, vndf_scattered *s, int settled,
                         vndf_choice choice)
{
    vndf_outcome out;
    double f[VNDF_WAVELENGTHS];
    int count = b->material->is.wavelengths;
    settled &= choice.bare || (!b->material->steep && vndf_keeps_reflectance(b, n->facing));
    if (!vndf_reflect(b, n, choice, settled, &out)) {
        vndf_scatter_nothing(s);
        return;
    }
    s->wo = choice.bare ? out.wo : vndf_mirrored(out.wo, b->side);
    s->wm = choice.bare ? n->wm : vndf_mirrored(n->wm, b->side);
    s->density = vndf_positive(out.density);
    s->lobe = VNDF_LOBE_REFLECTION;
    if (!choice.bare)
        vndf_reflectance(b, out.facing, f);
    for (int i = 0; i < count; i++)
        s->weight[i] = vndf_finite(choice.bare ? out.weight : out.weight * (float)f[i]);
}

VNDF_INLINE void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s, vndf_choice choice)
{
    vndf_bsdf_normal n = vndf_bsdf_draw(b, u[0], u[1], choice.normals);
    int bounded = choice.normals == VNDF_NORMALS_BOUNDED;
    scatter(b, &n, s,
            !bounded || (n.quotient > VNDF_TRUST_BOUNDED_AREA * b->area && vndf_trusts_number(u[0]) &&
                         vndf_trusts_number(u[1])),
            choice);
}

/* f and its density, where they are asked for. */
VNDF_INLINE void look(const vndf_bsdf *b, vndf_vec3 wo, float *value, float *pdf, vndf_choice choice)
{
    wo.z *= choice.bare ? 1.0f : b->side;
    vndf_half half = vndf_half_reflected(b->view.wi, wo);
    if (!(wo.z > 0.0f) || !(half.event.facing_i > 0.0)) {
        vndf_see_nothing(b, value, pdf);
        return;
    }
    if (value)
        vndf_eval_reflection(b, &half, value, choice.bare);
    if (pdf)
        *pdf = vndf_density_from(vndf_half_density(b, &half, choice.normals));
}

/* ---- bare ---- */

static void bare_visible(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1};
    sample(b, u, s, choice);
}

static void scatter_bare(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight, const float u[3],
                         vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1};
    vndf_bsdf_normal n = vndf_bsdf_visible(b, wm, density, weight, u[1]);
    scatter(b, &n, s, 1, choice);
}

static void bare_bounded(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_BOUNDED, 1};
    sample(b, u, s, choice);
}

static void bare_all(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_ALL, 1};
    sample(b, u, s, choice);
}

/* ---- with Fresnel and masking ---- */

static void sample_visible(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0};
    sample(b, u, s, choice);
}

static void scatter_visible(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight, const float u[3],
                            vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0};
    vndf_bsdf_normal n = vndf_bsdf_visible(b, wm, density, weight, u[1]);
    scatter(b, &n, s, 1, choice);
}

static void sample_bounded(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_BOUNDED, 0};
    sample(b, u, s, choice);
}

static void sample_all(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_ALL, 0};
    sample(b, u, s, choice);
}

static void sample_v_cavity(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_V_CAVITY, 0};
    sample(b, u, s, choice);
}

/* ---- values and densities ---- */

/* A routine's name, its choice, and which of f and density it is for. */
#define LOOKS(name, normals, bare)                                                                   \
  static void eval_##name(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf) \
  {                                                                                                  \
    const vndf_choice choice = {normals, bare};                                                      \
    (void)seed;                                                                                      \
    look(b, wo, value, pdf, choice);                                                                 \
  }                                                                                                  \
  static float pdf_##name(const vndf_bsdf *b, vndf_vec3 wo)                                          \
  {                                                                                                  \
    const vndf_choice choice = {normals, bare};                                                      \
    float pdf;                                                                                       \
    look(b, wo, NULL, &pdf, choice);                                                                 \
    return pdf;                                                                                      \
  }

LOOKS(bare_visible, VNDF_NORMALS_VISIBLE, 1)
LOOKS(bare_bounded, VNDF_NORMALS_BOUNDED, 1)
LOOKS(bare_all, VNDF_NORMALS_ALL, 1)
LOOKS(visible, VNDF_NORMALS_VISIBLE, 0)
LOOKS(bounded, VNDF_NORMALS_BOUNDED, 0)
LOOKS(all, VNDF_NORMALS_ALL, 0)
LOOKS(v_cavity, VNDF_NORMALS_V_CAVITY, 0)

const vndf_routines vndf_routines_bare[VNDF_NORMALS_COUNT] = {
    [VNDF_NORMALS_VISIBLE] = {vndf_prepare_visible, bare_visible, eval_bare_visible, pdf_bare_visible,
                              scatter_bare, VNDF_BLOCK_BARE},
    [VNDF_NORMALS_BOUNDED] = {vndf_prepare_bounded, bare_bounded, eval_bare_bounded, pdf_bare_bounded, NULL,
                              VNDF_BLOCK_NONE},
    [VNDF_NORMALS_ALL] = {vndf_prepare_all, bare_all, eval_bare_all, pdf_bare_all, NULL, VNDF_BLOCK_NONE},
    /* V-cavities have a masking of their own */
};

const vndf_routines vndf_routines_reflection[VNDF_NORMALS_COUNT] = {
    [VNDF_NORMALS_VISIBLE] = {vndf_prepare_visible, sample_visible, eval_visible, pdf_visible, scatter_visible,
                              VNDF_BLOCK_REFLECTION},
    [VNDF_NORMALS_BOUNDED] = {vndf_prepare_bounded, sample_bounded, eval_bounded, pdf_bounded, NULL,
                              VNDF_BLOCK_NONE},
    [VNDF_NORMALS_ALL] = {vndf_prepare_all, sample_all, eval_all, pdf_all, NULL, VNDF_BLOCK_NONE},
    [VNDF_NORMALS_V_CAVITY] = {vndf_prepare_all, sample_v_cavity, eval_v_cavity, pdf_v_cavity, NULL,
                               VNDF_BLOCK_NONE},
};
