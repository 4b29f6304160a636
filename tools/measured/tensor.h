/* Tensor files, as the measurements of EPFL's realistic graphics lab come in: "tensor_file\0", the version 1.0 as two
 * bytes, the number of fields (u32), then for each the length of its name (u16), the name, the number of dimensions
 * (u16), a type (u8), where its numbers begin (u64) and the length of each dimension (u64), the slowest first. All
 * numbers have the least byte first. */
#ifndef TOOLS_MEASURED_TENSOR_H
#define TOOLS_MEASURED_TENSOR_H

#include "measured/data.h"

enum { TENSOR_DIMENSIONS = 6 };
typedef enum tensor_type { TENSOR_U8 = 1, TENSOR_F32 = 10 } tensor_type; /* those that are read and written */

/* A field of a file: floats, or bytes for TENSOR_U8. */
typedef struct tensor {
    const char *name;
    tensor_type type;
    int dimensions;
    size_t shape[TENSOR_DIMENSIONS];
    const void *data;
} tensor;

size_t tensor_count(const tensor *of);

/* The field of this name, type and number of dimensions; its data are bytes of the file. */
int tensor_find(data_file *file, const char *name, tensor_type type, int dimensions, tensor *found);

/* Number i of a field of floats that was read. */
double tensor_at(const tensor *of, size_t i);

/* Writes to an open file; 0 if that fails. */
int tensor_write(FILE *file, const tensor *fields, size_t count);

#endif
