/* What distributions and samplers are measured with: by `vndf check`, `judge` and `bench`, and by the tests. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "vndf_build.h"

/* What decides a test: p-values of chi-square, the level that each of several tests gets, and Pearson's chi-square:
 * counts of samples in bins against what is expected there. The one place that pools bins and decides; `vndf check` and
 * all tests that bin use it. */

/* The chance that chi-square with dof degrees of freedom exceeds the statistic, 1 if dof is 0: relative error below
 * 1e-10 for 1e4 of them where it exceeds 1e-300. */
double statistics_chi_square_p(double statistic, size_t dof);

/* The level of each of n independent tests, so that all of them together err with probability `level`, which is
 * 0 to 1 (Sidak). */
double statistics_sidak(double level, size_t n);

typedef struct pearson {
    double statistic; /* sum of (observed - expected)^2 / expected */
    double p;         /* the chance of a larger one if the samples follow what is expected; 0 without a class */
    size_t classes;   /* classes - 1 degrees of freedom */
} pearson;

/* The bins have to be all there is: both sums are the number of samples. A bin that expects 5 or more is a class; the
 * others are added up in their order until they expect as much, and what is left at the end joins the last class. */
pearson pearson_of(const double *expected, const double *observed, size_t bins);

/* ---- quadrature.c ------------------------------------------------------------------------------ */

/* Integrals over bins of two numbers x and y, of any function, without bias, with an error that is measured. The caller
 * divides the bins into cells, which are rectangles, and answers for all points of a round at once, so that a process
 * may be who answers. */

typedef struct quadrature_point {
    size_t bin;
    double x, y, part; /* of the area in which it stands for the function; of most points 0 */
    double value[2];   /* of the function, and of another one that it is compared with, or 0 */
} quadrature_point;

typedef struct quadrature_sum {
    double value, variance;             /* the integral, and its error squared */
    double distance, square, uncovered; /* of the other one g: half of |f - g|, g^2/f, and of g where f is 0 */
} quadrature_sum;

typedef struct quadrature_cell {
    size_t bin;
    double x[2], y[2];
    int is_asked; /* from here on 0 to begin with: quadrature_run fills it */
    quadrature_sum sum;
    double urgency, along[2]; /* what it may err, of both functions; by how much they vary along x, and along y */
} quadrature_cell;

typedef struct quadrature {
    int (*answer)(void *of, quadrature_point *at, size_t count); /* fills values, which are 0; 0: it gives up */
    void *of;
    size_t bins, most;    /* how many bins, and at most cells */
    double close, finest; /* what a cell may err, and the width along x below which it may err more */
    int rounds;           /* times that points are asked for: a cell is halved less often */
    uint64_t seed;        /* of the points */
    const double
        *observed;  /* NULL or, of each bin, how many of `samples` fell into it: where they are too many or */
    double samples; /* too few, it is looked at more closely */
} quadrature;

/* The integrals over bins. `count` cells are there, and room for `most`. 0 if `answer` gave up or there was no
 * memory. */
int quadrature_run(const quadrature *q, quadrature_cell *cells, size_t count, quadrature_sum *sum);

/* ---- bins.c ------------------------------------------------------------------------------------ */

/* Chi-square of normals against a density of normals, whatever it is, over all that face a direction.
 *
 * The frame is an affine image of the slopes, in polar form (R, a) about the direction, where the median slope is about
 * 1: there the roughness is undone, and at a given R the normals that are seen are those with |a| < A(R). The bins are
 * the product of intervals of R from 0 to infinity and of even intervals of a/A from -1 to 1, so that no border cuts
 * one. The borders of R are quantiles of normals drawn apart from those that are tested, among a fourth as many even in
 * atan(R), so that most bins lie where the normals do; the bins hold all normals whatever they are. */

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

/* ---- stratified.c ------------------------------------------------------------------------------ */

/* What a renderer sees of a sampler's map: the error of light that is reflected, estimated with few Owen-scrambled
 * Sobol points (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995; hashes after Burley, "Practical
 * Hash-based Owen Scrambling", JCGT 2020). A map that folds or jumps loses what the points have over random numbers. */

