/* What all readers of measurements have in common: a file with what is said of it, its numbers, and the rows of D or
 * P22 that every reader ends in, for vndf_source_rows. */
#ifndef TOOLS_MEASURED_DATA_H
#define TOOLS_MEASURED_DATA_H

#include <stdio.h>

#include "cli/arguments.h"
#include "cli/files.h"
#include "vndf_build.h"

/* A file, whose bytes are not trusted. A reader returns 1, or 0 with the reason in `refused`: the file, the place in
 * it, what is wrong, what would be right. What it finds goes to `notes`, lines `key value`; `implausible` is the key
 * of what only a mistake explains. Members that are not given are zeroed. */
typedef struct data_file {
    const char *name;
    const unsigned char *bytes;
    size_t size;
    char refused[512], notes[4096];
} data_file;

/* "NAME: message"; returns 0, so that a reader can end with it. */
int refuse(data_file *file, const char *format, ...) PRINTF_LIKE(2, 3);

/* Adds a line, unless it does not fit. */
void note(data_file *file, const char *format, ...) PRINTF_LIKE(2, 3);

typedef struct profile {
    vndf_rows_over over;
    vndf_rows_of of;
    size_t count;
    double *x, *value; /* owned, one behind the other */
} profile;

/* Room for `count` rows of zeros. 0 and the reason if there is no memory. */
int profile_make(profile *made, vndf_rows_over over, vndf_rows_of of, size_t count, data_file *file);
void profile_free(profile *freed);

/* The curve through the rows, to be freed; NULL and the reason if they are none: not finite, not ascending. */
vndf_source *profile_source(const profile *from, data_file *file);

/* Finds the relative noise of values at even steps of some coordinate, about whose 0 they are symmetric, notes it,
 * and smooths them by as much as keeps them within that noise. */
int profile_smooth(profile *changed, data_file *file);

/* Writes the rows as a CSV that `vndf build --csv` reads, with `title` as a comment; 0 if that fails. */
int profile_write(FILE *file, const profile *from, const char *title);

#endif
