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
    VNDF_AREA_ORDER = 6,    /* coefficients of a piece of an area's spline */
    VNDF_AREA_SPAN = 8,     /* doubles from piece to piece */
    VNDF_GUIDE_SHIFT = 19   /* bits of a guide's entry below the index of a knot */
};

/* The knots and the sums up to them. For W = c z + k x at knot j,
 *   integral from the pole to knot j of f (c Z + k X) dxi = c e + W g, both terms >= 0 when c > 0 and W >= 0;
 *   integral from knot j to infinity                      = k s + W t, both terms >= 0 when k > 0 and W >= 0,
 * where e = F0 - F1 z/x, g = F1/x, s = T1 - T0 x/z, t = T0/z; F_n = integral P22 R^(n+1) dR up to the knot,
 * T_n the rest. Where k >= 0 the first is c F0 + k F1 without a difference. Arrays, so that a search can count
 * through all knots of a block or a window at once; `count` includes padding: what lies beyond the last knot has
 * sums that no search reaches. Of blocks x, z, s and t are filled: they are for directions below the horizon. */
typedef struct vndf_knots {
    uint32_t count;
    float *x, *z, *e, *g, *s, *t, *f0, *f1;
} vndf_knots;

/* f(xi) = f0 (1-xi) + f1 xi + xi (1-xi) (a + b xi); width = X1 Z0 - X0 Z1, so that dR = width/Z^2 dxi. Beside it
 * what the sampler wants of its knots: 64 bytes, a line of the cache, all floats. */
typedef struct vndf_radial_cell {
    float f0, f1, mu0, mu1;
    float x0, x1, z0, z1;   /* the knots */
    float before0, before1; /* sums up to the first (vndf_knots): F0, F1 */
    float width, calm; /* calm: 1 if no law with c, k >= 0 changes much in it (sampler/tabulated/radial.h), 2 if
                                  * those beside it are calm too and D does not jump at its ends */
    float a, b, e, g;  /* e, g: sums once more */
} vndf_radial_cell;

/* Index of the last knot <= a value, found from the value's bits: first[...] then at most a few steps
 * (table/guide.h). */
typedef struct vndf_guide {
    uint32_t low, shift, last; /* bits of the least key; resolution; last entry */
    uint32_t drop, single;     /* of entries; whether one step is always enough */
    uint16_t *first;
    uint32_t *next;  /* bits of the knot after each, beyond every value where the last cell has begun */
    uint32_t *entry; /* first, and where in its bucket the next is: for lanes of doubles */
} vndf_guide;

/* A piece of the spline of a wedge's mass (table/area_piece.h), as views want it: 64 bytes side by side. */
typedef struct vndf_area_span {
    double coefficient[VNDF_AREA_ORDER], begin, per_width;
} vndf_area_span;

/* The same in float: 32 bytes. */
typedef struct vndf_area_quick {
    float coefficient[VNDF_AREA_ORDER], begin, per_width;
} vndf_area_quick;

/* What the sampler wants of the three rows between two knots: where they begin, one over their width, and their
 * aspects. 32 bytes, all floats. */
typedef struct vndf_row_span {
    float begin, per_width, p[3], r[3];
} vndf_row_span;

/* A cell of a row as the sampler wants it: 16 bytes. */
typedef struct vndf_row_cell {
    float before, mass, begin, end; /* mass before the cell and in it; density at its ends */
} vndf_row_cell;

/* One side of the horizon. Coordinate y in [0, 1]: c/(s+c) above (pole), s/(s+|c|) below (tail); 0 where
 * the wedge has no mass. Rows of azimuth density in q (sampler/tabulated/azimuth.h) with aspect (p, r): a row at each of the
 * knots row_y, and one between two of them, which is the middle control point of a quadratic Bezier curve from
 * one to the other (it may differ from what is true there, its mixes do not). The wedge's mass divided by (s+|c|)
 * is a quintic spline on knots of its own (table/area_piece.h). */
typedef struct vndf_wedge {
    uint32_t cell_count, row_count, knot_count; /* row_count is odd */
    float *q;                                   /* cell_count + 1, from 0 to 1 */
    float *row_y;                               /* (row_count + 1)/2: where rows 0, 2, 4, ... stand */
    float *aspect_p, *aspect_r;                 /* row_count */
    uint32_t stride;                      /* floats from row to row in the next two: a multiple of VNDF_PADDING */
    float *cdf, *cell_mass;               /* mass before a cell and in it; each row's mass is 1 */
    float *density;                       /* at the ends of the cells, cell_count + 1 to a row */
    float *knot_y, *mass, *slope, *curve; /* knot_count; curve is the second derivative */
    vndf_area_span *piece;                /* the spline once more, knot_count - 1 */
    vndf_area_quick *quick;               /* and once more */
    float few[VNDF_AREA_ORDER + 2][VNDF_FEW];   /* members of quick, for lanes, if there are so few pieces */
    double few_exact[VNDF_AREA_SPAN][VNDF_FEW]; /* members of piece likewise */
    float few_y[VNDF_FEW + 1];                  /* row_y, if there are so few */
    float few_aspects[4][VNDF_FEW + 1];         /* p and then r of rows 0, 2, 4, ..., then of those between */
    vndf_row_span *row_span;                    /* row_y and aspects once more, (row_count - 1)/2 */
    vndf_row_cell *row_cell; /* cdf, cell_mass and density once more; from row to row `stride` */
    vndf_guide row_guide, knot_guide;
} vndf_wedge;

typedef enum vndf_kind { VNDF_KIND_TABLE, VNDF_KIND_GGX, VNDF_KIND_BECKMANN } vndf_kind;

struct vndf_distribution {
    vndf_kind kind;
    uint32_t radial_count;    /* cells */
    float f0_total, f1_total; /* integrals P22 R dR (= 1/2 pi) and P22 R^2 dR of the table */
    vndf_knots knots;         /* radial_count + 1 and padding */
    vndf_knots blocks;        /* the first knot of each block, padded likewise */
    float *slope;             /* X/Z of the knots, ascending, last is infinite */
    vndf_radial_cell *cells;  /* radial_count, on borders of lines of the cache in cells_memory */
    void *cells_memory;
    uint16_t windows[2][VNDF_RATIOS][VNDF_RANGES]; /* the second half for k < 0 */
    vndf_guide slope_guide;                        /* not last: lanes read a half word beyond the windows */
    vndf_wedge above, below;
    double normalization; /* the source was multiplied by it */
    double scale;         /* canonical slope 1 is this slope of the source */
    vndf_certificate certificate;
    const char *source, *tool; /* owned by tables */
    size_t bytes;              /* of the file */
};

#endif
