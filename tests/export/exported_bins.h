/* Pearson's chi-square of normals that an exported kernel drew, against integrals of the library's vndf_pdf over the
 * bins of tools/measure/bins.h. */
#ifndef TESTS_EXPORT_EXPORTED_BINS_H
#define TESTS_EXPORT_EXPORTED_BINS_H

#include <stddef.h>

#include "measure/bins.h"
#include "vndf.h"

typedef struct exported_bins {
    bin_map map;
    double *probability, *observed;
    size_t samples;
    size_t unclaimed; /* densities that are 0, negative or not finite */
} exported_bins;

/* Roughness and direction of the views; directions are in degrees. */
typedef struct exported_view {
    float alpha_x, alpha_y;
    double theta, phi;
} exported_view;

enum { EXPORTED_VIEWS = 6 };
extern const exported_view exported_views[EXPORTED_VIEWS];

/* 0 if there is no memory. */
int exported_bins_begin(exported_bins *bins, const vndf_distribution *distribution, const exported_view *view);
vndf_vec3 exported_view_direction(const exported_view *view);

/* Normals x y z with their densities. */
void exported_bins_add(exported_bins *bins, const float (*drawn)[4], size_t count);

/* Prints what was found; returns the chance of a larger statistic, and 0 where a density was none or no normal came. */
double exported_bins_end(exported_bins *bins, const char *name, const exported_view *view);

#endif
