/* Reflection: one routine for each way to draw normals, bare and with whatever Fresnel term and masking, in the
 * principal axes and turned from them. */
#include "bsdf/lobes/reflection.h"

#include "bsdf/lobes/scatter.h"
#include "bsdf/lobes/turned.h"

/* `settled` is 0 where the rounding of wo matters. */
VNDF_INLINE void scatter(const vndf_bsdf *b, const vndf_bsdf_normal *n, vndf_scattered *s, int settled,
                         vndf_choice choice)
{
    vndf_outcome out;
    double f[VNDF_WAVELENGTHS];
    int count = b->material->is.wavelengths;
    settled &= choice.bare || (!b->material->steep && vndf_keeps_reflectance(b, n->facing));
    vndf_leaving to = vndf_leave_reflected(b, n, choice);
    if (!vndf_reflect(b, n, to, choice, settled, &out)) {
        vndf_scatter_nothing(s);
        return;
    }
    vndf_vec3 wm = vndf_leaving_normal(b, n->wm, choice);
    s->wo = choice.bare ? to.wo : vndf_mirrored(to.wo, b->side);
    s->wm = choice.bare ? wm : vndf_mirrored(wm, b->side);
    s->density = vndf_positive(out.density);
    s->lobe = VNDF_LOBE_REFLECTION;
    if (!choice.bare)
        vndf_reflectance(b, out.facing, f);
    for (int i = 0; i < count; i++)
        s->weight[i] = vndf_finite(choice.bare ? out.weight : out.weight * (float)f[i]);
}

/* Whether the density of a bounded normal may stand for that of wo. It jumps in places that the trust of wo does not
 * look for: with no regard to that, 1e-6 of turned samples near the border of the unit square would be off by 2e-5. */
VNDF_INLINE int is_inside(const vndf_bsdf *b, const vndf_bsdf_normal *n, const float u[3], vndf_choice choice)
{
    return !choice.turned && n->quotient > VNDF_TRUST_BOUNDED_AREA * b->area && vndf_trusts_number(u[0]) &&
           vndf_trusts_number(u[1]);
}

VNDF_INLINE void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s, vndf_choice choice)
{
    vndf_bsdf_normal n = vndf_bsdf_draw(b, u[0], u[1], choice.normals);
    scatter(b, &n, s, choice.normals != VNDF_NORMALS_BOUNDED || is_inside(b, &n, u, choice), choice);
}

/* f and its density, where they are asked for. */
VNDF_INLINE void look(const vndf_bsdf *b, vndf_vec3 wo, float *value, float *pdf, vndf_choice choice)
{
    wo.z *= choice.bare ? 1.0f : b->side;
    vndf_half half = vndf_half_reflected(b->view.wi, vndf_to_axes(b, wo, choice));
    if (!(wo.z > 0.0f) || !(half.event.facing_i > 0.0)) {
        vndf_see_nothing(b, value, pdf);
        return;
    }
    if (value)
        vndf_eval_reflection(b, &half, value, choice.bare);
    if (pdf)
        *pdf = vndf_density_from(vndf_half_density(b, &half, choice.normals));
}

/* ---- routines ---- */

/* Named by what is drawn, with the choices of their names. */
#define ROUTINES(name, normals, bare, turned)                                                        \
  static void sample_##name(const vndf_bsdf *b, const float u[3], vndf_scattered *s)                 \
  {                                                                                                  \
    const vndf_choice choice = {normals, bare, turned};                                              \
    sample(b, u, s, choice);                                                                         \
  }                                                                                                  \
  static void eval_##name(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf) \
  {                                                                                                  \
    const vndf_choice choice = {normals, bare, turned};                                              \
    (void)seed;                                                                                      \
    look(b, wo, value, pdf, choice);                                                                 \
  }                                                                                                  \
  static float pdf_##name(const vndf_bsdf *b, vndf_vec3 wo)                                          \
  {                                                                                                  \
    const vndf_choice choice = {normals, bare, turned};                                              \
    float pdf;                                                                                       \
    look(b, wo, NULL, &pdf, choice);                                                                 \
    return pdf;                                                                                      \
  }

