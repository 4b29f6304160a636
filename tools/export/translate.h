/* Prints the text of the kernel in another language.
 *
 * The text is the part of C in which src/kernel is written. Of files there are comments, directives (which are left
 * out), `typedef struct n {...} n;`, `enum { A = 1 };`, `static const float N[] = {...};` and `HERE type name(...)
 * {...}`. Of statements there are declarations of types of one word, assignments, if, for and return; structs are made
 * as `n v = {a, b};` with every member. What stands between brackets stays as it is, word by word, but for calls, names
 * and conditions: an operand of && and || in an if that is neither a comparison nor any(mask) is a whole number. */
#ifndef TOOLS_EXPORT_TRANSLATE_H
#define TOOLS_EXPORT_TRANSLATE_H

#include <stdio.h>

#include "export/languages.h"
#include "export/parts.h"

enum { PREFIX_MAX = 32 };

typedef struct translation {
    const language *to;
    char lower[PREFIX_MAX + 2], upper[PREFIX_MAX + 2]; /* what stands for vndf_ and VNDF_ */
    int by_pointer;                                    /* numbers are the first parameter of what fetches them */
    const char *fetched;                               /* number $1 */
} translation;

/* Sets the prefix, a name in lower case; 0 if it is none, or if names of it would be reserved: GLSL keeps those with
 * two underscores in a row and those that begin with gl_. */
int translation_prefix(translation *t, const char *name);

/* Writes a text with the prefix for every vndf_ and VNDF_. In it $NAME is the name, which gets the prefix too, and $N
 * the number. */
void translate_pattern(const translation *t, FILE *to, const char *pattern, const char *name, long n);

/* Marks what is needed for a function; 0 if there is none of that name. */
int translation_want(const translation *t, part_list *parts, const char *name);

/* Writes all that is marked. */
void translate(const translation *t, FILE *to, part_list *parts);

#endif
