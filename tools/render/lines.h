/* Files that are not trusted: their lines as words. */
#pragma once

#include "cli/arguments.h"

enum { PATH_BYTES = 4096, LINE_WORDS_MAX = 4095 };

typedef struct lines {
    const char *name; /* of the file */
    char *at;         /* the rest of the text */
    unsigned long long line;
    char place[PATH_BYTES];         /* "vndf render: NAME:LINE", which opens every complaint */
    char *word[LINE_WORDS_MAX + 1]; /* of the line at hand */
    size_t count;
} lines;

#define wrong(in, ...) (complain((in)->place, __VA_ARGS__), 0)

/* Text of so many bytes, with a 0 behind them, which reading changes. 0 after a complaint. */
int lines_begin(lines *in, const char *name, char *text, size_t length);

/* Reads the next line that has words. Blanks and quotes separate them, # begins a comment. 0 at the end, -1 after a
 * complaint. */
int lines_next(lines *in);
