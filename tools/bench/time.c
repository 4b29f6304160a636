/* Time: all methods take turns, each turn with new random inputs, and the medians over the turns count.
 *
 * In a turn a method first runs once over its inputs, so that these and its tables are in the cache, and then
 * against the clock: once if that takes long enough, lest branches are learnt by heart. Three ways: a direction
 * each; many samples for one direction; and, for scalar methods, each input waiting for the last output. */
#include <math.h>
#include <stdlib.h>

#include "bench/parts.h"
#include "cli/clock.h"

enum { TURNS_MIN = 7, TURNS_MAX = 501, EACH = 0, SHARED = 1, LATENCY = 2, WAYS = 3 };

static const double turn_seconds = 20e-6; /* a pass shorter than this is repeated, for the clock's sake */

typedef struct times {
    double of[BENCH_ENTRIES_MAX][WAYS][TURNS_MAX];
} times;

double bench_elapsed(const bench_clock *at)
{
    return clock_seconds() - at->start;
}

int bench_go_on(const bench_clock *at, const char *what)
{
    double done = fmin(bench_elapsed(at) / at->plan->seconds, 0.99);
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

/* Nanoseconds for a sample. */
static double pass(const method *m, int way, const method_inputs *in, const method_outputs *out)
{
    method_run *run = run_of(m, way);
    if (!run)
        return NAN;
    double start = clock_seconds();
    run(m, in, out);
    double once = clock_seconds() - start;
    int repeats = (int)fmin(fmax(turn_seconds / fmax(once, 1e-7), 1), 100);
    start = clock_seconds();
    for (int i = 0; i < repeats; i++)
        run(m, in, out);
    return (clock_seconds() - start) * 1e9 / (double)repeats / BENCH_BLOCK;
}

/* ---- all turns --------------------------------------------------------------------------------- */

static int turn(bench_list *list, const bench_clock *at, times *t, bench_block *block, size_t index)
{
    for (bench_subject subject = 0; subject < BENCH_SUBJECTS; subject++) {
        if (!list->truth[subject].canonical.distribution)
            continue;
        bench_block_fill(block, &list->truth[subject], 1000 + index);
        method_inputs in = bench_block_inputs(block);
        method_outputs out = bench_block_outputs(block);
        for (size_t i = 0; i < list->count; i++) {
            const bench_entry *e = &list->entry[i];
            for (int way = 0; e->subject == subject && !e->row.wrong && way < WAYS; way++)
                t->of[i][way][index] = pass(&e->m, way, &in, &out);
        }
        if (!bench_go_on(at, "taking turns"))
            return 0;
    }
    return 1;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void summarize(bench_row *row, double of[WAYS][TURNS_MAX], size_t turns)
{
    for (int way = 0; way < WAYS; way++)
        qsort(of[way], turns, sizeof of[way][0], ascending);
    row->ns = of[EACH][turns / 2];
    row->ns_low = of[EACH][turns / 4];
    row->ns_high = of[EACH][3 * turns / 4];
    row->shared_ns = of[SHARED][turns / 2];
    row->latency_ns = of[LATENCY][turns / 2];
}

/* The first turn warms up the machine and is not counted. 0: stopped. */
static int take_turns(bench_list *list, const bench_clock *at, times *t, bench_block *block)
{
    size_t turns = 0;
    if (!turn(list, at, t, block, 0))
        return 0;
    for (; turns < TURNS_MAX && (turns < TURNS_MIN || bench_elapsed(at) < at->plan->seconds); turns++)
        if (!turn(list, at, t, block, turns))
            return 0;
    for (size_t i = 0; i < list->count; i++)
        if (!list->entry[i].row.wrong)
            summarize(&list->entry[i].row, t->of[i], turns);
    return 1;
}

vndf_status bench_time(bench_list *list, const bench_clock *at)
{
    times *t = malloc(sizeof *t);
    bench_block *block = malloc(sizeof *block);
    vndf_status status = VNDF_ERROR_MEMORY;
    if (t && block)
        status = take_turns(list, at, t, block) ? VNDF_OK : VNDF_ERROR_ARGUMENT;
    free(t);
    free(block);
    return status;
}
