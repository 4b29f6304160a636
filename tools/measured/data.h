/* What all readers of measurements have in common: a file with what is said of it, its numbers, and the rows of D or
 * P22 that every reader ends in, for vndf_source_rows. */
#ifndef TOOLS_MEASURED_DATA_H
#define TOOLS_MEASURED_DATA_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "vndf_build.h"

#if defined(__GNUC__)
#  define MEASURED_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#  define MEASURED_PRINTF(text, first)
#endif

/* A file, whose bytes are not trusted. A reader returns 1, or 0 with the reason in `refused`: the file, the place in
 * it, what is wrong, what would be right. What it finds goes to `notes`, lines `key value`; `implausible` is the key of
 * what only a mistake explains. Members that are not given are zeroed. */
typedef struct data_file {
    const char *name;
    const unsigned char *bytes;
    size_t size;
    char refused[512], notes[4096];
} data_file;

/* "NAME: message"; returns 0, so that a reader can end with it. */
int refuse(data_file *file, const char *format, ...) MEASURED_PRINTF(2, 3);

/* Adds a line, unless it does not fit. */
void note(data_file *file, const char *format, ...) MEASURED_PRINTF(2, 3);

/* ---- numbers and words --------------------------------------------------------------------------- */

/* Numbers with the least byte first. */
uint64_t little_whole(const unsigned char *at, size_t bytes);
double little_float(const unsigned char *at);
double little_double(const unsigned char *at);
void put_little(FILE *file, uint64_t value, size_t bytes);

enum { WORD_MAX = 64 };

/* Words of a text between blanks. From # on, a line is a comment. */
typedef struct scan {
    const unsigned char *bytes;
    size_t size, at, line; /* the line of the next byte, from 1 */
} scan;

/* At the beginning, past the mark of UTF-8 that spreadsheets write. */
scan scan_from(const data_file *file);

/* The next word of the line; 0 at its end. It is cut after WORD_MAX - 1 characters; what is no ASCII becomes '?'. */
int scan_word(scan *from, char word[WORD_MAX]);

/* Goes to the next line; 0 at the end of the text. */
int scan_line(scan *from);

/* The next word in this line or later ones. */
int scan_word_anywhere(scan *from, char word[WORD_MAX]);

/* Whether the whole word is a number, which may be nan, but not infinite. */
int word_number(const char *word, double *value);

/* ---- rows ---------------------------------------------------------------------------------------- */

typedef struct profile {
    vndf_rows_over over;
    vndf_rows_of of;
    size_t count;
    double *x, *value; /* owned */
} profile;

/* Room for `count` rows of zeros. 0 and the reason if there is no memory. */
int profile_make(profile *made, vndf_rows_over over, vndf_rows_of of, size_t count, data_file *file);
void profile_free(profile *freed);

/* The curve through the rows, to be freed; NULL and the reason if they are none: not finite, not ascending. */
vndf_source *profile_source(const profile *from, data_file *file);

/* Finds the relative noise of values at even steps of some coordinate, notes it, and smooths them by as much as keeps
 * them within that noise. */
int profile_smooth(profile *changed, data_file *file);

/* Writes the rows as a CSV that `vndf build --csv` reads, with `title` as a comment; 0 if that fails. */
int profile_write(FILE *file, const profile *from, const char *title);

#endif
