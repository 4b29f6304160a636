/* What a table, or a family of tables, is worth: one sentence, the same in every command. */
#ifndef TOOLS_CLI_VERDICT_H
#define TOOLS_CLI_VERDICT_H

#include "cli/figures.h"
#include "cli/subject.h"

typedef struct table_verdict {
    char within[128]; /* "within 0.05% of exact above the horizon, 1.2% below; 4.1 KiB; " */
    char
        needs[256]; /* what it hangs on: the matrix and the mean slope of a surface, features that none has seen */
    char doubts[896]; /* what is wrong, and what to do where something helps; "" if nothing is */
    int misses;       /* table_aim_above or _below, though a larger table would come closer */
} table_verdict;

/* Of certificate and notes. A closed form is good. */
table_verdict verdict_of(const chosen_distribution *of);

/* The largest total variation of the tables of a family. */
double verdict_largest_tv(const vndf_family *family);

/* Adds a doubt. */
void verdict_doubt(table_verdict *to, const char *format, ...) PRINTF_LIKE(2, 3);

/* "within ...; good to ship" or "within ...; doubtful: ", with what it hangs on; returns text. */
enum { VERDICT_TEXT = 1536 };
const char *verdict_text(const table_verdict *is, char text[VERDICT_TEXT]);

/* That as a figure, unless f is NULL; a doubt on stderr, too, with or without -q. */
void verdict_tell(const table_verdict *is, const char *command, figures *f);

#endif
