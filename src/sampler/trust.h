/* Where float is trusted: every threshold of the fast tier, with its cause. Drawing is in float. The density at the
 * place that was drawn is the density of the rounded normal only where rounding changes little; everywhere else the
 * sample is drawn again and its normal evaluated in double (vndf_law_sample_exactly).
 *
 * The promise is that a density has a relative error below 1e-5. The budget below says which part of it each cause may
 * use up; the shares that can meet in one sample add up to no more, which the compiler checks. A share is the worst
 * error measured on the trusted side of the threshold, within a factor of two of it, and rounded up by hand. */
#ifndef VNDF_SAMPLER_TRUST_H
#define VNDF_SAMPLER_TRUST_H

#include "math/rational_cell.h"
#include "simd/doubles.h"
#include "table/steep.h"
#include "table/table.h"

/* ---- the budget ---- */

/* Parts of the promise in units of 1e-8. The share of a cause leaves out the roundings that every sample has. The
 * shares were measured with 130 million samples of all shipped tables and of rings, discs, needles, tails of r^-3.1
 * and lobes whose widths differ a thousandfold, at roughness 1e-3 to 10. The worst error of all was 570; a search
 * that climbs from the worst points finds 730 for a ring of relative width 1e-6 (test float_accuracy). */
enum {
    VNDF_PROMISE = 1000,
    VNDF_SHARE_ROUNDING = 180, /* of a dozen operations each: direction, masses, cell, normal */
    VNDF_SHARE_RADIUS = 400,   /* a steep cell of the radius: VNDF_STEEP_RADIUS */
    VNDF_SHARE_FACING = 220,   /* wi.wm as a difference: VNDF_TRUST_FACING */
    VNDF_SHARE_CUT = 100,      /* a law that moves with its cut: VNDF_TRUST_CUT */
    VNDF_SHARE_AZIMUTH = 40,   /* a steep cell of the azimuth: VNDF_TRUST_AZIMUTH_STEEP */
    VNDF_SHARE_DIRECTION = 60, /* wedges and rows by the rounding of wi: VNDF_TRUST_WEDGE_MASS and below */
    VNDF_SHARE_GGX = 700,      /* all of GGX: within 7e-6 (sampler/analytic/ggx_draw.h) */
    VNDF_SHARE_BECKMANN = 800, /* all of Beckmann (sampler/analytic/beckmann_draw.h) */
    VNDF_WORST_TABLE = 730,    /* the worst that a search found of all shares of tables together */
    VNDF_SHARE_AFFINE = 200    /* the rounding of the real normal of an affine surface: VNDF_TRUST_AFFINE */
};

_Static_assert(VNDF_SHARE_ROUNDING + VNDF_SHARE_RADIUS + VNDF_SHARE_FACING + VNDF_SHARE_CUT + VNDF_SHARE_AZIMUTH +
                       VNDF_SHARE_DIRECTION <=
                   VNDF_PROMISE,
               "what can meet in one sample of a table");
_Static_assert(VNDF_SHARE_GGX <= VNDF_PROMISE && VNDF_SHARE_BECKMANN <= VNDF_PROMISE, "closed forms");
_Static_assert(VNDF_WORST_TABLE + VNDF_SHARE_AFFINE <= VNDF_PROMISE &&
                   VNDF_SHARE_GGX + VNDF_SHARE_AFFINE <= VNDF_PROMISE &&
                   VNDF_SHARE_BECKMANN + VNDF_SHARE_AFFINE <= VNDF_PROMISE,
               "a sample of an affine surface");

/* ---- range: nothing underflows, overflows or loses digits on the way; these thresholds have no share ---- */

/* The level part of the stretched direction, squared; its height over its length; its length. Beyond these, quotients
 * lose digits. */
static const float VNDF_TRUST_ACROSS2 = 1e-24f, VNDF_TRUST_HEIGHT = 1e-6f, VNDF_TRUST_LENGTH = 1e12f;

VNDF_INLINE lanes_m vndf_trusts_direction(lanes_f across2, lanes_f z, lanes_f length)
{
    return lanes_both(
        lanes_less(lanes_set(VNDF_TRUST_ACROSS2), across2),
        lanes_both(lanes_less(VNDF_TRUST_HEIGHT * length, z), lanes_less(length, lanes_set(VNDF_TRUST_LENGTH))));
}

