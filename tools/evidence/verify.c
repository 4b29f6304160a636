/* A benchmark of wrong results is worth nothing: what each method returns is looked at before it is timed. */
#include <math.h>
#include <string.h>

#include "evidence/evidence.h"

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

/* Whether samples agree with values and densities is what tests/bsdf ask. */
static int is_right(const method *m, method_run *run, block *b)
{
    int good = 1;
    for (size_t i = 0; i < BLOCK; i++)
        b->x[i] = b->y[i] = b->z[i] = b->pdf[i] = 0;
    run(m, b);
    for (size_t i = 0; i < BLOCK; i++)
        good &= m->kind == ROW_EFFECT ? is_sane(m->state, &b->out[i]) : sample_good(m, b, i);
    return good;
}

/* Whether a batch left in b what single calls leave in `single`, which are looked at themselves. */
static int same_bits(const method *m, const block *b, const block *single)
{
    int good = 1;
    for (size_t i = 0; i < BLOCK; i++) {
        const vndf_scattered *s = &single->out[i];
        const float found[] = {b->x[i],        b->y[i],        b->z[i],       b->pdf[i],
                               b->value[0][i], b->value[1][i], b->value[2][i]};
        const float one[] = {single->x[i], single->y[i], single->z[i], single->pdf[i]};
        const float of_one[] = {s->wo.x, s->wo.y, s->wo.z, s->density, s->weight[0], s->weight[1], s->weight[2]};
        good &= m->kind == ROW_EFFECT ? memcmp(found, of_one, sizeof found) == 0 && b->lobe[i] == s->lobe
                                      : memcmp(found, one, sizeof one) == 0;
    }
    return good;
}

int evidence_verify(const method *m, vndf_instructions set, const block_law *law, block *b, uint64_t seed)
{
    enum { ROUNDS = 4 };
    block *single = b + 1;
    int good = 1;
    for (uint64_t round = 0; round < ROUNDS && good; round++) {
        b->limit = set;
        block_fill(b, law, seed + round);
        memcpy(single, b, sizeof *b);
        if (set && m->kind == ROW_EFFECT) /* whose batches leave nothing in `out` */
            m->batch(m, b);
        else
            good = is_right(m, set ? m->batch : m->each, b);
        if (set && m->same_bits) {
            m->each(m, single);
            good = good && same_bits(m, b, single);
        } else if (!set && m->shared) {
            block_aim(b, b->in[0].wi, b->alpha[0]);
            good = good && is_right(m, m->shared, b);
        }
    }
    return good;
}
