/* Prints the text of the kernel in another language.
 *
 * Of statements there are declarations of types of one word, assignments, if, for and return; structs are made as
 * `n v = {a, b};` with every member. What stands between brackets stays as it is, word by word, but for calls, names
 * and conditions: an operand of && and || in an if that is neither a comparison nor any(mask) is a whole number. */
#ifndef TOOLS_EXPORT_TRANSLATE_H
#define TOOLS_EXPORT_TRANSLATE_H

#include <stdio.h>

#include "export/languages.h"
#include "export/words.h"

enum { PREFIX_MAX = 32 };

typedef struct translation {
    const language *to;
    char lower[PREFIX_MAX + 2], upper[PREFIX_MAX + 2]; /* what stands for vndf_ and VNDF_ */
    const char *fetched;                               /* number $1 */
    int by_pointer;                                    /* numbers are the first parameter of what fetches them */
} translation;

/* Sets the prefix, a name in lower case; 0 if it is none, or if names of it would be reserved: GLSL keeps those with
 * two underscores in a row and those that begin with gl_. */
int translation_prefix(translation *t, const char *name);

/* Writes `length` characters, with the prefix for every vndf_ and VNDF_. */
void put_prefixed(const translation *t, FILE *to, const char *from, size_t length);

/* A number with 9 digits, in the form of a float. */
void put_float(const translation *t, FILE *to, double x);

/* Marks what is needed for a declaration; 0 if there is none of that name. */
int translation_want(const translation *t, kernel *from, const word *name);

/* Writes all that is marked. */
void translate(const translation *t, FILE *to, kernel *from);

#endif
