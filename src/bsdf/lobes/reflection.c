/* Reflection: one routine for each way to draw normals, bare and with whatever Fresnel term and masking. */
#include "bsdf/lobes/reflection.h"

#include "bsdf/lobes/scatter.h"

/* `settled` is 0 where the rounding of wo matters. */
VNDF_INLINE void scatter(const vndf_bsdf *b, const vndf_bsdf_normal *n, vndf_scattered *s, int settled,
                         vndf_choice choice)
{
    vndf_outcome out;
    double f[VNDF_WAVELENGTHS];
    settled &= choice.bare || (!b->material->steep && vndf_keeps_reflectance(b, n->facing));
    if (!vndf_reflect(b, n, choice, settled, &out)) {
        vndf_scatter_nothing(s);
        return;
    }
    s->wo = choice.bare ? out.wo : vndf_mirrored(out.wo, b->side);
    s->density = vndf_positive(out.density);
    s->lobe = VNDF_LOBE_REFLECTION;
    if (!choice.bare)
        vndf_reflectance(b, out.facing, f);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
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

VNDF_INLINE float pdf(const vndf_bsdf *b, vndf_vec3 wo, vndf_normals_drawn normals)
{
    wo.z *= b->side;
    vndf_half half = vndf_half_reflected(b->view.wi, wo);
    return wo.z > 0.0f && half.event.facing_i > 0.0 ? vndf_density_from(vndf_half_density(b, &half, normals))
                                                    : 0.0f;
}

/* ---- bare ---- */

static void bare_visible(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1};
    sample(b, u, s, choice);
}

static void scatter_bare(const vndf_bsdf *b, vndf_vec3 wm, float density, float u3, vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1};
    vndf_bsdf_normal n = vndf_bsdf_visible(b, wm, density);
    (void)u3;
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

static void eval_bare(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS])
{
    (void)seed;
    vndf_eval_reflection(b, wo, value, 1);
}

/* ---- with Fresnel and masking ---- */

static void sample_visible(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0};
    sample(b, u, s, choice);
}

static void scatter_visible(const vndf_bsdf *b, vndf_vec3 wm, float density, float u3, vndf_scattered *s)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0};
    vndf_bsdf_normal n = vndf_bsdf_visible(b, wm, density);
    (void)u3;
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

static void eval_any(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS])
{
    (void)seed;
    wo.z *= b->side;
    vndf_eval_reflection(b, wo, value, 0);
}

/* ---- densities ---- */

static float pdf_visible(const vndf_bsdf *b, vndf_vec3 wo)
{
    return pdf(b, wo, VNDF_NORMALS_VISIBLE);
}

static float pdf_bounded(const vndf_bsdf *b, vndf_vec3 wo)
{
    return pdf(b, wo, VNDF_NORMALS_BOUNDED);
}

static float pdf_all(const vndf_bsdf *b, vndf_vec3 wo)
{
    return pdf(b, wo, VNDF_NORMALS_ALL);
}

static float pdf_v_cavity(const vndf_bsdf *b, vndf_vec3 wo)
{
    return pdf(b, wo, VNDF_NORMALS_V_CAVITY);
}

const vndf_routines vndf_routines_bare[VNDF_NORMALS_COUNT] = {
    [VNDF_NORMALS_VISIBLE] = {vndf_prepare_visible, bare_visible, eval_bare, pdf_visible, scatter_bare},
    [VNDF_NORMALS_BOUNDED] = {vndf_prepare_bounded, bare_bounded, eval_bare, pdf_bounded, NULL},
    [VNDF_NORMALS_ALL] = {vndf_prepare_all, bare_all, eval_bare, pdf_all, NULL},
    /* V-cavities have a masking of their own */
};

const vndf_routines vndf_routines_reflection[VNDF_NORMALS_COUNT] = {
    [VNDF_NORMALS_VISIBLE] = {vndf_prepare_visible, sample_visible, eval_any, pdf_visible, scatter_visible},
    [VNDF_NORMALS_BOUNDED] = {vndf_prepare_bounded, sample_bounded, eval_any, pdf_bounded, NULL},
    [VNDF_NORMALS_ALL] = {vndf_prepare_all, sample_all, eval_any, pdf_all, NULL},
    [VNDF_NORMALS_V_CAVITY] = {vndf_prepare_all, sample_v_cavity, eval_any, pdf_v_cavity, NULL},
};
