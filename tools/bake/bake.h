/* Tables that real-time engines and path tracers look up in the place of samples, for any distribution: `vndf bake`.
 *
 *     dfg        the split sum: f is f0 times the scale plus the bias
 *     energy     what one scattering event keeps of the light, by itself and in the mean over all directions
 *     ltc        a linearly transformed cosine for each roughness and cosine, or for two roughnesses (Heitz, Dupuy,
 *                Hill & Neubauer, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", TOG 35(4),
 *                2016)
 *     prefilter  normals with weights, for environments that are looked up at N = V = R (Karis, "Real Shading in
 *                Unreal Engine 4", 2013)
 */
#pragma once

#include "cli/progress.h"
#include "draw/page.h"
#include "vndf_bsdf.h"

/* How the roughness that a texture holds becomes alpha. */
typedef enum bake_mapping { BAKE_SQUARE, BAKE_LINEAR, BAKE_ROOT } bake_mapping;

/* The tables of energy as a host has them. */
typedef enum bake_shape { BAKE_GRID, BAKE_CYCLES, BAKE_OSPRAY } bake_shape;

float bake_alpha(bake_mapping mapping, double roughness);

typedef struct bake_settings {
    const vndf_distribution *distribution;
    bake_mapping mapping;
    vndf_masking masking;
    int masks_alike; /* what passes has 1/(1 + Lambda_i + Lambda_o), as in Cycles and OSPRay, not the Beta function */
    bake_shape shape;
    size_t size; /* of dfg and ltc: size x size */
    progress *progress;
} bake_settings;

enum { BAKE_AXES = 3, BAKE_CHANNELS = 4, BAKE_TABLES = 16 };

/* Numbers on a grid: channels run fastest, then the last axis. */
typedef struct baked {
    const char *name;            /* of its files: "dfg" */
    const char *holds;           /* what the channels are */
    const char *axis[BAKE_AXES]; /* what they stand for, with range and places */
    size_t count[BAKE_AXES];
    int axes, channels;
    float *value;      /* owned */
    const char *error; /* what was compared, NULL: nothing, and the largest and mean difference */
    double worst, mean;
} baked;

size_t baked_size(const baked *b);

typedef struct baked_list {
    baked table[BAKE_TABLES];
    size_t count;
} baked_list;

/* A table of zeros at the end of the list; NULL if there is no memory. `axis` and `count` of those that are used. */
baked *baked_add(baked_list *list, const char *name, const char *holds, int axes, const char *const *axis,
                 const size_t *count, int channels);
void baked_free(baked_list *list);

/* ---- one direction (integrals.c) ---- */

/* Room for samples from one direction: their numbers, and what vndf_bsdf_sample_n makes of them. */
enum { BAKE_SIDE = 96, BAKE_SIDE_GLASS = 64, BAKE_POINTS = BAKE_SIDE * BAKE_SIDE };
typedef struct bake_points {
    float wi[3], u[3][BAKE_POINTS], wo[3][BAKE_POINTS], density[BAKE_POINTS], weight[2][BAKE_POINTS];
    uint8_t lobe[BAKE_POINTS];
} bake_points;

/* Samples with the numbers in `u`, of a material of one or two wavelengths. */
void bake_sample(const vndf_material *material, const double wi[3], size_t count, bake_points *points);
vndf_bsdf_batch bake_batch(const vndf_material *material, const float wi[3], size_t count);

/* A mirror of two wavelengths: F = 1, and Schlick's F of f0 = 0. */
vndf_description bake_mirror(const bake_settings *s, float alpha);

/* The mean weights of samples from one direction; with `masks_alike` those of bake_settings. */
typedef struct bake_sum {
    double all, grazing; /* by wavelength */
} bake_sum;
bake_sum bake_mean(const vndf_description *of, const double wi[3], int side, int masks_alike);

/* What such a mirror reflects of the light, within 3e-4 (tests/bake); with eta above 0 in `all` what both lobes of a
 * dielectric keep from the side of z, within 5e-4, where eta < 1 within 3e-3. */
bake_sum bake_direction(const bake_settings *s, float alpha, double cosine, double eta);

/* The same by a quadrature over slopes that draws nothing, from D, Lambda and the law of reflection. */
bake_sum bake_reference(const bake_settings *s, float alpha, double cosine, double eta);

/* 2 integral E mu dmu by 8 nodes. */
double bake_average(const bake_settings *s, float alpha, double eta);

/* ---- tables; 0 if there is no memory or the user asked to stop ---- */

int bake_dfg(const bake_settings *s, baked_list *list);
int bake_energy(const bake_settings *s, baked_list *list);
int bake_ltc(const bake_settings *s, baked_list *list);
int bake_prefilter(const bake_settings *s, baked_list *list);

/* For alpha_x and alpha_y that differ, on a grid of so many places in each of four numbers, or of the size if less. */
enum { BAKE_ANISOTROPIC = 8 };
int bake_anisotropic(const bake_settings *s, baked_list *list);

/* A linearly transformed cosine: the inverse of M over its middle number, by rows. */
typedef struct bake_cosine {
    double inverse[3][3];
} bake_cosine;

/* The density of a direction. */
double bake_cosine_density(const bake_cosine *c, const double wo[3]);

/* ---- files (files.c) ---- */

/* As --format has them; the picture is always written. */
typedef enum bake_form { BAKE_NPY, BAKE_DDS, BAKE_C, BAKE_GLSL, BAKE_JS, BAKE_PICTURE } bake_form;

/* A page about all tables, with their files in these forms, a bit each; `made_by` is the command. 0 after a
 * complaint. */
int bake_page(html_page *page, const baked_list *list, unsigned forms, const char *made_by, const char *subject);

/* The half float nearest to x, ties to even; what is too large is infinite. */
unsigned bake_half(float x);
