/* A scene file as words, and its statements as clauses. Everything that reads returns 1, or 0 after a refusal that
 * names the place. */
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

/* Which of the names a word is; a refusal offers the nearest one, or all of them. `what`: "pattern". */
int read_choice(scene_words *w, const word *at, const char *what, const char *const *names, size_t count,
                size_t *chosen);

/* Splits the text, which has a 0 behind its bytes and is changed, into words. The list is to be freed in any case. */
int split_words(scene_words *w, char *text, size_t length);

/* ---- clauses ---- */

typedef enum key_kind { WORDS, NUMBERS, WHOLE } key_kind;
typedef enum key_rule {
    MAY_BE,
    NEEDED,
    OR,
    BESIDE
} key_rule; /* OR: one of it and `other`; BESIDE: only with that */

/* A keyword of a statement, with `least` to `most` words, or up to three numbers from `low` to `high`, behind it. */
typedef struct key {
    const char *of, *name, *takes;
    key_kind kind;
    size_t least, most;
    double low, high;
    key_rule rule;
    const char *other;
} key;

typedef struct clause {
    const key *is;
    const word *at, *value; /* the keyword and what is behind it; NULL if it is not there */
    size_t count;
    double number[3];
} clause;

enum { CLAUSES_MAX = 16 };

typedef struct statement {
    const word *list; /* its words */
    size_t count;
    clause clause[CLAUSES_MAX]; /* of all its keys */
    size_t clauses;
} statement;

/* Finds the clauses in the words from `from` on: those of the keys of `of` and `also`. A key without a name ends
 * them. */
int read_clauses(scene_words *w, statement *s, size_t from, const key *keys, const char *of, const char *also);

/* The clause with this name, with at == NULL if it is not there. */
const clause *clause_of(const statement *s, const char *name);

#endif
