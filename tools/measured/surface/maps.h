/* Slopes of normal maps. A normal n has the slope (-n.x/n.z, -n.y/n.z). Numbers of 8 or 16 bits are n/2 + 1/2, and so
 * are those of a PFM without negative ones; a PFM with negative numbers holds n itself. Lengths need not be 1. */
#ifndef TOOLS_MEASURED_SURFACE_MAPS_H
#define TOOLS_MEASURED_SURFACE_MAPS_H

#include "measured/surface/slopes.h"

/* Reads a PPM (P6) or a colour PFM. Normals shorter than a half, longer than 3/2 or without z above 0 are left out;
 * more than half of them are a reason to refuse. Writes what was found to *to. Returns 1, or 0 and the reason;
 * untrusted bytes are safe. */
int maps_read(slope_set *made, const char *name, const void *bytes, size_t size, notes *to, refusal *why);

#endif
