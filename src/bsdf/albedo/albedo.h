/* The table of albedos in memory, and how it is looked up: with + - * / sqrt and comparisons alone, in float.
 *
 * With a = scale alpha, the median slope, and c = |cos_i|, the coordinates of the grid are
 *
 *     x = (t + t^(1/4))/2,  t = c (1 + K a)/(c + K a)         from X to 1
 *     y = (a (1 + Q A)/(A (1 + Q a)))^(1/2),  A the largest a from 0 to 1
 *
 * E changes where c is of the size of a, at any roughness: in x that is one place, and E as a function of x tends
 * to a limit for a = 0. Near c = 0 1 - E falls as c log c or as a low power of c, which a root makes smooth;
 * elsewhere x is nearly even in c. What a dielectric transmits falls by a power so low that no root helps: there
 * the grid begins at X > 0.
 *
 * What is reflected of E changes with the cosine at any roughness, as F does: its coordinate is x for t = c.
 *
 * On the grid E is a tensor product of uniform cubic B-splines that meets the quadrature in the nodes: each look-up
 * is a sum over 4 x 4 coefficients. The result is clamped to [0, 1]. */
#ifndef VNDF_BSDF_ALBEDO_ALBEDO_H
#define VNDF_BSDF_ALBEDO_ALBEDO_H

#include <math.h>
#include <stdint.h>

#include "core/inline.h"
#include "vndf_albedo.h"

enum {
    VNDF_ALBEDO_REFINED = 4, /* nodes of averages to a row of the grid */
    VNDF_ALBEDO_LAYERS = 4   /* of a dielectric: from the side of z E, reflected; from the other side the same */
};

struct vndf_albedo {
    vndf_albedo_properties is;
    uint32_t layers;     /* 1: a mirror's E */
    float *value;        /* layers x (rows + 2) x (columns + 2) coefficients: single look-ups read them */
    float *average;      /* layers x (averages + 2) coefficients; follows in the block of `value` */
    uint32_t averages;   /* nodes of the averages, from y = 0 to 1 */
    char *source, *tool; /* owned */
};

static const float vndf_albedo_knee = 4.0f;   /* K */
static const float vndf_albedo_bend = 0.25f;  /* Q */
static const float vndf_albedo_least = 0.03f; /* X of a dielectric */

/* A place on a uniform grid: the first of four coefficients, and their weights. */
typedef struct vndf_albedo_place {
    uint32_t first;
    float weight[4];
} vndf_albedo_place;

/* at in [0, 1]; nodes >= 2. */
VNDF_INLINE vndf_albedo_place vndf_albedo_place_of(float at, uint32_t nodes)
{
    float scaled = at * (float)(nodes - 1);
    uint32_t first = (uint32_t)scaled;
    first = first < nodes - 1 ? first : nodes - 2;
    float f = scaled - (float)first, g = 1.0f - f, f2 = f * f, g2 = g * g;
    vndf_albedo_place place = {first,
                               {g2 * g * (1.0f / 6.0f), (4.0f - 3.0f * f2 * (1.0f + g)) * (1.0f / 6.0f),
                                (4.0f - 3.0f * g2 * (1.0f + f)) * (1.0f / 6.0f), f2 * f * (1.0f / 6.0f)}};
    return place;
}

/* NaN becomes 0. */
VNDF_INLINE float vndf_albedo_clamp(float value, float most)
{
    return value > 0.0f ? value < most ? value : most : 0.0f;
}

/* a, from any alpha. */
VNDF_INLINE float vndf_albedo_slope(const vndf_albedo *albedo, float alpha)
{
    return vndf_albedo_clamp(alpha, VNDF_ALBEDO_ALPHA_MAX) * albedo->is.scale;
}

VNDF_INLINE float vndf_albedo_y(const vndf_albedo *albedo, float slope)
{
    float most = VNDF_ALBEDO_ALPHA_MAX * albedo->is.scale;
    return vndf_albedo_clamp(
        sqrtf(slope * (1.0f + vndf_albedo_bend * most) / (most * (1.0f + vndf_albedo_bend * slope))), 1.0f);
}

/* X. */
VNDF_INLINE float vndf_albedo_from(const vndf_albedo *albedo)
{
    return albedo->layers > 1 ? vndf_albedo_least : 0.0f;
}

/* Of a cosine in [0, 1], for one layer: those of E have even numbers. */
VNDF_INLINE float vndf_albedo_x(const vndf_albedo *albedo, uint32_t layer, float cosine, float slope)
{
    float bend = vndf_albedo_knee * slope, sum = cosine + bend;
    float t = layer % 2 == 1 ? cosine : sum > 0.0f ? cosine * (1.0f + bend) / sum : 0.0f;
    float x = 0.5f * (t + sqrtf(sqrtf(t))), least = vndf_albedo_from(albedo);
    return vndf_albedo_clamp((x - least) / (1.0f - least), 1.0f);
}

VNDF_INLINE float vndf_albedo_sum(const float *coefficient, const vndf_albedo_place *place)
{
    const float *c = coefficient + place->first;
    return (c[0] * place->weight[0] + c[1] * place->weight[1]) +
           (c[2] * place->weight[2] + c[3] * place->weight[3]);
}

/* Of one layer, in [0, 1]. */
VNDF_INLINE float vndf_albedo_value(const vndf_albedo *albedo, uint32_t layer, const vndf_albedo_place *x,
                                    const vndf_albedo_place *y)
{
    uint32_t pitch = (uint32_t)albedo->is.columns + 2, rows = (uint32_t)albedo->is.rows + 2;
    const float *row = albedo->value + (layer * rows + y->first) * pitch;
    float sum = 0.0f;
    for (int i = 0; i < 4; i++)
        sum += y->weight[i] * vndf_albedo_sum(row + (uint32_t)i * pitch, x);
    return vndf_albedo_clamp(sum, 1.0f);
}

VNDF_INLINE float vndf_albedo_average_value(const vndf_albedo *albedo, uint32_t layer, const vndf_albedo_place *y)
{
    return vndf_albedo_clamp(vndf_albedo_sum(albedo->average + layer * (albedo->averages + 2), y), 1.0f);
}

/* The first of two layers of a side. */
VNDF_INLINE uint32_t vndf_albedo_side(const vndf_albedo *albedo, int other)
{
    return albedo->layers > 1 && other ? 2 : 0;
}

/* The table of this size with room for its coefficients, to be freed with vndf_albedo_free; NULL if there is no
 * memory. */
vndf_albedo *vndf_albedo_allocate(uint32_t columns, uint32_t rows, uint32_t layers);

/* Floats in it. */
size_t vndf_albedo_count(const vndf_albedo *albedo);

#endif
