/* Batches of mixtures in lanes, compiled once for each instruction set, made of batches of their lobes (lanes_block.c):
 * areas give the shares, u1 picks lobes, the elements of each lobe are drawn together, and the densities of all lobes
 * are summed. A lobe of weight 0 adds nothing. */
#ifndef VNDF_LANES
#define VNDF_LANES 4
#endif
#if defined(__GNUC__)

#include "kernel/lanes.h"

#include "kernel/sample.h"
#include "sampler/batch/call.h"

enum { BLOCK = VNDF_BLOCK, GROUPS = BLOCK / LANES, LOBES = VNDF_MIXTURE_LOBES };

typedef struct lobe_numbers {
    real *lobe;
} lobe_numbers;

KERNEL int lobe_end(int count)
{
    return count;
}

#include "kernel/shares.h"

/* Numbers of a block, which may be read one by one. */
typedef real row[GROUPS] __attribute__((may_alias));

/* A block of a batch: of each lobe its share, or its weight; which lobes have a weight above 0, bit by bit, and none if
 * weights, or surfaces where these matter, are not valid. */
typedef struct mixtures {
    const vndf_batch *batch;
    size_t first;
    int count, groups;
    real share[GROUPS][LOBES];
    integer has[GROUPS];
} mixtures;

KERNEL mask has_lobe(const mixtures *m, int g, int l)
{
    return eq((m->has[g] >> l) & 1, 1);
}

KERNEL float *numbers(real *of)
{
    return (float *)(void *)of;
}

/* A task on the elements `which` of a lobe. */
static void ask_lobe(const mixtures *m, int l, vndf_task task, uint64_t which, vndf_arrays a)
{
    vndf_call call = vndf_call_of(m->batch, &m->batch->lobe[l].surface, task, &a);
    for (int r = 0; r < VNDF_READ_A; r++)
        if (call.read[r] && !(call.shared >> r & 1))
            call.read[r] += m->first;
    call.which = which;
    call.count = (size_t)m->count;
    if (which)
        VNDF_OF_LANES(vndf_lanes_)(&call);
}

static const uint64_t everything = ~(uint64_t)0;

static void set_weights(mixtures *m, real weight[GROUPS][LOBES])
{
    const vndf_batch *b = m->batch;
    for (int l = 0; l < b->lobes; l++) {
        row of;
        if (!(b->shared & VNDF_SHARED_WEIGHT))
            memcpy(of, b->lobe[l].weight + m->first, (size_t)m->count * sizeof(float));
        for (int g = 0; g < m->groups; g++)
            weight[g][l] = b->shared & VNDF_SHARED_WEIGHT ? set(*b->lobe[l].weight) : of[g];
    }
    for (int g = 0; g < m->groups; g++) {
        lobe_weights((lobe_numbers){weight[g]}, b->lobes);
        m->has[g] = set_int(0);
        for (int l = 0; l < b->lobes; l++)
            m->has[g] |= select_int(lt(set(0.0f), weight[g][l]), set_int(1 << l), set_int(0));
    }
}

static void set_shares(mixtures *m, vndf_task area)
{
    real weight[GROUPS][LOBES];
    row value, valid;
    set_weights(m, weight);
    for (int l = 0; l < m->batch->lobes; l++) {
        ask_lobe(m, l, area, everything, (vndf_arrays){.write = {numbers(value), numbers(valid)}});
        for (int g = 0; g < m->groups; g++) {
            m->share[g][l] = value[g];
            m->has[g] = select_int(both(has_lobe(m, g, l), le(valid[g], set(0.0f))), set_int(0), m->has[g]);
        }
    }
    for (int g = 0; g < m->groups; g++)
        lobe_shares((lobe_numbers){weight[g]}, (lobe_numbers){m->share[g]}, m->batch->lobes);
}

KERNEL uint64_t chosen_bits(const mixtures *m, const integer *chosen, int l)
{
    uint64_t which = 0;
    for (int g = 0; g < m->groups; g++)
        which |= (uint64_t)mask_bits(eq(chosen[g], l)) << g * LANES;
    return which & ~(uint64_t)0 >> (BLOCK - m->count);
}

/* The sum over the lobes of their share times what a task finds, `known` of the lobe that was `chosen`; of densities 0
 * where no lobe has one. */
static void sum_lobes(const mixtures *m, vndf_task task, vndf_arrays a, const integer *chosen, const real *known,
                      real *sum)
{
    row value, largest;
    a.write[0] = numbers(value);
    for (int g = 0; g < m->groups; g++)
        sum[g] = largest[g] = set(0.0f);
    for (int l = 0; l < m->batch->lobes; l++) {
        const uint64_t others = chosen ? ~chosen_bits(m, chosen, l) : everything;
        ask_lobe(m, l, task, __builtin_popcountll(~others) * 4 < m->count ? everything : others, a);
        for (int g = 0; g < m->groups; g++) {
            real of = chosen ? select(eq(chosen[g], l), known[g], value[g]) : value[g];
            of = select(has_lobe(m, g, l), of, set(0.0f));
            largest[g] = max(largest[g], of);
            sum[g] = sum[g] + m->share[g][l] * of;
        }
    }
    for (int g = 0; g < m->groups; g++) {
        real all = task == VNDF_TASK_PDF ? lobe_density(sum[g], largest[g]) : min(sum[g], set(3.4028234e38f));
        sum[g] = select(eq(m->has[g], 0), set(0.0f), all);
    }
}

