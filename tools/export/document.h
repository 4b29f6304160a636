/* The file that `vndf export` writes: comments, constants, numbers, kernel. */
#ifndef TOOLS_EXPORT_DOCUMENT_H
#define TOOLS_EXPORT_DOCUMENT_H

#include <stdio.h>

#include "export/translate.h"
#include "vndf_bsdf.h"

enum { EXPORT_TABLES_MAX = 16 };

/* Kinds of distributions that a kernel draws from, as bits. */
enum { EXPORT_TABLE = 1, EXPORT_GGX = 2, EXPORT_BECKMANN = 4, EXPORT_ALL = 7 };

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
    translation as;
    exported_table table[EXPORT_TABLES_MAX];
    size_t tables, count; /* of tables; of all numbers */
    float *numbers;
    long lobes;
    unsigned kinds;
    int scatters; /* there is a BSDF, of these effects */
    vndf_effects effects;
    const char *only; /* names that are wanted, between blanks; NULL: the calls of normals, or of the BSDF */
    int bare;         /* the kernel without calls and constants, for Dr.Jit */
} export_document;

/* Texts that the build embeds. */
typedef struct embedded_text {
    const char *name;         /* of the file */
    const char *const *lines; /* ended by NULL, without line breaks */
} embedded_text;

/* Ended by a name NULL: the kernel, in the order in which it is read; the page of `vndf explore`. */
extern const embedded_text kernel_text[], page_texts[];

/* Adds a table or, where `distribution` is NULL, a family, with its numbers; 0 if its constant, named after the file,
 * is none or another one's, -1 if there is no memory. */
int document_add(export_document *document, const char *file, vndf_distribution *distribution,
                 vndf_family *family);

/* Writes the file; `more`, which may be NULL, is text in the kernel's part of C that goes behind the kernel. 0 if there
 * is no memory. */
int document_write(const export_document *document, FILE *to, const char *more);

#endif
