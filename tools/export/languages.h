/* Where the languages of `vndf export` differ. */
#ifndef TOOLS_EXPORT_LANGUAGES_H
#define TOOLS_EXPORT_LANGUAGES_H

#include <stddef.h>

/* How a struct is declared. */
typedef enum struct_form {
    STRUCT_PLAIN,   /* struct name { float a, b; }; */
    STRUCT_TYPEDEF, /* typedef struct name { float a, b; } name; */
    STRUCT_FIELDS,  /* struct name { a: f32, b: f32, } */
    STRUCT_CLASS    /* of Python */
} struct_form;

/* Where numbers are fetched from, unless they are embedded. */
typedef enum buffer_form {
    BUFFER_PARAMETER, /* a pointer, the first parameter of what fetches */
    BUFFER_BOUND      /* a buffer that the host binds */
} buffer_form;

/* What a word of the kernel becomes: a type, or a call, whose arguments are $1, $2 and $3. */
typedef struct renamed {
    const char *from, *to;
} renamed;

enum { RENAMED_MAX = 24 };

/* Declarations are patterns: in them the kernel's names get their prefix, and words that begin with $ are filled in. */
typedef struct language {
    const char *name, *title;
    struct_form structs;
    buffer_form buffer;
    int typed_after;      /* x: f32, not float x */
    int keeps_const;      /* of local values and parameters */
    int made_by_call;     /* T(a, b), not {a, b} */
    int vec3_is_ours;     /* a struct of three floats */
    int guarded;          /* #ifndef around all, since files include one another */
    int indents;          /* as Python does: no braces, no types */
    const char *function; /* before the type of a function */
    const char *unroll;   /* a line before loops with a constant end; NULL: none */
    const char *zero;     /* what a struct $ is before its members are set, where that must be said */
    const char *begin;    /* after the first comment */
    const char *constant; /* declares the whole number $NAME, which is $N */
    const char *array;    /* declares $N constant numbers $NAME, up to what opens them */
    const char *numbers;  /* the same for a table's numbers, if they are declared otherwise */
    const char *array_close;
    const char *pointer;        /* type of the pointer, for BUFFER_PARAMETER */
    const char *bound;          /* declares the buffer, for BUFFER_BOUND */
    const char *fetched;        /* number $1 of it */
    size_t most_embedded;       /* numbers; 0 for no limit */
    const char *why;            /* the limit */
    renamed types[5];           /* beside real, whole and mask */
    renamed calls[RENAMED_MAX]; /* beside those of most languages */
} language;

/* NULL if there is none of that name. */
const language *language_named(const char *name);

/* Ended by NULL; without Python, which is for tools/python. */
const char *const *language_names(void);

/* What a type or a call is in the language, or NULL. */
const char *language_type(const language *in, const char *name, size_t length);
const char *language_call(const language *in, const char *name, size_t length);

/* Whether a name of the kernel's is taken in one of the languages. */
int language_reserves(const char *name, size_t length);

#endif
