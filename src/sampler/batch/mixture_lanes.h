/* Mixtures in lanes, over the blocks of lanes_block.c: areas of each lobe give the shares, u1 picks lobes, the elements
 * of each lobe are put together to be drawn, and so are those for which the density of a lobe is still missing. Sums go
 * over the lobes in the order of mixture.c; a lobe of weight 0 adds nothing. */
#ifndef VNDF_SAMPLER_BATCH_MIXTURE_LANES_H
#define VNDF_SAMPLER_BATCH_MIXTURE_LANES_H

/* The tables of a call's lobes. */
typedef struct lobes {
    table t[VNDF_MIXTURE_LOBES];
    table_copies parts[VNDF_MIXTURE_LOBES];
} lobes;

/* A block of mixtures: of each lobe its weight over the sum of all, its share, and what a task found; which mixtures
 * are valid; the chosen lobe, where its share begins, and what is drawn from it with. */
typedef struct mixed {
    const vndf_call *call;
    lobes *of;
    size_t first;
    int count, groups;
    row weight[VNDF_MIXTURE_LOBES], share[VNDF_MIXTURE_LOBES], value[VNDF_MIXTURE_LOBES];
    mask valid[GROUPS];
    whole chosen[GROUPS];
    row begin, u;
} mixed;

/* A lobe of the block, as a block of its own. */
STEP void enter_lobe(const mixed *m, int l, vndf_task task, block *b, copies *c)
{
    b->lobe = &m->call->lobe[l];
    b->task = task;
    b->t = m->of->t[l];
    b->groups = m->groups;
    b->plain = 0;
    place_reads(b, m->first, m->count, 1, c);
}

/* A task on all elements of a lobe; the block says which of them are valid. */
STEP void run_lobe(const mixed *m, int l, vndf_task task, float *to, block *b)
{
    copies c;
    float *const writes[VNDF_WRITES] = {to};
    enter_lobe(m, l, task, b, &c);
    set_valid(b, &c);
    run_block(b, writes);
}

/* A task on some elements of a lobe, all of them valid, with these numbers or this normal. */
STEP void run_some(const mixed *m, int l, vndf_task task, some *e, const float *const from[3], int numbers,
                   float *const to[VNDF_WRITES])
{
    block b;
    copies c, own;
    float *results[VNDF_WRITES];
    count_some(e, m->groups);
    if (e->count == 0)
        return;
    enter_lobe(m, l, task, &b, &c);
    for (int r = 0; r < VNDF_READ_A; r++)
        if (b.lobe->read[r] && !(b.lobe->shared >> r & 1)) { /* others are the same for all */
            gather(e, m->groups, b.read[r], own.read[r]);
            b.read[r] = own.read[r];
        }
    for (int n = 0; n < numbers; n++) {
        gather(e, m->groups, from[n], own.read[VNDF_READ_A + n]);
        b.read[VNDF_READ_A + n] = own.read[VNDF_READ_A + n];
    }
    for (int g = 0; g < e->groups; g++)
        b.valid[g] = same(set_whole(0), 0);
    for (int w = 0; w < VNDF_WRITES; w++)
        results[w] = to[w] ? own.write[w] : NULL;
    b.groups = e->groups;
    run_block(&b, results);
    for (int w = 0; w < VNDF_WRITES; w++)
        if (to[w])
            scatter(e, m->groups, results[w], to[w]);
}

/* ---- weights and shares ---- */

HERE mask has_lobe(const mixed *m, int l, int g)
{
    return less(set(0.0f), load(m->weight[l] + g * LANES));
}

