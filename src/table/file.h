/* The table on disk, version 3. All little-endian; strings without terminator; floats are IEEE single.
 *
 *     8 bytes  "VNDFtab\n"        u32 version      u32 size of the whole file
 *     f64 normalization           f64 scale
 *     u32 radial cells; above: cells, rows, knots; below: cells, rows, knots
 *     12 f32 certificate (order of vndf_certificate; quick has no place of its own: in a quick certificate
 *             weight_bounded stands as 2 for 1 and as -0 for 0)
 *     u32 n, n bytes source       u32 n, n bytes tool
 *     radial  f32 x[n+1], z[n+1], f0[n], f1[n], mu0[n], mu1[n]
 *     wedge above, then below: f32 q[cells+1], row_y[(rows+1)/2], aspect_p[rows], aspect_r[rows],
 *             mass[rows][cells], density[rows][cells+1], knot_y[], mass[], slope[], curve[]; rows is odd
 *     u32 CRC-32 of all bytes before it
 *
 * A reader checks the size, the checksum, every count against its limit, and every array against what the
 * sampler relies on: ascending knots that begin and end where they must, positive masses, cubics that
 * stay positive. */
#ifndef VNDF_TABLE_FILE_H
#define VNDF_TABLE_FILE_H

#include "table/table.h"

enum { VNDF_CERTIFICATE_FLOATS = 12, VNDF_CERTIFICATE_BYTES = 4 * VNDF_CERTIFICATE_FLOATS };

/* Writes the table into bytes[0..capacity); returns the size that the whole takes, whether it fitted. */
size_t vndf_table_encode(const vndf_distribution *table, unsigned char *bytes, size_t capacity);

#endif
