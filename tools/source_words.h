/* The distribution of normals that a user brings on the command line: --ndf, --slope, --csv or --family, and --set
 * for the parameters of the first two. Shared by the subcommands that take one. */
#ifndef TOOLS_SOURCE_WORDS_H
#define TOOLS_SOURCE_WORDS_H

#include "arguments.h"
#include "vndf_build.h"

typedef struct source_words {
    words ndf, slope, csv, family, set;
} source_words;

/* How many sources were named. */
size_t source_words_count(const source_words *given);

/* PARSE_GO_ON, or STATUS_USE after a complaint: more than one source, or --set without an expression. */
int source_words_check(const char *command, const source_words *given);

/* What was given, as a shell would take it, cut at `size` with its end. */
void source_words_text(const source_words *given, char *text, size_t size);

/* The value of the one option that was given: a formula, a file or a family. */
const char *source_words_value(const source_words *given);

/* The source; exactly one must be named. NULL after a complaint. */
vndf_source *source_from_words(const char *command, const source_words *given);

#endif
