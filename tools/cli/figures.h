/* What commands print of what they found: named figures with units, as text or JSON (--json), or not at all (-q). */
#ifndef TOOLS_CLI_FIGURES_H
#define TOOLS_CLI_FIGURES_H

#include <stdio.h>

#include "cli/arguments.h"

/* CSV and Markdown are for tables of rows (draw/table.h). */
typedef enum figures_form { FIGURES_TEXT, FIGURES_CSV, FIGURES_MARKDOWN, FIGURES_JSON, FIGURES_NONE } figures_form;

/* Names and units have to outlive it: literals. */
typedef struct figures {
    FILE *file;
    figures_form form;
    const char *list; /* the list that is open, or NULL */
    int in_object;    /* figures that the object at hand has already */
    int records;      /* of the list */
    int column;       /* where its text goes on */
    char units[4096]; /* for JSON, which has them at its end */
} figures;

/* Text, JSON or nothing, on stdout. */
figures figures_begin(const arguments *given);

void figures_text(figures *f, const char *name, const char *text);

/* With this many digits, and a unit or ""; in JSON an infinity or NaN is null. */
void figures_number(figures *f, const char *name, int digits, double x, const char *unit);

/* "yes" or "no", in JSON true or false. */
void figures_truth(figures *f, const char *name, int is);

/* A list of records: each is a line of text that begins with the name of the list, and goes on below after 100
 * columns. */
void figures_list(figures *f, const char *name);
void figures_record(figures *f);
void figures_list_end(figures *f);

void figures_end(figures *f);

/* Between quotes, as JSON has it; bytes that are no UTF-8 are the caller's. */
void figures_json_text(FILE *file, const char *text);

#endif
