/* The page of `vndf report`: a section in each file, none of which calls another.
 *
 *     advice.c    which table to ship, and how many moments; and all tables with their certificates
 *     frontier.c  error against time
 *     samples.c   what a caller pays; density and samples (tools/draw/panels.h) */
#ifndef TOOLS_EVIDENCE_PAGE_REPORT_H
#define TOOLS_EVIDENCE_PAGE_REPORT_H

#include "draw/page.h"
#include "evidence/evidence.h"

enum { REPORT_SUBJECTS = 4 };

typedef struct report_subject {
    subject of;
    size_t chosen;                  /* the table to ship */
    double ns[SIZES], batch[SIZES]; /* view, sample and density: one by one, and in a batch; NaN: not timed */
} report_subject;

typedef struct report {
    report_subject subject[REPORT_SUBJECTS]; /* the first is the one at hand */
    size_t count;
    evidence_rows rows; /* of evidence_run for the one at hand */
    const char *batch;  /* the best instructions of this machine */
} report;

/* Builds all tables and chooses. VNDF_OK, or the status and error that stopped it. */
vndf_status report_choose(report_subject *s, const evidence_plan *plan, vndf_error *error);

/* Whether a table keeps all limits of the advice. */
int report_keeps(const vndf_distribution *table);

/* Of the tables at hand, from the rows. */
void report_note_times(report *r);

/* A section each; 0 after a complaint. */
int report_advice(html_page *page, const report *r);
int report_frontier(html_page *page, const report *r);
int report_times(html_page *page, const report *r);
int report_normals(html_page *page, const report *r);

#endif
