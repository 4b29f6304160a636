/* Tensor files, as the measurements of EPFL's realistic graphics lab come in: "tensor_file\0", the version 1.0 as two
 * bytes, the number of fields (u32), then for each the length of its name (u16), the name, the number of dimensions
 * (u16), a type (u8), where its numbers begin (u64) and the length of each dimension (u64), the slowest first. All
 * numbers have the least byte first. */
#ifndef TOOLS_MEASURED_RGL_TENSOR_H
#define TOOLS_MEASURED_RGL_TENSOR_H

#include <stdint.h>
#include <stdio.h>

#include "measured/refusal.h"

enum { TENSOR_FIELDS = 32, TENSOR_NAME = 32, TENSOR_DIMENSIONS = 6 };
typedef enum tensor_type { TENSOR_U8 = 1, TENSOR_F32 = 10 } tensor_type; /* those that are read and written */

typedef struct tensor_field {
    char name[TENSOR_NAME]; /* cut */
    int type, dimensions;
    size_t shape[TENSOR_DIMENSIONS];
    size_t count;              /* of numbers */
    const unsigned char *data; /* of the bytes that were read; NULL for types that are not */
} tensor_field;

typedef struct tensor_file {
    tensor_field field[TENSOR_FIELDS];
    size_t count;
} tensor_file;

/* The fields of a file, valid while its bytes are. Returns 1, or 0 and the reason; untrusted bytes are safe. */
int tensor_read(tensor_file *made, const char *name, const unsigned char *bytes, size_t size, refusal *why);

/* The floats of a field with so many dimensions; NULL and the reason if there is none. */
const tensor_field *tensor_floats(const tensor_file *file, const char *field, int dimensions, const char *name,
                                  refusal *why);

/* Or NULL. */
const tensor_field *tensor_find(const tensor_file *file, const char *field);

double tensor_at(const tensor_field *field, size_t i);

/* ---- writing ---- */

/* A field with its numbers: floats, or bytes for TENSOR_U8. */
typedef struct tensor_written {
    const char *name;
    tensor_type type;
    int dimensions;
    size_t shape[TENSOR_DIMENSIONS];
    const void *data;
} tensor_written;

/* Writes to an open file; 0 if that fails. */
int tensor_write(FILE *file, const tensor_written *fields, size_t count);

#endif
