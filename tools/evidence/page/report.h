/* The page of `vndf report`: a section in each file, none of which calls another.
 *
 *     angles.c    how far each table is from D, at every angle of incidence
 *     advice.c    which table to ship, and how many moments; and the same as a table
 *     plots.c     error against time and angle
 *     time.c      what a caller pays
 *     normals.c   density and samples (tools/draw/panels.h) */
#ifndef TOOLS_EVIDENCE_PAGE_REPORT_H
#define TOOLS_EVIDENCE_PAGE_REPORT_H

#include "draw/page.h"
#include "evidence/evidence.h"

enum { REPORT_ANGLES = 61, REPORT_SUBJECTS = 4 };

typedef struct report_table {
    const vndf_distribution *table; /* of the subject */
    vndf_info info;
    double tv[REPORT_ANGLES];  /* total variation; NaN where the visible area is below 1e-10 of that at grazing
                                 incidence */
    double weight, variance;   /* of true/drawn density: the largest met, and the largest variance at an angle */
    double tv_above, tv_below; /* the larger of the certificate's and what was met here; below: at all angles */
    double area;               /* largest relative error of the area above the horizon, hence of Lambda and G1 */
    double ns, batch;          /* view, sample and density: one by one, and in a batch; NaN: not timed */
} report_table;

typedef struct report_subject {
    subject of;
    vndf_reference *reference;
    report_table table[SIZES];
    size_t chosen; /* the table to ship */
} report_subject;

typedef struct report {
    report_subject subject[REPORT_SUBJECTS]; /* the first is the one at hand */
    size_t count;
    evidence_rows rows; /* of evidence_run for the one at hand */
    const char *batch;  /* the best instructions of this machine */
} report;

double report_theta(size_t angle);

/* What a table that is advised has to keep: the largest weight that was met, percents of added variance, total
 * variation from above the horizon and from below it, error of the area. */
enum { REPORT_LIMITS = 5 };
extern const double report_limits[REPORT_LIMITS];

typedef struct report_verdict {
    double value[REPORT_LIMITS];
    int kept[REPORT_LIMITS], all;
} report_verdict;
report_verdict report_judge(const report_table *t);

/* Takes the source. VNDF_OK, or the status and error that stopped it; report_subject_free in any case. */
vndf_status report_subject_begin(report_subject *s, vndf_source *source, const char *name, vndf_error *error);
vndf_status report_subject_measure(report_subject *s, const evidence_plan *plan, vndf_error *error);
void report_subject_free(report_subject *s);

/* Of the tables at hand, from the rows. */
void report_note_times(report *r);

/* A section each; 0 if there is no memory. */
int report_advice(html_page *page, const report *r);
int report_frontier(html_page *page, const report *r);
int report_angles(html_page *page, const report *r);
int report_times(html_page *page, const report *r);
int report_normals(html_page *page, const report *r);

#endif
