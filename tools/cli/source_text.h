/* The source that was given on a command line, as text once more. */
#ifndef TOOLS_CLI_SOURCE_TEXT_H
#define TOOLS_CLI_SOURCE_TEXT_H

#include "cli/source_words.h"

/* As a shell would take it, with quotes where they are needed; cut where `size` ends. */
void source_text(const source_words *given, char *text, size_t size);

/* For people: the formula, file or family alone, and the parameters after it; cut likewise. */
void source_text_name(const source_words *given, char *text, size_t size);

#endif
