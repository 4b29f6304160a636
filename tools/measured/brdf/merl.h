/* MERL files (W. Matusik, H. Pfister, M. Brand, L. McMillan, "A Data-Driven Reflectance Model", SIGGRAPH 2003):
 * three numbers of 32 bits, 90 90 180 (or 360), then red, green and blue, each 90 x 90 x 180 doubles, the azimuth
 * fastest; all with the least byte first. f is a number times 1/1500, 1.15/1500 and 1.66/1500. Its bins, counted
 * from the half vector h: theta_h even in its square root from 0 to 90 degrees, theta_d even, phi_d even over half
 * a turn. A number is taken as f in the middle of its bin, and masked with heights correlated. Programs that fill
 * such files often have f at the lower end, or the product of G1 of both ways: these are taken where they explain
 * the file with half the error. */
#ifndef TOOLS_MEASURED_BRDF_MERL_H
#define TOOLS_MEASURED_BRDF_MERL_H

#include <stdio.h>

#include "measured/profile.h"

typedef enum merl_channel { MERL_RED, MERL_GREEN, MERL_BLUE, MERL_LUMINANCE } merl_channel;

/* D over theta of one channel: that of the back-scattered light (power.h), less a constant, the diffuse part, chosen
 * so that D explains all of the file best. Writes to *to: that part (pi f, an albedo), F0 and F90 of Schlick's F, the
 * part of the light that the model has elsewhere, and F0 of each channel by itself, diffuse light counted in. Returns
 * 1, or 0 and the reason; untrusted bytes are safe. */
int merl_read(profile *rows, const char *name, const unsigned char *bytes, size_t size, merl_channel channel,
              notes *to, refusal *why);

/* Writes single scattering with Schlick's F to an open file, 33 MiB; 0 if that fails. */
int merl_write(FILE *file, const vndf_distribution *distribution, float alpha, const double f0[3]);

#endif
