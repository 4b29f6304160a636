/* Declarations that the parts of `vndf report` share. commands/report.c reads the words, measures one thing after the
 * other and calls the sections to write the page; no section calls another.
 *
 *   subject.c    a distribution of normals, its tables of several sizes, and how far each is from the reference
 *   time.c       nanoseconds of view, sample and pdf, one by one and in batches
 *   variance.c   the noise of two integrals that are estimated with the samples
 *   advice.c     which table to ship; and the same as a table
 *   frontier.c   error against time, with the rows of tools/bench/bench.h
 *   bytes.c      error against bytes, of the tables and of other methods
 *   theta.c      error against the angle of incidence
 *   normals.c    density and samples (tools/draw/panels.h)
 */
#ifndef TOOLS_REPORT_REPORT_H
#define TOOLS_REPORT_REPORT_H

#include <stddef.h>

#include "bench/bench.h"
#include "draw/page.h"
#include "draw/table.h"
#include "vndf_build.h"

enum { REPORT_ANGLES = 61, REPORT_SIZES = 5, REPORT_SUBJECTS = 4, REPORT_METHODS = 8, REPORT_COUNTS = 7 };

/* How far drawn visible normals are from the true ones, from one direction. NaN where the visible area is below 1e-10
 * of the area at grazing incidence. */
typedef struct report_error {
    double tv;         /* total variation: half the integral of |drawn - true| */
    double variance;   /* of the weight true/drawn: the variance of an estimator of something constant */
    double max_weight; /* the largest weight met */
} report_error;

/* Median nanoseconds per call, for random directions. */
typedef struct report_time {
    double view, sample, pdf;   /* one by one: the view; what a sample with its density adds; a given normal */
    double batch, batch_shared; /* vndf_sample_n, view included: a direction each; one direction for all */
} report_time;

typedef struct report_table {
    size_t asked; /* --max-bytes */
    vndf_distribution *table;
    vndf_info info;
    report_error error[REPORT_ANGLES], worst;
    /* The larger of the certificate's and that of the worst angle here; below: of all angles. */
    double tv_above, tv_below;
    double area; /* largest relative error of the area above the horizon, hence of Lambda and G1 */
    report_time time;
} report_table;

typedef struct report_subject {
    char name[64];       /* for people, cut to fit */
    char arguments[512]; /* of `vndf build`, for a shell; cut to fit */
    int brought;         /* by the user */
    vndf_source *source;
    vndf_reference *reference;
    report_table table[REPORT_SIZES];
    size_t count;
    size_t left_out; /* sizes that there was no time for */
    size_t chosen;   /* the recommended table */
} report_subject;

/* Noise of an integral: relative root mean square error of the mean of 1, 4, 16 ... samples. */
typedef struct report_noise {
    char method[64];
    double error[REPORT_COUNTS];
} report_noise;

typedef struct report_integral {
    char title[96];
    double reference;
    report_noise noise[REPORT_METHODS];
    size_t count;
} report_integral;

typedef struct report {
    report_subject subject[REPORT_SUBJECTS];
    size_t count;
    report_time ggx, beckmann;
    report_integral integral[2];
    bench_rows rows;
} report;

/* Receives how far the current step is, in [0, 1]; returns nonzero to stop. */
typedef struct report_watch {
    vndf_progress *progress;
    void *user;
} report_watch;

double report_theta(size_t angle);

/* ---- measuring; each returns VNDF_OK, or the status that stopped it and an error ---- */

/* Takes the source over. Free with report_subject_free, whatever this returns. `name` is cut to fit. */
vndf_status report_subject_begin(report_subject *subject, vndf_source *source, const char *name,
                                 const char *arguments, vndf_error *error);

/* Builds and measures the tables, smallest first: two at least, and more as long as the next one is likely to end
 * within `seconds`. */
vndf_status report_subject_build(report_subject *subject, double seconds, const report_watch *watch,
                                 vndf_error *error);
void report_subject_free(report_subject *subject);

/* Chooses the table to ship. */
void report_choose(report_subject *subject);

report_time report_time_of(const vndf_distribution *distribution);

/* Measures the noise of the albedo of a conductor at 60 and 85 degrees. */
void report_variance_measure(const report_subject *subject, report_integral integral[2]);

/* ---- writing: one section each; 0 if there is no memory ---- */

int report_write_advice(html_page *page, const report *r);
int report_write_frontier(html_page *page, const report *r);
int report_write_bytes(html_page *page, const report *r);
int report_write_theta(html_page *page, const report *r);
int report_write_normals(html_page *page, const report *r);
int report_write_variance(html_page *page, const report *r);
int report_write_time(html_page *page, const report *r);

#endif
