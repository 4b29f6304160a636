/* The table on disk, version 4. All little-endian; strings without terminator; floats are IEEE single.
 *
 *     8 bytes  "VNDFtab\n"        u32 version      u32 size of the whole file
 *     f64 normalization           f64 scale
 *     u32 cells N, moments, squarings
 *     12 f32 certificate (order of vndf_certificate)
 *     u32 n, n bytes source       u32 n, n bytes tool
 *     f32[N + 1] each: knot, g0, g1, m0, m1, m2, m4 (only if moments is 4), b0, b1, area, slope
 *     u32 CRC-32 of all bytes before it
 *
 * A reader checks the size, the checksum, every count against its limit, and every array against what the sampler
 * relies on: ascending knots, positive masses that add up to 1, finite densities. */
#ifndef VNDF_TABLE_FILE_H
#define VNDF_TABLE_FILE_H

#include "core/cursor.h"
#include "table/table.h"

enum { VNDF_CERTIFICATE_FLOATS = 12 };

/* Writes the file of a table, from its draft or as it was loaded. */
void vndf_table_write(const vndf_table_draft *draft, vndf_writer *writer);
void vndf_table_write_loaded(const vndf_distribution *table, vndf_writer *writer);

/* The bytes of such a file. */
size_t vndf_table_size(size_t knots, unsigned moments, const char *source, const char *tool);

/* Fills the numbers of a table from its draft. 0 where there is no memory, or where *why becomes what is wrong with the
 * draft. */
int vndf_table_fill(vndf_distribution *table, const vndf_table_draft *draft, const char **why);

/* Bytes of memory that it takes, all allocations together. */
size_t vndf_table_memory(const vndf_distribution *table);

/* The rho from which on the law of k~ begins at knot i. */
double vndf_table_turn(const vndf_table_draft *draft, size_t i);

#endif
