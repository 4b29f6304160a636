/* Tables, families and what they are worth as figures, the same wherever they are printed. */
#ifndef TOOLS_COMMANDS_PARTS_DESCRIBE_H
#define TOOLS_COMMANDS_PARTS_DESCRIBE_H

#include "cli/figures.h"
#include "vndf.h"

/* A closed form has no certificate. */
void describe_info(figures *f, const vndf_info *info);
void describe_certificate(figures *f, const vndf_certificate *certificate);
void describe_family(figures *f, const vndf_family *family);

/* One sentence on what a table is worth: "within 0.05% of exact above the horizon, 1.2% below; 4.1 KiB; good to
 * ship", or what is wrong and what to do. `by_default`: no size and no accuracy was asked for. Returns whether the
 * table is good. */
enum { DESCRIBE_VERDICT = 320 };
int describe_verdict(const vndf_info *info, int by_default, char verdict[DESCRIBE_VERDICT]);

/* The same of a family between its knots. */
int describe_family_verdict(const vndf_family *family, char verdict[DESCRIBE_VERDICT]);

#endif
