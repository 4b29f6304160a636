/* A benchmark of wrong results is worth nothing: what each method returns is looked at before it is timed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "evidence/evidence.h"

enum { ROUNDS = 4 };

/* ---- normals ------------------------------------------------------------------------------------- */

/* 4e-6 in the square of the length: what vectors with approximate roots leave. A normal at a right angle to wi may
 * be rounded to the far side. */
static int sample_good(const method *m, const block *b, size_t i)
{
    const float x = b->x[i], y = b->y[i], z = b->z[i], pdf = b->pdf[i];
    const float dot = x * b->wi[0][i] + y * b->wi[1][i] + z * b->wi[2][i];
    if (m->kind == ROW_CALL)
        return isfinite(pdf) && isfinite(x) && isfinite(y);
    if (!(fabsf(x * x + y * y + z * z - 1.0f) <= 4e-6f) || !(z >= 0.0f))
        return 0;
    if (m->turned && dot <= 0.0f)
        return pdf >= 0.0f && pdf < INFINITY;
    return dot >= -1e-6f && pdf > 0.0f && pdf < INFINITY;
}

static int normals_good(const method *m, method_run *run, block *b, block *scratch)
{
    int good = 1;
    for (size_t i = 0; i < BLOCK; i++)
        b->x[i] = b->y[i] = b->z[i] = b->pdf[i] = 0;
    memcpy(scratch, b, sizeof *b);
    run(m, b, 0, BLOCK);
    for (size_t i = 0; i < BLOCK; i++)
        good &= sample_good(m, b, i);
    if (!m->same_bits)
        return good;
    m->same_bits(m, scratch, 0, BLOCK);
    return good && memcmp(b->x, scratch->x, sizeof b->x) == 0 && memcmp(b->y, scratch->y, sizeof b->y) == 0 &&
           memcmp(b->z, scratch->z, sizeof b->z) == 0 && memcmp(b->pdf, scratch->pdf, sizeof b->pdf) == 0;
}

/* ---- materials ----------------------------------------------------------------------------------- */

/* Directions are unit and on the side of their lobe, weights and densities finite and not negative. */
static int is_sane(const effect_case *of, const vndf_scattered *s)
{
    const vndf_vec3 w = s->wo;
    int good = fabsf(w.x * w.x + w.y * w.y + w.z * w.z - 1.0f) < 4e-6f && s->density > 0.0f &&
               s->density < INFINITY && (s->lobe == VNDF_LOBE_REFLECTION) == (effect_cosine(of, w) > 0);
    for (int i = 0; i < 3; i++)
        good &= s->weight[i] >= 0.0f && s->weight[i] < INFINITY;
    return s->lobe == VNDF_LOBE_NONE ? s->weight[0] == 0.0f : good;
}

/* Wider than what 99.99% of samples keep: the tests look for rare roundings. */
static int is_near(double a, double b)
{
    return fabs(a - b) <= 8e-4 * fabs(b) + 1e-30;
}

/* The density of a sample is the density of its direction, and its weight the value times cosine over density. */
static int agrees(const effect_case *of, const vndf_scattered *drawn, const vndf_scattered *found)
{
    const double density = (double)drawn->density, per = fabs(effect_cosine(of, drawn->wo)) / density;
    int good = is_near((double)found->density, density);
    for (int i = 0; i < 3; i++)
        good &= is_near((double)found->weight[i] * per, (double)drawn->weight[i]);
    return good || drawn->lobe == VNDF_LOBE_NONE || drawn->lobe == VNDF_LOBE_STRAIGHT;
}

/* Samples that share a hit, and values and densities in their directions; values of random walks are random numbers,
 * which do not agree with weights one by one. */
static int material_good(const method *m, block *b, size_t first)
{
    const effect_case *of = m->state;
    vndf_scattered drawn[SHARE];
    int good = 1;
    m->each(m, b, first, SHARE);
    for (size_t i = first; i < first + SHARE; i++)
        good &= is_sane(of, &b->out[i]);
    if (of->set->effects.scattering == VNDF_SCATTERING_MULTIPLE)
        return good;
    m->shared(m, b, first, SHARE);
    memcpy(drawn, b->out + first, sizeof drawn);
    for (size_t i = 0; i < SHARE; i++) {
        b->given[0][first + i] = drawn[i].wo.x;
        b->given[1][first + i] = drawn[i].wo.y;
        b->given[2][first + i] = drawn[i].wo.z;
    }
    block_pack(b);
    m->eval(m, b, first, SHARE);
    m->density(m, b, first, SHARE);
    for (size_t i = 0; i < SHARE; i++)
        good &= agrees(of, &drawn[i], &b->out[first + i]);
    return good;
}

/* The same bits as from single calls, which are looked at themselves. */
static int batch_good(const method *m, block *b)
{
    int good = 1;
    m->each(m, b, 0, BLOCK);
    m->same_bits(m, b, 0, BLOCK);
    for (size_t i = 0; i < BLOCK; i++) {
        const vndf_scattered *s = &b->out[i];
        const float one[] = {s->wo.x, s->wo.y, s->wo.z, s->weight[0], s->weight[1], s->weight[2], s->density};
        const float found[] = {b->x[i],        b->y[i],        b->z[i],  b->value[0][i],
                               b->value[1][i], b->value[2][i], b->pdf[i]};
        good &= memcmp(one, found, sizeof one) == 0 && b->lobe[i] == s->lobe;
    }
    return good;
}

int evidence_verify(const method *m, const block_law *law, block *b, uint64_t seed)
{
    block *scratch = malloc(sizeof *scratch);
    int good = scratch != NULL;
    block_fill(b, law, seed);
    for (size_t first = 0; first < BLOCK && good && m->kind == ROW_EFFECT && !m->limit; first += SHARE)
        good = material_good(m, b, first);
    if (good && m->kind == ROW_EFFECT && m->limit)
        good = batch_good(m, b);
    for (uint64_t round = 0; round < ROUNDS && good && m->kind != ROW_EFFECT; round++) {
        block_fill(b, law, seed + round);
        good = normals_good(m, m->each, b, scratch);
        block_aim(b, b->in[0].wi, b->alpha[0]);
        good = good && (!m->shared || normals_good(m, m->shared, b, scratch));
    }
    free(scratch);
    return good;
}
