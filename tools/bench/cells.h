/* Cells of the tables that benchmarks print: numbers as people read them, texts and numbers of CSV and
 * Markdown. */
#ifndef TOOLS_BENCH_CELLS_H
#define TOOLS_BENCH_CELLS_H

#include <stdio.h>

enum { CELL = 24 };

/* `format` takes one double; a dash for NaN, what does not apply. */
void cell_number(char cell[CELL], const char *format, double x);

/* Times below 10 ns with two digits after the point, above with one. */
void cell_time(char cell[CELL], double ns);

/* The greater of a width and that of a text. */
int cell_wider(int width, const char *text);

/* A text in quotes; a comma and a number, nothing but the comma for NaN. */
void csv_text(FILE *file, const char *text);
void csv_number(FILE *file, double x);

/* A text without the bar that would end the cell. */
void markdown_text(FILE *file, const char *text);

#endif
