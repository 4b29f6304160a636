/* Distributions along one parameter (vndf.h, families), in memory and on disk. The file, version 1, all little-endian:
 *
 *     8 bytes  "VNDFfam\n"        u32 version      u32 size of the whole file
 *     u32 count                   u32 1 if mixtures are linear in 1/p, else 0
 *     f32 grazing distance        u32 n, n bytes source       u32 n, n bytes tool
 *     f32 parameter[count], ascending                         f32 distance[count - 1], between knots
 *     count times: u32 n, n bytes, a whole table (table/file.c)
 *     u32 CRC-32 of all bytes before it */
#ifndef VNDF_TABLE_FAMILY_FAMILY_H
#define VNDF_TABLE_FAMILY_FAMILY_H

#include "core/cursor.h"
#include "core/inline.h"
#include "table/table.h"

struct vndf_family {
    size_t count;
    int reciprocal;
    int owns; /* the distributions, which are tables then */
    float parameter[VNDF_LIMIT_FAMILY_KNOTS];
    float distance[VNDF_LIMIT_FAMILY_KNOTS]; /* to the next knot; zeros where nothing was measured */
    const vndf_distribution *distribution[VNDF_LIMIT_FAMILY_KNOTS];
    float grazing;
    char *source, *tool; /* owned, or NULL */
    size_t bytes;        /* of the file */
};

/* The weight t of the knot b at a parameter p between the knots a and b. */
VNDF_INLINE double vndf_family_weight(double a, double b, double p, int reciprocal)
{
    double share = (p - a) / (b - a);
    return reciprocal ? share * (b / p) : share;
}

/* Of 1 to VNDF_LIMIT_FAMILY_KNOTS knots, with zeros as parameters and distributions; 0 knots are no family. NULL if
 * there is no memory. */
vndf_family *vndf_family_allocate(size_t count);

/* Writes the file of a family that owns its tables; its bytes. */
void vndf_family_write(const vndf_family *family, vndf_writer *writer);
size_t vndf_family_size(const vndf_family *family);

#endif