/* ---- tasks ---- */

/* Picks lobes, -1 for what is invalid, and stretches u1 to [0, 1] in the interval of each. */
static void pick_lobes(const mixtures *m, real *u1, integer *chosen)
{
    for (int g = 0; g < m->groups; g++) {
        real u = unit_number(u1[g]), begin = set(0.0f), end = begin, share = set(1.0f);
        integer at = set_int(-1);
        for (int l = 0; l < m->batch->lobes; l++) { /* the last one takes what rounding leaves */
            real part = m->share[g][l];
            mask takes = both(both(has_lobe(m, g, l), lt(set(0.0f), part)), le(end, u));
            at = select_int(takes, set_int(l), at);
            share = select(takes, part, share);
            begin = select(takes, end, begin);
            end = select(takes, end + part, end);
        }
        u1[g] = (u - begin) / share;
        chosen[g] = at;
    }
}

/* Lobes, normals and, if they are asked for, densities. */
static void sample_mixtures(const mixtures *m, vndf_arrays given, row to[VNDF_WRITES], integer *chosen)
{
    real *const u1 = to[4]; /* a row that is free */
    const vndf_arrays normals = {{numbers(to[0]), numbers(to[1]), numbers(to[2])}, {NULL}},
                      drawn = {{numbers(u1), given.given[1]},
                               {numbers(to[0]), numbers(to[1]), numbers(to[2]), numbers(to[3])}};
    memcpy(u1, given.given[0], (size_t)m->count * sizeof(float));
    pick_lobes(m, u1, chosen);
    for (int g = 0; g < m->groups; g++) {
        to[0][g] = to[1][g] = to[3][g] = set(0.0f);
        to[2][g] = set(1.0f);
    }
    for (int l = 0; l < m->batch->lobes; l++)
        ask_lobe(m, l, VNDF_TASK_SAMPLE, chosen_bits(m, chosen, l), drawn);
    if (!given.write[3] && !given.write[4])
        return;
    sum_lobes(m, VNDF_TASK_PDF, normals, chosen, to[3], u1);
    for (int g = 0; g < m->groups; g++)
        to[3][g] = select(lt(set(0.0f), to[3][g]), u1[g], set(0.0f));
}

static void weigh_samples(mixtures *m, row to[VNDF_WRITES])
{
    const vndf_arrays normals = {{numbers(to[0]), numbers(to[1]), numbers(to[2])}, {NULL}};
    set_shares(m, VNDF_TASK_AREA);
    sum_lobes(m, VNDF_TASK_VISIBLE, normals, NULL, NULL, to[4]);
    for (int g = 0; g < m->groups; g++)
        to[4][g] = select(lt(set(0.0f), to[3][g]), min(to[4][g] / to[3][g], set(3.4028234e38f)), set(0.0f));
}

/* What masking makes of areas. */
static void mask_mixtures(const mixtures *m, vndf_task task, vndf_arrays given, row to[2])
{
    sum_lobes(m, VNDF_TASK_AREA, given, NULL, NULL, to[0]);
    sum_lobes(m, VNDF_TASK_COSINE, given, NULL, NULL, to[1]);
    for (int g = 0; g < m->groups; g++)
        to[0][g] = task == VNDF_TASK_LAMBDA ? lambda_of(to[0][g], to[1][g]) : g1_of(to[0][g], to[1][g]);
}

void VNDF_OF_LANES(vndf_mixtures_)(const vndf_batch *b, vndf_task task, const vndf_arrays *a)
{
    mixtures m; /* of which what is read is set */
    row to[VNDF_WRITES];
    integer chosen[GROUPS];
    m.batch = b;
    for (m.first = 0; m.first < b->count; m.first += BLOCK) {
        vndf_arrays here = *a;
        for (int i = 0; i < 3; i++)
            here.given[i] = a->given[i] ? a->given[i] + m.first : NULL;
        m.count = b->count - m.first < BLOCK ? (int)(b->count - m.first) : BLOCK;
        m.groups = (m.count + LANES - 1) / LANES;
        if (task < VNDF_TASK_NDF) /* densities go by shares, all else by weights */
            set_shares(&m, task == VNDF_TASK_VISIBLE ? VNDF_TASK_AREA : VNDF_TASK_DRAWN_AREA);
        else
            set_weights(&m, m.share);
        if (task == VNDF_TASK_SAMPLE)
            sample_mixtures(&m, here, to, chosen);
        else if (task == VNDF_TASK_LAMBDA || task == VNDF_TASK_G1)
            mask_mixtures(&m, task, here, to);
        else
            sum_lobes(&m, task, here, NULL, NULL, to[0]);
        if (a->write[4])
            weigh_samples(&m, to);
        for (int w = 0; w < VNDF_WRITES; w++)
            if (a->write[w])
                memcpy(a->write[w] + m.first, to[w], (size_t)m.count * sizeof(float));
        if (task == VNDF_TASK_SAMPLE && b->drawn)
            memcpy(b->drawn + m.first, chosen, (size_t)m.count * sizeof(int));
    }
}

#endif
