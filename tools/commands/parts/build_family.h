/* vndf build --parameter: the tables of a family, in one file. */
#ifndef TOOLS_COMMANDS_BUILD_FAMILY_H
#define TOOLS_COMMANDS_BUILD_FAMILY_H

#include "cli/arguments.h"

typedef struct family_words {
    words family, parameter, knots, distance, bytes, moments, output;
} family_words;

/* Builds, saves and prints; `held` are the signals that wait meanwhile. An exit status. */
int build_family(const char *command, const family_words *given, unsigned held);

#endif
