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
 * In memory they stand in one array of floats, the same that GPUs read (vndf_numbers): a head, then for each knot
 * VNDF_GROUPS rows of four numbers, side by side since a sample reads nearly all of them. */
#ifndef VNDF_TABLE_TABLE_H
#define VNDF_TABLE_TABLE_H

#include <stdint.h>

#include "core/cursor.h"
#include "core/inline.h"
#include "vndf.h"

enum {
    VNDF_CELLS_MAX = 4095,  /* N */
    VNDF_SQUARINGS_MAX = 5, /* tails of P22 down to r^-3.04 */
    VNDF_HEAD = 8           /* numbers before the rows: N, moments, squarings, scale, highest, steps, 0, 0 */
};

/* Where the law of k~ begins is looked up by rho, rounded to the middle of an eighth of an octave from 2^-13 to 2^15.
 * Eighth i is that of floats whose highest bits are VNDF_RHO_FIRST + i. */
enum { VNDF_RHO_PARTS = 224, VNDF_RHO_FIRST = (127 - 13) * 8 };

/* The rows of a knot, 0 to N. */
enum {
    VNDF_KNOT, /* R, z, h, and the turn: the (rounded) rho from which on the law of k~ begins at this knot */
    VNDF_LAW,  /* densities of f/R per xi, over z^2, at the left and the right end, in the last cell its limit for
                  xi -> 1; moments 0 and 1 */
    VNDF_MORE, /* moment 2; mean of R^-3 in f/R; shares of the two terms below the horizon at this knot */
    VNDF_TAIL, /* integrals beyond the knot of f R, f, f/R and f/R^4; at knot 0 the last three are those of knot 1 */
    VNDF_LOW, /* integrals beyond the knot of t f/R and t^2 f/R; area over c + s, and its derivative by x */
    VNDF_GROUPS,
    VNDF_STRIDE = 4 * VNDF_GROUPS /* from knot to knot */
};

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

/* The four numbers of a knot in a row. */
VNDF_INLINE float *vndf_table_row(const vndf_distribution *d, int row, size_t knot)
{
    return d->numbers + VNDF_HEAD + VNDF_STRIDE * knot + 4 * (size_t)row;
}

/* A table whose numbers are zeros. A builder or a reader puts scale, normalization and texts, and of each knot R, all
 * of VNDF_LAW and VNDF_MORE, and the areas of VNDF_LOW. NULL if there is no memory. */
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
