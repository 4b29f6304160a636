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
    vndf_lanes *lanes;
    vndf_call call[LOBES];
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
        m->lanes(&call);
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

/* The sum over the lobes of `by` times what a task finds; what elements are `chosen` for, if any are, is known. */
static void sum_lobes(mixed *m, vndf_task task, float by[LOBES][BLOCK], const float *const inputs[3],
                      const int *chosen, const float *known, float *sum)
{
    int list[BLOCK];
    for (int i = 0; i < m->count; i++)
        sum[i] = 0.0f;
    for (int l = 0; l < m->lobes; l++) {
        float *const write[VNDF_WRITES] = {m->value[l]};
        int count = chosen ? 0 : m->count;
        for (int i = 0; chosen && i < m->count; i++) {
            list[count] = i;
            count += (chosen[i] >= 0) & (chosen[i] != l) & (m->weight[l][i] > 0.0f);
            m->value[l][i] = known[i];
        }
        ask_lobe(m, l, task, chosen ? list : NULL, count, inputs, write);
        for (int i = 0; i < m->count; i++) {
            const float part = by[l][i] * m->value[l][i];
            sum[i] += m->weight[l][i] > 0.0f ? part : 0.0f;
        }
    }
}

/* ---- tasks ---- */

/* Lobes, -1 of what is invalid, normals and, if they are asked for, densities. */
static void sample_mixtures(mixed *m, const float *const inputs[3], float to[4][BLOCK], int *chosen, int with_pdf)
{
    float u1[BLOCK], begin[BLOCK], end[BLOCK], share[BLOCK], sum[BLOCK];
    int list[BLOCK];
    const float *const numbers[3] = {u1, inputs[1], NULL}, *const normal[3] = {to[0], to[1], to[2]};
    for (int i = 0; i < m->count; i++) {
        u1[i] = vndf_clamp_unit(inputs[0][i]);
        chosen[i] = -1;
        begin[i] = end[i] = to[0][i] = to[1][i] = to[3][i] = 0.0f;
        share[i] = to[2][i] = 1.0f;
    }
    for (int l = 0; l < m->lobes; l++)
        for (int i = 0; i < m->count; i++) { /* the last one takes what rounding leaves */
            const int takes = m->valid[i] & (m->share[l][i] > 0.0f) & (u1[i] >= end[i]);
            chosen[i] = takes ? l : chosen[i];
            share[i] = takes ? m->share[l][i] : share[i];
            begin[i] = takes ? end[i] : begin[i];
            end[i] = takes ? end[i] + m->share[l][i] : end[i];
        }
    for (int i = 0; i < m->count; i++)
        u1[i] = (u1[i] - begin[i]) / share[i];
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
    sum_lobes(m, VNDF_TASK_PDF, m->share, normal, chosen, to[3], sum);
    for (int i = 0; i < m->count; i++)
        to[3][i] = to[3][i] > 0.0f ? min(max(sum[i], FLT_MIN), FLT_MAX) : 0.0f;
}

/* Lambda or G1 of mixtures with these areas. */
static void mask_mixtures(const mixed *m, vndf_task task, float *to)
{
    for (int i = 0; i < m->count; i++) {
        float cosine = 0.0f;
        for (int l = 0; l < m->lobes; l++) {
            const vndf_call *call = &m->call[l];
            const size_t at = m->first + (size_t)i;
            const float x = vndf_call_number(call, VNDF_READ_WI_X, at),
                        y = vndf_call_number(call, VNDF_READ_WI_Y, at);
            const float level = x * vndf_call_number(call, VNDF_READ_MEAN_X, at) +
                                y * vndf_call_number(call, VNDF_READ_MEAN_Y, at);
            const float part = m->weight[l][i] * (vndf_call_number(call, VNDF_READ_WI_Z, at) - level);
            cosine += m->weight[l][i] > 0.0f ? part : 0.0f;
        }
        cosine = min(cosine, FLT_MAX);
        to[i] = task == VNDF_TASK_LAMBDA ? lambda_of(to[i], cosine) : g1_of(to[i], cosine);
    }
}

/* Densities, by the shares of lobes: where a lobe sees the normal none is 0. D, areas and what masking makes of them,
 * by the weights. */
