/* The file that `vndf export` writes: comments, constants, numbers, kernel. */
#ifndef TOOLS_EXPORT_DOCUMENT_H
#define TOOLS_EXPORT_DOCUMENT_H

#include <stdio.h>

#include "export/effects.h"
#include "export/translate.h"
#include "vndf.h"

enum { EXPORT_TABLES_MAX = 16, EXPORT_CALLS = 18 };

/* Kinds of distributions that a kernel draws from, as bits. */
enum { EXPORT_TABLE = 1, EXPORT_GGX = 2, EXPORT_BECKMANN = 4, EXPORT_ALL = 7 };

typedef struct exported_table {
    const vndf_distribution *distribution;
    const char *file;  /* as the user named it */
    char name[64];     /* its constant, without the prefix: "STUDENT_T_2_5" */
    size_t base, size; /* of its numbers */
} exported_table;

typedef struct export_document {
    translation as;
    exported_table table[EXPORT_TABLES_MAX];
    size_t tables, count; /* of tables; of all numbers */
    float *numbers;
    const char *notice; /* NULL or text */
    long lobes;
    int embeds;
    unsigned kinds;
    export_effects effects;
    const char *only[EXPORT_CALLS]; /* calls that are wanted, ended by NULL; all if there is none */
} export_document;

/* The calls that can be wanted, ended by NULL: "view" ... and those of a BSDF, "bsdf_sample" ... */
const char *const *document_calls(void);
int document_is_of_bsdf(const char *call);

/* Names the table's constant after its file; 0 if that leaves no name. */
int document_name_table(exported_table *table);

/* 0 if there is no memory. */
int document_write(const export_document *document, FILE *to);

#endif
