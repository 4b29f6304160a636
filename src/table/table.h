/* A distribution of normals.
 *
 * Slopes are in units of the median, R; f(R) = 2 pi R P22(R) has the mass 1. Knots R_0 = 0 < R_1 < ... < R_N cut the
 * slopes into cells; the last, cell N, goes on to infinity. Inside a cell the place xi in [0, 1] is linear in
 * x = R/(1 + R): x = x_i + h xi, and z = 1 - x = z_i - h xi. In the last cell z = z_N (1 - xi)^(2^squarings), so that
 * heavy tails are smooth in xi, and h is the derivative there at xi = 0.
 *
 * A cell knows the moments of f/R, integral t^k f/R dR with t = R - R_i, and the density of f/R per xi at its ends. All
 * that is drawn follows from these numbers (kernel/law.h).
 *
 * In memory they stand in one array of floats, the same that GPUs read, which layout.h draws. */
#ifndef VNDF_TABLE_TABLE_H
#define VNDF_TABLE_TABLE_H

#include <stdint.h>

#include "core/cursor.h"
#include "core/inline.h"
#include "table/layout.h"
#include "vndf.h"

enum { VNDF_CELLS_MAX = 4095, VNDF_SQUARINGS_MAX = 5 }; /* N; tails of P22 down to r^-3.04 */

/* The numbers of a knot, as layout.h draws them. `turn` is the (rounded) rho from which on the law of k~ begins at it;
 * `right` of the last cell is the limit for xi -> 1. */
typedef struct vndf_knot_numbers {
    float r, z, width, turn;
    float left, right, m0, m1;
    float m2, cube, b0, b1;
    float along, all, over, over4;
    float t1, t2, area, slope;
} vndf_knot_numbers;

_Static_assert(sizeof(vndf_knot_numbers) == VNDF_STRIDE * sizeof(float), "the rows of layout.h");

/* Knots and the sums beyond them, each in a column, for searches that compare four numbers at once: R, then the four
 * sums of VNDF_TAIL. A search counts pivots, every eighth knot from the eighth on, then the knots of one block of
 * eight. Padding fails every comparison of a search. */
enum { VNDF_COLUMNS = 5, VNDF_COLUMN_STEP = 8 };

/* What lanes read, laid out when a table is loaded. Entries 2^l to 2^(l+1) - 1 of `level` are the knots that step l of
 * a search by halves compares with, in ascending order: R^2, R, and sums beyond the knot. A knot that is not there
 * fails all comparisons. Searches take VNDF_STEPS_LEAST steps at least. */
enum { VNDF_AT_KNOT, VNDF_AT_R, VNDF_AT_T1, VNDF_AT_T0, VNDF_AT_TQ, VNDF_AT_T4, VNDF_AT_N1, VNDF_AT_N2 };
enum { VNDF_SEARCHED = VNDF_AT_N2 + 1, VNDF_LEVELS = 7, VNDF_STEPS_LEAST = 4, VNDF_COPIED = 128 };

typedef struct vndf_layout {
    float level[VNDF_SEARCHED][1 << VNDF_LEVELS];
    int32_t first[(VNDF_RHO_PARTS + 63) / 64 * 64]; /* where the law of k~ begins, for each part of rho */
    float column[VNDF_GROUPS][4][VNDF_COPIED];      /* of tables of fewer cells; beyond them the last knot's */
} vndf_layout;

typedef enum vndf_kind { VNDF_KIND_TABLE, VNDF_KIND_GGX, VNDF_KIND_BECKMANN } vndf_kind;

struct vndf_distribution {
    vndf_kind kind;
    int32_t cells, moments, squarings; /* N; terms of k~: 2, 3, 4; see above. 0 for closed forms, as all below */
    int32_t highest, steps;            /* the highest power of two <= cells, 2^(steps - 1) */
    float unit;                        /* scale, rounded: 1 for closed forms */
    float *numbers;
    size_t number_count;
    float *columns;         /* slopes and sums beyond them once more, each in a column (above) */
    int32_t column, pivots; /* floats of one, up to the end of its last block; its pivots, four by four */
    vndf_layout *layout;    /* at a multiple of 64 bytes in `room` */
    void *room;
    double normalization; /* the source was multiplied by it */
    double scale;         /* canonical slope 1 is this slope of the source */
    vndf_certificate certificate;
    const char *source, *tool, *notes; /* owned by tables */
    size_t bytes;                      /* of the file */
};

VNDF_INLINE int vndf_is_table(const vndf_distribution *d)
{
    return d->kind == VNDF_KIND_TABLE;
}

/* Knot i, 0 to N. */
VNDF_INLINE vndf_knot_numbers *vndf_knot_at(const vndf_distribution *d, size_t i)
{
    return (vndf_knot_numbers *)(void *)(d->numbers + VNDF_HEAD + VNDF_STRIDE * i);
}

/* A table whose numbers are zeros. A builder or a reader puts scale, normalization and texts, and of each knot R, both
 * densities, all moments, shares, area and slope. NULL if there is no memory. */
vndf_distribution *vndf_table_allocate(unsigned cells, unsigned moments, unsigned squarings);

/* Fills all other numbers; returns what is wrong with those that were put, NULL if nothing is. */
const char *vndf_table_fill(vndf_distribution *table);

/* Bytes of memory that it takes, all allocations together; bytes of a file. */
size_t vndf_table_memory(const vndf_distribution *table);
size_t vndf_table_size(size_t knots, unsigned moments, const char *source, const char *tool, const char *notes);

/* What is wrong with notes (vndf_source_note), NULL if nothing is. */
const char *vndf_notes_invalid(const char *notes);

/* Writes the file (file.c). */
void vndf_table_write(const vndf_distribution *table, vndf_writer *writer);

enum { VNDF_CERTIFICATE_FLOATS = 14 };

#endif
