/* Files that are not trusted: their lines as words, and what is said where they are wrong. */
#pragma once

#include "cli/arguments.h"
#include "vndf.h"

typedef struct lines {
    const char *name; /* of the file */
    vndf_error *error;
    char *at; /* the rest of the text */
    unsigned long long line;
    char *word[4096]; /* of the line at hand */
    size_t count;
} lines;

/* What is wrong, and where: "NAME:LINE: ...", less the line where it is 0. Control characters become '?'. Returns
 * 0. */
int refuse_at(vndf_error *error, const char *name, unsigned long long line, const char *format, ...)
    PRINTF_LIKE(4, 5);
#define refuse_line(in, ...) refuse_at((in)->error, (in)->name, (in)->line, __VA_ARGS__)

/* Text of so many bytes, with a 0 behind them, which reading changes. 0 after a refusal. */
int lines_begin(lines *in, const char *name, char *text, size_t length, vndf_error *error);

/* Reads the next line that has words. Blanks separate them, # begins a comment, "quotes" hold blanks. 0 at the
 * end, -1 after a refusal. */
int lines_next(lines *in);

/* A decimal number; 0 after a refusal. */
int read_number(const lines *in, const char *word, double *number);
