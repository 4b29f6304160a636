/* Tables and certificates as `key value` lines, the same wherever they are printed. */
#ifndef TOOLS_COMMANDS_DESCRIBE_H
#define TOOLS_COMMANDS_DESCRIBE_H

#include "vndf.h"

void describe_info(const vndf_info *info);
void describe_certificate(const vndf_certificate *certificate);
void describe_family(const vndf_family *family);

#endif
