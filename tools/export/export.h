/* The one file that `vndf export` writes: comments, tables, and the kernel of the library in another language. */
#pragma once

#include <stdio.h>

#include "vndf_bsdf.h"

/* ---- languages ---- */

enum {
    LANGUAGE_APART = 1,   /* one variable to a statement; and no preprocessor */
    LANGUAGE_INDENTS = 2, /* as Python does: no braces, no types */
};

/* Where a language differs from the others. `words` says "FORM: own; " of forms and types and "CALL = own; " of calls.
 * Of calls $1, $2 and $3 are arguments. In forms $T is a type, $V a variable's name, $N a number, $I what stands in
 * braces, $A and $B where a loop begins and ends, $; a semicolon and a blank; of a declaration $D is the name, $P are
 * parameters, $S statements, $M members. vndf_ stands for the prefix. */
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

/* What a name of `size` characters is in the language, up to the next "; ", or NULL. `means`: ": " or " = ". */
const char *language_word(const language *in, const char *name, int size, const char *means);

/* Names that are taken in one of the languages, between spaces. */
extern const char language_reserved[];

/* ---- the file ---- */

enum { EXPORT_TABLES_MAX = 16, PREFIX_MAX = 32 };

/* A table, or the tables of a family, whose numbers stand behind its own: how many, whether it is linear in 1/p, then
 * of each its parameter p and where its numbers begin. */
typedef struct exported_table {
    vndf_distribution *distribution; /* NULL for a family */
    vndf_family *family;
    const char *file;  /* as the user named it */
    char name[64];     /* its constant, without the prefix: "STUDENT_T_2_5" */
    size_t base, size; /* of its numbers */
} exported_table;

typedef struct export_document {
    const language *to;
    char lower[PREFIX_MAX + 2], upper[PREFIX_MAX + 2]; /* what stands for vndf_ and VNDF_ */
    int embeds; /* numbers are an array; else they are bound, or pointed to */
    exported_table table[EXPORT_TABLES_MAX];
    size_t tables, count; /* of tables; of all numbers */
    float *numbers;
    long lobes;
    int scatters; /* there is a BSDF, of these effects */
    vndf_effects effects;
    const char *only; /* names that are wanted, between blanks; NULL: the calls of normals, or of the BSDF */
} export_document;

/* Texts that the build embeds. */
typedef struct embedded_text {
    const char *name;         /* of the file */
    const char *const *lines; /* ended by NULL, without line breaks */
} embedded_text;

/* Ended by a name NULL: the kernel, in the order in which it is read; the page of `vndf explore`. */
extern const embedded_text kernel_text[], page_texts[];

/* Sets the prefix, a name in lower case; 0 if it is none, or if names of it would be reserved: GLSL keeps those with
 * two underscores in a row and those that begin with gl_. */
int document_prefix(export_document *document, const char *name);

/* Adds a table or, where `distribution` is NULL, a family, with its numbers; 0 if its constant, named after the file,
 * is none or another one's, -1 if there is no memory. */
int document_add(export_document *document, const char *file, vndf_distribution *distribution,
                 vndf_family *family);

/* Writes the file; `more`, which may be NULL, is text in the kernel's part of C that goes behind the kernel. 0 if there
 * is no memory. */
int document_write(const export_document *document, FILE *to, const char *more);

/* ---- its parts ---- */

/* Writes `length` characters, with the prefix for every vndf_ and VNDF_. */
void put_prefixed(const export_document *as, FILE *to, const char *from, size_t length);

/* Writes of the text what `wanted` names, between blanks, or what begins with such a name and a '_', and all that this
 * needs; 0 if there is no memory.
 *
 * It reads the part of C in which src/kernel is written, without directives. Of files there are comments,
 * `typedef struct n {...} n;`, `enum { A = 1 };`, `static const float n[1] = {...};` and `KERNEL type name(...) {...}`,
 * or CALL.
 * Of statements there are declarations of types of one word, assignments, to no parameter, if, else,
 * `for (int i = A; i < B; i++)` and return; structs are made as `n v = {a, b};` with every member. Where an if has
 * masks they are in any(mask), and a name alone is a whole number. An if whose condition, or the first part of one with
 * &&, is made of constants is folded. All else stays as it is, word by word, with the
 * blanks and comments between them, but for names, numbers and calls. The build translates the one text there is, so
 * its shape is not judged. */
int translate(const export_document *as, const char *source, const char *wanted, FILE *to);
