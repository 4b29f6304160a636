/* The engine: azimuth first, radius second.
 *
 * After stretching and turning about z the incident direction is (s, 0, c), s >= 0, c of either sign, and
 * normals are (X cos a, X sin a, Z) with slope length R = X/Z. The visible density is
 *
 *     P22(R) R (c + s cos(a) R) dR da        where c + s cos(a) R > 0.                               (1)
 *
 * For a given azimuth a the law of R depends on the direction through two numbers only, c and k = s cos a:
 * mass up to R is  c F0(R) + k F1(R),  F_n(R) = integral_0^R P22 r^(n+1) dr. So two 1D tables of D give
 * the law of R exactly for every direction of the sphere, whatever D is: rings, jumps, peaks and tails cost
 * cells where they are and nothing else. The cut at rho = -c/k falls into one cell, which is shortened.
 *
 * The density of the azimuth is the total of that law,
 *     a front half (c >= 0, cos a >= 0):   c F0(inf) + s cos(a) F1(inf)                               (2)
 *     the wedge above (c > 0, cos a < 0):  c (F0(rho) - F1(rho)/rho),   rho = c/(s |cos a|)           (3)
 *     the wedge below (c < 0, cos a > 0):  k (T1(rho) - rho T0(rho)),   T_n = F_n(inf) - F_n          (4)
 * u1 goes round from behind wi (0) through the side of wi (1/2) and back (1): |2 u1 - 1| is the part of a half turn's
 * mass between the side of wi and |a|. Above the horizon the front comes first and then the wedge, by their two
 * masses; below it the wedge is all there is.
 *
 * The front. (2) needs two numbers of D and no table. Its inverse is Kepler's equation; one step from a closed start
 * solves it to float precision (front.h).
 *
 * The wedge. (3) and (4) are integrals of D over a half plane's strip, twice smoother than D. Their masses over
 * the angle of incidence are quintic splines (table/area_piece.h); the one below also gives areas, Lambda and
 * G1, since A(w) - A(-w) = c. Only for the azimuth inside a wedge does a 2D table stand (vndf_wedge): rows over the
 * angle of incidence, each with mass and density on cells of a half-angle tangent q (azimuth.h). A direction mixes
 * three rows by quadratic Bezier weights (wedge.h). Linear mixing left twice the error at 64 KiB; higher orders may
 * leave the positive numbers.
 *
 * The wedges and the radius (radial.h) are drawn from piecewise densities that are *defined* by the numbers of
 * the table (cells of math/rational_cell.h: exact mass and exact end densities), and the pdf evaluates the same
 * cells: the density is known whatever the size of the table, only its distance to (1) shrinks with it.
 *
 * Drawing is in float: a place that is off by a rounding is as good as the one asked for, and where the density
 * changes little from a normal to its rounded self, the density at the place comes for nothing (sample.c). The density
 * of a *given* normal has no such freedom: its place is found from the normal, and in float three numbers are
 * differences that may lose every digit where the density is steep or ends: W at the cut, the slope in a narrow cell,
 * and the angle to a right angle from wi. So the same cells are evaluated in double from the caller's wi, wm and
 * roughness (exact.c); where rounding would show, a sample comes with that density too.
 *
 * Why not the other orders? Both were measured on prototypes of 16 KiB. Slope x first, then y given x, needs a 2D table
 * of D itself and leaves a total variation of 5e-2 on a ring and 1e-1 on a disc. Radius first needs a kernel of angle
 * and radius as a sum of powers, which stops at 1e-3 below the horizon at any size, and takes twice the time. */
#ifndef VNDF_SAMPLER_TABULATED_THEORY_H
#define VNDF_SAMPLER_TABULATED_THEORY_H

#include <stdint.h>

#include "sampler/analytic_density.h"
#include "vndf.h"

/* All of it is for tables, whose views have s + |c| = 1: the fast tier in sample.c, the exact one in exact.c. */

