/* Where the languages of `vndf export` differ. */
#ifndef TOOLS_EXPORT_LANGUAGES_H
#define TOOLS_EXPORT_LANGUAGES_H

#include <stddef.h>

enum {
    LANGUAGE_APART = 1,   /* one variable to a statement; and no preprocessor */
    LANGUAGE_INDENTS = 2, /* as Python does: no braces, no types */
};

/* `words` says "TYPE: own; " of types and forms and "CALL = own; " of calls; what it lacks is as in most languages. Of
 * calls $1, $2 and $3 are arguments. In forms $T is a type, $V a variable's name, $D a declaration's name, $P its
 * parameters and $N a number. vndf_ stands for the prefix. */
typedef struct language {
    const char *name, *title;
    unsigned is;
    size_t most_embedded; /* numbers; 0 for no limit */
    const char *why;      /* the limit */
    const char *bound;    /* declares the buffer of numbers that a host binds; or NULL */
    const char *begin;    /* after the first comment */
    const char *words;
} language;

/* NULL if there is none of that name. Besides c, cpp, cuda, opencl, glsl, hlsl, wgsl and msl there is python, which is
 * for tools/python. */
const language *language_named(const char *name);

/* What a name of `size` characters is in the language: *length characters, or NULL. `means`: ": " or " = ". */
const char *language_word(const language *in, const char *name, int size, const char *means, int *length);

/* Names that are taken in one of the languages, between spaces. */
extern const char language_reserved[];

#endif
