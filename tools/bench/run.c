/* The benchmark from plan to rows: methods, what they are worth, what they take. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/parts.h"
#include "cli/clock.h"
#include "measure/stratified.h"

enum { ANGLES = 6, ALBEDO_ANGLES = 2, LONG = 64, SHORT = 16 };

/* Degrees; the first two are those of the albedo, the first that of the small light. */
static const double angles[ANGLES] = {60, 85, 0, 30, 75, 89};

static const double noise_limit = 6; /* standard errors, of 15 to 63 degrees of freedom, that show a bias */

/* Variances by subject and method that efficiencies are made of, until times are known. */
typedef struct worth {
    double variance[ALBEDO_ANGLES], light;
} worth;

typedef struct state {
    bench_list list;
    bench_clock clock;
    bench_block block;
    worth worth[BENCH_ENTRIES_MAX];
    bench_findings reference[BENCH_SUBJECTS][ALBEDO_ANGLES];
} state;

static vndf_status fail(vndf_error *error, vndf_status status, const char *text)
{
    error->status = status;
    snprintf(error->message, sizeof error->message, "%s", text);
    return status;
}

/* Histograms want more samples than means do. */
static size_t replicates_at(const state *s, size_t angle, int biased)
{
    return (angle < ALBEDO_ANGLES || biased) && s->clock.plan->seconds >= 10 ? LONG : SHORT;
}

/* ---- worth ------------------------------------------------------------------------------------- */

static double bias_of(const bench_findings *f, const bench_findings *reference)
{
    double difference = f->albedo - reference->albedo;
    double noise = sqrt(f->albedo_noise * f->albedo_noise + reference->albedo_noise * reference->albedo_noise);
    return fabs(difference) <= noise_limit * noise + 1e-6 * reference->albedo ? 0 : difference / reference->albedo;
}

static void note(state *s, size_t i, size_t angle, const bench_findings *f)
{
    bench_row *row = &s->list.entry[i].row;
    if (!(f->tv <= row->tv)) {
        row->tv = f->tv;
        row->tv_theta = angles[angle];
    }
    row->max_weight = fmax(f->max_weight, row->max_weight);
    if (angle < ALBEDO_ANGLES) {
        s->worth[i].variance[angle] = f->variance;
        row->bias[angle] = bias_of(f, &s->reference[s->list.entry[i].subject][angle]);
    }
    if (angle == 0)
        s->worth[i].light = f->light_variance;
}

/* What the builder measured is worth more than what a few samples show. */
static void note_certificate(bench_row *row, const vndf_certificate *certificate)
{
    row->tv = (double)certificate->tv_above;
    row->tv_theta = (double)certificate->tv_above_theta;
    row->tv_below = (double)certificate->tv;
    row->max_weight = (double)certificate->max_weight;
}

/* A batch that gives the bits of a scalar call is worth what that is. */
static int copy_worth(state *s, size_t i)
{
    const bench_entry *e = &s->list.entry[i];
    for (size_t k = 0; e->m.same_bits && k < i; k++)
        if (s->list.entry[k].m.each == e->m.same_bits && s->list.entry[k].m.state == e->m.state) {
            bench_row *row = &s->list.entry[i].row;
            const bench_row *from = &s->list.entry[k].row;
            row->tv = from->tv;
            row->tv_theta = from->tv_theta;
            row->tv_below = from->tv_below;
            row->max_weight = from->max_weight;
            row->stratified = from->stratified;
            memcpy(row->bias, from->bias, sizeof row->bias);
            s->worth[i] = s->worth[k];
            return 1;
        }
    return 0;
}

/* At a roughness of 1/2 of slopes. */
static double stratified_of(const vndf_distribution *d)
{
    double scale = vndf_distribution_info(d).scale;
    return stratified_measure(d, (float)(0.5 / (scale > 0 ? scale : 1)), 32, 1).all;
}

static int measure_worth(state *s, size_t i)
{
    const bench_entry *e = &s->list.entry[i];
    bench_findings f;
    if (e->row.wrong || e->m.kind == BENCH_CALL || e->m.kind == BENCH_MOVE || copy_worth(s, i))
        return 1;
    for (size_t angle = 0; angle < ANGLES; angle++) {
        size_t replicates = replicates_at(s, angle, e->m.biased);
        if (!bench_integrate(&e->m, &s->list.reference[e->subject], angles[angle], replicates, &f))
            return 0;
        note(s, i, angle, &f);
    }
    if (e->m.kind == BENCH_TABLE || e->m.kind == BENCH_CLOSED)
        s->list.entry[i].row.stratified = stratified_of(e->m.state);
    if (e->m.certified) {
        vndf_certificate certificate = vndf_distribution_info(e->m.certified).certificate;
        note_certificate(&s->list.entry[i].row, &certificate);
    }
    return 1;
}

