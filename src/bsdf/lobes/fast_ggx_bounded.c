/* Bare reflection of GGX by bounded normals, all of it in one function, so that time does not cost what variance gains.
 * As fast_ggx.c, but no sample is lost: the weight is inside_mass G2/G1, and the density is that of visible normals, at
 * the rounded wo, over inside_mass. Where rounding changes inside_mass, or float is not
 * trusted, reflection.c samples. */
#include "bsdf/lobes/fast_ggx.h"
#include "bsdf/lobes/reflection.h"
#include "sampler/bounded/ggx_draw.h"

static int prepare(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    if (!vndf_prepare_fast_ggx(b, r, wi))
        return vndf_prepare_bounded(b, r, wi);
    vndf_outlook o = vndf_outlook_set(&b->view, &b->bounds.ggx);
    if (vndf_outlook_is_trusted(&b->view, &o))
        vndf_ggx_law_set(&b->bounds.ggx, &o);
    else
        vndf_bound_ggx_exactly(&b->view, &b->bounds.ggx);
    return 1;
}

static void sample_exactly(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_routines_bare[VNDF_FRAME_ALIGNED][VNDF_NORMALS_BOUNDED].sample(b, u, s);
}

/* How little wo turns when the normal does, beside the roughness: what rounds wo turns the azimuth of the stretched
 * normal by that much more than what rounds the normal. */
VNDF_INLINE float reach_of(const vndf_bsdf *b, float facing)
{
    float ax = b->view.ax, ay = b->view.ay, reach = VNDF_TRUST_BOUNDED_REACH * facing * (ax < ay ? ax : ay);
    return reach < VNDF_TRUST_BOUNDED_REACH_MOST ? reach : VNDF_TRUST_BOUNDED_REACH_MOST;
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_outlook o = vndf_outlook_of(&b->view, &b->bounds.ggx);
    if (!vndf_outlook_is_trusted(&b->view, &o)) {
        sample_exactly(b, u, s);
        return;
    }
    vndf_ggx_bounded n =
        vndf_ggx_draw_bounded(&b->view, &b->bounds.ggx, &o, vndf_clamp_unit(u[0]), vndf_clamp_unit(u[1]));
    /* wi.M = |A wi| cos(g), so neither M nor wi.wm has to be made unit */
    float stretch = 2.0f * b->area - b->view.wi.z, twice = 2.0f * stretch * n.cosine / n.length2;
    float facing = 0.5f * twice * sqrtf(n.length2);
    vndf_vec3 wi = b->view.wi, wo = {twice * n.x - wi.x, twice * n.y - wi.y, twice * n.z - wi.z};
    if (!(vndf_ggx_is_inside(&o, &n) && facing > VNDF_TRUST_GGX_FACING && wo.z > 0.0f &&
          vndf_ggx_is_settled(&b->view, &o, &n, reach_of(b, facing)))) {
        sample_exactly(b, u, s);
        return;
    }
    float weight = wo.z * (b->area * n.inside_mass) / vndf_fast_ggx_unmasked(b, wo);
    float per = 1.0f / sqrtf(n.length2);
    vndf_vec3 wm = {n.x * per, n.y * per, n.z * per};
    vndf_set_bare(s, wo, wm, weight, vndf_fast_ggx_density(b, vndf_sum(wi, wo)) / n.inside_mass);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    vndf_routines_bare[VNDF_FRAME_ALIGNED][VNDF_NORMALS_BOUNDED].eval(b, wo, seed, value, pdf);
}

static float pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    return vndf_routines_bare[VNDF_FRAME_ALIGNED][VNDF_NORMALS_BOUNDED].pdf(b, wo);
}

const vndf_routines vndf_routines_bare_bounded_ggx = {prepare, sample, eval, pdf, NULL, VNDF_BLOCK_NONE};
