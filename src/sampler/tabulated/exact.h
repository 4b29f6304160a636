/* The exact tier of tables draws, evaluates and inverts in double, for every direction and every normal. Only here do
 * cells at the cut and beside it stand, and no threshold is asked. The fast tier draws in float (draw.h) and evaluates
 * in lanes of doubles (density.h); it leaves every special case to this one. Both tiers look up a place by location.h
 * and mix rows by density_wedge.h; searches stay in float.
 *
 *     exact_azimuth.c  the azimuth: its density, draw and inverse
 *     exact_radius.c   the same for the slope length at one azimuth
 *     exact.c          both together: what theory.h declares */
#ifndef VNDF_SAMPLER_TABULATED_EXACT_H
#define VNDF_SAMPLER_TABULATED_EXACT_H

#include <math.h>

#include "sampler/stretch.h"
#include "sampler/tabulated/density_wedge.h"
#include "sampler/tabulated/exact_cell.h"
#include "sampler/tabulated/theory.h"

/* ---- parts of a mass ---- */

/* The part of a mass before a place, and how fast it grows there. */
typedef struct vndf_exact_part {
    double part, rate;
} vndf_exact_part;

/* ---- azimuth ---- */

/* Cosine and sine >= 0 of |a|, both times n, and whether rows drew it. */
typedef struct vndf_exact_azimuth {
    double cosine, sine, n;
    int in_wedge;
} vndf_exact_azimuth;

/* Mass per radian, 1 in a whole turn, for the stretched direction w. */
double vndf_exact_azimuth_density(const vndf_distribution *d, const vndf_stretched *w, double cosine, double sine);

/* The azimuth |a| with the part `half` of half a turn's mass between the side of wi and it. In a wedge *near gets the
 * shares of rows and the cell. */
vndf_exact_azimuth vndf_exact_azimuth_draw(const vndf_view *view, const vndf_stretched *w, float half,
                                           vndf_wedge_near *near);

/* The part of half a turn's mass before an azimuth, and its rate per radian. */
vndf_exact_part vndf_exact_azimuth_part(const vndf_view *view, const vndf_stretched *w, double cosine,
                                        double sine);

/* ---- radius ---- */

/* Finds the cut, its part and the mass of a law with the weights c and k. */
void vndf_exact_law_find(vndf_azimuth_slice *law);

/* A normal (X, Z) of any length. */
typedef struct vndf_exact_slope {
    double x, z;
} vndf_exact_slope;

/* The slope with the part u of the mass before it, and its cell; the horizon where nothing is visible. */
vndf_exact_slope vndf_exact_law_draw(const vndf_azimuth_slice *law, double u, uint32_t *cell);

/* The part before a slope, and its rate per radian between the normal and z: 0 at the cut and beside it. */
vndf_exact_part vndf_exact_law_part(const vndf_azimuth_slice *law, vndf_exact_slope slope);

#endif