/* Roughness and the height of the direction: densities are products of their powers. */
static const float VNDF_TRUST_SMOOTHEST = 1e-4f, VNDF_TRUST_ROUGHEST = 1e4f;

VNDF_INLINE lanes_m vndf_trusts_scale(lanes_f ax, lanes_f ay, lanes_f c)
{
    lanes_m low = lanes_less(lanes_set(VNDF_TRUST_SMOOTHEST), lanes_least(ax, ay));
    lanes_m high = lanes_less(lanes_most(ax, ay), lanes_set(VNDF_TRUST_ROUGHEST));
    return lanes_both(lanes_both(low, high), lanes_less(lanes_set(VNDF_TRUST_HEIGHT), c));
}

/* The density, the product that it divides by, and the squared length of a normal before it is made unit: a hostile
 * table may overflow here. */
static const float VNDF_TRUST_DENSITY_LEAST = 1e-37f, VNDF_TRUST_DENSITY_MOST = 1e38f;
static const float VNDF_TRUST_SQUARE = 1e-30f, VNDF_TRUST_PRODUCT = 1e-36f;

VNDF_INLINE lanes_m vndf_trusts_density(lanes_f density)
{
    return lanes_both(lanes_less(lanes_set(VNDF_TRUST_DENSITY_LEAST), density),
                      lanes_less(density, lanes_set(VNDF_TRUST_DENSITY_MOST)));
}

VNDF_INLINE lanes_m vndf_trusts_lengths(lanes_f square, lanes_f product)
{
    return lanes_both(lanes_less(lanes_set(VNDF_TRUST_SQUARE), square),
                      lanes_less(lanes_set(VNDF_TRUST_PRODUCT), product));
}

/* The root in the inverse of a rational cell, of the fourth power of a mass: at the pole, at u2 = 1e-10, denormals
 * cost it digits. */
static const float VNDF_TRUST_ROOT = 2e-18f;

VNDF_INLINE lanes_m vndf_trusts_root(lanes_f root)
{
    return lanes_less(lanes_set(VNDF_TRUST_ROOT), root);
}

/* ---- tables: azimuth ---- */

/* The mass of the range where the azimuth is drawn, over the mass in front: in a wedge of next to no mass the rounding
 * of the direction shows. */
static const float VNDF_TRUST_WEDGE_MASS = 0.01f;

VNDF_INLINE lanes_m vndf_trusts_wedge_mass(lanes_f front, lanes_f mass)
{
    return lanes_less(VNDF_TRUST_WEDGE_MASS * front, mass);
}

/* One over the width of a piece of the areas' spline, in the wedge's coordinate: a rounding of the direction shows
 * more in a narrow piece. Lobes whose widths differ hundreds of times have narrow pieces, and rows as close. */
static const float VNDF_TRUST_AREA_PER_WIDTH = 500.0f;

VNDF_INLINE lanes_m vndf_trusts_area_piece(lanes_f per_width)
{
    return lanes_at_most(per_width, lanes_set(VNDF_TRUST_AREA_PER_WIDTH));
}

/* How fast the density of a rational cell changes at a place, F''/F' as above/below (math/rational_cell.h): with the
 * numerator n and the root q of the denominator of F' it is n'/n - 2 q'/q. Both are times in->under^2. */
typedef struct vndf_change {
    lanes_f above, below;
} vndf_change;

VNDF_INLINE vndf_change vndf_change_at(const vndf_rational_cell *cell, const vndf_rational_place *in)
{
    lanes_f m = cell->mass, over = in->over, rest = in->rest, apart = rest - over;
    lanes_f rise = m * (m * (cell->e1 * over - cell->e0 * rest + m * apart));
    lanes_f bend = in->root * (((cell->e0 + cell->e1) - 2.0f * m) * apart);
    vndf_change change = {2.0f * lanes_abs(rise - bend) * in->under, in->root * in->below};
    return change;
}

