/* Batches of mixtures, made of batches of their lobes: areas give the shares, u1 picks lobes, the elements of each lobe
 * are drawn together, and so are the densities that are still missing. Sums are those of mixture.c, where a lobe of
 * weight 0 adds nothing. */
#include <string.h>

#include "sampler/batch/call.h"
#include "sampler/lobes.h"

enum { BLOCK = VNDF_MIXTURES, LOBES = VNDF_MIXTURE_LOBES };

/* A batch, whose lobes are calls; and of a block of it the weight of each lobe over the sum of all, its share, and what
 * a task found. */
typedef struct mixed {
    const vndf_mixture_batch *of;
    const vndf_lanes *lanes;
    vndf_call call[LOBES];
    vndf_prepared prepared[LOBES];
    size_t first;
    int lobes, count;
    float weight[LOBES][BLOCK], share[LOBES][BLOCK], value[LOBES][BLOCK];
    int weighed[BLOCK], valid[BLOCK]; /* whether weights are valid; and surfaces, where these matter */
} mixed;

/* A task on the elements `at` of a lobe, or on all of them, with these numbers or this normal. */
static void ask_lobe(const mixed *m, int l, vndf_task task, const int *at, int count, const float *const inputs[3],
                     float *const write[VNDF_WRITES])
{
    vndf_call call = m->call[l];
    for (int r = 0; r < VNDF_READ_A; r++)
        if (call.read[r] && !(call.shared >> r & 1))
            call.read[r] += m->first;
    for (int i = 0; inputs && i < 3; i++)
        call.read[VNDF_READ_A + i] = inputs[i];
    memcpy(call.write, write, sizeof call.write);
    call.task = task;
    call.at = at;
    call.count = (size_t)count;
    if (count > 0)
        m->lanes->run(&call);
}

static float number(const mixed *m, int l, int which, int i)
{
    const vndf_call *c = &m->call[l];
    return !c->read[which] ? 0.0f : c->read[which][c->shared >> which & 1 ? 0 : m->first + (size_t)i];
}

static void set_weights(mixed *m)
{
    const int shared = m->of->shared & VNDF_SHARED_WEIGHT;
    for (int l = 0; l < m->lobes; l++)
        for (int i = 0; i < m->count; i++)
            m->weight[l][i] = m->of->lobe[l].weight[shared ? 0 : m->first + (size_t)i];
    vndf_weigh_lobes(m->lobes, m->count, BLOCK, m->weight[0], m->weighed);
}

static void set_shares(mixed *m, vndf_task area)
{
    float is_valid[BLOCK];
    for (int l = 0; l < m->lobes; l++) {
        float *const write[VNDF_WRITES] = {m->share[l], is_valid};
        ask_lobe(m, l, area, NULL, m->count, NULL, write);
        for (int i = 0; i < m->count; i++)
            m->valid[i] &= (is_valid[i] > 0.0f) | !(m->weight[l][i] > 0.0f);
    }
    vndf_share_lobes(m->lobes, m->count, BLOCK, m->weight[0], m->share[0]);
}

/* The sum of `by` times what a task finds, over the lobes. */
static void sum_lobes(mixed *m, vndf_task task, float by[LOBES][BLOCK], const float *const inputs[3], float *sum)
{
    memset(sum, 0, BLOCK * sizeof *sum);
    for (int l = 0; l < m->lobes; l++) {
        float *const write[VNDF_WRITES] = {m->value[l]};
        ask_lobe(m, l, task, NULL, m->count, inputs, write);
        for (int i = 0; i < m->count; i++) {
            const float part = by[l][i] * m->value[l][i];
            sum[i] += m->weight[l][i] > 0.0f ? part : 0.0f;
        }
    }
}

/* ---- tasks ---- */

/* The lobes that numbers u1 pick, or -1, and in `u` u1 within their shares. */
static void choose_lobes(const mixed *m, const float *u1, int *chosen, float *u)
{
    float begin[BLOCK], end[BLOCK], share[BLOCK];
    for (int i = 0; i < m->count; i++) {
        u[i] = vndf_clamp_unit(u1[i]);
        chosen[i] = -1;
        begin[i] = end[i] = 0.0f;
        share[i] = 1.0f;
    }
    for (int l = 0; l < m->lobes; l++)
        for (int i = 0; i < m->count; i++) { /* the last one takes what rounding leaves */
            const int takes = m->valid[i] & (m->weight[l][i] > 0.0f) & (u[i] >= end[i]);
            chosen[i] = takes ? l : chosen[i];
            share[i] = takes ? m->share[l][i] : share[i];
            begin[i] = takes ? end[i] : begin[i];
            end[i] = takes ? end[i] + m->share[l][i] : end[i];
        }
    for (int i = 0; i < m->count; i++)
        u[i] = (u[i] - begin[i]) / share[i];
}

