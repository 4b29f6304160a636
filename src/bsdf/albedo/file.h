/* The table of albedos on disk, version 1. All little-endian; texts without terminator; floats are IEEE single.
 *
 *     8 bytes  "VNDFalb\n"        u32 version      u32 size of the whole file
 *     f32 eta      f32 scale      u32 columns      u32 rows
 *     8 f32: error, error_cosine, error_alpha, error_usual, split_error, split_usual, average_error, quadrature_error
 *     u32 n, n bytes source       u32 n, n bytes tool
 *     f32 coefficients of the grid [layers][rows + 2][columns + 2], layers 1 for eta 0, else 4
 *     f32 coefficients of averages [layers][4 (rows - 1) + 3]
 *     u32 CRC-32 of all bytes before it
 *
 * A reader checks the size, the checksum, the counts, and that every number is in its range; look-ups clamp what they
 * find, so any coefficients are safe. */
#ifndef VNDF_BSDF_ALBEDO_FILE_H
#define VNDF_BSDF_ALBEDO_FILE_H

#include "bsdf/albedo/albedo.h"

/* Writes the table into bytes[0..capacity); returns the size that the whole takes, whether it fitted. */
size_t vndf_albedo_encode(const vndf_albedo *albedo, unsigned char *bytes, size_t capacity);

/* Whether eta is 0 or one that can be built, and scale a median slope. */
int vndf_albedo_eta_valid(float eta);
int vndf_albedo_scale_valid(float scale);

#endif