/* Weights over the largest and then over their sum; `projection` becomes the sum of what lobes make of the cosine. */
HERE void set_weights(mixed *m, real projection[GROUPS])
{
    const int n = m->call->lobes;
    row cosine[VNDF_MIXTURE_LOBES];
    for (int l = 0; l < n; l++) {
        block b;
        copies c;
        enter_lobe(m, l, VNDF_TASK_AREA, &b, &c);
        for (int g = 0; g < m->groups; g++) {
            real x = input(&b, VNDF_READ_WI_X, g), y = input(&b, VNDF_READ_WI_Y, g),
                 z = input(&b, VNDF_READ_WI_Z, g);
            store(cosine[l] + g * LANES,
                  z - (x * input(&b, VNDF_READ_MEAN_X, g) + y * input(&b, VNDF_READ_MEAN_Y, g)));
            store(m->weight[l] + g * LANES, input(&b, VNDF_READ_WEIGHT, g));
        }
    }
    for (int g = 0; g < m->groups; g++) {
        const real zero = set(0.0f), end = set(3.40282347e38f);
        real largest = zero, sum = zero;
        mask valid = same(set_whole(0), 0);
        for (int l = 0; l < n; l++) {
            real w = load(m->weight[l] + g * LANES);
            valid = both(valid, both(at_most(zero, w), at_most(w, end)));
            largest = most(largest, w);
        }
        m->valid[g] = valid = both(valid, less(zero, largest));
        for (int l = 0; l < n; l++) {
            real w = pick(valid, load(m->weight[l] + g * LANES) / largest, zero);
            store(m->weight[l] + g * LANES, w);
            sum = sum + w;
        }
        projection[g] = zero;
        for (int l = 0; l < n; l++) {
            real w = pick(valid, load(m->weight[l] + g * LANES) / sum, zero);
            store(m->weight[l] + g * LANES, w);
            projection[g] = projection[g] + pick(less(zero, w), w * load(cosine[l] + g * LANES), zero);
        }
    }
}

/* Of valid surfaces: the areas, drawn or true, over their sum; the weights where no lobe sees an area that a float can
 * hold. */
HERE void set_shares(mixed *m, vndf_task area)
{
    const int n = m->call->lobes;
    real sum[GROUPS], total[GROUPS];
    for (int g = 0; g < m->groups; g++)
        sum[g] = total[g] = set(0.0f);
    for (int l = 0; l < n; l++) {
        block b;
        run_lobe(m, l, area, m->share[l], &b);
        for (int g = 0; g < m->groups; g++) {
            mask has = has_lobe(m, l, g);
            real w = load(m->weight[l] + g * LANES);
            real part = pick(has, w * load(m->share[l] + g * LANES), set(0.0f));
            m->valid[g] = both(m->valid[g], either(b.valid[g], (mask)~has));
            store(m->share[l] + g * LANES, part);
            sum[g] = sum[g] + part;
            total[g] = total[g] + w;
        }
    }
    for (int l = 0; l < n; l++)
        for (int g = 0; g < m->groups; g++) {
            real part = load(m->share[l] + g * LANES) / sum[g], w = load(m->weight[l] + g * LANES) / total[g];
            store(m->share[l] + g * LANES, pick(less(set(1.17549435e-38f), sum[g]), part, w));
        }
}

/* The sum of `by` times what a task finds, over the lobes. */
HERE void sum_lobes(mixed *m, vndf_task task, row *by, real sum[GROUPS])
{
    for (int g = 0; g < m->groups; g++)
        sum[g] = set(0.0f);
    for (int l = 0; l < m->call->lobes; l++) {
        block b;
        run_lobe(m, l, task, m->value[l], &b);
        for (int g = 0; g < m->groups; g++) {
            real part = load(by[l] + g * LANES) * load(m->value[l] + g * LANES);
            sum[g] = sum[g] + pick(has_lobe(m, l, g), part, set(0.0f));
        }
    }
}

/* ---- tasks ---- */

/* The lobe that u1 picks, and u1 within its share. */
HERE void choose_lobes(mixed *m, const block *b)
{
    for (int g = 0; g < m->groups; g++) {
        real u = unit_input(b, VNDF_READ_A, g), begin = set(0.0f), share = set(1.0f);
        whole chosen = set_whole(-1), last = chosen;
        for (int l = 0; l < m->call->lobes; l++)
            last = pick_whole(has_lobe(m, l, g), set_whole(l), last);
        for (int l = 0; l < m->call->lobes; l++) {
            real part = load(m->share[l] + g * LANES);
            mask open = both(both(has_lobe(m, l, g), m->valid[g]), same(chosen, -1));
            mask stop = both(open, either(less(u, begin + part), same(last, l)));
            chosen = pick_whole(stop, set_whole(l), chosen);
            share = pick(stop, part, share);
            begin = pick(both(open, same(chosen, -1)), begin + part, begin);
        }
        m->chosen[g] = chosen;
        store(m->u + g * LANES, (u - begin) / share);
    }
}

