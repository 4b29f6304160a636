/* Bins over the hemisphere of normals that see the lobe, however narrow or far from the pole it is.
 *
 * A normal wm is taken to the hemisphere stretched by (sx, sy): m' ~ (wm.x/sx, wm.y/sy, wm.z), which
 * divides its slopes by sx, sy and so undoes the roughness; (sx, sy) is (alpha_x, alpha_y) times the
 * median stretched slope. The bins are the product of 65 intervals of theta' in [0, 90] degrees and 130
 * of the azimuth phi' in [-180, 180] degrees from the incident direction. Half of the borders of each are
 * even, the other half are quantiles, so that half of the bins lie where the normals do. Median and quantiles
 * are those of 2001 visible normals drawn apart from those that are tested; the bins cover the hemisphere
 * whatever they are. */
#ifndef TOOLS_EVIDENCE_MEASURE_BINS_H
#define TOOLS_EVIDENCE_MEASURE_BINS_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

enum { BINS_THETA = 65, BINS_PHI = 130, BINS_COUNT = BINS_THETA * BINS_PHI };

typedef struct bin_map {
    double stretch_x, stretch_y;
    double centre;                /* azimuth of the incident direction in the stretched hemisphere */
    double slope[BINS_THETA + 1]; /* borders: tan(theta'), ascending from 0 to infinity */
    double phi[BINS_PHI + 1];     /* radians, ascending */
} bin_map;

/* Bins for the visible normals of one view; seed starts the pilot samples. */
bin_map bins_for(const vndf_surface *surface, vndf_vec3 wi, uint64_t seed);

/* The bin of a normal, 0 to BINS_COUNT - 1: rows of constant theta', phi' ascending within a row. */
size_t bins_place(const bin_map *map, vndf_vec3 wm);

/* The integral of vndf_pdf over each bin, to 1e-4 of it or 1e-9, whichever is larger, where the density is
 * continuous. The sum over all bins is within 2e-6 of 1 for a density whose integral is 1, jumps and narrow
 * peaks included. test_bins measures both. Returns by how much rounding of normals and densities may
 * move that sum: next to nothing but for rings so narrow that floats hardly tell slopes in them apart. */
double bins_integrate(const bin_map *map, const vndf_surface *surface, vndf_vec3 wi,
                      double probability[BINS_COUNT]);

/* For bins of other kinds: borders, in no order yet, of which every other is even between low and high and the rest are
 * quantiles of what is sorted; and which of `parts` intervals of ascending borders holds x. */
void bins_borders(double *border, size_t parts, double low, double high, const double *sorted, size_t count);
size_t bins_interval(const double *border, size_t parts, double x);

#endif
