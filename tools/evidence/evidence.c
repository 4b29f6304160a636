/* From a plan to rows: methods, what they are worth, what they take. */
#include "evidence/evidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/clock.h"
#include "evidence/measure/stratified.h"

enum { ANGLES = 6, ALBEDO_ANGLES = 2, LONG = 64, SHORT = 16 };

/* Degrees; the first two are those of the albedo, the first that of the small light. */
static const double angles[ANGLES] = {60, 85, 0, 30, 75, 89};

static const double noise_limit = 6; /* standard errors, of 15 to 63 degrees of freedom, that show a bias */

typedef struct run {
    evidence_list list;
    const evidence_plan *plan;
    block block;
    findings reference[SUBJECTS][ALBEDO_ANGLES];
} run;

static vndf_status fail(vndf_error *error, vndf_status status, const char *text)
{
    error->status = status;
    snprintf(error->message, sizeof error->message, "%s", text);
    return status;
}

/* ---- worth --------------------------------------------------------------------------------------- */

/* Histograms want more samples than means do. */
static size_t replicates_at(const run *r, size_t angle, int biased)
{
    return (angle < ALBEDO_ANGLES || biased) && r->plan->seconds >= 10 ? LONG : SHORT;
}

static double bias_of(const findings *f, const findings *reference)
{
    double difference = f->albedo - reference->albedo;
    double noise = sqrt(f->albedo_noise * f->albedo_noise + reference->albedo_noise * reference->albedo_noise);
    return fabs(difference) <= noise_limit * noise + 1e-6 * reference->albedo ? 0 : difference / reference->albedo;
}

static void note(run *r, entry *e, size_t angle, const findings *f)
{
    double *to = e->row.number;
    if (!(f->tv <= to[COL_TV])) {
        to[COL_TV] = f->tv;
        to[COL_TV_THETA] = angles[angle];
    }
    to[COL_WEIGHT] = fmax(f->max_weight, to[COL_WEIGHT]);
    if (angle < ALBEDO_ANGLES) {
        e->variance[angle] = f->variance;
        to[COL_BIAS_60 + angle] = bias_of(f, &r->reference[e->of][angle]);
    }
    if (angle == 0)
        e->variance[2] = f->light_variance;
}

/* A batch that gives the bits of a scalar call is worth what that is. */
static int copy_worth(run *r, entry *e)
{
    static const evidence_column copied[] = {COL_TV,    COL_TV_THETA, COL_TV_BELOW, COL_WEIGHT,
                                             COL_SOBOL, COL_BIAS_60,  COL_BIAS_85};
    for (const entry *from = r->list.entry; e->m.same_bits && from < e; from++)
        if (from->m.each == e->m.same_bits && from->m.state == e->m.state) {
            for (size_t i = 0; i < sizeof copied / sizeof *copied; i++)
                e->row.number[copied[i]] = from->row.number[copied[i]];
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
    e->row.number[COL_SOBOL] = stratified_measure(d, (float)(0.5 / (info.scale > 0 ? info.scale : 1)), 32, 1).all;
    if (e->m.kind != ROW_TABLE)
        return;
    e->row.number[COL_TV] = (double)info.certificate.tv_above;
    e->row.number[COL_TV_THETA] = (double)info.certificate.tv_above_theta;
    e->row.number[COL_TV_BELOW] = (double)info.certificate.tv;
    e->row.number[COL_WEIGHT] = (double)info.certificate.max_weight;
}

static int measure_normals(run *r, entry *e)
{
    findings f;
    if (e->m.kind == ROW_CALL || e->m.kind == ROW_MOVE || copy_worth(r, e))
        return 1;
    for (size_t angle = 0; angle < ANGLES; angle++) {
        size_t replicates = replicates_at(r, angle, e->m.biased);
        if (!worth_of_normals(&e->m, &r->list.reference[e->of], angles[angle], replicates, &f))
            return 0;
        note(r, e, angle, &f);
    }
    if (e->m.kind == ROW_TABLE || e->m.kind == ROW_CLOSED)
        note_ours(e);
    return 1;
}

static int measure_references(run *r)
{
    for (size_t of = 0; of < SUBJECTS; of++) {
        const method_reference *reference = &r->list.reference[of];
        if (!reference->canonical.distribution)
            continue;
        method m = method_ours(reference->canonical.distribution, "", METHOD_SAMPLE, VNDF_INSTRUCTIONS_BEST);
        for (size_t angle = 0; angle < ALBEDO_ANGLES; angle++)
            if (!worth_of_normals(&m, reference, angles[angle], replicates_at(r, angle, 0),
                                  &r->reference[of][angle]))
                return 0;
    }
    return 1;
}

static vndf_status measure(run *r, vndf_error *error)
{
    if (!measure_references(r))
        return fail(error, VNDF_ERROR_MEMORY, "no memory");
    for (size_t i = 0; i < r->list.count; i++) {
        entry *e = &r->list.entry[i];
        int good = evidence_verify(&e->m, &e->law, &r->block, 500);
        if (e->m.kind == ROW_EFFECT)
            good &= worth_of_material(&e->m, &e->law, e->worth_theta, &r->block, r->plan->seconds < 5 ? 8 : 64,
                                      &e->row);
        else if (good && !measure_normals(r, e))
            return fail(error, VNDF_ERROR_MEMORY, "no memory");
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

static void relate(const evidence_list *list, entry *e)
{
    double *to = e->row.number;
    const entry *normals = e->visible != NO_ENTRY ? &list->entry[e->visible] : NULL;
    if (e->m.kind != ROW_EFFECT && e->beside != NO_ENTRY)
        to[COL_RATIO] = to[COL_NS] / list->entry[e->beside].row.number[COL_NS];
    if (!normals)
        return;
    const double *from = normals->row.number;
    for (size_t k = 0; k < 3 && e->m.kind != ROW_EFFECT; k++)
        to[COL_EFF_60 + k] = efficiency(e->variance[k], to[COL_NS], normals->variance[k], from[COL_NS]);
    if (e->m.kind == ROW_EFFECT)
        to[COL_EFF_VISIBLE] = efficiency(to[COL_VARIANCE], to[COL_NS], from[COL_VARIANCE], from[COL_NS]);
}

static vndf_status collect(run *r, evidence_rows *found, vndf_error *error)
{
    found->row = malloc((r->list.count + 1) * sizeof *found->row);
    if (!found->row)
        return fail(error, VNDF_ERROR_MEMORY, "no memory");
    for (size_t i = 0; i < r->list.count; i++)
        relate(&r->list, &r->list.entry[i]);
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
        status = evidence_time(&r->list, plan);
        if (status != VNDF_OK)
            fail(error, status, status == VNDF_ERROR_MEMORY ? "no memory" : "interrupted");
    }
    if (status == VNDF_OK)
        status = collect(r, found, error);
    evidence_list_free(&r->list);
    free(r);
    return status;
}