/* The density of a cell of azimuths may change by a factor e^20 per radian, or per xi: rounding moves both by 1e-7.
 * turn/n2 is radians per xi. Where all underflows, nothing is less. */
static const float VNDF_TRUST_AZIMUTH_STEEP = 20.0f;

VNDF_INLINE lanes_m vndf_trusts_azimuth(vndf_change change, lanes_f turn, lanes_f n2)
{
    return lanes_less(change.above * n2, VNDF_TRUST_AZIMUTH_STEEP * change.below * lanes_least(turn, n2));
}

/* The density of an azimuth over its mean, about. Where one of the three rows has almost all of the density, and the
 * least weight, the rounding of the direction shows in that weight. */
static const float VNDF_TRUST_AZIMUTH_DENSITY = 0.05f;

VNDF_INLINE lanes_m vndf_trusts_azimuth_density(lanes_f density)
{
    return lanes_less(lanes_set(VNDF_TRUST_AZIMUTH_DENSITY), density);
}

/* The cosine to wi's azimuth at its side: rounding must not take a normal from the front to the wedge or back, as
 * the wedge's density is the table's. */
static const float VNDF_TRUST_SIDE = 1e-6f;

/* `away` is the cosine on the side where the azimuth was drawn. */
VNDF_INLINE lanes_m vndf_trusts_side(lanes_f away)
{
    return lanes_less(lanes_set(VNDF_TRUST_SIDE), away);
}

/* W = along + up is wi.wm times a length. It must be no small difference, and large beside the change by a rounding
 * of the azimuth, which is a part of `across`. In front of wi nearly nothing is drawn where W is small, and there
 * roundings of the direction and of the azimuth meet, 6e-7 in all. */
static const float VNDF_TRUST_FACING_IN_FRONT = 0.1f, VNDF_TRUST_FACING = 0.06f;

VNDF_INLINE lanes_m vndf_trusts_facing_in_front(lanes_f across, lanes_f along, lanes_f up)
{
    return lanes_less(VNDF_TRUST_FACING_IN_FRONT * across, along + up);
}

VNDF_INLINE lanes_m vndf_trusts_facing_in_wedge(lanes_f across, lanes_f along, lanes_f up)
{
    return lanes_less(VNDF_TRUST_FACING * (across + up), along + up);
}

/* ---- tables: radius ---- */

/* How much of a law in the wedge changes per e-fold of its cut: rounding the azimuth moves the cut by some 1e-7.
 * Smooth lobes have 1 to 4; where only the foot of a ring is visible it may be 500, and float is off by 2e-3. */
static const float VNDF_TRUST_CUT = 6.0f;

/* `inside` is the change of the cells inside the cut. The mass of the cell at the cut is the steeper, the narrower its
 * visible part is. */
VNDF_INLINE lanes_m vndf_trusts_cut(lanes_f inside, lanes_f part_mass, lanes_f reach, lanes_f total,
                                    lanes_f visible)
{
    return lanes_at_most(inside * visible + part_mass * reach, VNDF_TRUST_CUT * total * visible);
}

/* The density of a cell may change by a factor e^10 per e-fold of the slope: rounding a normal moves that by 5e-7,
 * and xi by reach/width times as much, which may be VNDF_TRUST_KNOT's distance from a knot. */
VNDF_INLINE lanes_m vndf_trusts_radius(vndf_change change, lanes_f width, lanes_f reach)
{
    return lanes_both(lanes_at_most(reach, VNDF_NARROW * width),
                      lanes_at_most(change.above * reach, VNDF_STEEP_RADIUS * change.below * width));
}

/* The distance in xi from a knot, which may be a jump of D; counted from the middle of the cell. */
static const float VNDF_TRUST_KNOT = 0.499f;

VNDF_INLINE lanes_m vndf_is_beside_knot(lanes_f over, lanes_f under)
{
    return lanes_less(VNDF_TRUST_KNOT * under, lanes_abs(over - 0.5f * under));
}

/* ---- tables: the weight of a sample, D (wi.wm) over area and density ---- */

/* P22 in a cell is the sum of a line and a bump. Over its terms: it must be no small difference. It may change by a
 * factor e^10 per e-fold of the slope, as the density may (VNDF_STEEP_RADIUS): weights are within 5e-6. */