/* Normals, and densities if they are asked for, go to `to`. */
static void sample_mixtures(mixed *m, const float *const inputs[3], float (*to)[BLOCK], int *chosen, int with_pdf)
{
    float u1[BLOCK];
    int list[BLOCK];
    const float *const numbers[3] = {u1, inputs[1], NULL}, *const normal[3] = {to[0], to[1], to[2]};
    choose_lobes(m, inputs[0], chosen, u1);
    for (int i = 0; i < m->count; i++) {
        to[0][i] = to[1][i] = to[3][i] = 0.0f;
        to[2][i] = 1.0f;
    }
    for (int l = 0; l < m->lobes; l++) {
        float *const write[VNDF_WRITES] = {to[0], to[1], to[2], to[3]};
        int count = 0;
        for (int i = 0; i < m->count; i++) {
            list[count] = i;
            count += chosen[i] == l;
        }
        ask_lobe(m, l, VNDF_TASK_SAMPLE, list, count, numbers, write);
    }
    if (!with_pdf)
        return;
    float sum[BLOCK] = {0.0f};
    for (int l = 0; l < m->lobes; l++) {
        float *const write[VNDF_WRITES] = {m->value[l]};
        int count = 0;
        for (int i = 0; i < m->count; i++) {
            list[count] = i;
            count += (chosen[i] >= 0) & (chosen[i] != l) & (m->weight[l][i] > 0.0f);
        }
        memcpy(m->value[l], to[3], sizeof m->value[l]);
        ask_lobe(m, l, VNDF_TASK_PDF, list, count, normal, write);
        for (int i = 0; i < m->count; i++) {
            const float part = m->share[l][i] * m->value[l][i];
            sum[i] += m->weight[l][i] > 0.0f ? part : 0.0f;
        }
    }
    for (int i = 0; i < m->count; i++)
        to[3][i] = to[3][i] > 0.0f ? least(most(sum[i], FLT_MIN), FLT_MAX) : 0.0f;
}

/* Lambda or G1 of mixtures with these areas. */
static void mask_mixtures(const mixed *m, vndf_task task, float *to)
{
    for (int i = 0; i < m->count; i++) {
        float cosine = 0.0f;
        for (int l = 0; l < m->lobes; l++) {
            const float x = number(m, l, VNDF_READ_WI_X, i), y = number(m, l, VNDF_READ_WI_Y, i);
            const float level = x * number(m, l, VNDF_READ_MEAN_X, i) + y * number(m, l, VNDF_READ_MEAN_Y, i);
            const float part = m->weight[l][i] * (number(m, l, VNDF_READ_WI_Z, i) - level);
            cosine += m->weight[l][i] > 0.0f ? part : 0.0f;
        }
        cosine = least(cosine, FLT_MAX);
        to[i] = task == VNDF_TASK_LAMBDA ? lambda_of(to[i], cosine) : g1_of(to[i], cosine);
    }
}

/* Densities, by the shares of lobes: where the first lobe sees the normal none is 0. D, areas and what masking makes of
 * them, by the weights. */
static void sum_mixtures(mixed *m, vndf_task task, const float *const inputs[3], float *to)
{
    const int masks = task == VNDF_TASK_LAMBDA || task == VNDF_TASK_G1;
    float first[BLOCK] = {0.0f};
    sum_lobes(m, masks ? VNDF_TASK_AREA : task, task < VNDF_TASK_NDF ? m->share : m->weight, inputs, to);
    for (int l = m->lobes; task == VNDF_TASK_PDF && l-- > 0;)
        for (int i = 0; i < m->count; i++)
            first[i] = m->weight[l][i] > 0.0f ? m->value[l][i] : first[i];
    for (int i = 0; task == VNDF_TASK_PDF && i < m->count; i++)
        to[i] = first[i] > 0.0f ? most(to[i], FLT_MIN) : 0.0f;
    for (int i = 0; i < m->count; i++)
        to[i] = least(to[i], FLT_MAX);
    if (masks)
        mask_mixtures(m, task, to);
    for (int i = 0; i < m->count; i++)
        to[i] = m->valid[i] ? to[i] : 0.0f;
}

/* The lobes as calls; a lobe without a distribution makes all mixtures invalid, one by one. */
static void set_lobes(mixed *m, const vndf_mixture_batch *b)
{
    m->of = b;
    m->lobes = b->lobes >= 1 && b->lobes <= LOBES ? b->lobes : 0;
    m->lanes = vndf_lanes_for(b->count, 0, b->limit);
    for (int l = 0; l < m->lobes; l++)
        m->lanes = b->lobe[l].distribution ? m->lanes : &vndf_one_by_one;
    for (int l = 0; l < m->lobes; l++) {
        const vndf_lobe_batch *a = &b->lobe[l];
        const vndf_batch surface = {a->distribution, b->count, b->shared, b->limit, a->xx,     a->yy,    b->wi_x,
                                    b->wi_y,         b->wi_z,  a->xy,     a->yx,    a->mean_x, a->mean_y};
        m->call[l] = vndf_call_of(&surface);
        m->call[l].diagonal = 0;
        m->call[l].prepared = &m->prepared[l];
        m->lanes->prepare(a->distribution, &m->prepared[l]);
    }
}

void vndf_run_mixtures(const vndf_mixture_batch *b, vndf_task task, vndf_arrays a, int *lobe)
{
    mixed m; /* large: nothing of it is set but what is read */
    float to[4][BLOCK];
    int chosen[BLOCK];
    set_lobes(&m, b);
    for (m.first = 0; m.first < b->count; m.first += BLOCK) {
        const float *here[3];
        m.count = b->count - m.first < BLOCK ? (int)(b->count - m.first) : BLOCK;
        for (int i = 0; i < 3; i++)
            here[i] = a.given[i] ? a.given[i] + m.first : NULL;
        if (m.first == 0 || !(b->shared & VNDF_SHARED_WEIGHT))
            set_weights(&m);
        memcpy(m.valid, m.weighed, (size_t)m.count * sizeof(int));
        if (task < VNDF_TASK_NDF)
            set_shares(&m, task == VNDF_TASK_VISIBLE ? VNDF_TASK_AREA : VNDF_TASK_DRAWN_AREA);
        if (task == VNDF_TASK_SAMPLE)
            sample_mixtures(&m, here, to, chosen, a.write[3] != NULL);
        else
            sum_mixtures(&m, task, here, to[0]);
        for (int w = 0; w < 4; w++)
            if (a.write[w])
                memcpy(a.write[w] + m.first, to[w], (size_t)m.count * sizeof(float));
        if (lobe)
            memcpy(lobe + m.first, chosen, (size_t)m.count * sizeof(int));
    }
}
