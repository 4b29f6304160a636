/* The kernel's text as words and declarations.
 *
 * It is the part of C in which src/kernel is written. Of files there are comments, directives (which are left out),
 * `typedef struct n {...} n;`, `enum { A = 1 };`, `static const float N[] = {...};` and `HERE type name(...) {...}`.
 * The build translates the one text there is, so its shape is asserted, not judged. */
#ifndef TOOLS_EXPORT_WORDS_H
#define TOOLS_EXPORT_WORDS_H

#include <stddef.h>

typedef enum word_kind { WORD_NAME, WORD_NUMBER, WORD_SIGN, WORD_END } word_kind;

typedef struct word {
    word_kind kind;
    const char *text; /* not terminated */
    int length;
    int gap;   /* characters between the last word and this one: blanks, comments, directives */
    int other; /* of a bracket: the word that closes or opens it */
} word;

typedef enum declaration_kind { FUNCTION, STRUCT, CONSTANT, ARRAY } declaration_kind;

/* Words from `begin` to before `end`. `inner` is the bracket that opens members, numbers or parameters. */
typedef struct declaration {
    declaration_kind kind;
    int name, type, begin, inner, end;
    long value;  /* of a constant */
    int wanted;  /* it goes into the file */
    int fetches; /* it reads numbers of tables */
} declaration;

enum { DECLARATIONS_MAX = 1024 };

typedef struct kernel {
    word *word;
    int words, count;
    declaration at[DECLARATIONS_MAX];
} kernel;

/* 0 if there is no memory; words point into `source`. */
int kernel_read(kernel *t, const char *source);
void kernel_free(kernel *t);

int word_is(const word *w, const char *name);
int word_is_in(const word *w, const char *list); /* " a b c " */
int word_equals(const word *a, const word *b);

/* Whether the word begins with vndf_ or VNDF_. */
int word_is_public(const word *w);

/* The declaration of that name, or NULL. */
declaration *kernel_named(kernel *t, const word *name);

/* The first word from `at` to before `end` that is the sign, outside of brackets; or `end`. */
int kernel_find(const kernel *t, int at, int end, const char *sign);

/* Complains of the line and ends the program: what is wrong with the one text there is is a fault of this program. */
void kernel_expect(int good, const word *at, const char *what);

#endif
