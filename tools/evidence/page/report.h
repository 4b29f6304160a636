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

/* What a table that is advised has to keep. */
typedef enum report_limit {
    REPORT_WEIGHT,   /* the largest true/drawn density that was met */
    REPORT_VARIANCE, /* percents that weights add, at the worst angle */
    REPORT_TV_ABOVE, /* total variation above the horizon and below it: of the certificate or met, the larger one */
    REPORT_TV_BELOW,
    REPORT_AREA, /* largest relative error of the area above the horizon, hence of Lambda and G1 */
    REPORT_LIMITS
} report_limit;

extern const struct report_limit_text {
    double most;
    const char *heading, *format, *sentence; /* of its column, of a number in it, and of one in a sentence */
} report_limits[REPORT_LIMITS];

typedef struct report_table {
    const vndf_distribution *table; /* of the subject */
    vndf_info info;
    double tv[REPORT_ANGLES]; /* total variation; NaN where the visible area is below 1e-10 of that at grazing
                                 incidence */
    double worst[REPORT_LIMITS];
    double ns, batch; /* view, sample and density: one by one, and in a batch; NaN: not timed */
} report_table;

/* Whether a table keeps one limit, and all of them. */
int report_keeps(const report_table *t, report_limit limit);
int report_keeps_all(const report_table *t);

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
