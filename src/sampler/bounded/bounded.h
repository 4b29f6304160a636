/* Visible normals bounded by the horizon: those of wi that reflect it to above the surface. No sample is lost,
 * for any D; wi is above the horizon, else nothing is drawn.
 *
 * With slopes m = wm.xy/wm.z, wo = 2 (wi.wm) wm - wi and b = wi.xy/wi.z
 *
 *     wo.z > 0   where   |m|^2 - 2 b.m - 1 < 0,                                                          (1)
 *
 * a disc that holds the pole m = 0; wi.wm > wi.z/2 in it. Every sampler here draws a first coordinate and then a
 * second one on a line, both by inverting distribution functions. The law of the first stays what it is for all
 * visible normals, or nearly, and the second is drawn from the chord of the disc on its line:
 *
 *     density = (that of vndf_pdf)/kept,     kept = P(chord) of the visible normals of that line,            (2)
 *
 * times a constant of the direction where the first law is cut or weighted too. A reflection has the weight kept
 * F G2/G1: what would be lost has been summed in closed form, so the variance is below that of visible normals,
 * where a sample has F G2/G1 or 0 (Rao-Blackwell). Published bounds (Tokuyoshi & Eto, "Bounded VNDF Sampling for
 * Smith-GGX Reflections", SIGGRAPH Asia 2023 Technical Communications) are for GGX and loose; this one is tight.
 *
 *     tables     azimuth about z, then the slope length               table.c
 *     GGX        azimuth about the stretched wi, then the angle to it     ggx.c
 *     Beckmann   the slope along the stretched wi, then that across       beckmann.c */
#ifndef VNDF_SAMPLER_BOUNDED_BOUNDED_H
#define VNDF_SAMPLER_BOUNDED_BOUNDED_H

#include "sampler/closed.h"

/* What the laws take of the direction, of tables nothing; the view of a closed form is given its direction,
 * turned. */
enum { VNDF_BOUNDS = 8 };
void vndf_bounds_of(vndf_view *view, double bounds[VNDF_BOUNDS]);

/* A normal, its density per steradian within [FLT_MIN, FLT_MAX], and `kept` in [FLT_MIN, 1]: the density is that
 * of vndf_pdf over it, to 1e-5. */
typedef struct vndf_bounded {
    vndf_vec3 wm;
    float density, kept;
} vndf_bounded;

/* From two uniform numbers in [0, 1] (outside: clamped; NaN: 0). Unit, wi.wm > 0 and wo.z > 0 for wm as it is
 * returned and wi as it was given, by 2^-21 of wi.z. Continuous and monotone as vndf_sample, in its order for
 * tables and Beckmann; for GGX u1 turns the normal about the stretched wi, from below it through the side (1/4)
 * and the top (1/2) round again, and u2 moves it away. An invalid view or one from below: (0, 0, 1) with density
 * and kept 0. */
vndf_bounded vndf_sample_bounded(const vndf_view *view, const double bounds[VNDF_BOUNDS], float u1, float u2);

/* The density with which vndf_sample_bounded draws wm, unit but for rounding; 0 where it reflects wi to below the
 * horizon. Not held to the range of float. */
double vndf_pdf_bounded(const vndf_view *view, const double bounds[VNDF_BOUNDS], vndf_normal wm);

/* ---- the kinds of distributions ---- */

/* The two factors of the density (2) of a normal in the disc. */
typedef struct vndf_bounded_factors {
    double visible, kept;
} vndf_bounded_factors;

vndf_bounded vndf_bounded_table(const vndf_view *view, float u1, float u2);
vndf_bounded_factors vndf_bounded_table_at(const vndf_view *view, vndf_normal wm, double facing);

void vndf_bounds_ggx(vndf_view *view, double bounds[VNDF_BOUNDS]);
vndf_bounded vndf_bounded_ggx(const vndf_view *view, const double bounds[VNDF_BOUNDS], float u1, float u2);
vndf_bounded_factors vndf_bounded_ggx_at(const vndf_view *view, const double bounds[VNDF_BOUNDS], vndf_normal wm,
                                         double facing);

void vndf_bounds_beckmann(vndf_view *view, double bounds[VNDF_BOUNDS]);
vndf_bounded vndf_bounded_beckmann(const vndf_view *view, const double bounds[VNDF_BOUNDS], float u1, float u2);
vndf_bounded_factors vndf_bounded_beckmann_at(const vndf_view *view, const double bounds[VNDF_BOUNDS],
                                              vndf_normal wm, double facing);

/* A normal as it was drawn, of any length: turned into the disc if rounding has put it outside, and with the
 * density of that. */
vndf_bounded vndf_bounded_settled(const vndf_view *view, const double bounds[VNDF_BOUNDS], vndf_normal drawn);

#endif
