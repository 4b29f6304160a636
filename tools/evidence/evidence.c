/* From a plan to rows: methods, what they are worth, what they take. */
#include "evidence/evidence.h"

#include <math.h>

#include "cli/sort.h"
#include "evidence/measure/measure.h"

enum { ANGLES = 6, ALBEDO_ANGLES = 2, LONG = 64, SHORT = 16 };

/* Degrees; the first two are those of the albedo, the first that of the small light. */
static const double angles[ANGLES] = {60, 85, 0, 30, 75, 89};

static void measure_normals(evidence_row *r, const evidence_plan *plan, block *b)
{
    double *to = r->number;
    for (size_t angle = 0; angle < ANGLES; angle++) {
        const size_t replicates = angle < ALBEDO_ANGLES && plan->seconds >= 10 ? LONG : SHORT;
        const findings f = worth_of_normals(&r->m, r->of, angles[angle], replicates, b);
        to[COL_TV] = fmax(f.tv, to[COL_TV]);
        to[COL_WEIGHT] = fmax(f.max_weight, to[COL_WEIGHT]);
        if (angle < ALBEDO_ANGLES)
            r->variance[angle] = f.variance;
        if (angle == 0)
            r->variance[2] = f.light_variance;
    }
    if (r->m.kind != ROW_TABLE && r->m.kind != ROW_CLOSED)
        return;
    const vndf_info info = vndf_distribution_info(r->m.d);
    to[COL_SOBOL] = stratified_beside_caps(r->m.d, (float)(0.5 / (info.scale > 0 ? info.scale : 1)), 32, 1);
    if (r->m.kind == ROW_TABLE) { /* what the builder measured is worth more than what a few samples show */
        to[COL_TV] = (double)info.certificate.tv_above;
        to[COL_TV_BELOW] = (double)info.certificate.tv;
        to[COL_WEIGHT] = (double)info.certificate.max_weight;
    }
}

/* Batches that are right are worth what one by one is. */
static int measure(evidence *all, block *b)
{
    const evidence_plan *plan = all->plan;
    for (evidence_row *r = all->row; r < all->row + all->count; r++) {
        const method *m = &r->m;
        int good = 1;
        if (!r->is_needed)
            continue;
        for (vndf_instructions set = VNDF_INSTRUCTIONS_BEST; set <= VNDF_INSTRUCTIONS_AVX512 && good; set++)
            good = (set && !method_has_batch(m, set)) || evidence_verify(m, set, &r->law, b, 500);
        if (good && m->kind == ROW_EFFECT)
            worth_of_material(m, &r->law, plan->theta, b, plan->seconds < 5 ? 16 : 128, r->number);
        else if (good && m->kind != ROW_CALL)
            measure_normals(r, plan, b);
        r->number[COL_WRONG] = !good;
        if (!evidence_go_on(plan, m->name))
            return 0;
    }
    return 1;
}

enum { TURNS_LEAST = 7 };

static const double shortest = 20e-6; /* seconds: a shorter run is repeated, for the clock's sake */

int evidence_go_on(const evidence_plan *plan, const char *what)
{
    double done = (clock_seconds() - plan->start) / plan->seconds;
    return progress_show(fmin(done, 0.99), what, plan->progress) == 0;
}

/* Nanoseconds for a sample. The first run, which is not counted, brings inputs and tables into the cache; then
 * it runs once against the clock, so that the branch predictor does not learn the inputs by heart, or more often
 * where a single run is too short for the clock. */
static double time_run(const method *m, method_run *run, block *b)
{
    if (!run)
        return NAN;
    double start = clock_seconds();
    run(m, b);
    int repeats = (int)fmin(fmax(shortest / fmax(clock_seconds() - start, 1e-7), 1), 100);
    start = clock_seconds();
    for (int i = 0; i < repeats; i++)
        run(m, b);
    return 1e9 * (clock_seconds() - start) / repeats / BLOCK;
}

static int is_timed(const evidence_row *r)
{
    return r->is_needed && !(r->number[COL_WRONG] > 0);
}

static int take_turn(evidence *all, block *b, size_t turn)
{
    for (evidence_row *r = all->row; r < all->row + all->count; r++) {
        const method *m = &r->m;
        method_run *const of_one[SERIES - SETS] = {m->shared, m->eval, m->density};
        if (!is_timed(r))
            continue;
        block_fill(b, &r->law, 1000 + turn);
        r->ns[0][turn] = time_run(m, m->each, b);
        for (b->limit = VNDF_INSTRUCTIONS_PORTABLE; b->limit <= VNDF_INSTRUCTIONS_AVX512; b->limit++)
            r->ns[b->limit][turn] = time_run(m, method_has_batch(m, b->limit) ? m->batch : NULL, b);
        for (int k = 0; k < SERIES - SETS; k++)
            r->ns[SETS + k][turn] = time_run(m, of_one[k], b);
        if (!evidence_go_on(all->plan, "taking turns"))
            return 0;
    }
    return 1;
}

/* All methods take turns, so that all of them meet the machine in the same mood, each turn with new random inputs, and
 * the median over the turns counts. The first turn warms up the machine and is not counted. */
static int take_times(evidence *all, block *b)
{
    const evidence_plan *plan = all->plan;
    size_t turns = 0;
    int goes_on = take_turn(all, b, 0);
    while (goes_on && turns < TURNS_MOST && (turns < TURNS_LEAST || clock_seconds() - plan->start < plan->seconds))
        goes_on = take_turn(all, b, turns++);
    for (evidence_row *r = all->row; r < all->row + all->count; r++)
        for (int way = 0; way < SERIES && is_timed(r); way++) {
            double *ns = r->ns[way];
            sort_numbers(ns, turns);
            r->number[COL_NS + way] = ns[turns / 2];
            if (way == 0)
                r->number[COL_SPREAD] = 0.5 * (ns[3 * turns / 4] - ns[turns / 4]) / ns[turns / 2];
        }
    return goes_on;
}

static double efficiency(double variance, double ns, double other_variance, double other_ns)
{
    return variance > 0 ? other_variance * other_ns / (variance * ns) : NAN;
}

static void relate(evidence_row *r)
{
    double *to = r->number, ns = to[COL_NS];
    if (r->beside)
        to[COL_RATIO] = ns / r->beside->number[COL_NS];
    if (!r->normals)
        return;
    const double *from = r->normals->number;
    if (r->m.kind == ROW_EFFECT)
        to[COL_EFF_VISIBLE] = efficiency(to[COL_VARIANCE], ns, from[COL_VARIANCE], from[COL_NS]);
    for (size_t k = 0; k < 3; k++)
        to[COL_EFF_60 + k] = efficiency(r->variance[k], ns, r->normals->variance[k], from[COL_NS]);
}

evidence *evidence_run(const evidence_plan *plan, vndf_error *error)
{
    evidence *all = calloc(1, sizeof *all);
    block *b = malloc(2 * sizeof *b); /* two to compare */
    if (all && b) {
        all->plan = plan;
        all->error = error;
        if (evidence_list(all) == VNDF_OK && !(measure(all, b) && take_times(all, b)))
            *error = (vndf_error){VNDF_ERROR_ARGUMENT, "interrupted"};
        for (evidence_row *r = all->row; r < all->row + all->count; r++)
            relate(r);
    } else {
        *error = (vndf_error){VNDF_ERROR_MEMORY, "no memory"};
    }
    free(b);
    if (error->status == VNDF_OK)
        return all;
    evidence_free(all);
    return NULL;
}

void evidence_free(evidence *of)
{
    for (size_t i = 0; of && i < of->count; i++)
        method_release(&of->row[i].m);
    free(of);
}
