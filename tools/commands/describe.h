/* Tables and certificates as `key value` lines, the same wherever they are printed. */
#ifndef TOOLS_COMMANDS_DESCRIBE_H
#define TOOLS_COMMANDS_DESCRIBE_H

#include "vndf.h"

void describe_info(const vndf_info *info);
void describe_certificate(const vndf_certificate *certificate);
void describe_family(const vndf_family *family);

/* One sentence on what a table is worth: "within 0.05% of exact above the horizon, 1.2% below; 4.1 KiB; good to ship",
 * or what is wrong and what to do. `by_default`: no size and no accuracy was asked for. Returns whether the table is
 * good. */
enum { DESCRIBE_VERDICT = 256 };
int describe_verdict(const vndf_info *info, int by_default, char verdict[DESCRIBE_VERDICT]);

#endif
