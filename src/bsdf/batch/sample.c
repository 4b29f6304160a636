/* The calls of many. Visible normals are drawn in lanes (sampler/batch/sample.c), a block at a time, and scattered in
 * lanes (lanes_scatter.h) where the effects are of their kinds. The rest is done for one sample after the other by the
 * code of the call of one. */
#include "bsdf/batch/elements.h"
#include "bsdf/batch/lanes_scatter.h"
#include "sampler/surface.h"

/* ---- one by one ---- */

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
    int one = vndf_elements_share_hit(b);
    vndf_bsdf hit;
    for (size_t i = 0; i < b->count; i++) {
        const float numbers[3] = {u[0][i], u[1][i], u[2][i]};
        vndf_scattered s;
        if (i == 0 || !one)
            vndf_element_hit(&hit, b, i);
        vndf_bsdf_sample(&hit, numbers, &s);
        put(to, i, &s, b->material->is.wavelengths);
    }
}

/* At least as many as lanes, less one. */
enum { SPARE = 15 };

/* The normals of a block, and the heights of its directions. */
typedef struct drawn_part {
    vndf_drawn_block drawn;
    float up[VNDF_HIT_BLOCK];
} drawn_part;

/* The elements from `first` on, turned up for the sampler. */
static vndf_batch part_of(const vndf_bsdf_batch *b, size_t first, size_t count, float *up)
{
    const vndf_material *m = b->material;
    size_t wi = vndf_element_index(b, first, VNDF_SHARED_WI), heights = b->shared & VNDF_SHARED_WI ? 1 : count;
    vndf_batch part = {m->is.distribution,    count,        b->shared,    b->limit,    &m->roughness.alpha_x,
                       &m->roughness.alpha_y, b->wi_x + wi, b->wi_y + wi, b->wi_z + wi};
    if (b->alpha_x) {
        part.alpha_x = b->alpha_x + vndf_element_index(b, first, VNDF_SHARED_ALPHA);
        part.alpha_y = b->alpha_y + vndf_element_index(b, first, VNDF_SHARED_ALPHA);
    } else
        part.shared |= VNDF_SHARED_ALPHA;
    for (size_t i = 0; i < heights; i++)
        up[i] = fabsf(b->wi_z[wi + i]);
    part.wi_z = up;
    return part;
}

/* Lanes past the end find zeros. */
static void draw_block(const vndf_bsdf_batch *b, const float *const u[3], size_t first, size_t count,
                       drawn_part *to)
{
    vndf_drawn_block *d = &to->drawn;
    const vndf_normals wm = {d->x, d->y, d->z};
    vndf_batch part = part_of(b, first, count, to->up);
    vndf_sample_weight_n(&part, u[0] + first, u[1] + first, wm, d->density, d->weight);
    for (size_t i = count; i < VNDF_HIT_BLOCK && i < count + SPARE; i++)
        d->x[i] = d->y[i] = d->z[i] = d->density[i] = d->weight[i] = 0.0f;
}

/* Sample i of a block whose first is `first`, on its hit. */
VNDF_INLINE void scatter_one(const vndf_bsdf_batch *b, const vndf_bsdf *hit, const vndf_drawn_block *d,
                             const float *const u[3], size_t first, size_t i, vndf_scattered *s)
{
    const float own[3] = {u[0][first + i], u[1][first + i], u[2][first + i]};
    if (hit->material == b->material)
        b->material->routines->scatter(hit, vndf_vec3_of(d->x[i], d->y[i], d->z[i]), d->density[i], d->weight[i],
                                       own, s);
    else
        vndf_bsdf_sample(hit, own, s); /* of nothing */
}

static void sample_in_blocks(const vndf_bsdf_batch *b, const float *const u[3], const vndf_scattered_n *to)
{
    int one = vndf_elements_share_hit(b);
    drawn_part own;
    vndf_bsdf hit;
    for (size_t first = 0; first < b->count; first += VNDF_HIT_BLOCK) {
        size_t count = b->count - first < VNDF_HIT_BLOCK ? b->count - first : VNDF_HIT_BLOCK;
        draw_block(b, u, first, count, &own);
        for (size_t i = 0; i < count; i++) {
            vndf_scattered s;
            if (first + i == 0 || !one)
                vndf_element_hit(&hit, b, first + i);
            scatter_one(b, &hit, &own.drawn, u, first, i, &s);
            put(to, first + i, &s, b->material->is.wavelengths);
        }
    }
}

/* ---- in lanes ---- */

#if VNDF_HAS_LANES

enum { RESULTS = VNDF_WAVELENGTHS + 7 };

/* Copies of inputs (vndf_batch_input). Results of the last block wait here. */
typedef struct copies {
    float of[VNDF_SCATTER_INPUTS][VNDF_HIT_BLOCK], result[RESULTS][VNDF_HIT_BLOCK];
    uint8_t lobe[VNDF_HIT_BLOCK];
} copies;

