/* What the user brings to be tabulated, as words of a command line: a formula, a CSV or a named family. */
#ifndef TOOLS_CLI_SOURCE_WORDS_H
#define TOOLS_CLI_SOURCE_WORDS_H

#include "cli/arguments.h"
#include "vndf_build.h"

/* --ndf, --slope, --csv, --family; NULL ends them. */
extern const char *const source_kinds[];

/* The source of the one that was given, or of the family `otherwise` where none was (NULL: one is needed). NULL after a
 * complaint, also where --set stands with another one than a formula. */
vndf_source *source_from_words(const arguments *given, const char *otherwise);

/* Of rows of D or P22 in a CSV, or on stdin for "-"; NULL after a complaint. */
vndf_source *source_from_csv(const char *command, const char *path);

/* For people: its description; of a family its name. */
const char *source_name(const vndf_source *source);

#endif
