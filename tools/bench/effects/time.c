/* Time: all sets take turns (turns.h), each turn with new random inputs that are the same for all sets. */
#include <math.h>
#include <stdlib.h>

#include "bench/effects/effects.h"
#include "cli/clock.h"
#include "measure/turns.h"

enum { EACH = 0, SHARED = 1, EVAL = 2, PDF = 3, BEYOND_BARE = 4, SERIES = 5 };

/* ---- one pass ---------------------------------------------------------------------------------- */

typedef struct pass {
    const effects_subject *subject;
    effects_block *block;
    effects_loop *loop;
    size_t share; /* inputs of a hit that they share, else all */
} pass;

static void run_pass(void *user)
{
    const pass *p = user;
    effects_job job = effects_job_of(p->block, p->subject);
    job.count = p->share;
    for (size_t first = 0; first < EFFECTS_BLOCK; first += job.count) {
        job.in = p->block->in + first;
        job.out = p->block->out + first;
        job.first = first;
        p->loop(&job);
    }
}

/* ---- all turns --------------------------------------------------------------------------------- */

typedef struct contenders {
    effects_list *list;
    const effects_plan *plan;
    effects_block *block;
    double start;
} contenders;

static int is_timed(const effects_entry *e)
{
    return e->needed && !e->row.wrong;
}

/* Nanoseconds for a sample. */
static void time_entry(const effects_entry *e, effects_block *block, double ns[SERIES])
{
    const effects_loops *loops = e->subject.loops;
    effects_loop *const of[] = {loops->each, loops->shared, loops->eval, loops->pdf};
    for (int way = EACH; way <= (e->of_variance ? EACH : PDF); way++) {
        pass p = {&e->subject, block, of[way], way == EACH ? EFFECTS_BLOCK : EFFECTS_SHARE};
        ns[way] = 1e9 * turns_seconds(run_pass, &p) / EFFECTS_BLOCK;
    }
}

static int take_turn(void *user, size_t turn, double *number)
{
    const contenders *c = user;
    double done = fmin((clock_seconds() - c->start) / c->plan->seconds, 0.99);
    if (progress_show(done, "taking turns", c->plan->progress))
        return 0;
    for (size_t i = 0; i < c->list->count; i++) {
        effects_entry *e = &c->list->entry[i];
        if (!is_timed(e))
            continue;
        effects_fill(c->block, &e->subject, e->theta, 1000 + turn);
        time_entry(e, c->block, number + i * SERIES);
    }
    for (size_t i = 0; i < c->list->count; i++) {
        int bare = c->list->entry[i].bare;
        if (bare != EFFECTS_NONE)
            number[i * SERIES + BEYOND_BARE] = number[i * SERIES + EACH] - number[(size_t)bare * SERIES + EACH];
    }
    return 1;
}

static void note_times(effects_entry *e, const turns_quartiles of[SERIES])
{
    effects_row *row = &e->row;
    row->ns = of[EACH].median;
    row->ns_low = of[EACH].low;
    row->ns_high = of[EACH].high;
    row->to_bare = of[BEYOND_BARE].median;
    row->shared_ns = of[SHARED].median;
    row->eval_ns = of[EVAL].median;
    row->pdf_ns = of[PDF].median;
}

static void relate(effects_list *list)
{
    for (size_t i = 0; i < list->count; i++) {
        effects_entry *e = &list->entry[i];
        if (!e->needed || e->visible == EFFECTS_NONE)
            continue;
        const effects_row *visible = &list->entry[e->visible].row;
        e->row.efficiency =
            e->row.variance > 0 ? visible->variance * visible->ns / (e->row.variance * e->row.ns) : NAN;
    }
}

vndf_status effects_time(effects_list *list, const effects_plan *plan, effects_block *block)
{
    turns_quartiles *found = malloc(list->count * SERIES * sizeof *found);
    contenders c = {list, plan, block, clock_seconds()};
    const turns_plan turns = {.series = list->count * SERIES,
                              .least = 7,
                              .most = 301,
                              .seconds = plan->seconds,
                              .take = take_turn,
                              .user = &c};
    vndf_status status = found ? turns_run(&turns, found) : VNDF_ERROR_MEMORY;
    for (size_t i = 0; i < list->count && status == VNDF_OK; i++)
        note_times(&list->entry[i], found + i * SERIES);
    if (status == VNDF_OK)
        relate(list);
    free(found);
    return status;
}
