/* From a plan to rows: methods, what they are worth, what they take. */
#include "evidence/evidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"
#include "evidence/measure/stratified.h"

enum { ANGLES = 6, ALBEDO_ANGLES = 2, LONG = 64, SHORT = 16 };

/* Degrees; the first two are those of the albedo, the first that of the small light. */
static const double angles[ANGLES] = {60, 85, 0, 30, 75, 89};

static vndf_status fail(vndf_error *error, vndf_status status)
{
    error->status = status;
    snprintf(error->message, sizeof error->message, "%s",
             status == VNDF_ERROR_MEMORY ? "no memory" : "interrupted");
    return status;
}

/* ---- worth --------------------------------------------------------------------------------------- */

static void measure_normals(entry *e, const evidence_plan *plan, block *b)
{
    double *to = e->row.number;
    for (size_t angle = 0; angle < ANGLES; angle++) {
        size_t replicates = angle < ALBEDO_ANGLES && plan->seconds >= 10 ? LONG : SHORT;
        findings f;
        worth_of_normals(&e->m, e->of, angles[angle], replicates, b, &f);
        to[COL_TV] = fmax(f.tv, to[COL_TV]);
        to[COL_WEIGHT] = fmax(f.max_weight, to[COL_WEIGHT]);
        if (angle < ALBEDO_ANGLES)
            e->variance[angle] = f.variance;
        if (angle == 0)
            e->variance[2] = f.light_variance;
    }
    if (e->m.kind != ROW_TABLE && e->m.kind != ROW_CLOSED)
        return;
    const vndf_info info = vndf_distribution_info(e->m.state);
    to[COL_SOBOL] = stratified_beside_caps(e->m.state, (float)(0.5 / (info.scale > 0 ? info.scale : 1)), 32, 1);
    if (e->m.kind == ROW_TABLE) { /* what the builder measured is worth more than what a few samples show */
        to[COL_TV] = (double)info.certificate.tv_above;
        to[COL_TV_BELOW] = (double)info.certificate.tv;
        to[COL_WEIGHT] = (double)info.certificate.max_weight;
    }
}

/* A batch that gives the bits of a scalar call is worth what that is. */
static int copy_worth(const evidence_list *list, entry *e)
{
    for (const entry *from = list->entry; e->m.same_bits && from < e; from++)
        if (from->is_needed && from->m.each == e->m.same_bits && from->m.state == e->m.state) {
            memcpy(e->row.number + COL_TV, from->row.number + COL_TV, (COL_SOBOL + 1 - COL_TV) * sizeof(double));
            memcpy(e->variance, from->variance, sizeof e->variance);
            return 1;
        }
    return 0;
}

static vndf_status measure(evidence_list *list, const evidence_plan *plan, block *b)
{
    for (entry *e = list->entry; e < list->entry + list->count; e++) {
        if (!e->is_needed)
            continue;
        int good = evidence_verify(&e->m, &e->law, b, 500);
        if (e->m.kind == ROW_EFFECT)
            good &= worth_of_material(&e->m, &e->law, plan->theta, b, plan->seconds < 5 ? 8 : 64, &e->row);
        else if (good && e->m.kind != ROW_CALL && !copy_worth(list, e))
            measure_normals(e, plan, b);
        e->row.number[COL_WRONG] = !good;
        if (!evidence_go_on(plan, e->m.name))
            return VNDF_ERROR_ARGUMENT;
    }
    return VNDF_OK;
}

/* ---- time ---------------------------------------------------------------------------------------- */

enum { TURNS_LEAST = 7 };

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

static int take_turn(evidence_list *list, const evidence_plan *plan, block *b, size_t turn)
{
    for (entry *e = list->entry; e < list->entry + list->count; e++) {
        const method *m = &e->m;
        method_run *const run[SERIES] = {m->each, m->shared, m->eval, m->density};
        if (!e->is_needed || e->row.number[COL_WRONG] > 0)
            continue;
        block_fill(b, &e->law, 1000 + turn);
        for (int way = 0; way < SERIES; way++)
            e->ns[way][turn] = time_run(m, run[way], b, way == 0 ? BLOCK : SHARE);
        if (!evidence_go_on(plan, "taking turns"))
            return 0;
    }
    return 1;
}

/* All methods take turns, so that all of them meet the machine in the same mood, each turn with new random inputs, and
 * the median over the turns counts. The first turn warms up the machine and is not counted. */
static vndf_status take_times(evidence_list *list, const evidence_plan *plan, block *b)
{
    static const evidence_column medians[SERIES] = {COL_NS, COL_SHARED, COL_EVAL, COL_PDF};
    size_t turns = 0;
    int goes_on = take_turn(list, plan, b, 0);
    while (goes_on && turns < TURNS_MOST && (turns < TURNS_LEAST || clock_seconds() - plan->start < plan->seconds))
        goes_on = take_turn(list, plan, b, turns++);
    for (entry *e = list->entry; e < list->entry + list->count; e++) {
        double *to = e->row.number;
        for (int way = 0; way < SERIES && e->is_needed && !(to[COL_WRONG] > 0); way++) {
            double *ns = e->ns[way];
            sort_numbers(ns, turns);
            to[medians[way]] = ns[turns / 2];
            if (way == 0)
                to[COL_SPREAD] = 0.5 * (ns[3 * turns / 4] - ns[turns / 4]) / ns[turns / 2];
        }
    }
    return goes_on ? VNDF_OK : VNDF_ERROR_ARGUMENT;
}

/* ---- rows ---------------------------------------------------------------------------------------- */

static double efficiency(double variance, double ns, double other_variance, double other_ns)
{
    return variance > 0 ? other_variance * other_ns / (variance * ns) : NAN;
}

/* To the yardsticks. */
static void relate(entry *e)
{
    double *to = e->row.number, ns = to[COL_NS];
    if (e->beside)
        to[COL_RATIO] = ns / e->beside->row.number[COL_NS];
    if (!e->normals)
        return;
    const double *from = e->normals->row.number;
    if (e->m.kind == ROW_EFFECT)
        to[COL_EFF_VISIBLE] = efficiency(to[COL_VARIANCE], ns, from[COL_VARIANCE], from[COL_NS]);
    for (size_t k = 0; k < 3; k++)
        to[COL_EFF_60 + k] = efficiency(e->variance[k], ns, e->normals->variance[k], from[COL_NS]);
}

vndf_status evidence_run(const evidence_plan *plan, evidence_rows *found, vndf_error *error)
{
    evidence_list *list = calloc(1, sizeof *list);
    block *b = malloc(sizeof *b);
    *found = (evidence_rows){malloc(ENTRIES_MAX * sizeof *found->row), 0};
    if (!list || !b || !found->row) {
        free(list);
        free(b);
        return fail(error, VNDF_ERROR_MEMORY);
    }
    vndf_status status = evidence_list_make(list, plan, error);
    if (status == VNDF_OK) {
        status = measure(list, plan, b);
        if (status == VNDF_OK)
            status = take_times(list, plan, b);
        if (status != VNDF_OK)
            fail(error, status);
    }
    for (entry *e = list->entry; e < list->entry + list->count && status == VNDF_OK; e++)
        if (e->is_shown) {
            relate(e);
            found->row[found->count++] = e->row;
        }
    evidence_list_free(list);
    free(list);
    free(b);
    return status;
}
