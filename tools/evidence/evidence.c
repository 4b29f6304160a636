/* From a plan to rows: methods, what they are worth, what they take. */
#include "evidence/evidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "evidence/measure/stratified.h"

enum { ANGLES = 6, ALBEDO_ANGLES = 2, LONG = 64, SHORT = 16 };

/* Degrees; the first two are those of the albedo, the first that of the small light. */
static const double angles[ANGLES] = {60, 85, 0, 30, 75, 89};

typedef struct run {
    evidence_list list;
    const evidence_plan *plan;
    block block;
} run;

static vndf_status fail(vndf_error *error, vndf_status status, const char *text)
{
    error->status = status;
    snprintf(error->message, sizeof error->message, "%s", text);
    return status;
}

/* ---- worth --------------------------------------------------------------------------------------- */

/* A batch that gives the bits of a scalar call is worth what that is. */
static int copy_worth(run *r, entry *e)
{
    for (const entry *from = r->list.entry; e->m.same_bits && from < e; from++)
        if (from->m.each == e->m.same_bits && from->m.state == e->m.state) {
            memcpy(e->row.number + COL_TV, from->row.number + COL_TV, (COL_SOBOL + 1 - COL_TV) * sizeof(double));
            memcpy(e->variance, from->variance, sizeof e->variance);
            return 1;
        }
    return 0;
}

/* What the builder measured is worth more than what a few samples show. */
static void note_ours(entry *e)
{
    const vndf_distribution *d = e->m.state;
    vndf_info info = vndf_distribution_info(d);
    double *to = e->row.number, scale = info.scale > 0 ? info.scale : 1;
    to[COL_SOBOL] = stratified_beside_caps(d, (float)(0.5 / scale), 32, 1);
    if (e->m.kind != ROW_TABLE)
        return;
    to[COL_TV] = (double)info.certificate.tv_above;
    to[COL_TV_BELOW] = (double)info.certificate.tv;
    to[COL_WEIGHT] = (double)info.certificate.max_weight;
}

static void measure_normals(run *r, entry *e)
{
    double *to = e->row.number;
    if (e->m.kind == ROW_CALL || copy_worth(r, e))
        return;
    for (size_t angle = 0; angle < ANGLES; angle++) {
        size_t replicates = angle < ALBEDO_ANGLES && r->plan->seconds >= 10 ? LONG : SHORT;
        findings f;
        worth_of_normals(&e->m, &r->list.reference[e->of], angles[angle], replicates, &r->block, &f);
        to[COL_TV] = fmax(f.tv, to[COL_TV]);
        to[COL_WEIGHT] = fmax(f.max_weight, to[COL_WEIGHT]);
        if (angle < ALBEDO_ANGLES)
            e->variance[angle] = f.variance;
        if (angle == 0)
            e->variance[2] = f.light_variance;
    }
    if (e->m.kind == ROW_TABLE || e->m.kind == ROW_CLOSED)
        note_ours(e);
}

static vndf_status measure(run *r, vndf_error *error)
{
    for (entry *e = r->list.entry; e < r->list.entry + r->list.count; e++) {
        int good = evidence_verify(&e->m, &e->law, &r->block, 500);
        if (e->m.kind == ROW_EFFECT)
            good &= worth_of_material(&e->m, &e->law, r->plan->theta, &r->block, r->plan->seconds < 5 ? 8 : 64,
                                      &e->row);
        else if (good)
            measure_normals(r, e);
        e->row.number[COL_WRONG] = !good;
        if (!evidence_go_on(r->plan, e->m.name))
            return fail(error, VNDF_ERROR_ARGUMENT, "interrupted");
    }
    return VNDF_OK;
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
    to[COL_RATIO] = e->beside ? ns / e->beside->row.number[COL_NS] : (double)NAN;
    if (!e->normals)
        return;
    const double *from = e->normals->row.number;
    if (e->m.kind == ROW_EFFECT)
        to[COL_EFF_VISIBLE] = efficiency(to[COL_VARIANCE], ns, from[COL_VARIANCE], from[COL_NS]);
    for (size_t k = 0; k < 3; k++)
        to[COL_EFF_60 + k] = efficiency(e->variance[k], ns, e->normals->variance[k], from[COL_NS]);
}

static vndf_status collect(run *r, evidence_rows *found, vndf_error *error)
{
    found->row = malloc((r->list.count + 1) * sizeof *found->row);
    if (!found->row)
        return fail(error, VNDF_ERROR_MEMORY, "no memory");
    for (size_t i = 0; i < r->list.count; i++)
        relate(&r->list.entry[i]);
    for (size_t i = 0; i < r->list.count; i++)
        if (r->list.entry[i].is_shown)
            found->row[found->count++] = r->list.entry[i].row;
    return VNDF_OK;
}

vndf_status evidence_run(const evidence_plan *plan, evidence_rows *found, vndf_error *error)
{
    run *r = calloc(1, sizeof *r);
    *found = (evidence_rows){NULL, 0};
    if (!r)
        return fail(error, VNDF_ERROR_MEMORY, "no memory");
    r->plan = plan;
    vndf_status status = evidence_list_make(&r->list, plan, error);
    if (status == VNDF_OK)
        status = measure(r, error);
    if (status == VNDF_OK) {
        status = evidence_time(&r->list, plan, &r->block);
        if (status != VNDF_OK)
            fail(error, status, status == VNDF_ERROR_MEMORY ? "no memory" : "interrupted");
    }
    if (status == VNDF_OK)
        status = collect(r, found, error);
    evidence_list_free(&r->list);
    free(r);
    return status;
}
