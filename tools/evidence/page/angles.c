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
 * bias without the weight. So the advice is the smallest table that keeps report_limits. No table
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

static void meet(report_table *t, report_limit limit, double value)
{
    t->worst[limit] = fmax(t->worst[limit], value);
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
        meet(t, REPORT_WEIGHT, weight);
    }
    meet(t, REPORT_VARIANCE, 100 * variance);
    meet(t, REPORT_TV_BELOW, *tv);
    if (theta <= 90) {
        meet(t, REPORT_TV_ABOVE, *tv);
        meet(t, REPORT_AREA, fabs((double)vndf_projected_area(&surface, wi) / area - 1));
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

/* (The weight of the certificate is larger than the one met here: it looks where 1e-10 of the area is left.) No
 * sample is brighter than chance would make it; nobody can see the variance; without the weight the error stays
 * below half a step of 8 bits above the horizon, where below it light has met the surface before; the weight does
 * not mend the area. */
const struct report_limit_text report_limits[REPORT_LIMITS] = {
    [REPORT_WEIGHT] = {2, "weight", "%.3g", "weights up to %.3g"},
    [REPORT_VARIANCE] = {1, "added variance (%)", "%.2g", "%.2g%% of added variance"},
    [REPORT_TV_ABOVE] = {1e-3, "TV above", "%.1e", "a total variation of %.2g above the horizon"},
    [REPORT_TV_BELOW] = {3e-2, "TV below", "%.1e", "a total variation of %.2g below it"},
    [REPORT_AREA] = {1e-4, "G1 error", "%.1e", "G1 within %.1g"}};

int report_keeps(const report_table *t, report_limit limit)
{
    return t->worst[limit] <= report_limits[limit].most;
}

int report_keeps_all(const report_table *t)
{
    int good = 1;
    for (report_limit i = 0; i < REPORT_LIMITS; i++)
        good = good && report_keeps(t, i);
    return good;
}

static int keeps_what_it_can(const report_table *t, const report_table *finest)
{
    int good = 1;
    for (report_limit i = 0; i < REPORT_LIMITS; i++)
        good = good && (report_keeps(finest, i) ? report_keeps(t, i) : t->worst[i] <= 1.25 * finest->worst[i]);
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
        t->worst[REPORT_TV_ABOVE] = (double)t->info.certificate.tv_above;
        t->worst[REPORT_TV_BELOW] = (double)t->info.certificate.tv;
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
