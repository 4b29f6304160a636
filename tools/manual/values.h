/* What may stand for a value: the words of "FILE|ggx|beckmann" and whether a file may. */
#ifndef TOOLS_MANUAL_VALUES_H
#define TOOLS_MANUAL_VALUES_H

#include <stddef.h>

typedef struct values {
    char words[256]; /* between blanks */
    int files;
} values;

values values_of(const char *text);

void values_add(values *to, const char *word);

#endif
