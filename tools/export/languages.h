/* Where the languages of `vndf export` differ. */
#ifndef TOOLS_EXPORT_LANGUAGES_H
#define TOOLS_EXPORT_LANGUAGES_H

#include <stddef.h>

/* In forms $T is a type, $V a variable's name, $D a declaration's name, $P its parameters and $N a number; in those of
 * `types` and `calls`, lists of "word: form; ", $1, $2 and $3 are arguments. vndf_ stands for the prefix. */
typedef struct language {
    const char *name, *title;
    const char *typed, *several; /* a variable, a parameter, a member; N of them */
    const char *given, *copied;  /* a parameter that is assigned to, and its copy, where it must not be; or NULL */
    const char *function, *structs, *structs_close, *constant, *array, *array_close;
    const char *zero;    /* what a struct is before its members are set, where that must be said */
    const char *pointer; /* type of the pointer to numbers, the first parameter of what fetches them; or */
    const char *bound;   /* declares the buffer of numbers that a host binds */
    const char *fetched; /* number $1 of either */
    const char *begin;   /* after the first comment */
    const char *types, *calls;
    const char *unroll;   /* a line before loops with a constant end; NULL: none */
    size_t most_embedded; /* numbers; 0 for no limit */
    const char *why;      /* the limit */
    int apart;            /* one variable to a statement */
    int made_by_call;     /* T(a, b), not {a, b} */
    int guarded;          /* #ifndef around all, since files include one another */
    int indents;          /* as Python does: no braces, no types */
} language;

/* NULL if there is none of that name. */
const language *language_named(const char *name);

/* Without Python, which is for tools/python. */
enum { LANGUAGES = 8 };
extern const char *const language_names[LANGUAGES];

/* What a type or a call of the kernel is in the language: a pattern of *length characters, or NULL. */
const char *language_type(const language *in, const char *name, int size, int *length);
const char *language_call(const language *in, const char *name, int size, int *length);

/* Names that are taken in one of the languages, between spaces. */
extern const char language_reserved[];

#endif
