/* The table in memory: what a distribution is to the sampler.
 *
 * The unit problem (sampler/tabulated/theory.h derives it) needs three things, all for the distribution at a
 * canonical scale (median slope 1; `scale` brings it back):
 *
 * Radial cells. The slope length R = X/Z is cut by knots (X_j, Z_j), X + Z = 1, from (0, 1) to (1, 0);
 *   inside a cell X and Z are linear in xi in [0, 1]. The mass of normals at R, P22(R) R dR = f(xi) Z dxi
 *   per radian of azimuth, is held as a cubic f through the end values f0, f1 and the two moments
 *   mu0 = integral f (1-xi), mu1 = integral f xi. Any weight c Z + k X is linear in xi, W0 (1-xi) + W1 xi, so
 *   the weighted mass of a cell is W0 mu0 + W1 mu1: a sum of positive terms for whatever direction.
 * Sums over the cells, from the pole and from the tail (vndf_knots).
 * Wedges, one above the horizon (pole) and one below (tail): the azimuth density of the part of the
 *   circle that the horizon of wi cuts, as rows over the angle of incidence, all on the same cells of q.
 *
 * On disk are knots, cells, rows and the values of the area splines; prefix sums, windows, guides and coefficients
 * follow from them. */
#ifndef VNDF_TABLE_TABLE_H
#define VNDF_TABLE_TABLE_H

#include <stdint.h>

#include "core/inline.h"
#include "vndf.h"

enum {
    VNDF_RADIAL_CELLS_MAX = 8192, /* 2^VNDF_WINDOW_SHIFT */
    VNDF_WEDGE_ROWS_MAX = 4096,
    VNDF_WEDGE_CELLS_MAX = 64,
    VNDF_AREA_KNOTS_MAX = 4096,
    VNDF_BLOCK = 16,        /* radial knots are searched by blocks */
    VNDF_WINDOW = 8,        /* above the horizon by a window of so many (table/window.h), */
    VNDF_RANGES = 94,       /* one for each of this many ranges of u */
    VNDF_RANGES_END = 16,   /* the first and last so many are half octaves of u and of 1 - u */
    VNDF_RATIOS = 18,       /* and of |k|/c, for either sign of k */
    VNDF_WINDOW_SHIFT = 13, /* above a window's first cell, below VNDF_RADIAL_CELLS_MAX, stands its width */
    VNDF_PADDING = 8,       /* arrays that are counted through are padded to a multiple of this */
    VNDF_FEW = 16,          /* so many numbers are looked up in registers */
    VNDF_STEP = 8,          /* there, knots of radial cells are searched by so many */
    VNDF_AREA_ORDER = 6,    /* coefficients of a piece of an area's spline */
    VNDF_AREA_SPAN = 8,     /* doubles from piece to piece */
    VNDF_GUIDE_SHIFT = 16   /* bits of a guide's entry below the index of a knot */
};

/* A knot of the slope length. */
typedef struct vndf_knot {
    float x, z;
} vndf_knot;

/* Sums up to a knot and beyond it (vndf_knots). */
typedef struct vndf_pole_sums {
    float e, g;
} vndf_pole_sums;

typedef struct vndf_tail_sums {
    float s, t;
} vndf_tail_sums;

/* The knots and the sums up to them. For W = c z + k x at knot j,
 *   integral from the pole to knot j of f (c Z + k X) dxi = c e + W g, both terms >= 0 when c > 0 and W >= 0;
 *   integral from knot j to infinity                      = k s + W t, both terms >= 0 when k > 0 and W >= 0,
 * where e = F0 - F1 z/x, g = F1/x, s = T1 - T0 x/z, t = T0/z; F_n = integral P22 R^(n+1) dR up to the knot,
 * T_n the rest. Where k >= 0 the first is c F0 + k F1 without a difference.
 *
 * A search counts through all knots of a block or a window at once: above the horizon through `at` and `pole`
 * behind wi and through f0 and f1 in front, below it through `at` and `tail`. Pairs, so that a cell finds both its
 * knots in four successive floats. `count` includes padding: what lies beyond the last knot has sums that no
 * search reaches. Blocks have `at` and `tail` alone: they are for directions below the horizon. */
