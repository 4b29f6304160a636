/* What the languages of `vndf export` have in common with the kernel's GLSL, and where they differ. */
#ifndef TOOLS_EXPORT_LANGUAGES_H
#define TOOLS_EXPORT_LANGUAGES_H

#include <stddef.h>

/* How a struct is declared. */
typedef enum struct_form {
    STRUCT_PLAIN,   /* struct name { float a, b; }; */
    STRUCT_TYPEDEF, /* typedef struct name { float a, b; } name; */
    STRUCT_FIELDS   /* struct name { a: f32, b: f32, } */
} struct_form;

/* How the struct T is made from a and b. */
typedef enum made_form {
    MADE_CALL,     /* T(a, b) */
    MADE_COMPOUND, /* (T){a, b} */
    MADE_BRACES,   /* T{a, b} */
    MADE_FUNCTION  /* T_of(a, b), a function of ours */
} made_form;

/* Where numbers are fetched from, unless they are embedded. */
typedef enum buffer_form {
    BUFFER_PARAMETER, /* a pointer, the first parameter of what fetches */
    BUFFER_BOUND      /* a buffer that the host binds */
} buffer_form;

typedef struct renamed {
    const char *from, *to;
} renamed;

enum { RENAMED_MAX = 12 };

/* Declarations are patterns: in them the kernel's names get their prefix, and words that begin with $ are filled in. */
typedef struct language {
    const char *name, *title;
    struct_form structs;
    made_form made;
    buffer_form buffer;
    int casts;             /* (int)(x), not int(x) */
    int typed_after;       /* x: f32, not float x */
    int vec3_is_ours;      /* a struct of three floats */
    const char *suffix;    /* of a number with a point */
    const char *function;  /* before the type of a function */
    const char *vec3_made; /* before the parenthesis that makes a vec3; NULL if that is a function of ours */
    const char *begin;     /* after the first comment */
    const char *constant;  /* declares the whole number $NAME, which is $N */
    int guarded;           /* #ifndef around all, since files include one another */
    const char *numbers;   /* declares $N embedded numbers, up to what opens them */
    const char *numbers_close;
    const char *pointer;        /* type of the pointer, for BUFFER_PARAMETER */
    const char *bound;          /* declares the buffer, for BUFFER_BOUND */
    const char *fetched;        /* number i of it */
    size_t most_embedded;       /* numbers; 0 for no limit */
    const char *why;            /* the limit */
    renamed names[RENAMED_MAX]; /* types, and functions of the language */
} language;

/* NULL if there is none of that name. */
const language *language_named(const char *name);

/* Ended by NULL. */
const char *const *language_names(void);

/* What the language calls a name of the kernel's. */
const char *language_word(const language *in, const char *name, size_t length);

#endif
