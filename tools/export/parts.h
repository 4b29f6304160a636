/* The declarations of the kernel's text, and which of them a file needs. */
#ifndef TOOLS_EXPORT_PARTS_H
#define TOOLS_EXPORT_PARTS_H

#include "export/words.h"

typedef enum part_kind {
    PART_FUNCTION,
    PART_STRUCT,
    PART_CONSTANT, /* one name of an enum */
    PART_ARRAY
} part_kind;

/* A declaration: `inner` is what stands between its braces, or the parameters of a function. */
typedef struct part {
    part_kind kind;
    word name, type; /* type: of a function's value, or of an array's elements */
    const char *comment, *begin, *inner, *body;
    const char *end;
    long value;  /* of a constant */
    int wanted;  /* it goes into the file */
    int fetches; /* it reads numbers of tables */
} part;

enum { PARTS_MAX = 512 };

typedef struct part_list {
    part at[PARTS_MAX];
    size_t count;
} part_list;

/* Reads a text that keeps the shape that translate.h states: the build translates the one text there is, so its shape
 * is asserted, not judged. */
void parts_read(part_list *parts, const char *text);

/* NULL if there is none. */
part *part_named(part_list *parts, const word *name);

/* Marks a declaration and what it mentions, but for functions that `is_known` says the language has. */
void part_want(part_list *parts, part *p, int (*is_known)(const void *language, const word *name),
               const void *language);

#endif
