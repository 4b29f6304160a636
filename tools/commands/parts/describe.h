/* A table, or a family of tables, and what it is worth: the same wherever it is printed. */
#pragma once

#include "cli/figures.h"
#include "cli/subject.h"

/* "good to ship", with the matrix, the mean slope and the condition that it hangs on, or "doubtful: " and what is wrong
 * by certificate and notes, and what helps. Returns whether it is good, as closed forms are. */
enum { DESCRIBE_WORTH = 1600, DESCRIBE_VERDICT = DESCRIBE_WORTH + 192 };
int describe_worth(const vndf_info *of, char worth[DESCRIBE_WORTH]);

/* The same of a table or a family behind "within 0.05% of exact above the horizon, 1.2% below; 4.1 KiB; ". */
int describe_verdict(const chosen_distribution *of, char verdict[DESCRIBE_VERDICT]);

/* As figures: what it is, its certificate, and its end: notes, and the verdict, a doubtful one on stderr too, with or
 * without -q. A closed form has neither certificate nor end. */
void describe(figures *f, const chosen_distribution *of);
void describe_end(figures *f, const chosen_distribution *of);
