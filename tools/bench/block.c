/* Inputs of the benchmark and room for its results: 1024 samples, 40 KB as a structure of arrays, so
 * that they stay in the first cache. */
#include <math.h>

#include "bench/parts.h"
#include "cli/random.h"

method_inputs bench_block_inputs(bench_block *b)
{
    for (size_t i = 0; i < BENCH_BLOCK; i++) {
        b->at[i] = (method_input){{b->wi_x[i], b->wi_y[i], b->wi_z[i]}, b->alpha[i], b->u1[i], b->u2[i]};
        b->wm[i] = (vndf_vec3){b->wm_x[i], b->wm_y[i], b->wm_z[i]};
    }
    return (method_inputs){BENCH_BLOCK, b->alpha, b->wi_x, b->wi_y, b->wi_z, b->u1,
                           b->u2,       b->wm_x,  b->wm_y, b->wm_z, b->at,   b->wm};
}

method_outputs bench_block_outputs(bench_block *block)
{
    return (method_outputs){block->x, block->y, block->z, block->pdf};
}

static void fill_normals(bench_block *block, const method_reference *reference)
{
    vndf_batch batch = {reference->canonical.distribution,
                        BENCH_BLOCK,
                        0,
                        VNDF_INSTRUCTIONS_BEST,
                        block->alpha,
                        block->alpha,
                        block->wi_x,
                        block->wi_y,
                        block->wi_z};
    vndf_sample_n(&batch, block->u1, block->u2, (vndf_normals){block->wm_x, block->wm_y, block->wm_z}, NULL);
}

/* A cosine of at least 2^-25: exactly along the surface several published methods divide by zero. */
void bench_block_fill(bench_block *block, const method_reference *reference, uint64_t seed)
{
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < BENCH_BLOCK; i++) {
        float z = random_float(&stream) + 0x1p-25f, phi = 6.28318531f * random_float(&stream);
        float s = sqrtf(1.0f - fminf(z * z, 1.0f));
        block->wi_x[i] = s * cosf(phi);
        block->wi_y[i] = s * sinf(phi);
        block->wi_z[i] = z;
        block->alpha[i] = (0.05f + 0.9f * random_float(&stream)) / reference->scale;
        block->u1[i] = random_float(&stream);
        block->u2[i] = random_float(&stream);
    }
    fill_normals(block, reference);
}

void bench_block_aim(bench_block *block, vndf_vec3 wi, float alpha)
{
    for (size_t i = 0; i < BENCH_BLOCK; i++) {
        block->alpha[i] = alpha;
        block->wi_x[i] = wi.x;
        block->wi_y[i] = wi.y;
        block->wi_z[i] = wi.z;
    }
}

/* The bits of i after the point, in reverse. */
static double mirrored(uint32_t i)
{
    double x = 0, digit = 0.5;
    for (; i; i >>= 1, digit /= 2)
        x += (i & 1u) ? digit : 0;
    return x;
}

static float wrapped(double x)
{
    x -= floor(x);
    return (float)(floor(x * 0x1p24) * 0x1p-24);
}

void bench_block_spread(bench_block *block, uint64_t seed)
{
    random_stream stream = random_from(seed);
    double shift1 = random_double(&stream), shift2 = random_double(&stream);
    for (uint32_t i = 0; i < BENCH_BLOCK; i++) {
        block->u1[i] = wrapped((double)i / BENCH_BLOCK + shift1);
        block->u2[i] = wrapped(mirrored(i) + shift2);
    }
}