ROUTINES(bare_visible, VNDF_NORMALS_VISIBLE, 1, 0)
ROUTINES(bare_bounded, VNDF_NORMALS_BOUNDED, 1, 0)
ROUTINES(bare_all, VNDF_NORMALS_ALL, 1, 0)
ROUTINES(visible, VNDF_NORMALS_VISIBLE, 0, 0)
ROUTINES(bounded, VNDF_NORMALS_BOUNDED, 0, 0)
ROUTINES(all, VNDF_NORMALS_ALL, 0, 0)
ROUTINES(v_cavity, VNDF_NORMALS_V_CAVITY, 0, 0)

ROUTINES(turned_bare_visible, VNDF_NORMALS_VISIBLE, 1, 1)
ROUTINES(turned_bare_bounded, VNDF_NORMALS_BOUNDED, 1, 1)
ROUTINES(turned_bare_all, VNDF_NORMALS_ALL, 1, 1)
ROUTINES(turned_visible, VNDF_NORMALS_VISIBLE, 0, 1)
ROUTINES(turned_bounded, VNDF_NORMALS_BOUNDED, 0, 1)
ROUTINES(turned_all, VNDF_NORMALS_ALL, 0, 1)
ROUTINES(turned_v_cavity, VNDF_NORMALS_V_CAVITY, 0, 1)

/* After the normals of a batch. */
#define SCATTERS(name, bare)                                                                                  \
  static void scatter_##name(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight, const float u[3], \
                             vndf_scattered *s)                                                               \
  {                                                                                                           \
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, bare, 0};                                               \
    vndf_bsdf_normal n = vndf_bsdf_visible(b, wm, density, weight, u[1]);                                     \
    scatter(b, &n, s, 1, choice);                                                                             \
  }

SCATTERS(bare_visible, 1)
SCATTERS(visible, 0)

#define SET(prepare, name, scatter, kind)                          \
  {                                                                \
    prepare, sample_##name, eval_##name, pdf_##name, scatter, kind \
  }
#define ALIGNED(prepare, name) SET(prepare, name, NULL, VNDF_BLOCK_NONE)
#define TURNED(name, normals) SET(vndf_prepare_turned_##normals, turned_##name, NULL, VNDF_BLOCK_NONE)

/* without V-cavities, which have a masking of their own */
const vndf_routines vndf_routines_bare[VNDF_FRAMES][VNDF_NORMALS_COUNT] = {
    {[VNDF_NORMALS_VISIBLE] = SET(vndf_prepare_visible, bare_visible, scatter_bare_visible, VNDF_BLOCK_BARE),
     [VNDF_NORMALS_BOUNDED] = ALIGNED(vndf_prepare_bounded, bare_bounded),
     [VNDF_NORMALS_ALL] = ALIGNED(vndf_prepare_all, bare_all)},
    {[VNDF_NORMALS_VISIBLE] = TURNED(bare_visible, visible),
     [VNDF_NORMALS_BOUNDED] = TURNED(bare_bounded, bounded),
     [VNDF_NORMALS_ALL] = TURNED(bare_all, all)},
};

const vndf_routines vndf_routines_reflection[VNDF_FRAMES][VNDF_NORMALS_COUNT] = {
    {[VNDF_NORMALS_VISIBLE] = SET(vndf_prepare_visible, visible, scatter_visible, VNDF_BLOCK_REFLECTION),
     [VNDF_NORMALS_BOUNDED] = ALIGNED(vndf_prepare_bounded, bounded),
     [VNDF_NORMALS_ALL] = ALIGNED(vndf_prepare_all, all),
     [VNDF_NORMALS_V_CAVITY] = ALIGNED(vndf_prepare_all, v_cavity)},
    {[VNDF_NORMALS_VISIBLE] = TURNED(visible, visible),
     [VNDF_NORMALS_BOUNDED] = TURNED(bounded, bounded),
     [VNDF_NORMALS_ALL] = TURNED(all, all),
     [VNDF_NORMALS_V_CAVITY] = TURNED(v_cavity, all)},
};
