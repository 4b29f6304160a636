/* Chi-square of normals against a density of normals, whatever it is, over all that face a direction.
 *
 * The frame is an affine image of the slopes, in polar form (R, a) about the direction, where the median slope is about
 * 1: there the roughness is undone, and at a given R the normals that are seen are those with |a| < A(R). The bins are
 * the product of intervals of R from 0 to infinity and of even intervals of a/A from -1 to 1, so that no border cuts
 * one. The borders of R are quantiles of normals drawn apart from those that are tested, among a fourth as many even in
 * atan(R), so that most bins lie where the normals do; the bins hold all normals whatever they are. */
#ifndef TOOLS_EVIDENCE_MEASURE_BINS_H
#define TOOLS_EVIDENCE_MEASURE_BINS_H

#include <stddef.h>
#include <stdint.h>

#include "evidence/measure/quadrature.h"
#include "evidence/measure/statistics.h"
#include "vndf.h"

typedef struct bins_frame {
    double xx, xy, yx, yy, mean_x, mean_y, det; /* slope = M (R cos, R sin) + mean, after a turn by (x, y) */
    double s, c, x, y;                          /* the direction in it: (s, 0, c) */
} bins_frame;

/* Of the matrix of a surface times its distribution's median slope, its mean slope, and wi. */
bins_frame bins_frame_of(const vndf_surface *surface, vndf_vec3 wi);

/* The normal where its slopes are over the matrix, unit, turned to wi. */
void bins_over(const bins_frame *f, vndf_vec3 wm, double n[3]);

/* How far two normals are apart where their slopes are over the matrix, as unit vectors. */
double bins_apart(const bins_frame *f, vndf_vec3 a, vndf_vec3 b);

/* What draws normals, and the density that they should have. */
typedef struct bins_sampler {
    bins_frame frame;
    vndf_vec3 (*draw)(const void *of, float u1, float u2, float *pdf);
    float (*pdf)(const void *of, vndf_vec3 wm);
    const void *of;
} bins_sampler;

/* Of a view of the library's; it has to outlive the sampler. */
bins_sampler bins_of_view(const vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

enum { BINS_RINGS = 65, BINS_SECTORS = 48, BINS_COUNT = BINS_RINGS * BINS_SECTORS };

typedef struct bins_result {
    pearson found;
    double mass, error; /* the integral of the density; and what it may err: four standard deviations, and by how
                           much one rounding of normals may move it; -1: there was no memory for it */
    size_t unseen;      /* samples whose density is not a positive float */
    double slope[BINS_RINGS + 1];   /* borders of R, ascending */
    quadrature_sum sum[BINS_COUNT]; /* ring by ring */
} bins_result;

bins_result bins_chi_square(const bins_sampler *judged, size_t samples, uint64_t seed);

/* The bin of a normal. */
size_t bins_bin(const bins_frame *f, const double slope[BINS_RINGS + 1], vndf_vec3 wm);

/* ---- for bins of other kinds --------------------------------------------------------------------- */

/* Borders that are quantiles of samples, the first of `at`, and of a fourth as many even numbers, which are put behind
 * them. */
enum { BINS_PILOTS = 4000, BINS_EVEN = BINS_PILOTS / 4 };
void bins_borders(double *border, size_t parts, double low, double high, double at[BINS_PILOTS + BINS_EVEN]);

/* Which of `parts` intervals of ascending borders holds x. */
size_t bins_interval(const double *border, size_t parts, double x);

/* A cell for each bin that is not empty, bin by bin from the one that is `first`; returns how many. */
size_t bins_cells(const double *x, size_t rings, const double *y, size_t sectors, size_t first,
                  quadrature_cell *to);

#endif
