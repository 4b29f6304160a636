/* A distribution of normals and its tables.
 *
 * Error. With w = true/drawn density at a normal and normals drawn from two uniform numbers u, every integral over
 * the drawn density is one over the unit square of u:
 *     total variation = 1/2 integral |w(u) - 1| du,   variance of the weight = integral (w(u) - 1)^2 du.
 * A Fibonacci lattice (a rank-1 lattice of 6765 points) gives the integrals, for 61 directions. The reference is the
 * source itself by vndf_reference_p22 and vndf_reference_area, in double. The integrals miss nothing: where the true
 * density is positive, so is the drawn one. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/clock.h"
#include "cli/subject.h"
#include "report/report.h"

enum { LATTICE = 6765, LATTICE_STEP = 4181 };

static const double radians = 3.14159265358979323846 / 180;

/* Every 3 degrees; straight from below nothing is visible, so the last is at 179. */
double report_theta(size_t angle)
{
    return angle + 1 == REPORT_ANGLES ? 179 : 180.0 * (double)angle / (REPORT_ANGLES - 1);
}

/* ---- error --------------------------------------------------------------------------------------- */

typedef struct direction {
    vndf_vec3 wi;
    double area; /* the reference */
} direction;

/* True over drawn density at a normal; 1 at the horizon itself, where both vanish or cannot be told apart. */
static double weight_at(const vndf_reference *reference, const direction *from, const vndf_view *view,
                        vndf_vec3 wm)
{
    double x = (double)wm.x, y = (double)wm.y, z = (double)wm.z;
    double cosine = (double)from->wi.x * x + (double)from->wi.y * y + (double)from->wi.z * z;
    double drawn = (double)vndf_pdf(view, wm);
    if (!(z > 1e-12) || !(drawn > 0))
        return 1;
    double ndf = vndf_reference_p22(reference, sqrt(x * x + y * y) / z) / (z * z * z * z);
    return fmax(cosine, 0) * ndf / (from->area * drawn);
}

static report_error measure_error(const vndf_reference *reference, const direction *from,
                                  const vndf_distribution *table)
{
    vndf_surface surface = {table, 1, 1};
    vndf_view view = vndf_view_from(&surface, from->wi);
    report_error error = {0, 0, 0};
    for (size_t i = 0; i < LATTICE; i++) {
        double u1 = ((double)i + 0.5) / LATTICE, u2 = ((double)(i * LATTICE_STEP % LATTICE) + 0.5) / LATTICE;
        vndf_vec3 wm = vndf_sample(&view, (float)u1, (float)u2, NULL);
        double weight = weight_at(reference, from, &view, wm);
        error.tv += fabs(weight - 1) / (2 * LATTICE);
        error.variance += (weight - 1) * (weight - 1) / LATTICE;
        error.max_weight = fmax(error.max_weight, weight);
    }
    return error;
}

static void measure_angles(const report_subject *subject, const double areas[REPORT_ANGLES], report_table *t)
{
    double grazing = vndf_reference_area(subject->reference, 90 * radians);
    t->worst = (report_error){0, 0, 0};
    for (size_t a = 0; a < REPORT_ANGLES; a++) {
        direction from = {direction_from(report_theta(a), 0), areas[a]};
        t->error[a] = (report_error){(double)NAN, (double)NAN, (double)NAN};
        if (!(areas[a] > 1e-10 * grazing))
            continue;
        t->error[a] = measure_error(subject->reference, &from, t->table);
        t->worst.tv = fmax(t->worst.tv, t->error[a].tv);
        if (report_theta(a) <= 90) {
            double area = (double)vndf_projected_area(&(vndf_surface){t->table, 1, 1}, from.wi);
            t->tv_above = fmax(t->tv_above, t->error[a].tv);
            t->area = fmax(t->area, fabs(area / areas[a] - 1));
        }
        t->worst.variance = fmax(t->worst.variance, t->error[a].variance);
        t->worst.max_weight = fmax(t->worst.max_weight, t->error[a].max_weight);
    }
}

