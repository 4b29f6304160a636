/* Time: all methods take turns (turns.h), each turn with new random inputs. Three ways: a direction each; many samples
 * for one direction; and, for scalar methods, each input depends on the last output. */
#include <math.h>
#include <stdlib.h>

#include "bench/parts.h"
#include "cli/clock.h"
#include "measure/turns.h"

enum { EACH = 0, SHARED = 1, LATENCY = 2, WAYS = 3 };

static double elapsed(const bench_clock *at)
{
    return clock_seconds() - at->start;
}

int bench_go_on(const bench_clock *at, const char *what)
{
    double done = fmin(elapsed(at) / at->plan->seconds, 0.99);
    return !at->plan->progress || at->plan->progress(done, what, at->plan->progress_user) == 0;
}

/* ---- one pass ---------------------------------------------------------------------------------- */

/* What is added to roughness and uniform numbers is zero, but the processor has to wait for it. */
static void pass_in_a_row(const method *m, const method_inputs *in, const method_outputs *out)
{
    float wait = 0;
    for (size_t i = 0; i < in->count; i++) {
        method_input at = in->at[i];
        at.alpha += wait;
        at.u1 += wait;
        at.u2 += wait;
        vndf_vec3 wm = m->one(m, &at, &out->pdf[i]);
        wait = 0.0f * (out->pdf[i] < 1e30f ? out->pdf[i] : 1.0f) * wm.z;
    }
}

static method_run *run_of(const method *m, int way)
{
    return way == EACH ? m->each : way == SHARED ? m->shared : m->one ? pass_in_a_row : NULL;
}

typedef struct pass {
    const method *m;
    method_run *run;
    method_inputs in;
    method_outputs out;
} pass;

static void run_pass(void *user)
{
    const pass *p = user;
    p->run(p->m, &p->in, &p->out);
}

/* ---- all turns --------------------------------------------------------------------------------- */

typedef struct contenders {
    const bench_list *list;
    const bench_clock *at;
    bench_block *block;
} contenders;

/* Nanoseconds for a sample in all ways. */
static void time_entry(const bench_entry *e, pass *p, double ns[WAYS])
{
    p->m = &e->m;
    for (int way = 0; way < WAYS; way++)
        if ((p->run = run_of(p->m, way)) != NULL)
            ns[way] = 1e9 * turns_seconds(run_pass, p) / BENCH_BLOCK;
}

static int take_turn(void *user, size_t turn, double *number)
{
    const contenders *c = user;
    for (bench_subject subject = 0; subject < BENCH_SUBJECTS; subject++) {
        if (!c->list->reference[subject].canonical.distribution)
            continue;
        bench_block_fill(c->block, &c->list->reference[subject], 1000 + turn);
        pass p = {.in = bench_block_inputs(c->block), .out = bench_block_outputs(c->block)};
        for (size_t i = 0; i < c->list->count; i++) {
            const bench_entry *e = &c->list->entry[i];
            if (e->subject == subject && !e->row.wrong)
                time_entry(e, &p, number + i * WAYS);
        }
        if (!bench_go_on(c->at, "taking turns"))
            return 0;
    }
    return 1;
}

static void note_times(bench_row *row, const turns_quartiles of[WAYS])
{
    row->ns = of[EACH].median;
    row->ns_low = of[EACH].low;
    row->ns_high = of[EACH].high;
    row->shared_ns = of[SHARED].median;
    row->latency_ns = of[LATENCY].median;
}

vndf_status bench_time(bench_list *list, const bench_clock *at)
{
    bench_block *block = malloc(sizeof *block);
    turns_quartiles *found = malloc(list->count * WAYS * sizeof *found);
    contenders c = {list, at, block};
    const turns_plan plan = {.series = list->count * WAYS,
                             .least = 7,
                             .most = 501,
                             .seconds = at->plan->seconds - elapsed(at),
                             .take = take_turn,
                             .user = &c};
    vndf_status status = block && found ? turns_run(&plan, found) : VNDF_ERROR_MEMORY;
    for (size_t i = 0; i < list->count && status == VNDF_OK; i++)
        note_times(&list->entry[i].row, found + i * WAYS);
    free(found);
    free(block);
    return status;
}
