/* Bare reflection of GGX, the least that a material can be: visible normals, height-correlated masking. All of it
 * in one function, since a call is a tenth of what it costs. The same bits as reflection.c gives. */
#include "bsdf/reflection.h"
#include "bsdf/scatter.h"
#include "sampler/closed_view.h"

static int prepare(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    const vndf_surface surface = {b->material->is.distribution, r->alpha_x, r->alpha_y};
    vndf_ggx_incidence w = vndf_ggx_aim(r->alpha_x, r->alpha_y, wi.x, wi.y, wi.z);
    float x = r->alpha_x * wi.x, y = r->alpha_y * wi.y;
    if (!w.plain)
        return vndf_prepare_visible(b, r, wi);
    vndf_ggx_view_set(&b->view, &surface, wi, &w);
    b->area = 0.5f * (wi.z + sqrtf(x * x + y * y + wi.z * wi.z));
    return 1;
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_ggx_incidence w = vndf_ggx_incidence_of(&b->view);
    lanes_m plain;
    vndf_drawn drawn = vndf_ggx_draw(&w, vndf_clamp_unit(u[0]), vndf_clamp_unit(u[1]), &plain);
    if (!plain) {
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
    int as_drawn = vndf_is_ggx_drawn(b, facing);
    if (!(facing > VNDF_GGX_LEAST_FACING)) {
        vndf_routines_bare[VNDF_NORMALS_VISIBLE].scatter(b, wm, drawn.density, u[2], s);
        return;
    }
    float x = w.ax * wo.x, y = w.ay * wo.y, below = 0.5f * (wo.z + sqrtf((x * x + y * y) + wo.z * wo.z)) - wo.z;
    float weight = wo.z * b->area / (wo.z * b->area + wi.z * lanes_positive(below));
    s->wo.x = wo.x;
    s->wo.y = wo.y;
    s->wo.z = wo.z;
    s->weight[0] = s->weight[1] = s->weight[2] = weight;
    s->density = vndf_positive(as_drawn ? 0.25f * drawn.density / facing : vndf_ggx_density_of(b, wo));
    s->lobe = VNDF_LOBE_REFLECTION;
}

/* Whether both directions are of plain size and their half vector has its digits. */
VNDF_INLINE int is_plain(const vndf_bsdf *b, vndf_vec3 wo)
{
    vndf_vec3 wi = b->view.wi;
    float x = wi.x + wo.x, y = wi.y + wo.y, z = wi.z + wo.z, square = x * x + y * y + z * z;
    return b->view.plain && wo.z > 0.0f && vndf_is_near_unit(wo) &&
           square > 4.0f * VNDF_GGX_LEAST_FACING * VNDF_GGX_LEAST_FACING;
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS])
{
    if (!is_plain(b, wo)) {
        vndf_routines_bare[VNDF_NORMALS_VISIBLE].eval(b, wo, seed, value);
        return;
    }
    float x = b->view.ax * wo.x, y = b->view.ay * wo.y;
    float below = 0.5f * (wo.z + sqrtf((x * x + y * y) + wo.z * wo.z)) - wo.z;
    float over = wo.z * b->area + b->view.wi.z * lanes_positive(below);
    value[0] = value[1] = value[2] = vndf_finite(vndf_ggx_density_of(b, wo) * (b->area / over));
}

static float pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    return is_plain(b, wo) ? vndf_positive(vndf_ggx_density_of(b, wo))
                           : vndf_routines_bare[VNDF_NORMALS_VISIBLE].pdf(b, wo);
}

static void scatter(const vndf_bsdf *b, vndf_vec3 wm, float density, float u3, vndf_scattered *s)
{
    vndf_routines_bare[VNDF_NORMALS_VISIBLE].scatter(b, wm, density, u3, s);
}

const vndf_routines vndf_routines_bare_ggx = {prepare, sample, eval, pdf, scatter};