static int measure_references(state *s)
{
    for (size_t subject = 0; subject < BENCH_SUBJECTS; subject++) {
        const method_reference *reference = &s->list.reference[subject];
        if (!reference->canonical.distribution)
            continue;
        method m = method_ours(reference->canonical.distribution, "reference", VNDF_INSTRUCTIONS_BEST);
        for (size_t angle = 0; angle < ALBEDO_ANGLES; angle++)
            if (!bench_integrate(&m, reference, angles[angle], replicates_at(s, angle, 0),
                                 &s->reference[subject][angle]))
                return 0;
    }
    return 1;
}

static vndf_status measure(state *s, vndf_error *error)
{
    if (!measure_references(s))
        return fail(error, VNDF_ERROR_MEMORY, "no memory");
    for (size_t i = 0; i < s->list.count; i++) {
        bench_entry *e = &s->list.entry[i];
        e->row.wrong = !bench_verify(&e->m, &s->list.reference[e->subject], &s->block, 500);
        if (!measure_worth(s, i))
            return fail(error, VNDF_ERROR_MEMORY, "no memory");
        if (!bench_go_on(&s->clock, e->m.name))
            return fail(error, VNDF_ERROR_ARGUMENT, "interrupted");
    }
    return VNDF_OK;
}

/* ---- rows -------------------------------------------------------------------------------------- */

static double efficiency(double variance, double ns, double reference_variance, double reference_ns)
{
    return variance > 0 ? reference_variance * reference_ns / (variance * ns) : NAN;
}

static void relate(state *s, size_t i)
{
    bench_entry *e = &s->list.entry[i];
    const bench_entry *caps = bench_list_find(&s->list, BENCH_GGX, method_ggx_caps().name, "scalar");
    const bench_entry *normals = bench_list_find(&s->list, e->subject, "all normals", "scalar");
    e->row.ratio = e->row.ns / caps->row.ns;
    if (!normals || e->m.kind == BENCH_CALL || e->m.kind == BENCH_MOVE)
        return;
    const worth *own = &s->worth[i], *other = &s->worth[normals - s->list.entry];
    for (size_t angle = 0; angle < ALBEDO_ANGLES; angle++)
        e->row.efficiency[angle] =
            efficiency(own->variance[angle], e->row.ns, other->variance[angle], normals->row.ns);
    e->row.efficiency_light = efficiency(own->light, e->row.ns, other->light, normals->row.ns);
}

static vndf_status collect(state *s, bench_rows *rows, vndf_error *error)
{
    rows->row = malloc((s->list.count + 1) * sizeof *rows->row);
    if (!rows->row)
        return fail(error, VNDF_ERROR_MEMORY, "no memory");
    for (size_t i = 0; i < s->list.count; i++) {
        relate(s, i);
        if (s->list.entry[i].shown)
            rows->row[rows->count++] = s->list.entry[i].row;
    }
    return VNDF_OK;
}

static vndf_status take_times(state *s, vndf_error *error)
{
    vndf_status status = bench_time(&s->list, &s->clock);
    return status == VNDF_OK ? status
                             : fail(error, status, status == VNDF_ERROR_MEMORY ? "no memory" : "interrupted");
}

vndf_status bench_run(const bench_plan *plan, bench_rows *rows, vndf_error *error)
{
    state *s = calloc(1, sizeof *s);
    *rows = (bench_rows){NULL, 0};
    if (!s)
        return fail(error, VNDF_ERROR_MEMORY, "no memory");
    s->clock = (bench_clock){plan, clock_seconds()};
    vndf_status status = bench_list_make(&s->list, &s->clock, error);
    if (status == VNDF_OK)
        status = measure(s, error);
    if (status == VNDF_OK)
        status = take_times(s, error);
    if (status == VNDF_OK)
        status = collect(s, rows, error);
    bench_list_free(&s->list);
    free(s);
    return status;
}

void bench_rows_free(bench_rows *rows)
{
    free(rows->row);
    *rows = (bench_rows){NULL, 0};
}
