/* The page of `vndf report` (tools/commands/report.c): which table to ship, and how many moments, with all tables and
 * their certificates; error against time; what a caller pays; density and samples (tools/draw/panels.h). */
#ifndef TOOLS_EVIDENCE_PAGE_REPORT_H
#define TOOLS_EVIDENCE_PAGE_REPORT_H

#include "draw/page.h"
#include "evidence/evidence.h"

enum { REPORT_SUBJECTS = 4 };

typedef struct report {
    subject subject[REPORT_SUBJECTS]; /* the first is the one at hand */
    size_t chosen[REPORT_SUBJECTS];   /* the table to ship */
    size_t count;
    evidence *found;       /* for the one at hand */
    evidence_column batch; /* by the best instructions of this machine, and their name */
    const char *instructions;
} report;

/* Builds all tables and chooses. VNDF_OK, or the status and error that stopped it. */
vndf_status report_choose(subject *s, size_t *chosen, const evidence_plan *plan, vndf_error *error);

/* Whether a table keeps all limits of the advice. */
int report_keeps(const vndf_distribution *table);

/* The page with its data; 0 after a complaint. */
int report_write(html_page *page, const report *r);

#endif
