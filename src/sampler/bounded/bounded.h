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
 *     density = (that of vndf_pdf)/inside_mass,    inside_mass = P(chord) among the visible normals of that line,   (2)
 *
 * times a constant of the direction where the first law is cut or weighted too. A reflection has the weight
 * inside_mass F G2/G1: the lost part has been summed in closed form, so the variance is below that of visible normals,
 * where a sample has F G2/G1 or 0 (Rao-Blackwell). Published bounds (Tokuyoshi & Eto, "Bounded VNDF Sampling for
 * Smith-GGX Reflections", SIGGRAPH Asia 2023 Technical Communications) are for GGX and loose; this one is tight.
 *
 *     tables     azimuth about z, then the slope length               table.c
 *     GGX        azimuth about the stretched wi, then the angle to it     ggx.c
 *     Beckmann   the slope along the stretched wi, then that across       beckmann.c */
#ifndef VNDF_SAMPLER_BOUNDED_BOUNDED_H
#define VNDF_SAMPLER_BOUNDED_BOUNDED_H

#include "sampler/bounded/disc.h"

/* Prepares the law for a direction; tables need nothing. */
void vndf_bounds_of(const vndf_view *view, vndf_bounds *bounds);

/* From two uniform numbers in [0, 1] (outside: clamped; NaN: 0). Unit, wi.wm > 0 and wo.z > 0 for wm as it is
 * returned and wi as it was given, by 2^-21 of wi.z. Continuous and monotone as vndf_sample, in its order for
 * tables and Beckmann; for GGX u1 turns the normal about the stretched wi, from below it through the side (1/4)
 * and the top (1/2) round again, and u2 moves it away. An invalid view or one from below: (0, 0, 1) with density
 * and inside_mass 0. */
vndf_bounded vndf_sample_bounded(const vndf_view *view, const vndf_bounds *bounds, float u1, float u2);

/* The density with which vndf_sample_bounded draws wm, unit but for rounding; 0 where it reflects wi to below the
 * horizon. Not held to the range of float. */
double vndf_pdf_bounded(const vndf_view *view, const vndf_bounds *bounds, vndf_normal wm);

#endif
