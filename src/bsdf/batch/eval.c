/* Values and densities of many: in lanes where the effects are of their kinds (lanes_look.h), else one after the
 * other. */
#include "bsdf/batch/elements.h"
#include "bsdf/batch/lanes_look.h"

/* What a call asks for; no values if `value` is NULL, and no densities if `pdf` is. */
typedef struct call {
    const vndf_bsdf_batch *batch;
    vndf_normals wo;
    const uint64_t *seed;
    float *const *value;
    float *pdf;
} call;

/* ---- one by one ---- */

/* Element i on its hit, into arrays. */
VNDF_INLINE void look_at(const call *c, const vndf_bsdf *hit, size_t i, float *const *value, float *pdf, size_t at)
{
    vndf_vec3 wo = vndf_vec3_of(c->wo.x[i], c->wo.y[i], c->wo.z[i]);
    float f[VNDF_WAVELENGTHS];
    if (!value) {
        pdf[at] = vndf_bsdf_pdf(hit, wo);
        return;
    }
    hit->material->routines->eval(hit, wo, c->seed ? c->seed[i] : 0, f, pdf ? pdf + at : NULL);
    for (int n = 0; n < c->batch->material->is.wavelengths; n++)
        value[n][at] = f[n];
}

static void look_one_by_one(const call *c)
{
    const vndf_bsdf_batch *b = c->batch;
    int one = vndf_elements_share_hit(b);
    vndf_bsdf hit;
    for (size_t i = 0; i < b->count; i++) {
        if (i == 0 || !one)
            vndf_element_hit(&hit, b, i);
        look_at(c, &hit, i, c->value, c->pdf, i);
    }
}

/* ---- in lanes ---- */

#if VNDF_HAS_LANES

/* Copies of inputs (vndf_batch_input). Results of the last block wait here. */
typedef struct copies {
    float of[VNDF_LOOK_INPUTS][VNDF_HIT_BLOCK], value[VNDF_WAVELENGTHS][VNDF_HIT_BLOCK], pdf[VNDF_HIT_BLOCK];
} copies;

static void read_block(vndf_look_block *block, const call *c, size_t first, copies *own)
{
    const float *wo[3] = {c->wo.x, c->wo.y, c->wo.z};
    vndf_block_hits(c->batch, first, block->count, block->in, own->of);
    for (int n = VNDF_LOOK_WO_X; n <= VNDF_LOOK_WO_Z; n++)
        block->in[n] =
            vndf_batch_input(wo[n - VNDF_LOOK_WO_X], 0, first, block->count, VNDF_HIT_BLOCK, own->of[n]);
}

/* Where a block writes its results: in place, or into the copies. */
static void place_results(vndf_look_block *block, const call *c, size_t first, copies *own)
{
    int whole = block->count == VNDF_HIT_BLOCK;
    block->value[0] = NULL;
    for (int n = 0; n < c->batch->material->is.wavelengths && c->value; n++)
        block->value[n] = whole ? c->value[n] + first : own->value[n];
    block->pdf = !c->pdf ? NULL : whole ? c->pdf + first : own->pdf;
}

static void move_results(const vndf_look_block *block, const call *c, size_t first)
{
    size_t bytes = block->count * sizeof(float);
    if (block->count == VNDF_HIT_BLOCK)
        return;
    for (int n = 0; n < c->batch->material->is.wavelengths && c->value; n++)
        memcpy(c->value[n] + first, block->value[n], bytes);
    if (c->pdf)
        memcpy(c->pdf + first, block->pdf, bytes);
}

/* Answers for the elements that lanes have left. */
static void look_at_left(const vndf_look_block *block, const call *c, size_t first)
{
    uint32_t left[VNDF_HIT_BLOCK], count = vndf_list_samples(&block->left, block->count, left);
    vndf_bsdf own;
    for (uint32_t n = 0; n < count; n++) {
        uint32_t i = left[n];
        if (!block->hit)
            vndf_element_hit(&own, c->batch, first + i);
        look_at(c, block->hit ? block->hit : &own, first + i, c->value ? block->value : NULL, block->pdf, i);
    }
}

static void look_in_lanes(const call *c)
{
    const vndf_bsdf_batch *b = c->batch;
    int wide = vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_AVX512;
    vndf_look_block block;
    vndf_bsdf hit;
    copies own;
    block.material = b->material;
    block.hit = vndf_elements_share_hit(b) ? &hit : NULL;
    if (block.hit)
        vndf_element_hit(&hit, b, 0);
    if (block.hit && hit.material != b->material) { /* nothing is seen */
        look_one_by_one(c);
        return;
    }
    for (size_t first = 0; first < b->count; first += block.count) {
        size_t rest = b->count - first;
        block.count = rest < VNDF_HIT_BLOCK ? (uint32_t)rest : VNDF_HIT_BLOCK;
        read_block(&block, c, first, &own);
        place_results(&block, c, first, &own);
        if (wide)
            vndf_look_block_avx512(&block);
        else
            vndf_look_block_avx2(&block);
        look_at_left(&block, c, first);
        move_results(&block, c, first);
    }
}

#else

static void look_in_lanes(const call *c)
{
    look_one_by_one(c);
}

#endif

static void look(const call *c)
{
    if (vndf_elements_have_lanes(c->batch))
        look_in_lanes(c);
    else
        look_one_by_one(c);
}

/* ---- the calls ---- */

void vndf_bsdf_eval_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value)
{
    call c = {b, wo, seed, value, NULL};
    look(&c);
}

void vndf_bsdf_eval_pdf_n(const vndf_bsdf_batch *b, vndf_normals wo, const uint64_t *seed, float *const *value,
                          float *pdf)
{
    call c = {b, wo, seed, value, pdf};
    look(&c);
}

void vndf_bsdf_pdf_n(const vndf_bsdf_batch *b, vndf_normals wo, float *pdf)
{
    call c = {b, wo, NULL, NULL, pdf};
    look(&c);
}
