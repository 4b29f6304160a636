/* A benchmark of wrong results is worth nothing: what each method returns is looked at before it is timed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/parts.h"

enum { ROUNDS = 4, REST = 3 };

/* 4e-6 in the square of the length: what vectors with approximate roots leave. A normal at a right angle to wi may
 * be rounded to the far side. */
static int sample_good(const method *m, const bench_block *b, size_t i)
{
    float x = b->x[i], y = b->y[i], z = b->z[i], dot = x * b->wi_x[i] + y * b->wi_y[i] + z * b->wi_z[i];
    if (!(fabsf(x * x + y * y + z * z - 1.0f) <= 4e-6f) || !(z >= 0.0f))
        return 0;
    if (m->turned && dot <= 0.0f)
        return b->pdf[i] >= 0.0f && b->pdf[i] < INFINITY;
    return dot >= -1e-6f && b->pdf[i] > 0.0f && b->pdf[i] < INFINITY;
}

static int outputs_good(const method *m, const bench_block *b)
{
    for (size_t i = 0; i < BENCH_BLOCK; i++) {
        if (m->kind == BENCH_MOVE && (b->x[i] != b->wi_x[i] || b->pdf[i] != b->u1[i] + b->u2[i]))
            return 0;
        if (m->kind == BENCH_CALL && !(isfinite(b->pdf[i]) && isfinite(b->x[i]) && isfinite(b->y[i])))
            return 0;
        if (m->kind != BENCH_MOVE && m->kind != BENCH_CALL && !sample_good(m, b, i))
            return 0;
    }
    return 1;
}

static void clear_outputs(bench_block *b)
{
    memset(b->x, 0, sizeof b->x);
    memset(b->y, 0, sizeof b->y);
    memset(b->z, 0, sizeof b->z);
    memset(b->pdf, 0, sizeof b->pdf);
}

static int same_outputs(const bench_block *a, const bench_block *b)
{
    return memcmp(a->x, b->x, sizeof a->x) == 0 && memcmp(a->y, b->y, sizeof a->y) == 0 &&
           memcmp(a->z, b->z, sizeof a->z) == 0 && memcmp(a->pdf, b->pdf, sizeof a->pdf) == 0;
}

static int scalar_bits(const method *m, const bench_block *b, const method_inputs *in, bench_block *scratch)
{
    method_outputs out = bench_block_outputs(scratch);
    clear_outputs(scratch);
    m->same_bits(m, in, &out);
    return same_outputs(b, scratch);
}

/* A count that leaves a rest for vectors: the same results, and nothing beyond the last. */
static int rest_good(const method *m, method_run *run, bench_block *b, method_inputs in, bench_block *scratch)
{
    float *whole[] = {b->x, b->y, b->z, b->pdf};
    method_outputs out = bench_block_outputs(scratch);
    in.count -= REST;
    clear_outputs(scratch);
    run(m, &in, &out);
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++)
        memset(whole[i] + in.count, 0, REST * sizeof(float));
    return same_outputs(b, scratch);
}

/* Runs one of the method's loops; `scratch` for what it is compared with. */
static int run_good(const method *m, method_run *run, bench_block *b, bench_block *scratch)
{
    method_inputs in = bench_block_inputs(b);
    method_outputs out = bench_block_outputs(b);
    clear_outputs(b);
    run(m, &in, &out);
    if (!outputs_good(m, b) || (m->same_bits && !scalar_bits(m, b, &in, scratch)))
        return 0;
    return rest_good(m, run, b, in, scratch);
}

int bench_verify(const method *m, const method_reference *reference, bench_block *block, uint64_t seed)
{
    bench_block *scratch = malloc(sizeof *scratch);
    int good = scratch != NULL;
    for (uint64_t round = 0; good && round < ROUNDS; round++) {
        bench_block_fill(block, reference, seed + round);
        good = run_good(m, m->each, block, scratch);
        bench_block_aim(block, (vndf_vec3){block->wi_x[0], block->wi_y[0], block->wi_z[0]}, block->alpha[0]);
        good = good && (!m->shared || run_good(m, m->shared, block, scratch));
    }
    free(scratch);
    return good;
}
