/* Time: all methods take turns, so that all of them meet the machine in the same mood, each turn with new random
 * inputs, and the median over the turns counts. The first turn warms up the machine and is not counted. */
#include <math.h>
#include <stdlib.h>

#include "cli/progress.h"
#include "cli/sort.h"
#include "evidence/evidence.h"

enum { EACH, SHARED, EVAL, DENSITY, SERIES };
enum { TURNS_LEAST = 7, TURNS_MOST = 501 };

static const double shortest = 20e-6; /* seconds: a shorter run is repeated, for the clock's sake */

int evidence_go_on(const evidence_plan *plan, const char *what)
{
    double done = (clock_seconds() - plan->start) / plan->seconds;
    return progress_show(fmin(done, 0.99), what, plan->progress) == 0;
}

static void run_block(const method *m, method_run *run, block *b, size_t share)
{
    for (size_t first = 0; first < BLOCK; first += share)
        run(m, b, first, share);
}

/* Nanoseconds for a sample. The first run, which is not counted, brings inputs and tables into the cache; then
 * it runs once against the clock, so that the branch predictor does not learn the inputs by heart, or more often
 * where a single run is too short for the clock. */
static double time_run(const method *m, method_run *run, block *b, size_t share)
{
    if (!run)
        return NAN;
    double start = clock_seconds();
    run_block(m, run, b, share);
    int repeats = (int)fmin(fmax(shortest / fmax(clock_seconds() - start, 1e-7), 1), 100);
    start = clock_seconds();
    for (int i = 0; i < repeats; i++)
        run_block(m, run, b, share);
    return 1e9 * (clock_seconds() - start) / repeats / BLOCK;
}

/* SERIES numbers for each entry. */
static int take_turn(const evidence_list *list, const evidence_plan *plan, block *b, size_t turn, double *number)
{
    for (size_t i = 0; i < list->count; i++) {
        const entry *e = &list->entry[i];
        double *ns = number + i * SERIES;
        for (int way = 0; way < SERIES; way++)
            ns[way] = NAN;
        if (!e->is_needed || e->row.number[COL_WRONG] > 0)
            continue;
        block_fill(b, &e->law, 1000 + turn);
        ns[EACH] = time_run(&e->m, e->m.each, b, BLOCK);
        ns[SHARED] = time_run(&e->m, e->m.shared, b, SHARE);
        ns[EVAL] = time_run(&e->m, e->m.eval, b, SHARE);
        ns[DENSITY] = time_run(&e->m, e->m.density, b, SHARE);
        if (i % 8 == 0 && !evidence_go_on(plan, "taking turns"))
            return 0;
    }
    return 1;
}

/* The series of one entry are `turns` numbers, SERIES x count apart; `of` has room for them. */
static void conclude(entry *e, const double *number, size_t stride, size_t turns, double *of)
{
    static const evidence_column medians[SERIES] = {COL_NS, COL_SHARED, COL_EVAL, COL_PDF};
    for (int way = 0; way < SERIES; way++) {
        for (size_t turn = 0; turn < turns; turn++)
            of[turn] = number[turn * stride + (size_t)way];
        sort_numbers(of, turns);
        e->row.number[medians[way]] = of[turns / 2];
        if (way == EACH)
            e->row.number[COL_SPREAD] = 0.5 * (of[3 * turns / 4] - of[turns / 4]) / of[turns / 2];
    }
}

vndf_status evidence_time(evidence_list *list, const evidence_plan *plan, block *b)
{
    size_t stride = list->count * SERIES, turns = 0;
    double *number = malloc((stride + 1) * TURNS_MOST * sizeof *number), *room = number + stride * TURNS_MOST;
    vndf_status status = number ? VNDF_OK : VNDF_ERROR_MEMORY;
    if (status == VNDF_OK && !take_turn(list, plan, b, 0, number))
        status = VNDF_ERROR_ARGUMENT;
    while (status == VNDF_OK && turns < TURNS_MOST &&
           (turns < TURNS_LEAST || clock_seconds() - plan->start < plan->seconds)) {
        if (!take_turn(list, plan, b, turns, number + turns * stride))
            status = VNDF_ERROR_ARGUMENT;
        turns++;
    }
    for (size_t i = 0; i < list->count && status == VNDF_OK; i++)
        conclude(&list->entry[i], number + i * SERIES, stride, turns, room);
    free(number);
    return status;
}