/* ---- building ------------------------------------------------------------------------------------ */

/* Cuts between characters, and ends with an ellipsis. */
static void copy_cut(char *copy, size_t size, const char *text)
{
    size_t length = strlen(text);
    if (length < size) {
        memcpy(copy, text, length + 1);
        return;
    }
    length = size - 4;
    while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80)
        length--;
    memcpy(copy, text, length);
    memcpy(copy + length, "…", 4);
}

vndf_status report_subject_begin(report_subject *subject, vndf_source *source, const char *name,
                                 const char *arguments, vndf_error *error)
{
    *subject = (report_subject){.source = source};
    copy_cut(subject->name, sizeof subject->name, name);
    copy_cut(subject->arguments, sizeof subject->arguments, arguments);
    subject->reference = vndf_reference_from(source, error);
    return subject->reference ? VNDF_OK : error->status;
}

static vndf_status build_one(report_subject *subject, size_t bytes, const report_watch *watch, vndf_error *error)
{
    report_table *t = &subject->table[subject->count];
    vndf_build_options options = {.max_bytes = bytes, .progress = watch->progress, .progress_user = watch->user};
    *t = (report_table){.asked = bytes};
    t->table = vndf_build(subject->source, &options, NULL, error);
    if (!t->table)
        return error->status;
    t->info = vndf_distribution_info(t->table);
    subject->count++;
    return VNDF_OK;
}

/* Whether the last table did not grow with its limit: then it is as large as it gets. */
static int is_full(const report_subject *subject)
{
    size_t n = subject->count;
    return n >= 2 && subject->table[n - 1].info.bytes < subject->table[n - 1].asked / 2;
}

/* Each size takes about twice the time of the one before. */
static vndf_status build_all(report_subject *subject, double seconds, const report_watch *watch, vndf_error *error)
{
    static const size_t sizes[REPORT_SIZES] = {2048, 4096, 8192, 16384, 32768};
    /* time of this process: others on the machine do not make tables fewer */
    double begin = clock_processor_seconds(), before = begin, last = 0;
    for (size_t i = 0; i < REPORT_SIZES && !is_full(subject); i++) {
        if (i >= 2 && before - begin + 2 * last > seconds) {
            subject->left_out++;
            continue;
        }
        vndf_status status = build_one(subject, sizes[i], watch, error);
        if (status != VNDF_OK)
            return status;
        double now = clock_processor_seconds();
        last = now - before;
        before = now;
    }
    return VNDF_OK;
}

vndf_status report_subject_build(report_subject *subject, double seconds, const report_watch *watch,
                                 vndf_error *error)
{
    double areas[REPORT_ANGLES];
    vndf_status status = build_all(subject, seconds, watch, error);
    if (status != VNDF_OK)
        return status;
    for (size_t a = 0; a < REPORT_ANGLES; a++)
        areas[a] = vndf_reference_area(subject->reference, report_theta(a) * radians);
    for (size_t i = 0; i < subject->count; i++) {
        measure_angles(subject, areas, &subject->table[i]);
        subject->table[i].time = report_time_of(subject->table[i].table);
        report_table *t = &subject->table[i];
        t->tv_above = fmax((double)t->info.certificate.tv_above, t->tv_above);
        t->tv_below = fmax((double)t->info.certificate.tv, t->worst.tv);
        if (watch->progress(1, "measuring errors", watch->user) != 0) {
            *error = (vndf_error){VNDF_ERROR_ARGUMENT, "interrupted"};
            return error->status;
        }
    }
    report_choose(subject);
    return VNDF_OK;
}

void report_subject_free(report_subject *subject)
{
    for (size_t i = 0; i < subject->count; i++)
        vndf_free(subject->table[i].table);
    vndf_reference_free(subject->reference);
    vndf_source_free(subject->source);
    *subject = (report_subject){.count = 0};
}
