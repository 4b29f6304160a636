/* The calls of many. The visible normals of a level surface are drawn a block at a time, in lanes
 * (vndf_sample_weight_n), and scattered by the routine of the call of one. The rest is done one after the other. */
#include "bsdf/bsdf.h"

enum { BLOCK = 64 };

static vndf_vec3 wi_at(const vndf_bsdf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    return vndf_vec3_of(b->wi_x[at], b->wi_y[at], b->wi_z[at]);
}

static vndf_surface surface_of(const vndf_bsdf_batch *b, size_t i)
{
    return b->surface.xx ? vndf_surface_at(&b->surface, b->shared & VNDF_SHARED_SURFACE ? 0 : i)
                         : b->material->own.surface;
}

/* Makes hit i, unless all elements are one hit that is made. */
static void step_to(const vndf_bsdf_batch *b, size_t i, vndf_bsdf *hit)
{
    const int one_shape = (b->shared & VNDF_SHARED_SURFACE) || (!b->surface.xx && !b->mixture);
    const vndf_surface surface = surface_of(b, i);
    if (i > 0 && one_shape && (b->shared & VNDF_SHARED_WI))
        return;
    if (b->material->is.effects.shape == VNDF_SHAPE_MIXTURE)
        vndf_bsdf_mixture(hit, b->material, b->mixture ? b->mixture + (one_shape ? 0 : i) : NULL, wi_at(b, i));
    else
        vndf_bsdf_on(hit, b->material, &surface, wi_at(b, i));
}

/* ---- samples ---- */

typedef struct block {
    float wi[3][BLOCK], matrix[4][BLOCK], wm[3][BLOCK], density[BLOCK], weight[BLOCK];
} block;

/* Draws the normals of the elements from `first` on, whose directions are turned to the side where hits are. */
static void draw_block(const vndf_bsdf_batch *b, const float *const u[3], size_t first, block *to)
{
    const vndf_surface *own = &b->material->own.surface;
    const vndf_normals wm = {to->wm[0], to->wm[1], to->wm[2]};
    const size_t rest = b->count - first, count = rest < BLOCK ? rest : BLOCK;
    const int turns = b->surface.xx ? b->surface.xy || b->surface.yx : own->xy != 0.0f || own->yx != 0.0f;
    const vndf_batch part = {.surface = {own->distribution, to->matrix[0], turns ? to->matrix[1] : NULL,
                                         turns ? to->matrix[2] : NULL, to->matrix[3], NULL, NULL},
                             .count = count,
                             .limit = b->limit,
                             .wi_x = to->wi[0],
                             .wi_y = to->wi[1],
                             .wi_z = to->wi[2]};
    for (size_t i = 0; i < count; i++) {
        const vndf_vec3 wi = wi_at(b, first + i);
        const vndf_surface s = surface_of(b, first + i);
        const float side = wi.z < 0.0f ? -1.0f : 1.0f, matrix[] = {s.xx, s.xy, s.yx, s.yy};
        to->wi[0][i] = side * wi.x;
        to->wi[1][i] = side * wi.y;
        to->wi[2][i] = side * wi.z;
        for (int k = 0; k < 4; k++)
            to->matrix[k][i] = matrix[k];
    }
    vndf_sample_weight_n(&part, u[0] + first, u[1] + first, wm, to->density, to->weight);
}

void vndf_bsdf_sample_n(const vndf_bsdf_batch *b, const float *const u[3], vndf_scattered_n to)
{
    const vndf_material *m = b->material;
    const vndf_effects *e = &m->is.effects;
    int in_blocks = e->shape == VNDF_SHAPE_LEVEL && e->normals == VNDF_NORMALS_VISIBLE &&
                    e->reflection == VNDF_REFLECTION_SPECULAR && m->own.routines == &vndf_routines_single;
    vndf_bsdf hit;
    block drawn;
    for (size_t i = 0; i < b->count; i++) {
        const size_t at = i % BLOCK;
        const float own[3] = {u[0][i], u[1][i], u[2][i]};
        vndf_scattered s;
        step_to(b, i, &hit);
        if (in_blocks && at == 0)
            draw_block(b, u, i, &drawn);
        if (in_blocks && hit.own.area > 0.0f) {
            const vndf_drawn_normal n = {
                {drawn.wm[0][at], drawn.wm[1][at], drawn.wm[2][at]}, drawn.density[at], drawn.weight[at]};
            if (!vndf_scatter(&hit, &n, own[2], &s))
                s = vndf_scattered_nothing;
        } else
            vndf_bsdf_sample(&hit, own, &s);
        to.wo.x[i] = s.wo.x;
        to.wo.y[i] = s.wo.y;
        to.wo.z[i] = s.wo.z;
        if (to.wm.x) {
            to.wm.x[i] = s.wm.x;
            to.wm.y[i] = s.wm.y;
            to.wm.z[i] = s.wm.z;
        }
        for (int n = 0; n < m->is.wavelengths; n++)
            to.weight[n][i] = s.weight[n];
        to.density[i] = s.density;
        to.lobe[i] = (uint8_t)s.lobe;
    }
}

/* ---- values and densities ---- */

void vndf_bsdf_eval_pdf_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value,
                          float *pdf)
{
    vndf_bsdf hit;
    for (size_t i = 0; i < b->count; i++) {
        float f[VNDF_WAVELENGTHS];
        step_to(b, i, &hit);
        vndf_bsdf_eval_pdf(&hit, vndf_vec3_of(wo.x[i], wo.y[i], wo.z[i]), seed ? seed[i] : 0, value ? f : NULL,
                           pdf ? pdf + i : NULL);
        for (int n = 0; value && n < b->material->is.wavelengths; n++)
            value[n][i] = f[n];
    }
}