static const float VNDF_TRUST_P22_TERMS = 0.125f;

VNDF_INLINE lanes_m vndf_trusts_p22(lanes_f p22, lanes_f terms, lanes_f rise, lanes_f width, lanes_f reach)
{
    return lanes_both(lanes_less(VNDF_TRUST_P22_TERMS * terms, p22),
                      lanes_at_most(lanes_abs(rise) * reach, VNDF_STEEP_RADIUS * (p22 * width)));
}

/* The density that divides. */
static const float VNDF_TRUST_DRAWN = 1e-30f;

VNDF_INLINE lanes_m vndf_trusts_drawn(lanes_f drawn)
{
    return lanes_less(lanes_set(VNDF_TRUST_DRAWN), drawn);
}

/* ---- GGX ---- */

/* The level part of the stretched direction, squared: its area does not overflow. */
static const float VNDF_TRUST_GGX_ACROSS2 = 1e24f;

/* cot^2 of half the angle to z: products of what is drawn overflow near the normal. */
static const float VNDF_TRUST_GGX_COTANGENT = 1e10f;

/* |h|^2, which is above 0 where the cap comes close to -w, over the square of its scale. */
static const float VNDF_TRUST_GGX_HALFWAY = 0.005f;

VNDF_INLINE lanes_m vndf_trusts_ggx_halfway(lanes_f r, lanes_f h2)
{
    return lanes_less(VNDF_TRUST_GGX_HALFWAY * (r * r), h2);
}

/* ---- Beckmann ---- */

static const float VNDF_TRUST_BECKMANN_BOUND = 1e10f; /* K, and one over the level length */

/* 4 u (1 - u): starting values and quantiles are fitted down to it, and squares of slopes stay below 15, so that a
 * rounding of the normal moves exp(-x^2 - y^2) by a few 1e-6. */
#define VNDF_TRUST_BECKMANN_MIDDLE 3.4e-4f

VNDF_INLINE lanes_m vndf_trusts_beckmann_middle(lanes_f middle)
{
    return lanes_less(lanes_set(VNDF_TRUST_BECKMANN_MIDDLE), middle);
}

/* d, which is wi.wm times a length, over the sum of its terms. */
static const float VNDF_TRUST_BECKMANN_FACING = 0.06f;

VNDF_INLINE lanes_m vndf_trusts_beckmann_facing(lanes_f terms, lanes_f d)
{
    return lanes_less(VNDF_TRUST_BECKMANN_FACING * terms, d);
}

/* ---- all normals of Beckmann ---- */

/* R^2: the rounding of a normal, 6e-7 of R with that of its azimuth, is R^2 times as much of P22. */
static const double VNDF_TRUST_ALL_BECKMANN = 4.0;

/* ---- affine surfaces: an ordinary sample, turned, sheared and rounded once more ---- */

/* Rounding moves the slope s of the real normal by 2^-23 |s|, and its unit slope u, on which P22 depends, by that over
 * the lesser roughness m. Squares, each times whatever keeps them free of divisions: u^2 = across/up, and (|s|/m)^2 =
 * slope/least. The azimuth's cosine to wi is along/reach, squared, and times z^2. */
typedef struct vndf_rounding {
    doubles across, up, slope, least, along, reach;
} vndf_rounding;

/* The change of log P22 over u, times |s|/m: in units of 2^-23. */
static const double VNDF_TRUST_AFFINE = 12.0;

/* P22 may change at this rate at least, so that the rounding stays far from a knot that no rounding of float reached,
 * and by no more over an e-fold of u where it is drawn in float (VNDF_STEEP_RADIUS). */
static const double VNDF_TRUST_AFFINE_STEEP = 4.0;

/* The cosine to wi's azimuth at its side, over |s|/(m u): as VNDF_TRUST_SIDE. */
static const double VNDF_TRUST_AFFINE_SIDE = 1e-6;

VNDF_INLINE doubles_m vndf_trusts_affine_side(const vndf_rounding *r)
{
    const double side = VNDF_TRUST_AFFINE_SIDE * VNDF_TRUST_AFFINE_SIDE;
    return doubles_less(side * r->reach * r->slope, r->along * r->least);
}