/* vndf_sample and vndf_pdf; u1 and u2 are in [0, 1], wm is unit, wm.z >= 0 and faces wi. */
vndf_vec3 vndf_engine_sample(const vndf_view *view, float u1, float u2, float *pdf);

/* The same, which tells in *fast whether float drew the normal; elsewhere the density is not wanted. */
vndf_vec3 vndf_engine_sample_telling(const vndf_view *view, float u1, float u2, float *pdf, int *fast);

/* The same with *weight (vndf_sample_weight); 0 if it has to be computed from wm. */
vndf_vec3 vndf_engine_sample_weight(const vndf_view *view, float u1, float u2, float *pdf, float *weight);

/* The same by the exact tier (exact.h), for samples that float may not draw. */
vndf_vec3 vndf_engine_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf);

struct vndf_query; /* sampler/tabulated/density.h */
double vndf_engine_density(const vndf_view *view, const struct vndf_query *given);

/* The law of the radius at one azimuth a, given by its cosine and sine >= 0. */
typedef struct vndf_azimuth_slice {
    const vndf_distribution *table;
    double c, k;       /* k = s cos a */
    double azimuth;    /* density of the azimuth, per radian */
    double mass, part; /* c F0 + k F1 as far as it is visible; the visible part of the cell of the cut */
    uint32_t cut;      /* that cell; radial_count if there is none */
} vndf_azimuth_slice;

/* At any azimuth of one direction: the fan is found once for all of them (exact.h). */
typedef struct vndf_azimuth_fan vndf_azimuth_fan;
vndf_azimuth_slice vndf_azimuth_slice_in(const vndf_azimuth_fan *fan, double cosine, double sine);

/* The slice through a normal of any length. */
vndf_azimuth_slice vndf_azimuth_slice_of(const vndf_view *view, vndf_normal wm);

/* The density per steradian of a normal in the slice, of length 1 but for rounding, with facing = wi.wm > 0. */
double vndf_engine_density_on(const vndf_view *view, const vndf_azimuth_slice *slice, vndf_normal wm,
                              double facing);

/* The part of the law with slopes up to X/Z. */
double vndf_azimuth_slice_part(const vndf_azimuth_slice *slice, double x, double z);

/* The density per X Z^2 dR da at X + Z = 1, where w = c Z + k X > 0. */
double vndf_azimuth_slice_density(const vndf_azimuth_slice *slice, double x, double z, double w);

/* The visible part of a cell of the law, from `begin` on, `length` long in xi: its mass, the densities at its ends, and
 * V there. Densities are per xi of the part or, if weighted, per zeta of V (math/weighted_cell.h). */
typedef struct vndf_engine_piece {
    double e0, e1, mass, v0, v1, begin, length;
    int weighted;
} vndf_engine_piece;
vndf_engine_piece vndf_engine_piece_of(const vndf_azimuth_slice *slice, uint32_t cell);

/* The density per dxi da at a visible place of that cell, xi and eta from its knots. */
double vndf_engine_piece_density(const vndf_azimuth_slice *slice, const vndf_engine_piece *piece, uint32_t cell,
                                 double xi, double eta);

/* Places of a cell: xi and eta = 1 - xi. */
typedef struct vndf_engine_places {
    const double *xi, *eta;
    size_t count;
} vndf_engine_places;

/* The same at places that are all visible, in the cell of the piece. */
void vndf_engine_piece_densities(const vndf_azimuth_slice *slice, const vndf_engine_piece *piece, uint32_t cell,
                                 const vndf_engine_places *places, double *density);

/* The uniform numbers that give a normal (X cos a, X sin a, Z) of the turned frame, of any length, but for some steps
 * of 2^-24. Returns whether these steps are known to move it by no more than 1e-5; if not, sampler/nearest.h improves
 * them. */
int vndf_engine_invert(const vndf_view *view, vndf_vec3 normal, float *u1, float *u2);

/* P22/Z^4 at (X, Z), X + Z = 1: D is this times (X^2 + Z^2)^2, finite at the horizon. */
double vndf_engine_p22_over_z4(const vndf_distribution *d, double x, double z);

#endif
