/* A table, or a family of tables, and what it is worth: the same wherever it is printed. */
#ifndef TOOLS_COMMANDS_PARTS_DESCRIBE_H
#define TOOLS_COMMANDS_PARTS_DESCRIBE_H

#include "cli/figures.h"
#include "cli/subject.h"

/* One sentence: "within 0.05% of exact above the horizon, 1.2% below; 4.1 KiB; good to ship", or what is wrong and what
 * to do. `by_default`: no size and no accuracy was asked for. Returns whether it is good. */
enum { DESCRIBE_VERDICT = 320 };
int describe_verdict(const chosen_distribution *of, int by_default, char verdict[DESCRIBE_VERDICT]);

/* As figures: what it is, its certificate, `found` in measurements (lines of a key and a value), and the verdict; a
 * closed form has neither certificate nor verdict. */
void describe(figures *f, const chosen_distribution *of, const char *found, const char *verdict);

#endif
