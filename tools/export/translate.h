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

/* Sets the prefix, a name in lower case; 0 if it is none. */
int translation_prefix(translation *t, const char *name);

/* Writes a name with its prefix. */
void translate_name(const translation *t, FILE *to, const char *name);

/* Writes `text`, which keeps the shape that kernel.glsl states. */
void translate(const translation *t, FILE *to, const char *text);

#endif
