/* The page of `vndf report` (tools/commands/report.c), a section in each function:
 *
 *     advice.c    which table to ship, and how many moments; and all tables with their certificates
 *     figures.c   error against time; what a caller pays; density and samples (tools/draw/panels.h) */
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

/* "16 KiB", "1 MiB", "25.8 KiB", to 3%: files stay a little below a power of two. */
enum { REPORT_BYTES = 16 };
void report_bytes(char text[REPORT_BYTES], double bytes);

/* What was measured of a table, or NaN. */
double report_number(const report *r, const vndf_distribution *table, evidence_column c);

/* The inside of a section each; 0 after a complaint. */
int report_advice(html_page *page, const report *r);
int report_frontier(html_page *page, const report *r);
int report_times(html_page *page, const report *r);
int report_normals(html_page *page, const report *r);

#endif