/* |s|/(m u): rounding turns the azimuth by 2^-23 of it, and what a table draws beside the pole changes with that. */
static const double VNDF_TRUST_AFFINE_POLE = 80.0;

VNDF_INLINE doubles_m vndf_trusts_affine_pole(const vndf_rounding *r)
{
    const double most = VNDF_TRUST_AFFINE_POLE * VNDF_TRUST_AFFINE_POLE;
    return doubles_less(r->slope * r->up, most * r->across * r->least);
}

/* (steepness |s|/m)^2 = above/below. */
VNDF_INLINE doubles_m vndf_trusts_affine_change(doubles above, doubles below)
{
    return doubles_less(above, VNDF_TRUST_AFFINE * VNDF_TRUST_AFFINE * below);
}

/* |s|/m where P22 is flat, and its bend counts: rounding moves u by less than 1.2e-4. */
static const double VNDF_TRUST_AFFINE_FLAT = 1000.0;

VNDF_INLINE doubles_m vndf_trusts_affine_flat(const vndf_rounding *r)
{
    return doubles_less(r->slope, VNDF_TRUST_AFFINE_FLAT * VNDF_TRUST_AFFINE_FLAT * r->least);
}

/* u^2 of Beckmann: beyond it float draws nothing, and P22 falls too fast. */
static const double VNDF_TRUST_AFFINE_BECKMANN = 15.0;

/* wi.wm over the sum of its terms, each of which is rounded. */
static const double VNDF_TRUST_AFFINE_FACING = 0.1;

VNDF_INLINE doubles_m vndf_trusts_affine_facing(doubles terms, doubles facing)
{
    return doubles_less(VNDF_TRUST_AFFINE_FACING * terms, facing);
}

/* The density as it was drawn: a least and a largest one stand for others. */
VNDF_INLINE doubles_m vndf_trusts_affine_density(doubles density)
{
    return doubles_both(doubles_less(doubles_set((double)VNDF_TRUST_DENSITY_LEAST), density),
                        doubles_less(density, doubles_set((double)VNDF_TRUST_DENSITY_MOST)));
}

/* ---- bounded normals: errors by `inside_mass`, the part of the law inside the horizon's disc ---- */

/* The border's slope over the normal's: the normal is so far inside that no rounding takes it out. */
#define VNDF_TRUST_INSIDE 1.00001

/* The root of the border's slope: a rounding of the azimuth moves it by 1e-7 of s/root. */
static const float VNDF_TRUST_BORDER_ROOT = 0.02f;

/* The density per e-fold of the border's slope over the mass inside: how fast that mass moves with the slope. */
static const float VNDF_TRUST_BORDER_STEEP = 30.0f;

/* In cells that float does not follow, at the cut, hardly anything is lost. */
static const float VNDF_TRUST_BORDER_CUT = 0.999f;

/* GGX: the constant term of the chord, where w leaves the disc, over c; z and the cosine of the sample. */
static const float VNDF_TRUST_CHORD_INSIDE = -0.1f;
static const float VNDF_TRUST_CHORD_HEIGHT = 0.02f, VNDF_TRUST_CHORD_COSINE = 0.03f;

/* GGX: d log(mass)/d psi, times a rounding of psi by 1e-7/(reach sine); psi beside the border between front and wedge,
 * where the mass has another form; the sine; and the cancellation in the matrix of level directions. */
static const float VNDF_TRUST_CHORD_STEEP = 150.0f, VNDF_TRUST_CHORD_SIDE = 1e-12f;
static const float VNDF_TRUST_CHORD_SINE = 0.01f, VNDF_TRUST_CHORD_MATRIX = 100.0f;

/* Beckmann: the slope squared and wi.wm as above; how fast the part on the chord moves with the slopes; and the least
 * part that keeps its digits as a difference in float. */
static const double VNDF_TRUST_BOUNDED_SLOPE = 12.0, VNDF_TRUST_BOUNDED_FACING = 0.05;
static const double VNDF_TRUST_BOUNDED_STEEP = 30.0;
static const float VNDF_TRUST_BOUNDED_PART = 0.1f;

#endif