typedef struct vndf_knots {
    uint32_t count;
    vndf_knot *at;
    vndf_pole_sums *pole;
    vndf_tail_sums *tail;
    float *f0, *f1;
} vndf_knots;

/* f(xi) = f0 (1-xi) + f1 xi + xi (1-xi) (a + b xi); width = X1 Z0 - X0 Z1, so that dR = width/Z^2 dxi. Every sample in
 * front of wi reads these 32 bytes of its cell, half a line of the cache, beside the knots. before0 and before1 repeat
 * knots.f0 and knots.f1: they cost 8 bytes and save a load. */
typedef struct vndf_radial_cell {
    /* smooth: 1 if no law with c, k >= 0 changes much in the cell, 2 if that is so of its neighbours too and D does not
     * jump at its ends */
    float width, smooth;
    float f0, f1, mu0, mu1; /* four loads of four begin at width, at f0 and at mu0 */
    float before0, before1; /* sums up to the first knot (vndf_knots): F0, F1 */
} vndf_radial_cell;

/* a and b of a cell: samples behind wi read them. */
typedef struct vndf_radial_bend {
    float a, b;
} vndf_radial_bend;

/* Index of the last knot <= a value, found from the value's bits: an entry, then at most a few steps
 * (table/guide.h). */
typedef struct vndf_guide {
    uint32_t low, shift, last; /* bits of the least key; resolution; last entry */
    uint32_t drop, single;     /* of entries; whether one step is always enough */
    uint32_t *next;            /* bits of the knot after each, beyond every value where the last cell has begun */
    uint32_t *entry;           /* of a bucket: the last knot at or below it, and where in it the next is */
} vndf_guide;

/* Where a search above the horizon begins (table/window.h): for 2 VNDF_RATIOS ratios k/c, the second half for
 * k < 0, and VNDF_RANGES ranges of u; in tables of few cells 2^range_shift of these share a window. */
typedef struct vndf_windows {
    uint32_t range_shift, ranges; /* ranges: windows to a ratio */
    uint16_t *code;               /* and a half word, which lanes read */
} vndf_windows;

/* A piece of the spline of a wedge's mass (table/area_piece.h): 64 bytes side by side, which a view reads. */
typedef struct vndf_area_span {
    double coefficient[VNDF_AREA_ORDER], begin, per_width;
} vndf_area_span;

/* The same in float, as powers of y - begin: 32 bytes. */
typedef struct vndf_area_quick {
    float coefficient[VNDF_AREA_ORDER], begin, per_width;
} vndf_area_quick;

/* The three rows between two knots: where they begin, one over their width, and their aspects. 32 bytes, all
 * floats. After the last stands one that only begins. */
typedef struct vndf_row_span {
    float begin, per_width, p[3], r[3];
} vndf_row_span;

/* A cell of a row: its mass, and the density where it begins. The density where it ends stands in the next cell: four
 * successive floats hold all that a reader needs of a cell. After the last stands one that only begins. */
typedef struct vndf_row_cell {
    float mass, density;
} vndf_row_cell;

/* One side of the horizon. Coordinate y in [0, 1]: c/(s+c) above (pole), s/(s+|c|) below (tail); 0 where
 * the wedge has no mass. Rows of azimuth density in q (sampler/tabulated/azimuth.h) with aspect (p, r): a row at each
 * of the knots row_y, and one between two of them, which is the middle control point of a quadratic Bezier curve from
 * one to the other (it may differ from what is true there, its mixes do not). The wedge's mass divided by (s+|c|)
 * is a quintic spline on knots of its own (table/area_piece.h).
 *
 * Lanes read in registers what is few: then the same numbers stand in another order too, the pointers `few_...`
 * are not NULL (table/derive_lanes.c). Lanes do not use what they read beyond them. */
