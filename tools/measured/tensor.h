/* Tensor files, as the measurements of EPFL's realistic graphics lab come in: "tensor_file\0", the version 1.0 as two
 * bytes, the number of fields (u32), then for each the length of its name (u16), the name, the number of dimensions
 * (u16), a type (u8), where its numbers begin (u64) and the length of each dimension (u64), the slowest first. All
 * numbers have the least byte first. */
#ifndef TOOLS_MEASURED_TENSOR_H
#define TOOLS_MEASURED_TENSOR_H

#include "measured/measured.h"

enum { TENSOR_DIMENSIONS = 6 };
typedef enum tensor_type { TENSOR_U8 = 1, TENSOR_F32 = 10 } tensor_type; /* those that are written */

/* A field of a file: floats, or bytes for TENSOR_U8. */
typedef struct tensor {
    const char *name;
    tensor_type type;
    int dimensions;
    size_t shape[TENSOR_DIMENSIONS];
    const void *data;
} tensor;

size_t tensor_count(const tensor *of);

/* The field of floats of this name and number of dimensions; its data are bytes of the file. */
int tensor_find(data_file *file, const char *name, int dimensions, tensor *found);

/* Number i of a field of floats that was read. */
double tensor_at(const tensor *of, size_t i);

/* Writes to an open file; 0 if that fails. */
int tensor_write(FILE *file, const tensor *fields, size_t count);

/* ---- grids --------------------------------------------------------------------------------------- */

/* Functions on grids over the unit square, at i/(width - 1), j/(height - 1), bilinear between these. */

/* The map from the unit square to a density on it, as Mitsuba and pbrt read .bsdf files: first y by the sums of rows,
 * then x along the mixture of two rows. */
typedef struct warp {
    int width, height;
    const double *density; /* height rows of width; the caller's, >= 0 */
    double *along;         /* owned: the integral of each row up to each point, in units of a cell */
    double *up;            /* behind it: the integral of the row sums up to each row */
} warp;

/* 0 if there is no memory, or the density is 0 everywhere. Both sides are 2 at least. */
int warp_make(warp *made, const double *density, int width, int height);
void warp_free(warp *freed);

/* Where the uniform numbers s go. */
void warp_sample(const warp *of, double s_x, double s_y, double *x, double *y);

enum { FIT_SIDE_MAX = 64 };

/* The function on a grid of side^2 numbers that is near `value` in the middles of points x points parts of each cell,
 * ((side - 1) points)^2 numbers. The first step gives each point of the grid the mean of the parts around it, weighed
 * by its hat; more steps add the means of what is left, which comes to least squares in the limit. After any step the
 * grid has the integral of `value`. Parts where is_known (NULL: everywhere) is 0 do not count: where a function ends,
 * interpolation between points would halve it in the cells of its end; here it goes on beyond as it likes. */
void grid_fit(const float *value, const float *is_known, int side, int points, int steps, double *grid);

#endif