/* Normals and their densities go to to[0] to to[3]. */
STEP void sample_mixtures(mixed *m, float *const to[VNDF_WRITES])
{
    block b;
    copies c;
    row u2, known;
    some e;
    const float *const numbers[3] = {m->u, u2, NULL}, *const normal[3] = {to[0], to[1], to[2]};
    float *const drawn_to[VNDF_WRITES] = {to[0], to[1], to[2], known};
    enter_lobe(m, 0, VNDF_TASK_SAMPLE, &b, &c);
    choose_lobes(m, &b);
    for (int g = 0; g < m->groups; g++) {
        store(u2 + g * LANES, unit_input(&b, VNDF_READ_B, g));
        store(to[0] + g * LANES, set(0.0f));
        store(to[1] + g * LANES, set(0.0f));
        store(to[2] + g * LANES, set(1.0f));
        store(known + g * LANES, set(0.0f));
    }
    for (int l = 0; l < m->call->lobes; l++) {
        for (int g = 0; g < m->groups; g++)
            e.of[g] = same(m->chosen[g], l);
        run_some(m, l, VNDF_TASK_SAMPLE, &e, numbers, 2, drawn_to);
    }
    if (!m->call->write[3])
        return;
    real sum[GROUPS];
    for (int g = 0; g < m->groups; g++)
        sum[g] = set(0.0f);
    for (int l = 0; l < m->call->lobes; l++) {
        float *const density[VNDF_WRITES] = {m->value[l]};
        for (int g = 0; g < m->groups; g++) {
            mask other = less(set(0.5f), size(to_real(m->chosen[g] - l)));
            e.of[g] = both(both(m->valid[g], has_lobe(m, l, g)), other);
        }
        memcpy(m->value[l], known, sizeof known);
        run_some(m, l, VNDF_TASK_PDF, &e, normal, 3, density);
        for (int g = 0; g < m->groups; g++) {
            real part = load(m->share[l] + g * LANES) * load(m->value[l] + g * LANES);
            sum[g] = sum[g] + pick(has_lobe(m, l, g), part, set(0.0f));
        }
    }
    for (int g = 0; g < m->groups; g++) {
        real d = least(most(sum[g], set(1.17549435e-38f)), set(3.40282347e38f));
        store(to[3] + g * LANES, pick(less(set(0.0f), load(known + g * LANES)), d, set(0.0f)));
    }
}

/* The lobe that is asked for, or that draws the normal most often. */
STEP void invert_mixtures(mixed *m, float *const to[VNDF_WRITES])
{
    block b;
    copies c;
    some e;
    real sum[GROUPS], share[GROUPS];
    enter_lobe(m, 0, VNDF_TASK_INVERT, &b, &c);
    const float *const normal[3] = {b.read[VNDF_READ_A], b.read[VNDF_READ_B], b.read[VNDF_READ_C]};
    sum_lobes(m, VNDF_TASK_PDF, m->share, sum);
    for (int g = 0; g < m->groups; g++) {
        whole asked = set_whole(-1), chosen = asked;
        real begin = set(0.0f), best = set(-1.0f), best_begin = begin;
        for (int l = 0; m->call->asked && l < LANES; l++)
            if (g * LANES + l < m->count)
                asked[l] = m->call->asked[m->first + (size_t)(g * LANES + l)];
        mask any_lobe = less_whole(asked, set_whole(0));
        share[g] = begin;
        for (int l = 0; l < m->call->lobes; l++) {
            real part = load(m->share[l] + g * LANES), often = part * load(m->value[l] + g * LANES);
            mask better = either(same(asked, l), both(any_lobe, less(best, often)));
            mask take = both(both(m->valid[g], has_lobe(m, l, g)), better);
            chosen = pick_whole(take, set_whole(l), chosen);
            best = pick(take, often, best);
            best_begin = pick(take, begin, best_begin);
            share[g] = pick(take, part, share[g]);
            begin = pick(has_lobe(m, l, g), begin + part, begin);
        }
        m->chosen[g] = chosen;
        store(m->begin + g * LANES, best_begin);
        store(to[0] + g * LANES, set(0.0f));
        store(to[1] + g * LANES, set(0.0f));
    }
    for (int l = 0; l < m->call->lobes; l++) {
        for (int g = 0; g < m->groups; g++)
            e.of[g] = same(m->chosen[g], l);
        run_some(m, l, VNDF_TASK_INVERT, &e, normal, 3, to);
    }
    for (int g = 0; g < m->groups; g++) {
        real u = load(m->begin + g * LANES) + load(to[0] + g * LANES) * share[g];
        store(to[0] + g * LANES, least(most(u, set(0.0f)), set(1.0f)));
    }
}

