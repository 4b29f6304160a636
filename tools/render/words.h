/* A scene file as words, and the clauses of a statement. Everything that reads returns 1, or 0 after a refusal
 * that names the place. */
#ifndef TOOLS_RENDER_WORDS_H
#define TOOLS_RENDER_WORDS_H

#include <stddef.h>

#include "cli/arguments.h"

typedef struct word {
    char *text;            /* without its quotes; into the text of the file */
    unsigned line, column; /* from 1 */
    int is_quoted, begins; /* begins: a statement */
} word;

typedef struct scene_words {
    const char *name; /* of the file */
    char *message;    /* room of `size` for a refusal */
    size_t size;
    word *list; /* owned */
    size_t count, room;
} scene_words;

/* "NAME:LINE:COLUMN: ..."; returns 0. */
int refuse_word(scene_words *w, const word *at, const char *format, ...) PRINTF_LIKE(3, 4);

/* The same for a word that may not stand there; offers the nearest one that may, or all of them. `what`:
 * "pattern". */
int refuse_unknown(scene_words *w, const word *at, const char *what, const char *const *names, size_t count);

/* Splits the text, which has a 0 behind its bytes and is changed, into words. The list is to be freed in any case.
 */
int split_words(scene_words *w, char *text, size_t length);

/* ---- clauses ---- */

enum { CLAUSES_MAX = 16 };

typedef enum clause_kind { CLAUSE_WORDS, CLAUSE_NUMBERS, CLAUSE_WHOLE } clause_kind;

/* A keyword with `least` to `most` words, or up to three numbers from `low` to `high`, behind it. */
typedef struct clause_form {
    const char *keyword, *takes;
    clause_kind kind;
    size_t least, most;
    int is_needed;
    double low, high;
} clause_form;

typedef struct clause {
    const word *at, *value; /* the keyword and what is behind it; NULL if it is not there */
    size_t count;
    double number[3];
} clause;

/* Finds the clauses of the statement list[0], ..., list[count - 1] in its words from `from` on. */
int read_clauses(scene_words *w, const word *list, size_t count, size_t from, const clause_form *forms, size_t n,
                 clause found[CLAUSES_MAX]);

/* Which of the names the first value of a clause is. */
int read_choice(scene_words *w, const clause *c, const char *what, const char *const *names, size_t count,
                size_t *chosen);

#endif
