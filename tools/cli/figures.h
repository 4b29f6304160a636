/* What commands print of what they found: named figures, filled once and printed as a document, or as a table.
 *
 * A document has single figures with their units, and lists of records; as text a line for each of them, as JSON
 * (--json) one object, or nothing (-q). A table has records alone, which have the same names; it is printed as text,
 * CSV, Markdown or JSON, or into a page (draw/page.h). A column is named where its cell is filled, so that a list of
 * columns is a function of a row:
 *
 *     figures_record(&f);
 *     figures_text(&f, "method", row->method);
 *     figures_number(&f, "TV", "%.1e", row->tv, "");
 */
#pragma once

#include <stdio.h>

#include "cli/arguments.h"

/* CSV and Markdown are for tables. */
typedef enum figures_form { FIGURES_TEXT, FIGURES_CSV, FIGURES_MARKDOWN, FIGURES_JSON, FIGURES_NONE } figures_form;

/* In a table texts and words stand on the left, numbers on the right; CSV has quotes around texts. A list is the name
 * of the records behind it. */
typedef enum figure_kind { FIGURE_TEXT, FIGURE_WORD, FIGURE_NUMBER, FIGURE_TRUTH, FIGURE_LIST } figure_kind;

typedef struct figure {
    const char *list; /* NULL if it is in none; list, unit and mark are literals */
    const char *name, *unit;
    const char *mark; /* NULL, or the class in a page of the number; of the first cell, of its row */
    char *text;       /* owned; "" for a number that does not apply */
    figure_kind kind;
    size_t row; /* its record, from 1; 0: it stands alone */
} figure;

/* A table begins as {0}, a document by figures_begin. */
typedef struct figures {
    const char *command;
    figures_form form;
    figure *at;
    size_t count, room, rows, row; /* row: the one that is being filled */
    const char *list;
    int failed; /* there was no memory */
} figures;

figures figures_begin(const arguments *given);
void figures_free(figures *f);

/* Of any kind, without a unit. */
void figures_add(figures *f, figure_kind kind, const char *name, const char *text);
void figures_text(figures *f, const char *name, const char *text);

/* `format` takes one double. NaN is a number that does not apply, a dash, in CSV nothing; in JSON it is null, and an
 * infinity too. The unit may be "". */
void figures_number(figures *f, const char *name, const char *format, double x, const char *unit);

/* Times below 10 ns with two digits after the point, above with one. */
void figures_time(figures *f, const char *name, double ns);

/* "yes" or "no", in JSON true or false. */
void figures_truth(figures *f, const char *name, int is);

void figures_mark(figures *f, const char *mark);

/* Begins a list of a document, and a record of it or of a table. */
void figures_list(figures *f, const char *name);
void figures_record(figures *f);
void figures_list_end(figures *f);

/* The document on stdout, and frees it: a record is a line that begins with the name of its list, and goes on below
 * after 100 columns. An exit status, after a complaint if there was no memory. */
int figures_end(figures *f);

/* The table: for a terminal in groups of equal first cells, which stand in the heading, columns as wide as they have
 * to be; as JSON an array of objects; not FIGURES_NONE. 0 if there was no memory. */
int figures_print(FILE *file, const figures *f, figures_form form);

/* How many characters a text has; it is UTF-8. */
size_t text_glyphs(const char *text);

/* What a table shows in a row, from 0, and a column. */
size_t figures_columns(const figures *f);
const char *figures_shown(const figures *f, size_t row, size_t column);
