/* What the user brings to be tabulated, as words of a command line: a formula, a CSV or a named family. And those words
 * as text once more. */
#ifndef TOOLS_CLI_SOURCE_WORDS_H
#define TOOLS_CLI_SOURCE_WORDS_H

#include "cli/arguments.h"
#include "vndf_build.h"

/* How many of --ndf, --slope, --csv and --family were given. */
size_t source_words_count(const arguments *given);

/* The source of the one that was given, or of the family `otherwise` where none was (NULL: one is needed). NULL after a
 * complaint, also where --set stands with another one than a formula. */
vndf_source *source_from_words(const arguments *given, const char *otherwise);

/* Of rows of D or P22 in a CSV, or on stdin for "-"; NULL after a complaint. */
vndf_source *source_from_csv(const char *command, const char *path);

/* Adds " OPTION VALUE" for each value of an option to what stands in text, with quotes where a shell needs them;
 * " OPTION" for a flag. Cut where `size` ends. */
void source_text_add(const arguments *given, const char *option, char *text, size_t size);

/* For people: the formula, file or family alone, and the parameters after it; cut where `size` ends. */
void source_text_name(const arguments *given, char *text, size_t size);

#endif
