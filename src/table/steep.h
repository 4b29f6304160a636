/* How steep the density may be in a radial cell whose density is formed in float: the part of sampler/trust.h that
 * a table already knows of its cells (derive_radial.c). */
#ifndef VNDF_TABLE_STEEP_H
#define VNDF_TABLE_STEEP_H

/* e^10 per e-fold of the slope: rounding a normal moves its slope by up to 5e-7 of itself. */
#define VNDF_STEEP_RADIUS 10.0f

/* The same for a cell that is nowhere steep, where W is constant or proportional to the slope. What W adds where the
 * horizon cuts it off is 7.8 at most (VNDF_TRUST_FACING): 13.8 of 4e-7 are less than the shares of both. */
#define VNDF_STEEP_CELL 6.0

/* One over the width of a cell in e-folds of the slope, from which on that rounding is a thousandth of the cell. */
#define VNDF_NARROW 2000.0f

/* D on both sides of a knot beside which no rounding matters, relative. */
#define VNDF_STEEP_KNOT 1e-6

#endif
