/* A benchmark of wrong results is worth nothing: what each method returns is looked at before it is timed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "evidence/evidence.h"

/* Wider than what 99.99% of samples keep: the tests look for rare roundings. */
static const double tolerance_ours = 8e-4, tolerance_by_hand = 2e-2;

enum { ROUNDS = 4 };

/* ---- normals ------------------------------------------------------------------------------------- */

/* 4e-6 in the square of the length: what vectors with approximate roots leave. A normal at a right angle to wi may
 * be rounded to the far side. */
static int sample_good(const method *m, const block *b, size_t i)
{
    float x = b->x[i], y = b->y[i], z = b->z[i], dot = x * b->wi[0][i] + y * b->wi[1][i] + z * b->wi[2][i];
    if (!(fabsf(x * x + y * y + z * z - 1.0f) <= 4e-6f) || !(z >= 0.0f))
        return 0;
    if (m->turned && dot <= 0.0f)
        return b->pdf[i] >= 0.0f && b->pdf[i] < INFINITY;
    return dot >= -1e-6f && b->pdf[i] > 0.0f && b->pdf[i] < INFINITY;
}

static int outputs_good(const method *m, const block *b)
{
    for (size_t i = 0; i < BLOCK; i++) {
        int is_finite = isfinite(b->pdf[i]) && isfinite(b->x[i]) && isfinite(b->y[i]);
        if (!(m->kind == ROW_CALL ? is_finite : sample_good(m, b, i)))
            return 0;
    }
    return 1;
}

static int same_outputs(const block *a, const block *b)
{
    return memcmp(a->x, b->x, sizeof a->x) == 0 && memcmp(a->y, b->y, sizeof a->y) == 0 &&
           memcmp(a->z, b->z, sizeof a->z) == 0 && memcmp(a->pdf, b->pdf, sizeof a->pdf) == 0;
}

static int normals_good(const method *m, method_run *run, block *b, block *scratch)
{
    for (size_t i = 0; i < BLOCK; i++)
        b->x[i] = b->y[i] = b->z[i] = b->pdf[i] = 0;
    memcpy(scratch, b, sizeof *b);
    run(m, b, 0, BLOCK);
    if (m->same_bits)
        m->same_bits(m, scratch, 0, BLOCK);
    return outputs_good(m, b) && !(m->same_bits && !same_outputs(b, scratch));
}

/* ---- materials ----------------------------------------------------------------------------------- */

/* Results of a batch, as if from single calls. */
static void gather(const method *m, block *b, size_t first, size_t count)
{
    for (size_t i = first; m->limit && i < first + count; i++) {
        b->out[i].wo = (vndf_vec3){b->x[i], b->y[i], b->z[i]};
        b->out[i].density = b->pdf[i];
        b->out[i].lobe = (vndf_lobe)b->lobe[i];
        for (int k = 0; k < 3; k++)
            b->out[i].weight[k] = b->value[k][i];
    }
}

/* Directions are unit and on the side of their lobe, weights and densities finite and not negative. */
static int is_sane(const effect_case *of, const vndf_scattered *s)
{
    vndf_vec3 w = s->wo;
    float length2 = w.x * w.x + w.y * w.y + w.z * w.z;
    if (s->lobe == VNDF_LOBE_NONE)
        return s->weight[0] == 0.0f;
    for (int i = 0; i < 3; i++)
        if (!(s->weight[i] >= 0.0f && s->weight[i] < INFINITY))
            return 0;
    return fabsf(length2 - 1.0f) < 4e-6f && s->density > 0.0f && s->density < INFINITY &&
           (s->lobe == VNDF_LOBE_REFLECTION) == (effect_cosine(of, w) > 0);
}

static int is_near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance * fabs(b) + 1e-30;
}

/* The density of a sample is the density of its direction, and its weight the value times cosine over density. */
static int agrees(const effect_case *of, const vndf_scattered *drawn, const vndf_scattered *found,
                  double tolerance)
{
    double cosine = fabs(effect_cosine(of, drawn->wo)), density = (double)drawn->density;
    if (drawn->lobe == VNDF_LOBE_NONE || drawn->lobe == VNDF_LOBE_STRAIGHT)
        return 1;
    for (int i = 0; i < 3; i++)
        if (!is_near((double)found->weight[i] * cosine / density, (double)drawn->weight[i], tolerance))
            return 0;
    return is_near((double)found->density, density, tolerance);
}

/* Compares samples that share a hit with values and densities in their directions. */
static int share_agrees(const method *m, block *b, size_t first, double tolerance)
{
    vndf_scattered drawn[SHARE];
    m->shared(m, b, first, SHARE);
    gather(m, b, first, SHARE);
    memcpy(drawn, b->out + first, sizeof drawn);
    for (size_t i = 0; i < SHARE; i++) {
        b->given[0][first + i] = drawn[i].wo.x;
        b->given[1][first + i] = drawn[i].wo.y;
        b->given[2][first + i] = drawn[i].wo.z;
    }
    block_pack(b);
    m->eval(m, b, first, SHARE);
    m->density(m, b, first, SHARE);
    gather(m, b, first, SHARE);
    for (size_t i = 0; i < SHARE; i++)
        if (!agrees(m->state, &drawn[i], &b->out[first + i], tolerance))
            return 0;
    return 1;
}

/* Values of random walks are random numbers, which do not agree with weights one by one. */
static int material_good(const method *m, block *b)
{
    const effect_set *set = ((const effect_case *)m->state)->set;
    double tolerance = set->kind == EFFECT_BY_HAND ? tolerance_by_hand : tolerance_ours;
    int good = 1;
    m->each(m, b, 0, BLOCK);
    gather(m, b, 0, BLOCK);
    for (size_t i = 0; i < BLOCK; i++)
        good = good && is_sane(m->state, &b->out[i]);
    for (size_t first = 0; first < BLOCK && set->effects.scattering != VNDF_SCATTERING_MULTIPLE; first += SHARE)
        good = good && share_agrees(m, b, first, tolerance);
    return good;
}

int evidence_verify(const method *m, const block_law *law, block *b, uint64_t seed)
{
    block *scratch = malloc(sizeof *scratch);
    int good = scratch != NULL;
    for (uint64_t round = 0; good && round < ROUNDS; round++) {
        block_fill(b, law, seed + round);
        if (m->kind == ROW_EFFECT) {
            good = material_good(m, b);
            break;
        }
        good = normals_good(m, m->each, b, scratch);
        block_aim(b, b->in[0].wi, b->alpha[0]);
        good = good && (!m->shared || normals_good(m, m->shared, b, scratch));
    }
    free(scratch);
    return good;
}
