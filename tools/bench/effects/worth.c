/* Checks that a set's results are right, and measures their worth. Results are right if directions are unit and on the
 * side of their lobe, and weights and densities are finite and not negative. Except for random walks, whose values are
 * random numbers, the density of a sample must also be the density of its direction, and its weight the value times
 * cosine over density. The tolerance is wider than the library's promise: the tests look for rare roundings. */
#include <math.h>

#include "bench/effects/effects.h"

enum { SHARES = EFFECTS_BLOCK / EFFECTS_SHARE };

static const double tolerance_ours = 1e-4, tolerance_by_hand = 2e-2, noise_limit = 6;

static int is_sane(const effects_subject *subject, const vndf_scattered *s, float side_of_wi)
{
    vndf_vec3 w = s->wo;
    float length2 = w.x * w.x + w.y * w.y + w.z * w.z;
    double side = (double)side_of_wi * effects_cosine(subject, w);
    if (s->lobe == VNDF_LOBE_NONE)
        return s->weight[0] == 0.0f;
    for (int i = 0; i < 3; i++)
        if (!(s->weight[i] >= 0.0f && s->weight[i] < INFINITY))
            return 0;
    return fabsf(length2 - 1.0f) < 4e-6f && s->density > 0.0f && s->density < INFINITY &&
           (s->lobe == VNDF_LOBE_REFLECTION) == (side > 0);
}

static int are_sane(const effects_subject *subject, const effects_block *block, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++)
        if (!is_sane(subject, &block->out[i], block->in[i].wi.z < 0.0f ? -1.0f : 1.0f))
            return 0;
    return 1;
}

/* ---- agreement --------------------------------------------------------------------------------- */

static int is_near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance * fabs(b) + 1e-30;
}

static int agrees(const effects_subject *subject, const vndf_scattered *drawn, const vndf_scattered *found,
                  double tolerance)
{
    double cosine = fabs(effects_cosine(subject, drawn->wo)), density = (double)drawn->density;
    if (drawn->lobe == VNDF_LOBE_NONE || drawn->lobe == VNDF_LOBE_STRAIGHT)
        return 1;
    for (int i = 0; i < 3; i++)
        if (!is_near((double)found->weight[i] * cosine / density, (double)drawn->weight[i], tolerance))
            return 0;
    return is_near((double)found->density, density, tolerance);
}

/* Compares the samples of one hit with its values and densities in their directions. */
static int share_agrees(const effects_job *job, double tolerance)
{
    effects_input in[EFFECTS_SHARE];
    vndf_scattered drawn[EFFECTS_SHARE];
    effects_job again = {job->of, in, job->out, EFFECTS_SHARE, job->arrays, job->first};
    job->of->loops->shared(job);
    effects_unpack(job);
    for (size_t i = 0; i < EFFECTS_SHARE; i++) {
        in[i] = job->in[i];
        drawn[i] = job->out[i];
        in[i].wo = drawn[i].wo;
    }
    effects_pack(&again);
    job->of->loops->eval(&again);
    job->of->loops->pdf(&again);
    effects_unpack(&again);
    for (size_t i = 0; i < EFFECTS_SHARE; i++)
        if (!agrees(job->of, &drawn[i], &again.out[i], tolerance))
            return 0;
    return 1;
}

void effects_verify(effects_entry *entry, effects_block *block)
{
    const effects_set *set = entry->subject.set;
    int walks = set->effects.scattering == VNDF_SCATTERING_MULTIPLE;
    int by_hand = set->kind == EFFECTS_BY_HAND || set->kind == EFFECTS_BY_CAPS;
    effects_fill(block, &entry->subject, entry->theta, 500);
    effects_job job = effects_job_of(block, &entry->subject);
    entry->subject.loops->each(&job);
    effects_unpack(&job);
    entry->row.wrong = !are_sane(&entry->subject, block, 0, EFFECTS_BLOCK);
    job.count = EFFECTS_SHARE;
    for (size_t share = 0; share < SHARES && !walks; share++) {
        job.in = block->in + share * EFFECTS_SHARE;
        job.out = block->out + share * EFFECTS_SHARE;
        job.first = share * EFFECTS_SHARE;
        entry->row.wrong |= !share_agrees(&job, by_hand ? tolerance_by_hand : tolerance_ours);
    }
}

/* ---- worth -------------------------------------------------------------------------------------- */

typedef struct tally {
    double count, sum, square, lost, most;
} tally;

static void add(tally *t, const vndf_scattered *s)
{
    double weight = (double)s->weight[0];
    t->count += 1;
    t->sum += weight;
    t->square += weight * weight;
    t->lost += s->lobe == VNDF_LOBE_NONE;
    t->most = fmax(t->most, weight);
}

static double mean_of(const tally *t)
{
    return t->sum / t->count;
}

static double variance_of(const tally *t)
{
    double mean = mean_of(t);
    return fmax(t->square / t->count - mean * mean, 0) * t->count / (t->count - 1);
}

static tally weigh(effects_entry *entry, effects_block *block, size_t blocks, uint64_t seed)
{
    tally t = {0, 0, 0, 0, 0};
    for (size_t i = 0; i < blocks; i++) {
        effects_fill(block, &entry->subject, entry->worth_theta, seed + i);
        effects_aim(block, entry->subject.set, entry->worth_theta);
        effects_job job = effects_job_of(block, &entry->subject);
        entry->subject.loops->each(&job);
        effects_unpack(&job);
        for (size_t k = 0; k < EFFECTS_BLOCK; k++)
            add(&t, &block->out[k]);
    }
    return t;
}

void effects_weigh(effects_entry *entry, effects_block *block, size_t blocks)
{
    tally a = weigh(entry, block, blocks, 1u << 20), b = weigh(entry, block, blocks, 2u << 20);
    tally t = {a.count + b.count, a.sum + b.sum, a.square + b.square, a.lost + b.lost, fmax(a.most, b.most)};
    effects_row *row = &entry->row;
    double between = sqrt(variance_of(&a) / a.count + variance_of(&b) / b.count);
    row->mean = mean_of(&t);
    row->variance = variance_of(&t);
    row->noise = sqrt(row->variance / t.count);
    row->lost = t.lost / t.count;
    row->max_weight = t.most;
    row->wrong |= !(fabs(mean_of(&a) - mean_of(&b)) <= noise_limit * between + 1e-5);
}
