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

enum { PREFIX_MAX = 32 };

typedef struct translation {
    const language *to;
    char lower[PREFIX_MAX + 2], upper[PREFIX_MAX + 2]; /* what stands for vndf_ and VNDF_ */
    int embeds;                                        /* numbers are an array */
    int by_pointer;                                    /* or the first parameter of what fetches them */
} translation;

/* Sets the prefix, a name in lower case; 0 if it is none, or if names of it would be reserved: GLSL keeps those with
 * two underscores in a row and those that begin with gl_. */
int translation_prefix(translation *t, const char *name);

/* Writes `length` characters, with the prefix for every vndf_ and VNDF_. */
void put_prefixed(const translation *t, FILE *to, const char *from, size_t length);

/* Writes of the text what `wanted` names, between blanks, or what begins with such a name and a '_', and all that this
 * needs; 0 if there is no memory. */
int translate(const translation *as, const char *source, const char *wanted, FILE *to);

#endif
