/* The calls of many. The visible normals of an aligned surface are drawn a block at a time, in lanes
 * (vndf_sample_weight_n), and scattered by the routine of the call of one. The rest is done one after the other. */
#include "bsdf/bsdf.h"

enum { BLOCK = 256 };

/* ---- hits ---- */

static vndf_vec3 wi_at(const vndf_bsdf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    return vndf_vec3_of(b->wi_x[at], b->wi_y[at], b->wi_z[at]);
}

static void hit_at(const vndf_bsdf_batch *b, size_t i, vndf_bsdf *hit)
{
    const vndf_material *m = b->material;
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_roughness r = {m->is.alpha_x, m->is.alpha_y, m->own.cos_rotation, m->own.sin_rotation};
    if (m->is.effects.shape == VNDF_SHAPE_MIXTURE) {
        vndf_bsdf_mixture(hit, m, b->mixture ? b->mixture + at : NULL, wi_at(b, i));
        return;
    }
    if (m->is.effects.shape > VNDF_SHAPE_ROTATED) {
        vndf_bsdf_affine(hit, m, b->affine ? b->affine + at : NULL, wi_at(b, i));
        return;
    }
    if (b->alpha_x) {
        r.alpha_x = b->alpha_x[at];
        r.alpha_y = b->alpha_y[at];
    }
    if (b->cos_rotation) {
        r.cos_rotation = b->cos_rotation[at];
        r.sin_rotation = b->sin_rotation[at];
    }
    vndf_bsdf_rough(hit, m, &r, wi_at(b, i));
}

/* Makes hit i, unless all elements are one hit that is made. */
static void step_to(const vndf_bsdf_batch *b, size_t i, vndf_bsdf *hit)
{
    int one_shape =
        (b->shared & VNDF_SHARED_ALPHA) || (!b->alpha_x && !b->cos_rotation && !b->affine && !b->mixture);
    if (i == 0 || !one_shape || !(b->shared & VNDF_SHARED_WI))
        hit_at(b, i, hit);
}

/* ---- samples ---- */

static void put(const vndf_scattered_n *to, size_t i, const vndf_scattered *s, int wavelengths)
{
    to->wo.x[i] = s->wo.x;
    to->wo.y[i] = s->wo.y;
    to->wo.z[i] = s->wo.z;
    if (to->wm.x) {
        to->wm.x[i] = s->wm.x;
        to->wm.y[i] = s->wm.y;
        to->wm.z[i] = s->wm.z;
    }
    for (int n = 0; n < wavelengths; n++)
        to->weight[n][i] = s->weight[n];
    to->density[i] = s->density;
    to->lobe[i] = (uint8_t)s->lobe;
}

typedef struct block {
    float wi_x[BLOCK], wi_y[BLOCK], wi_z[BLOCK], x[BLOCK], y[BLOCK], z[BLOCK], density[BLOCK], weight[BLOCK];
} block;

/* Draws the normals of the elements from `first` on, whose directions are turned to the side where hits are. */
static void draw_block(const vndf_bsdf_batch *b, const float *const u[3], size_t first, size_t count, block *to)
{
    const vndf_material *m = b->material;
    size_t shape = b->shared & VNDF_SHARED_ALPHA ? 0 : first, directions = b->shared & VNDF_SHARED_WI ? 1 : count;
    const vndf_normals wm = {to->x, to->y, to->z};
    vndf_batch part = {.distribution = m->is.distribution,
                       .count = count,
                       .shared = b->shared | (b->alpha_x ? 0u : (unsigned)VNDF_SHARED_ALPHA),
                       .limit = b->limit,
                       .alpha_x = &m->is.alpha_x,
                       .alpha_y = &m->is.alpha_y,
                       .wi_x = to->wi_x,
                       .wi_y = to->wi_y,
                       .wi_z = to->wi_z};
    if (b->alpha_x) {
        part.alpha_x = b->alpha_x + shape;
        part.alpha_y = b->alpha_y + shape;
    }
    for (size_t i = 0; i < directions; i++) {
        vndf_vec3 wi = wi_at(b, first + i);
        float side = wi.z < 0.0f ? -1.0f : 1.0f;
        to->wi_x[i] = side * wi.x;
        to->wi_y[i] = side * wi.y;
        to->wi_z[i] = side * wi.z;
    }
    vndf_sample_weight_n(&part, u[0] + first, u[1] + first, wm, to->density, to->weight);
}

void vndf_bsdf_sample_n(const vndf_bsdf_batch *b, const float *const u[3], vndf_scattered_n scattered)
{
    const vndf_material *m = b->material;
    int in_blocks = m->is.effects.shape == VNDF_SHAPE_ALIGNED && m->is.effects.normals == VNDF_NORMALS_VISIBLE &&
                    m->is.effects.reflection == VNDF_REFLECTION_SPECULAR &&
                    m->own.routines == &vndf_routines_single;
    vndf_bsdf hit;
    block drawn;
    for (size_t i = 0; i < b->count; i++) {
        size_t at = i % BLOCK, rest = b->count - i;
        const float own[3] = {u[0][i], u[1][i], u[2][i]};
        vndf_scattered s;
        step_to(b, i, &hit);
        if (in_blocks && at == 0)
            draw_block(b, u, i, rest < BLOCK ? rest : BLOCK, &drawn);
        if (in_blocks && hit.own.area > 0.0f) {
            const vndf_drawn_normal n = {
                {drawn.x[at], drawn.y[at], drawn.z[at]}, drawn.density[at], drawn.weight[at]};
            if (!vndf_scatter(&hit, &n, own[2], &s))
                s = vndf_scattered_nothing;
        } else
            vndf_bsdf_sample(&hit, own, &s);
        put(&scattered, i, &s, m->is.wavelengths);
    }
}

/* ---- values and densities ---- */

/* No values if `value` is NULL, and no densities if `pdf` is. */
static void look(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value, float *pdf)
{
    vndf_bsdf hit;
    for (size_t i = 0; i < b->count; i++) {
        float f[VNDF_WAVELENGTHS];
        step_to(b, i, &hit);
        vndf_bsdf_look(&hit, vndf_vec3_of(wo.x[i], wo.y[i], wo.z[i]), seed ? seed[i] : 0, value ? f : NULL,
                       pdf ? pdf + i : NULL);
        for (int n = 0; value && n < b->material->is.wavelengths; n++)
            value[n][i] = f[n];
    }
}

void vndf_bsdf_eval_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value)
{
    look(b, wo, seed, value, NULL);
}

void vndf_bsdf_eval_pdf_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value,
                          float *pdf)
{
    look(b, wo, seed, value, pdf);
}

void vndf_bsdf_pdf_n(const vndf_bsdf_batch *b, vndf_normals wo, float *pdf)
{
    look(b, wo, NULL, NULL, pdf);
}
