/* Where a table's numbers stand in the array that GPUs read (vndf_numbers), for the library and exports alike: a head,
 * then VNDF_STRIDE numbers for each knot, in rows of four, side by side since a sample reads nearly all of them.
 *
 *     VNDF_KNOT    R         z         width     turn       the knot, dx/dxi of its cell; where k~ begins (table.h)
 *     VNDF_LAW     left      right     m0        m1         densities of f/R per xi over z^2 at both ends of the cell,
 *                                                           moments 0 and 1 of f/R
 *     VNDF_SHARES  m2        cube      b0        b1         moment 2, mean of R^-3 in f/R; shares below the horizon
 *     VNDF_TAIL    along     all       over      over4      integrals beyond the knot of f R, f, f/R and f/R^4; at
 *                                                           knot 0 the last three are those of knot 1
 *     VNDF_AREA    t1        t2        area      slope      integrals beyond it of t f/R and t^2 f/R, t = R - knot;
 *                                                           area over c + s, and its derivative by x */
#ifndef VNDF_TABLE_LAYOUT_H
#define VNDF_TABLE_LAYOUT_H

/* The head: N, moments, squarings, scale, highest, steps (table.h), 0, 0. */
enum { VNDF_HEAD = 8 };

enum {
    VNDF_KNOT = 0,
    VNDF_LAW = 1,
    VNDF_SHARES = 2,
    VNDF_TAIL = 3,
    VNDF_AREA = 4,
    VNDF_GROUPS = 5,
    VNDF_STRIDE = 20
};

/* Where the law of k~ begins is looked up by rho, rounded to the middle of an eighth of an octave from 2^-13 to 2^15.
 * Eighth i is that of floats whose highest bits are VNDF_RHO_FIRST + i. */
enum { VNDF_RHO_PARTS = 224, VNDF_RHO_FIRST = 912 };

#endif
