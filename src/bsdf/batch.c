/* The calls of many. Visible normals are drawn in lanes (sampler/batch/sample.c), a block at a time. The rest is done
 * for one sample after the other by the code of the call of one, so the bits are the same. */
#include "bsdf/routines.h"
#include "math/vector.h"
#include "sampler/surface.h"

enum { BLOCK = 256 };

/* ---- elements ---- */

VNDF_INLINE size_t at_of(const vndf_bsdf_batch *b, size_t i, unsigned shared)
{
    return b->shared & shared ? 0 : i;
}

VNDF_INLINE vndf_vec3 wi_at(const vndf_bsdf_batch *b, size_t i)
{
    size_t at = at_of(b, i, VNDF_SHARED_WI);
    return vndf_vec3_of(b->wi_x[at], b->wi_y[at], b->wi_z[at]);
}

VNDF_INLINE vndf_roughness roughness_at(const vndf_bsdf_batch *b, size_t i)
{
    size_t at = at_of(b, i, VNDF_SHARED_ALPHA);
    vndf_roughness r = b->material->roughness;
    if (b->alpha_x) {
        r.alpha_x = b->alpha_x[at];
        r.alpha_y = b->alpha_y[at];
    }
    if (b->cos_rotation) {
        r.cos_rotation = b->cos_rotation[at];
        r.sin_rotation = b->sin_rotation[at];
    }
    return r;
}

VNDF_INLINE int is_one_shape(const vndf_bsdf_batch *b)
{
    return (b->shared & VNDF_SHARED_ALPHA) || (!b->alpha_x && !b->cos_rotation && !b->affine && !b->mixture);
}

/* Whether all elements are one hit. */
static int is_one_hit(const vndf_bsdf_batch *b)
{
    return (b->shared & VNDF_SHARED_WI) && is_one_shape(b);
}

VNDF_INLINE void hit_at(vndf_bsdf *hit, const vndf_bsdf_batch *b, size_t i)
{
    size_t at = at_of(b, i, VNDF_SHARED_ALPHA);
    vndf_roughness r;
    switch (b->material->is.effects.shape) {
    case VNDF_SHAPE_ALIGNED:
    case VNDF_SHAPE_ROTATED: break;
    case VNDF_SHAPE_MATRIX:
    case VNDF_SHAPE_AFFINE:
        vndf_bsdf_affine(hit, b->material, b->affine ? b->affine + at : NULL, wi_at(b, i));
        return;
    case VNDF_SHAPE_MIXTURE:
        vndf_bsdf_mixture(hit, b->material, b->mixture ? b->mixture + at : NULL, wi_at(b, i));
        return;
    }
    r = roughness_at(b, i);
    vndf_bsdf_hit(hit, b->material, &r, wi_at(b, i));
}

VNDF_INLINE vndf_vec3 direction_at(vndf_normals w, size_t i)
{
    return vndf_vec3_of(w.x[i], w.y[i], w.z[i]);
}

/* ---- sample ---- */

VNDF_INLINE void put(const vndf_scattered_n *to, size_t i, const vndf_scattered *s, int wavelengths)
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

static void sample_one_by_one(const vndf_bsdf_batch *b, const float *const u[3], const vndf_scattered_n *to)
{
    int one = is_one_hit(b);
    vndf_bsdf hit;
    for (size_t i = 0; i < b->count; i++) {
        const float numbers[3] = {u[0][i], u[1][i], u[2][i]};
        vndf_scattered s;
        if (i == 0 || !one)
            hit_at(&hit, b, i);
        vndf_bsdf_sample(&hit, numbers, &s);
        put(to, i, &s, b->material->is.wavelengths);
    }
}

/* Normals of a block, and the heights of its directions. */
typedef struct block {
    float x[BLOCK], y[BLOCK], z[BLOCK], density[BLOCK], weight[BLOCK], up[BLOCK];
} block;

/* The elements from `first` on, turned up for the sampler. */
static vndf_batch part_of(const vndf_bsdf_batch *b, size_t first, size_t count, float *up)
{
    const vndf_material *m = b->material;
    size_t wi = at_of(b, first, VNDF_SHARED_WI), heights = b->shared & VNDF_SHARED_WI ? 1 : count;
    vndf_batch part = {m->is.distribution,    count,        b->shared,    b->limit,    &m->roughness.alpha_x,
                       &m->roughness.alpha_y, b->wi_x + wi, b->wi_y + wi, b->wi_z + wi};
    if (b->alpha_x) {
        part.alpha_x = b->alpha_x + at_of(b, first, VNDF_SHARED_ALPHA);
        part.alpha_y = b->alpha_y + at_of(b, first, VNDF_SHARED_ALPHA);
    } else
        part.shared |= VNDF_SHARED_ALPHA;
    for (size_t i = 0; i < heights; i++)
        up[i] = fabsf(b->wi_z[wi + i]);
    part.wi_z = up;
    return part;
}

static void sample_in_blocks(const vndf_bsdf_batch *b, const float *const u[3], const vndf_scattered_n *to)
{
    const vndf_routines *routines = b->material->routines;
    int one = is_one_hit(b);
    block drawn;
    vndf_normals wm = {drawn.x, drawn.y, drawn.z};
    vndf_bsdf hit;
    for (size_t first = 0; first < b->count; first += BLOCK) {
        size_t count = b->count - first < BLOCK ? b->count - first : BLOCK;
        vndf_batch part = part_of(b, first, count, drawn.up);
        vndf_sample_weight_n(&part, u[0] + first, u[1] + first, wm, drawn.density, drawn.weight);
        for (size_t i = 0; i < count; i++) {
            const float own[3] = {u[0][first + i], u[1][first + i], u[2][first + i]};
            vndf_scattered s;
            if (first + i == 0 || !one)
                hit_at(&hit, b, first + i);
            if (hit.material == b->material)
                routines->scatter(&hit, direction_at(wm, i), drawn.density[i], drawn.weight[i], own, &s);
            else
                vndf_bsdf_sample(&hit, own, &s); /* of nothing */
            put(to, first + i, &s, b->material->is.wavelengths);
        }
    }
}

void vndf_bsdf_sample_n(const vndf_bsdf_batch *b, const float *const u[3], vndf_scattered_n scattered)
{
    if (b->material->routines->scatter)
        sample_in_blocks(b, u, &scattered);
    else
        sample_one_by_one(b, u, &scattered);
}

/* ---- eval, pdf ---- */

static void look_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value,
                   float *pdf)
{
    int one = is_one_hit(b);
    vndf_bsdf hit;
    for (size_t i = 0; i < b->count; i++) {
        float f[VNDF_WAVELENGTHS];
        if (i == 0 || !one)
            hit_at(&hit, b, i);
        hit.material->routines->eval(&hit, direction_at(wo, i), seed ? seed[i] : 0, f, pdf ? pdf + i : NULL);
        for (int n = 0; n < b->material->is.wavelengths; n++)
            value[n][i] = f[n];
    }
}

void vndf_bsdf_eval_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value)
{
    look_n(b, wo, seed, value, NULL);
}

void vndf_bsdf_eval_pdf_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value,
                          float *pdf)
{
    look_n(b, wo, seed, value, pdf);
}

void vndf_bsdf_pdf_n(const vndf_bsdf_batch *b, vndf_normals wo, float *pdf)
{
    int one = is_one_hit(b);
    vndf_bsdf hit;
    for (size_t i = 0; i < b->count; i++) {
        if (i == 0 || !one)
            hit_at(&hit, b, i);
        pdf[i] = vndf_bsdf_pdf(&hit, direction_at(wo, i));
    }
}
