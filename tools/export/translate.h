/* Writes the kernel in another language. */
#ifndef TOOLS_EXPORT_TRANSLATE_H
#define TOOLS_EXPORT_TRANSLATE_H

#include <stdio.h>

#include "export/languages.h"

enum { PREFIX_MAX = 32 };

typedef struct translation {
    const language *to;
    char lower[PREFIX_MAX + 2], upper[PREFIX_MAX + 2]; /* what stands for vndf_ and VNDF_ */
    int by_pointer;                                    /* numbers are the first parameter of what fetches them */
} translation;

/* Sets the prefix, a name in lower case; 0 if it is none, or if names of it would be reserved: GLSL keeps those with
 * two underscores in a row and those that begin with gl_. */
int translation_prefix(translation *t, const char *name);

/* Writes a name of the kernel's, with the prefix for vndf_ or VNDF_. */
void translate_name(const translation *t, FILE *to, const char *name, size_t length);

/* Writes `text`, which keeps the shape that kernel.glsl states. */
void translate(const translation *t, FILE *to, const char *text);

#endif