static void read_block(vndf_scatter_block *block, const vndf_bsdf_batch *b, const float *const u[3], size_t first,
                       copies *own)
{
    vndf_block_hits(b, first, block->count, block->in, own->of);
    for (int n = VNDF_SCATTER_U2; n <= VNDF_SCATTER_U3; n++)
        block->in[n] =
            vndf_batch_input(u[1 + n - VNDF_SCATTER_U2], 0, first, block->count, VNDF_HIT_BLOCK, own->of[n]);
}

/* All arrays of floats of some results, one after the other, those that are NULL too. */
static void results_of(vndf_scattered_n *of, float **array[RESULTS])
{
    float **const all[] = {&of->wo.x, &of->wo.y, &of->wo.z, &of->wm.x, &of->wm.y, &of->wm.z, &of->density};
    for (int n = 0; n < 7; n++)
        array[n] = all[n];
    for (int n = 0; n < VNDF_WAVELENGTHS; n++)
        array[7 + n] = &of->weight[n];
}

/* Where a block writes its results: in place, or into the copies. */
static void place_results(vndf_scatter_block *block, const vndf_bsdf_batch *b, const vndf_scattered_n *to,
                          size_t first, copies *own)
{
    float **array[RESULTS];
    int whole = block->count == VNDF_HIT_BLOCK;
    block->to = *to;
    block->to.lobe = whole ? to->lobe + first : own->lobe;
    results_of(&block->to, array);
    for (int n = 0; n < 7 + b->material->is.wavelengths; n++)
        if (*array[n])
            *array[n] = whole ? *array[n] + first : own->result[n];
}

static void move_results(vndf_scatter_block *block, const vndf_bsdf_batch *b, vndf_scattered_n to, size_t first)
{
    float **from[RESULTS], **array[RESULTS];
    if (block->count == VNDF_HIT_BLOCK)
        return;
    results_of(&block->to, from);
    results_of(&to, array);
    for (int n = 0; n < 7 + b->material->is.wavelengths; n++)
        if (*array[n])
            memcpy(*array[n] + first, *from[n], block->count * sizeof(float));
    memcpy(to.lobe + first, block->to.lobe, block->count);
}

/* Scatters the samples that lanes have left. */
static void scatter_left(const vndf_scatter_block *block, const vndf_bsdf_batch *b, const float *const u[3],
                         size_t first)
{
    uint32_t left[VNDF_HIT_BLOCK], count = vndf_list_samples(&block->left, block->count, left);
    vndf_bsdf own;
    for (uint32_t n = 0; n < count; n++) {
        vndf_scattered s;
        if (!block->hit)
            vndf_element_hit(&own, b, first + left[n]);
        scatter_one(b, block->hit ? block->hit : &own, block->drawn, u, first, left[n], &s);
        put(&block->to, left[n], &s, b->material->is.wavelengths);
    }
}

static void sample_in_lanes(const vndf_bsdf_batch *b, const float *const u[3], const vndf_scattered_n *to)
{
    int wide = vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_AVX512;
    vndf_scatter_block work;
    vndf_bsdf hit;
    copies own;
    drawn_part drawn;
    work.material = b->material;
    work.hit = vndf_elements_share_hit(b) ? &hit : NULL;
    work.drawn = &drawn.drawn;
    if (work.hit)
        vndf_element_hit(&hit, b, 0);
    if (work.hit && hit.material != b->material) { /* nothing is seen */
        sample_one_by_one(b, u, to);
        return;
    }
    for (size_t first = 0; first < b->count; first += work.count) {
        size_t rest = b->count - first;
        work.count = rest < VNDF_HIT_BLOCK ? (uint32_t)rest : VNDF_HIT_BLOCK;
        read_block(&work, b, u, first, &own);
        place_results(&work, b, to, first, &own);
        draw_block(b, u, first, work.count, &drawn);
        if (wide)
            vndf_scatter_block_avx512(&work);
        else
            vndf_scatter_block_avx2(&work);
        scatter_left(&work, b, u, first);
        move_results(&work, b, *to, first);
    }
}

#else

static void sample_in_lanes(const vndf_bsdf_batch *b, const float *const u[3], const vndf_scattered_n *to)
{
    sample_in_blocks(b, u, to);
}

#endif

void vndf_bsdf_sample_n(const vndf_bsdf_batch *b, const float *const u[3], vndf_scattered_n scattered)
{
    if (vndf_elements_have_lanes(b))
        sample_in_lanes(b, u, &scattered);
    else if (b->material->routines->scatter)
        sample_in_blocks(b, u, &scattered);
    else
        sample_one_by_one(b, u, &scattered);
}
