/* `vndf build` from files of measurements: their words, and the source that comes of them. */
#ifndef TOOLS_COMMANDS_PARTS_BUILD_MEASURED_H
#define TOOLS_COMMANDS_PARTS_BUILD_MEASURED_H

#include "cli/arguments.h"
#include "vndf_build.h"

typedef struct measured_words {
    words rgl, merl, height, normal_map; /* files */
    words step, cutoff;                  /* of heights */
    words channel;                       /* of MERL */
    words profile;                       /* what is written beside the table */
} measured_words;

/* What --help says of them. A string literal may have 4095 characters, so it is no part of the other. */
enum { MEASURED_HELP_MAX = 4096, MEASURED_NOTES = 4096 };
extern const char measured_help[];

/* How many files were given. */
size_t measured_words_count(const measured_words *given);

/* PARSE_GO_ON if every option stands with its file, else the status after a complaint. */
int measured_words_check(const char *command, const measured_words *given);

/* The source of the one file, to be freed, which says what it was made of; what was found on the way, as lines, in
 * found[]. NULL after a complaint. */
vndf_source *measured_source(const char *command, const measured_words *given, char found[MEASURED_NOTES]);

#endif
