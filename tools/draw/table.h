/* Rows of cells, filled once and printed as text for a terminal, as Markdown, CSV or JSON, or into a page.
 *
 * A column is named where its cell is filled, so that a list of columns is a function of a row:
 *
 *     table_row(&t);
 *     table_text(&t, "method", row->method);
 *     table_number(&t, "TV", "%.1e", row->tv);
 *
 * The first row makes the headings; all rows fill the same columns. What is NaN is printed as a dash, in CSV as
 * nothing. */
#ifndef TOOLS_DRAW_TABLE_H
#define TOOLS_DRAW_TABLE_H

#include <stddef.h>
#include <stdio.h>

#include "cli/figures.h"

enum { TABLE_COLUMNS_MAX = 48, TABLE_CELL = 96 };

typedef enum table_kind { TABLE_TEXT, TABLE_WORD, TABLE_NUMBER } table_kind;

typedef struct table_cell {
    char text[TABLE_CELL]; /* "" for what does not apply; cut to fit */
    const char *mark,      /* NULL, or the class in a page of the number, and of the row that the cell begins */
        *row_mark;
} table_cell;

typedef struct text_table {
    const char *heading[TABLE_COLUMNS_MAX]; /* literals */
    table_kind kind[TABLE_COLUMNS_MAX];
    size_t columns, rows;
    table_cell *cell; /* row after row */
    size_t count, room;
    int failed; /* there was no memory */
} text_table;

/* A table begins as {0}. */
void table_free(text_table *t);

/* ---- filling ---- */

/* Begins a row. */
void table_row(text_table *t);

/* Texts and words stand on the left, figures and numbers on the right; CSV has quotes around texts. */
void table_text(text_table *t, const char *heading, const char *text);
void table_word(text_table *t, const char *heading, const char *word);
void table_figure(text_table *t, const char *heading, const char *figure);

/* `format` takes one double. */
void table_number(text_table *t, const char *heading, const char *format, double x);

/* Times below 10 ns with two digits after the point, above with one. */
void table_time(text_table *t, const char *heading, double ns);

/* The class in a page of the last cell, a number: "no", say; and of the row. */
void table_mark(text_table *t, const char *mark);
void table_row_mark(text_table *t, const char *mark);

/* ---- printing; 0 if there was no memory ---- */

/* For a terminal in groups of equal first cells, which stand in the heading, columns as wide as they have to be;
 * as JSON an array of objects; not FIGURES_NONE. */
int table_print(FILE *file, const text_table *t, figures_form form);

/* Into a page. */
int table_print_html(FILE *file, const text_table *t);

/* "16 KiB", "1 MiB", "25.8 KiB", to 3%: files stay a little below a power of two. */
enum { TABLE_BYTES = 16 };
void table_bytes_text(char text[TABLE_BYTES], double bytes);

#endif