typedef struct vndf_wedge {
    uint32_t cell_count, row_count, knot_count; /* row_count is odd */
    uint32_t stride;                            /* floats from row to row in cdf: a multiple of VNDF_PADDING */
    float *q;                                   /* cell_count + 1, from 0 to 1 */
    float *row_y;            /* where rows 0, 2, 4, ... stand, then 2 where few are looked up: row_span's begin */
    vndf_row_span *row_span; /* (row_count + 1)/2 */
    float *cdf;              /* mass before a cell, each row's mass being 1: searches count through it */
    vndf_row_cell *row_cell; /* cell_count + 1 to a row */
    float *knot_y; /* knot_count, as many as the next three: the file, its checks and the survey read them */
    float *mass, *slope, *curve; /* curve is the second derivative */
    vndf_area_span *piece;       /* made of them, knot_count - 1: areas and densities read it, in double */
    vndf_area_quick *quick;      /* in float: single draws read it; NULL below the horizon, where nothing does */
    uint32_t few_pitch;          /* numbers from member to member of the next two: VNDF_FEW, or half of it */
    float *few;                  /* members of quick: lanes read them if there are no more than VNDF_FEW pieces */
    double *few_exact;           /* members of piece: lanes of doubles read them if pieces are so few */
    float *
        few_aspects; /* if knots of rows are so few, p of rows 0, 2, 4, ..., then of the rows between, then r likewise,
                         * then per_width of spans: lanes read them */
    float *few_cdf; /* likewise cdf of all rows, cell by cell from the second on: lanes search through it; NULL
                         * below the horizon, where none draw */
    vndf_guide row_guide, knot_guide;
} vndf_wedge;

/* The aspect of a row, where it is written: what a span repeats of the next follows (vndf_table_derive). */
static inline float *vndf_aspect_p(const vndf_wedge *wedge, size_t row)
{
    return &wedge->row_span[row / 2].p[row % 2];
}

static inline float *vndf_aspect_r(const vndf_wedge *wedge, size_t row)
{
    return &wedge->row_span[row / 2].r[row % 2];
}

/* The cells of a row. */
static inline vndf_row_cell *vndf_row_cells(const vndf_wedge *wedge, size_t row)
{
    return wedge->row_cell + row * (wedge->cell_count + 1);
}

/* What a distribution is. sampler/law.h answers for each kind; nobody else asks. */
typedef enum vndf_kind { VNDF_KIND_TABLE, VNDF_KIND_GGX, VNDF_KIND_BECKMANN } vndf_kind;

struct vndf_distribution {
    vndf_kind kind;
    uint32_t radial_count;    /* cells */
    float f0_total, f1_total; /* integrals P22 R dR (= 1/2 pi) and P22 R^2 dR of the table */
    float lift;               /* draws multiply their laws by this power of two (math/rational_cell.h) */
    vndf_knots knots;         /* radial_count + 1 and padding: all searches of cells read them */
    vndf_knots blocks;        /* the first knot of each block, padded too: draws below the horizon read them */
    vndf_radial_cell *cells;  /* radial_count: draws and densities of all kinds read them (tabulated/radial.h) */
    vndf_radial_bend *bends;  /* radial_count: the cell at the cut is drawn with them (radial_law_cut) */
    void *block;              /* of block_bytes: all arrays but those of guides */
    size_t block_bytes;
    /* knots.f0 of every eighth knot from 1 on, then from 2 on, ... from 7 on, then knots.f1 likewise: with them lanes
     * search in front, if the cells are no more than VNDF_STEP VNDF_FEW; else NULL */
    float *few_sums;
    vndf_windows windows;
    vndf_guide slope_guide; /* of X/Z: finds the cell of the cut, and that of a given normal */
    vndf_wedge above, below;
    double normalization; /* the source was multiplied by it */
    double scale;         /* canonical slope 1 is this slope of the source */
    vndf_certificate certificate;
    const char *source, *tool; /* owned by tables */
    size_t bytes;              /* of the file */
    /* The largest change of log P22 over the slope length in units of `scale`, and over an e-fold of it, within cells
     * that hold more than 1e-8 of the mass; from this slope on, as P22 may grow without bound towards 0. */
    double steepness, fold_steepness, steep_from;
};

/* How many times VNDF_STEP cells there are, rounded up. */
VNDF_INLINE uint32_t vndf_step_count(const vndf_distribution *d)
{
    return (d->radial_count + VNDF_STEP - 1) / VNDF_STEP;
}

/* Whether the members above are filled: what is loaded, saved and freed. */
VNDF_INLINE int vndf_is_table(const vndf_distribution *d)
{
    return d->kind == VNDF_KIND_TABLE;
}

VNDF_INLINE void vndf_make_table(vndf_distribution *d)
{
    d->kind = VNDF_KIND_TABLE;
}

#endif
