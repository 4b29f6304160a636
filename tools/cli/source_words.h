/* What the user brings to be tabulated, as words of a command line: a formula, a CSV or a named family. And those words
 * as text once more. */
#ifndef TOOLS_CLI_SOURCE_WORDS_H
#define TOOLS_CLI_SOURCE_WORDS_H

#include "cli/arguments.h"
#include "vndf_build.h"

typedef struct source_words {
    words ndf, slope, csv, family, set;
} source_words;

/* How many of --ndf, --slope, --family and the CSV's option were given. */
size_t source_words_count(const source_words *given);

/* PARSE_GO_ON if --set stands with a formula or not at all, else the status after a complaint. */
int source_words_check_set(const char *command, const source_words *given);

/* The source of the one that was given; NULL after a complaint. */
vndf_source *source_from_words(const char *command, const source_words *given);

/* Of rows of D or P22 in a CSV, or on stdin for "-"; NULL after a complaint. */
vndf_source *source_from_csv(const char *command, const char *path);

/* Adds " OPTION VALUE" for each of the values to what stands in text, with quotes where a shell needs them;
 * " OPTION" for a flag. Cut where `size` ends. */
void source_text_add(const char *option, const words *values, char *text, size_t size);

/* For people: the formula, file or family alone, and the parameters after it; cut where `size` ends. */
void source_text_name(const source_words *given, char *text, size_t size);

#endif
