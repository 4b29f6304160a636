/* Bins over the hemisphere of normals that see the lobe, however narrow or far from the pole it is.
 *
 * A normal wm is taken to the hemisphere stretched by (sx, sy): m' ~ (wm.x/sx, wm.y/sy, wm.z), which
 * divides its slopes by sx, sy and so undoes the roughness. theta' in [0, 90] degrees of m' is cut
 * into BINS_THETA even parts, its azimuth phi' around a centre into BINS_PHI parts that are even in psi,
 *
 *     tan(phi'/2) = kappa tan(psi/2),
 *
 * a smooth map of the circle onto itself that opens up a lobe narrow in azimuth (kappa < 1; kappa = 1
 * leaves phi' as it is). (sx, sy) = (alpha_x, alpha_y) times the median stretched slope, and kappa
 * puts the median |phi'| at psi = 90 degrees, both of a few hundred visible normals drawn apart from
 * those that are tested. The bins cover the hemisphere whatever these numbers are. */
#ifndef TOOLS_BINS_H
#define TOOLS_BINS_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

enum { BINS_THETA = 65, BINS_PHI = 130, BINS_COUNT = BINS_THETA * BINS_PHI };

typedef struct bin_map {
    double stretch_x, stretch_y;
    double centre; /* azimuth in the stretched hemisphere where psi = 0, radians */
    double kappa;
} bin_map;

/* Bins for the visible normals of one view; seed starts the pilot samples. */
bin_map bins_for(const vndf_surface *surface, vndf_vec3 wi, uint64_t seed);

/* The bin of a normal, 0 to BINS_COUNT - 1: rows of constant theta', psi ascending within a row. */
size_t bins_place(const bin_map *map, vndf_vec3 wm);

/* The integral of vndf_pdf over each bin: nested adaptive Lobatto rules, error about 1e-5 of the bin or
 * 5e-10, whichever is larger. Kinks and jumps of the density are refined; the end points that the rules
 * use see a jump that hides near the border of a bin. */
void bins_integrate(const bin_map *map, const vndf_view *view, double probability[BINS_COUNT]);

#endif