/* The point `index` of a scrambled sequence, of 24 bits each. */
void stratified_point(uint32_t index, uint32_t scramble, float *u1, float *u2);

/* The root mean square error over scrambled sequences of 64 points, over that of GGX by caps, as rough in the median
 * slope: the geometric mean over six views and two lights. */
double stratified_beside_caps(const vndf_distribution *distribution, float alpha, size_t scrambles, uint64_t seed);

/* ---- stress.c ---------------------------------------------------------------------------------- */

/* Hard cases: what a renderer hands to vndf.h on a bad day. It is the product of incident directions along the axes, a
 * hair beside them, at and beyond the horizon, of length 1 and nearly 1; of roughnesses from 1e-8 to 1e4 in all pairs
 * up to a ratio of 1e8; and of uniform numbers at their ends and at 1/2 in all pairs, and random ones (stress.c lists
 * them). Each property is a number that is 0 at best and must not exceed its limit. */

/* Of a sample; from STRESS_AREA on, of a direction. */
typedef enum stress_id {
    STRESS_UNIT,
    STRESS_ABOVE,
    STRESS_FACING,
    STRESS_POSITIVE,
    STRESS_RETURNED,
    STRESS_AREA,
    STRESS_MIRRORED,
    STRESS_LAMBDA,
    STRESS_G1,
    STRESS_G2,
    STRESS_COUNT
} stress_id;

typedef struct stress_property {
    const char *name, *meaning; /* a word; what the number is, and in which unit */
    double limit;
} stress_property;

extern const stress_property stress_properties[STRESS_COUNT];

/* One input, whole: alpha, wi, wo of G2, u; nine digits of each number give it again. Their names. */
enum { STRESS_NUMBERS = 10 };
extern const char *const stress_numbers[STRESS_NUMBERS];

typedef struct stress_finding {
    size_t checked, failed;
    double worst;                 /* infinite for NaN */
    float number[STRESS_NUMBERS]; /* where the worst was */
} stress_finding;

typedef struct stress_result {
    size_t views, samples;
    size_t outside; /* views left out, whose roughness times the scale of the table they leave [1e-15, 1e15] */
    stress_finding found[STRESS_COUNT];
} stress_result;

/* Every `every`-th view of the product (1: all, some 23000 of 80 samples each; a number prime to 12 and 22 does
 * not favour any direction). */
stress_result stress_run(const vndf_distribution *distribution, size_t every, uint64_t seed);

/* Notes a number for a property; returns whether it is within the limit. */
int stress_note(stress_result *result, stress_id id, double value, const float at[STRESS_NUMBERS]);

/* ---- laws.c ------------------------------------------------------------------------------------ */

/* How far a table is from its source, measured from outside: vndf_pdf, vndf_p22 and vndf_projected_area beside
 * vndf_source_p22, with none of the library's own integrals, so that a fault of a certificate is seen.
 *
 * Given the slope length R a table draws the azimuth exactly, so the density of one normal at R tells the drawn law of
 * R. Both laws are added up over points of R that are as close as D varies, from directions where D says that something
 * happens and many more. */

/* Members of vndf_certificate. */
enum { LAWS_TV, LAWS_TV_ABOVE, LAWS_MAX_WEIGHT, LAWS_AREA_ERROR, LAWS_CONSISTENCY, LAWS_NDF_ERROR, LAWS_FIGURES };

typedef struct laws_figure {
    const char *name;
    double stored, measured, theta; /* the worst, and where it was found, degrees; NaN for ndf_error */
    int good;                       /* it is at most a tenth, or 2e-5, worse than stored */
} laws_figure;

/* `per_octave` directions in each octave of cot(theta), on both sides of the horizon, and some hundred more: 4 are
 * within a few percent. What rounding of directions and normals explains is taken off. 0: no memory, or `progress`,
 * which may be NULL, said to stop. */
int laws_measure(const vndf_distribution *table, const vndf_source *source, int per_octave,
                 vndf_progress *progress, void *user, laws_figure found[LAWS_FIGURES]);
