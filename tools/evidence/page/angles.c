/* How far the tables of a distribution are from it, at every angle of incidence.
 *
 * With w = true/drawn density at a normal and normals drawn from two uniform numbers u, every integral over the
 * drawn density is one over the unit square of u:
 *     total variation = 1/2 integral |w(u) - 1| du,   variance of the weight = integral (w(u) - 1)^2 du.
 * A Fibonacci lattice (a rank-1 lattice of 2584 points) gives the integrals. The reference is the source itself
 * by vndf_reference_p22 and vndf_reference_area, in double. The integrals miss nothing: where the true density
 * is positive, so is the drawn one.
 *
 * Which table to ship. Any table is right with its weight; a small one costs noise and rare bright samples, and
 * bias without the weight. So the advice is the smallest table that keeps the limits of report_limits. No table
 * keeps a limit that the finest breaks; there a table is good if it is within a quarter of the finest. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/subject.h"
#include "evidence/page/report.h"

enum { LATTICE = 2584, LATTICE_STEP = 1597 };

static const double radians = 3.14159265358979323846 / 180;

/* Every 3 degrees; straight from below nothing is visible, so the last is at 179. */
double report_theta(size_t angle)
{
    return angle + 1 == REPORT_ANGLES ? 179 : 180.0 * (double)angle / (REPORT_ANGLES - 1);
}

/* True over drawn density at a normal; 1 at the horizon itself, where both vanish or cannot be told apart. */
static double weight_at(const vndf_reference *reference, vndf_vec3 wi, double area, const vndf_view *view,
                        vndf_vec3 wm)
{
    double x = (double)wm.x, y = (double)wm.y, z = (double)wm.z, drawn = (double)vndf_pdf(view, wm);
    double cosine = (double)wi.x * x + (double)wi.y * y + (double)wi.z * z;
    if (!(z > 1e-12) || !(drawn > 0))
        return 1;
    double ndf = vndf_reference_p22(reference, sqrt(x * x + y * y) / z) / (z * z * z * z);
    return fmax(cosine, 0) * ndf / (area * drawn);
}

static void measure_angle(const vndf_reference *reference, double theta, double area, report_table *t, double *tv)
{
    const vndf_surface surface = {t->table, 1, 1};
    vndf_vec3 wi = direction_from(theta, 0);
    vndf_view view = vndf_view_from(&surface, wi);
    double variance = 0;
    *tv = 0;
    for (size_t i = 0; i < LATTICE; i++) {
        double u1 = ((double)i + 0.5) / LATTICE, u2 = ((double)(i * LATTICE_STEP % LATTICE) + 0.5) / LATTICE;
        vndf_vec3 wm = vndf_sample(&view, (float)u1, (float)u2, NULL);
        double weight = weight_at(reference, wi, area, &view, wm);
        *tv += fabs(weight - 1) / (2 * LATTICE);
        variance += (weight - 1) * (weight - 1) / LATTICE;
        t->weight = fmax(t->weight, weight);
    }
    t->variance = fmax(t->variance, variance);
    t->tv_below = fmax(t->tv_below, *tv);
    if (theta <= 90) {
        t->tv_above = fmax(t->tv_above, *tv);
        t->area = fmax(t->area, fabs((double)vndf_projected_area(&surface, wi) / area - 1));
    }
}

vndf_status report_subject_begin(report_subject *s, vndf_source *source, const char *name, vndf_error *error)
{
    subject_begin(&s->of, source, name);
    s->reference = vndf_reference_from(source, error);
    return s->reference ? VNDF_OK : error->status;
}

void report_subject_free(report_subject *s)
{
    vndf_reference_free(s->reference);
    subject_free(&s->of);
}

/* (The weight of the certificate is larger than the one met here: it looks where 1e-10 of the area is left.) */
const double report_limits[REPORT_LIMITS] = {
    2,    /* no sample is brighter than chance would make it */
    1,    /* nobody can see that */
    1e-3, /* without the weight the error stays below half a step of 8 bits */
    3e-2, /* from where light has met the surface before */
    1e-4  /* of Lambda and G1, below 8 bits as well: the weight does not mend them */
};

report_verdict report_judge(const report_table *t)
{
    report_verdict v = {{t->weight, 100 * t->variance, t->tv_above, t->tv_below, t->area}, {0}, 1};
    for (int i = 0; i < REPORT_LIMITS; i++) {
        v.kept[i] = v.value[i] <= report_limits[i];
        v.all &= v.kept[i];
    }
    return v;
}

static int keeps_what_it_can(const report_table *t, const report_table *finest)
{
    report_verdict v = report_judge(t), best = report_judge(finest);
    int good = 1;
    for (int i = 0; i < REPORT_LIMITS; i++)
        good = good && (best.kept[i] ? v.kept[i] : v.value[i] <= 1.25 * best.value[i]);
    return good;
}

vndf_status report_subject_measure(report_subject *s, const evidence_plan *plan, vndf_error *error)
{
    double area[REPORT_ANGLES], grazing = vndf_reference_area(s->reference, 90 * radians);
    for (size_t a = 0; a < REPORT_ANGLES; a++)
        area[a] = vndf_reference_area(s->reference, report_theta(a) * radians);
    for (size_t i = 0; i < SIZES; i++) {
        report_table *t = &s->table[i];
        *t = (report_table){.table = subject_table(&s->of, i, plan, error), .ns = NAN, .batch = NAN};
        if (!t->table)
            return error->status;
        t->info = vndf_distribution_info(t->table);
        t->tv_above = (double)t->info.certificate.tv_above;
        t->tv_below = (double)t->info.certificate.tv;
        for (size_t a = 0; a < REPORT_ANGLES; a++) {
            t->tv[a] = (double)NAN;
            if (area[a] > 1e-10 * grazing)
                measure_angle(s->reference, report_theta(a), area[a], t, &t->tv[a]);
        }
        if (!evidence_go_on(plan, "measuring errors")) {
            *error = (vndf_error){VNDF_ERROR_ARGUMENT, "interrupted"};
            return error->status;
        }
    }
    s->chosen = SIZES - 1;
    for (size_t i = SIZES; i-- > 0;)
        if (keeps_what_it_can(&s->table[i], &s->table[SIZES - 1]))
            s->chosen = i;
    return VNDF_OK;
}
