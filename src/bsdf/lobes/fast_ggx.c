/* Bare reflection of GGX, the least that a material can be: visible normals, height-correlated masking. All of it
 * in one function, since a call is a tenth of what it costs. The same bits as reflection.c gives. */
#include "bsdf/lobes/fast_ggx.h"
#include "bsdf/lobes/reflection.h"

static int prepare(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_prepare_fast_ggx(b, r, wi) || vndf_prepare_visible(b, r, wi);
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    if (!b->view.trusted) {
        vndf_routines_bare[VNDF_NORMALS_VISIBLE].sample(b, u, s);
        return;
    }
    vndf_ggx_incidence w = vndf_ggx_incidence_of(&b->view);
    lanes_m trusted;
    vndf_drawn drawn = vndf_ggx_draw(&w, vndf_clamp_unit(u[0]), vndf_clamp_unit(u[1]), &trusted);
    if (!trusted) {
        vndf_routines_bare[VNDF_NORMALS_VISIBLE].sample(b, u, s);
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
        vndf_routines_bare[VNDF_NORMALS_VISIBLE].scatter(b, wm, drawn.density, 1.0f, u, s);
        return;
    }
    float weight = wo.z * b->area / vndf_fast_ggx_unmasked(b, wo);
    vndf_set_bare(s, wo, wm, weight,
                  vndf_is_fast_ggx_drawn(b, facing) ? 0.25f * drawn.density / facing
                                                    : vndf_fast_ggx_density(b, wo));
}

/* Whether float is trusted for both directions and their half vector. */
VNDF_INLINE int is_trusted(const vndf_bsdf *b, vndf_vec3 wo)
{
    vndf_vec3 wi = b->view.wi;
    float x = wi.x + wo.x, y = wi.y + wo.y, z = wi.z + wo.z, square = x * x + y * y + z * z;
    return b->view.trusted && wo.z > 0.0f && vndf_is_near_unit(wo) &&
           square > 4.0f * VNDF_TRUST_GGX_FACING * VNDF_TRUST_GGX_FACING;
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    if (!is_trusted(b, wo)) {
        vndf_routines_bare[VNDF_NORMALS_VISIBLE].eval(b, wo, seed, value, pdf);
        return;
    }
    float density = vndf_fast_ggx_density(b, wo);
    float f = vndf_finite(density * (b->area / vndf_fast_ggx_unmasked(b, wo)));
    for (int i = 0; i < b->material->is.wavelengths; i++)
        value[i] = f;
    if (pdf)
        *pdf = vndf_positive(density);
}

static float pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    return is_trusted(b, wo) ? vndf_positive(vndf_fast_ggx_density(b, wo))
                             : vndf_routines_bare[VNDF_NORMALS_VISIBLE].pdf(b, wo);
}

static void scatter(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight, const float u[3],
                    vndf_scattered *s)
{
    vndf_routines_bare[VNDF_NORMALS_VISIBLE].scatter(b, wm, density, weight, u, s);
}

const vndf_routines vndf_routines_bare_ggx = {prepare, sample, eval, pdf, scatter, VNDF_BLOCK_BARE};
