/* How steep the density may be in a radial cell whose density is formed in float: the part of sampler/trust.h that
 * a table already knows of its cells (derive_radial.c). */
#ifndef VNDF_TABLE_STEEP_H
#define VNDF_TABLE_STEEP_H

/* e^10 per e-fold of the slope: rounding a normal moves its slope by up to 5e-7 of itself. */
#define VNDF_STEEP_RADIUS 10.0f

/* The same with room for float, for a cell that is nowhere steep. */
#define VNDF_STEEP_CELL 9.0

/* D on both sides of a knot beside which no rounding matters, relative. */
#define VNDF_STEEP_KNOT 1e-6

#endif