static void sum_mixtures(mixed *m, vndf_task task, const float *const inputs[3], float *to)
{
    const int masks = task == VNDF_TASK_LAMBDA || task == VNDF_TASK_G1;
    sum_lobes(m, masks ? VNDF_TASK_AREA : task, task < VNDF_TASK_NDF ? m->share : m->weight, inputs, NULL, NULL,
              to);
    for (int i = 0; i < m->count; i++) {
        int is_seen = 0;
        for (int l = 0; l < m->lobes; l++)
            is_seen |= (m->weight[l][i] > 0.0f) & (m->value[l][i] > 0.0f);
        if (task == VNDF_TASK_PDF)
            to[i] = is_seen ? max(to[i], FLT_MIN) : 0.0f;
        to[i] = min(to[i], FLT_MAX);
    }
    if (masks)
        mask_mixtures(m, task, to);
    for (int i = 0; i < m->count; i++)
        to[i] = m->valid[i] ? to[i] : 0.0f;
}

/* The numbers that the lobe which draws a normal most often makes it of, one by one. */
static void invert_mixtures(const mixed *m, const vndf_batch *b, const float *const inputs[3], float to[4][BLOCK])
{
    for (int i = 0; i < m->count; i++) {
        const size_t at = m->first + (size_t)i;
        vndf_mixture of = {.count = m->lobes};
        for (int l = 0; l < m->lobes; l++)
            of.lobe[l] = (vndf_mixture_lobe){vndf_call_surface(&m->call[l], at),
                                             b->lobe[l].weight[b->shared & VNDF_SHARED_WEIGHT ? 0 : at]};
        const vndf_mixture_view view =
            vndf_mixture_view_from(&of, vndf_call_vec3(&m->call[0], VNDF_READ_WI_X, at));
        const vndf_vec3 wm = {inputs[0][i], inputs[1][i], inputs[2][i]};
        vndf_mixture_invert(&view, wm, -1, &to[0][i], &to[1][i]);
    }
}

/* The lobes as calls; a lobe without a distribution makes all mixtures invalid, one by one. */
static void set_lobes(mixed *m, const vndf_batch *b)
{
    m->lobes = b->lobes >= 1 && b->lobes <= LOBES ? b->lobes : 0;
    m->lanes = vndf_lanes_for(b->count, b->limit);
    m->call[0] = vndf_call_of(b, &b->lobe[0].surface);
    for (int l = 0; l < m->lobes; l++) {
        m->lanes = b->lobe[l].surface.distribution ? m->lanes : vndf_one_by_one;
        m->call[l] = vndf_call_of(b, &b->lobe[l].surface);
    }
}

void vndf_run_mixtures(const vndf_batch *b, vndf_task task, vndf_arrays a)
{
    mixed m; /* large: nothing of it is set but what is read */
    float to[VNDF_WRITES][BLOCK];
    int chosen[BLOCK];
    const int one = (b->shared & VNDF_SHARED_WEIGHT) != 0;
    const float *const normal[3] = {to[0], to[1], to[2]};
    set_lobes(&m, b);
    for (m.first = 0; m.first < b->count; m.first += BLOCK) {
        const float *here[3];
        m.count = b->count - m.first < BLOCK ? (int)(b->count - m.first) : BLOCK;
        for (int i = 0; i < 3; i++)
            here[i] = a.given[i] ? a.given[i] + m.first : NULL;
        for (int i = 0; i < m.count && (m.first == 0 || !one); i++) {
            for (int l = 0; l < m.lobes; l++)
                m.weight[l][i] = b->lobe[l].weight[one ? 0 : m.first + (size_t)i];
            m.weighed[i] = vndf_weigh_lobes(m.lobes, BLOCK, &m.weight[0][i]);
        }
        memcpy(m.valid, m.weighed, (size_t)m.count * sizeof(int));
        if (task < VNDF_TASK_NDF)
            set_shares(&m, task == VNDF_TASK_VISIBLE ? VNDF_TASK_AREA : VNDF_TASK_DRAWN_AREA);
        if (task == VNDF_TASK_SAMPLE)
            sample_mixtures(&m, here, to, chosen, a.write[3] || a.write[4]);
        else if (task == VNDF_TASK_INVERT)
            invert_mixtures(&m, b, here, to);
        else
            sum_mixtures(&m, task, here, to[0]);
        if (a.write[4]) {
            set_shares(&m, VNDF_TASK_AREA);
            sum_mixtures(&m, VNDF_TASK_VISIBLE, normal, to[4]);
            for (int i = 0; i < m.count; i++)
                to[4][i] = to[3][i] > 0.0f ? min(to[4][i] / to[3][i], FLT_MAX) : 0.0f;
        }
        for (int w = 0; w < VNDF_WRITES; w++)
            if (a.write[w])
                memcpy(a.write[w] + m.first, to[w], (size_t)m.count * sizeof(float));
        if (task == VNDF_TASK_SAMPLE && b->drawn)
            memcpy(b->drawn + m.first, chosen, (size_t)m.count * sizeof(int));
    }
}