/* Densities, by the shares of lobes: where the first lobe sees the normal none is 0. D, areas and what masking makes of
 * them, by the weights. */
STEP void sum_mixtures(mixed *m, const real *projection, float *to)
{
    const real zero = set(0.0f), end = set(3.40282347e38f);
    const vndf_task task = m->call->task;
    real sum[GROUPS];
    sum_lobes(m, task > VNDF_TASK_NDF ? VNDF_TASK_AREA : task, task < VNDF_TASK_NDF ? m->share : m->weight, sum);
    for (int g = 0; g < m->groups; g++) {
        real first = zero, d = sum[g], cosine = least(projection[g], end);
        for (int l = m->call->lobes; task == VNDF_TASK_PDF && l-- > 0;)
            first = pick(has_lobe(m, l, g), load(m->value[l] + g * LANES), first);
        if (task == VNDF_TASK_PDF)
            d = pick(less(zero, first), most(d, set(1.17549435e-38f)), zero);
        d = least(d, end);
        if (task == VNDF_TASK_LAMBDA)
            d = lambda_of(d, cosine);
        else if (task == VNDF_TASK_G1)
            d = g1_of(d, cosine);
        store(to + g * LANES, pick(m->valid[g], d, zero));
    }
}

STEP void block_of_mixtures(mixed *m, float *const to[VNDF_WRITES])
{
    real projection[GROUPS];
    const vndf_task task = m->call->task;
    set_weights(m, projection);
    if (task < VNDF_TASK_NDF)
        set_shares(m, task == VNDF_TASK_VISIBLE ? VNDF_TASK_AREA : VNDF_TASK_DRAWN_AREA);
    if (task == VNDF_TASK_SAMPLE)
        sample_mixtures(m, to);
    else if (task == VNDF_TASK_INVERT)
        invert_mixtures(m, to);
    else
        sum_mixtures(m, projection, to[0]);
}

static void mixtures(const vndf_call *call)
{
    lobes of;
    mixed m = {.call = call, .of = &of};
    row results[VNDF_WRITES];
    float *const to[VNDF_WRITES] = {results[0], results[1], results[2], results[3]};
    for (int l = 0; l < call->lobes; l++)
        if (call->lobe[l].distribution->kind == VNDF_KIND_TABLE)
            of.t[l] = table_of(call->lobe[l].distribution, &of.parts[l]);
    for (m.first = 0; m.first < call->count; m.first += BLOCK) {
        m.count = call->count - m.first < BLOCK ? (int)(call->count - m.first) : BLOCK;
        m.groups = (m.count + LANES - 1) / LANES;
        block_of_mixtures(&m, to);
        for (int w = 0; w < VNDF_WRITES; w++)
            if (call->write[w])
                memcpy(call->write[w] + m.first, results[w], (size_t)m.count * sizeof(float));
        if (call->drawn)
            memcpy(call->drawn + m.first, m.chosen, (size_t)m.count * sizeof(int));
    }
}

#endif
