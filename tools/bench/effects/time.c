/* Time: all sets take turns, each turn with new random inputs that are the same for all sets, and the medians
 * over the turns count. In a turn a set first runs once over its inputs, so that these and its tables are in
 * the cache, and then against the clock: once if that takes long enough, lest branches are learnt by heart. */
#include <math.h>
#include <stdlib.h>

#include "cli/clock.h"
#include "bench/effects/effects.h"

enum { TURNS_MIN = 7, TURNS_MAX = 301, EACH = 0, SHARED = 1, EVAL = 2, PDF = 3, BEYOND_BARE = 4, SERIES = 5 };

static const double turn_seconds = 20e-6; /* a pass shorter than this is repeated, for the clock's sake */

typedef struct times {
    double of[SERIES][TURNS_MAX];
} times;

/* ---- one pass ---------------------------------------------------------------------------------- */

static effects_loop *loop_of(const effects_loops *loops, int way)
{
    effects_loop *const of[] = {loops->each, loops->shared, loops->eval, loops->pdf};
    return of[way];
}

/* Hits that are shared serve EFFECTS_SHARE each. */
static void run(effects_loop *loop, int way, effects_block *block, const effects_subject *subject)
{
    effects_job job = effects_job_of(block, subject);
    job.count = way == EACH ? EFFECTS_BLOCK : EFFECTS_SHARE;
    for (size_t first = 0; first < EFFECTS_BLOCK; first += job.count) {
        job.in = block->in + first;
        job.out = block->out + first;
        loop(&job);
    }
}

/* Nanoseconds for a sample. */
static double pass(const effects_subject *subject, int way, effects_block *block)
{
    effects_loop *loop = loop_of(subject->loops, way);
    double start = clock_seconds();
    run(loop, way, block, subject);
    double once = clock_seconds() - start;
    int repeats = (int)fmin(fmax(turn_seconds / fmax(once, 1e-7), 1), 100);
    start = clock_seconds();
    for (int i = 0; i < repeats; i++)
        run(loop, way, block, subject);
    return (clock_seconds() - start) * 1e9 / (double)repeats / EFFECTS_BLOCK;
}

/* ---- all turns --------------------------------------------------------------------------------- */

static int is_timed(const effects_entry *e)
{
    return e->needed && !e->row.wrong;
}

static void turn(effects_list *list, times *t, effects_block *block, size_t index)
{
    for (size_t i = 0; i < list->count; i++) {
        effects_entry *e = &list->entry[i];
        if (!is_timed(e))
            continue;
        effects_fill(block, &e->subject, e->theta, 1000 + index);
        for (int way = EACH; way <= (e->of_variance ? EACH : PDF); way++)
            t[i].of[way][index] = pass(&e->subject, way, block);
    }
    for (size_t i = 0; i < list->count; i++) {
        int bare = list->entry[i].bare;
        t[i].of[BEYOND_BARE][index] = bare == EFFECTS_NONE ? NAN : t[i].of[EACH][index] - t[bare].of[EACH][index];
    }
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void summarize(effects_entry *e, times *t, size_t turns)
{
    effects_row *row = &e->row;
    for (int k = 0; k < SERIES; k++)
        qsort(t->of[k], turns, sizeof t->of[k][0], ascending);
    row->ns = t->of[EACH][turns / 2];
    row->ns_low = t->of[EACH][turns / 4];
    row->ns_high = t->of[EACH][3 * turns / 4];
    if (e->of_variance)
        return;
    row->to_bare = t->of[BEYOND_BARE][turns / 2];
    row->shared_ns = t->of[SHARED][turns / 2];
    row->eval_ns = t->of[EVAL][turns / 2];
    row->pdf_ns = t->of[PDF][turns / 2];
}

static double efficiency(const effects_row *row, const effects_row *visible)
{
    return row->variance > 0 ? visible->variance * visible->ns / (row->variance * row->ns) : NAN;
}

static void relate(effects_list *list)
{
    for (size_t i = 0; i < list->count; i++) {
        effects_entry *e = &list->entry[i];
        if (e->needed && e->visible != EFFECTS_NONE)
            e->row.efficiency = efficiency(&e->row, &list->entry[e->visible].row);
        if (e->bare != EFFECTS_NONE && list->entry[e->bare].row.wrong)
            e->row.to_bare = NAN;
    }
}

/* The first turn warms up the machine and is not counted. 0: stopped. */
static int take_turns(effects_list *list, const effects_plan *plan, times *t, effects_block *block)
{
    double start = clock_seconds(), spent = 0;
    size_t turns = 0;
    turn(list, t, block, 0);
    for (; turns < TURNS_MAX && (turns < TURNS_MIN || spent < plan->seconds); turns++) {
        if (!plan->go_on(fmin(spent / plan->seconds, 0.99), "taking turns", plan->user))
            return 0;
        turn(list, t, block, turns);
        spent = clock_seconds() - start;
    }
    for (size_t i = 0; i < list->count; i++)
        if (is_timed(&list->entry[i]))
            summarize(&list->entry[i], &t[i], turns);
    relate(list);
    return 1;
}

vndf_status effects_time(effects_list *list, const effects_plan *plan, effects_block *block)
{
    times *t = calloc(list->count, sizeof *t);
    if (!t)
        return VNDF_ERROR_MEMORY;
    int done = take_turns(list, plan, t, block);
    free(t);
    return done ? VNDF_OK : VNDF_ERROR_ARGUMENT;
}
