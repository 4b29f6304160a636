/* Prints the text of the kernel in another language.
 *
 * It reads the part of C in which src/kernel is written. Of files there are comments, directives (which are left out),
 * `typedef struct n {...} n;`, `enum { A = 1 };`, `static const float n[1] = {...};` and `HERE type name(...) {...}`.
 * Of statements there are declarations of types of one word, assignments, if, for and return; structs are made as
 * `n v = {a, b};` with every member. Where an if has masks they are in any(mask), and a name alone is a whole number.
 * All else stays as it is, word by word, with the blanks and comments between them, but for names, numbers and calls.
 * The build translates the one text there is, so its shape is not judged. */
#ifndef TOOLS_EXPORT_TRANSLATE_H
#define TOOLS_EXPORT_TRANSLATE_H

#include <stdio.h>

#include "export/languages.h"

typedef enum word_kind { WORD_NAME, WORD_NUMBER, WORD_SIGN, WORD_END } word_kind;

typedef struct word {
    word_kind kind;
    const char *text; /* not terminated */
    int length;
    int gap;   /* characters between the last word and this one: blanks, comments, directives */
    int other; /* of a bracket: the word that closes or opens it */
} word;

typedef enum declaration_kind { FUNCTION, STRUCT, CONSTANT, ARRAY } declaration_kind;

/* Words from `begin` to before `end`. `inner` is the bracket that opens members, numbers or parameters, or the first
 * word of a constant's value. */
typedef struct declaration {
    declaration_kind kind;
    int name, type, begin, inner, end;
    int wanted;  /* it goes into the file */
    int fetches; /* it reads numbers of tables */
} declaration;

enum { PREFIX_MAX = 32, DECLARATIONS_MAX = 1024 };

typedef struct translation {
    const language *to;
    char lower[PREFIX_MAX + 2], upper[PREFIX_MAX + 2]; /* what stands for vndf_ and VNDF_ */
    int embeds;                                        /* numbers are an array */
    int by_pointer;                                    /* or the first parameter of what fetches them */
    int apart, indents;                                /* of the language */
    FILE *file;
    word *word; /* of the text */
    int words, count;
    declaration at[DECLARATIONS_MAX];
} translation;

/* Sets the prefix, a name in lower case; 0 if it is none, or if names of it would be reserved: GLSL keeps those with
 * two underscores in a row and those that begin with gl_. */
int translation_prefix(translation *t, const char *name);

/* Writes `length` characters to t->file, with the prefix for every vndf_ and VNDF_. */
void put_prefixed(const translation *t, const char *from, size_t length);

/* Reads the text, to which words point; 0 if there is no memory. The caller frees t->word. */
int translation_read(translation *t, const char *source);

/* Marks the declarations whose name is this one, or begins with it and a '_', and what they need. */
void translation_want(translation *t, const char *name);

/* Writes what is marked of the declarations from that one on to t->file. */
void translate(translation *t, int first);

/* Of words, for both files: whether it is this one; the first one from `at` to before `end` that is the sign, outside
 * of brackets, or `end`. */
int word_is(const word *w, const char *name);
int word_find(const translation *t, int at, int end, const char *sign);

#endif
