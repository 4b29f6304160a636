#include "bsdf/albedo/albedo.h"

#include <stdlib.h>

/* ---- memory -------------------------------------------------------------------------------------- */

size_t vndf_albedo_count(const vndf_albedo *albedo)
{
    size_t grid = ((size_t)albedo->is.columns + 2) * ((size_t)albedo->is.rows + 2);
    return albedo->layers * (grid + albedo->averages + 2);
}

vndf_albedo *vndf_albedo_allocate(uint32_t columns, uint32_t rows, uint32_t layers)
{
    vndf_albedo *albedo = calloc(1, sizeof *albedo);
    if (!albedo)
        return NULL;
    albedo->is.columns = (int)columns;
    albedo->is.rows = (int)rows;
    albedo->layers = layers;
    albedo->averages = VNDF_ALBEDO_REFINED * (rows - 1) + 1;
    albedo->is.values = vndf_albedo_count(albedo);
    albedo->value = calloc(albedo->is.values, sizeof *albedo->value);
    if (!albedo->value) {
        free(albedo);
        return NULL;
    }
    albedo->average = albedo->value + layers * (columns + 2) * (rows + 2);
    return albedo;
}

void vndf_albedo_free(vndf_albedo *albedo)
{
    if (!albedo)
        return;
    free(albedo->value);
    free(albedo->source);
    free(albedo->tool);
    free(albedo);
}

/* ---- looking up ---------------------------------------------------------------------------------- */

/* One layer for a direction. */
VNDF_INLINE float look_up(const vndf_albedo *albedo, uint32_t layer, float cosine, float alpha)
{
    float slope = vndf_albedo_slope(albedo, alpha), up = vndf_albedo_clamp(fabsf(cosine), 1.0f);
    vndf_albedo_place x =
        vndf_albedo_place_of(vndf_albedo_x(albedo, layer, up, slope), (uint32_t)albedo->is.columns);
    vndf_albedo_place y = vndf_albedo_place_of(vndf_albedo_y(albedo, slope), (uint32_t)albedo->is.rows);
    return vndf_albedo_value(albedo, layer, &x, &y);
}

float vndf_albedo_directional(const vndf_albedo *albedo, float cosine, float alpha)
{
    return albedo ? look_up(albedo, vndf_albedo_side(albedo, cosine < 0.0f), cosine, alpha) : 1.0f;
}

/* What is reflected is a part of the whole. */
VNDF_INLINE vndf_albedo_parts parts_of(float whole, float reflected)
{
    float least = reflected < whole ? reflected : whole;
    vndf_albedo_parts parts = {least, whole - least};
    return parts;
}

vndf_albedo_parts vndf_albedo_split(const vndf_albedo *albedo, float cosine, float alpha)
{
    float whole = vndf_albedo_directional(albedo, cosine, alpha);
    if (!albedo || albedo->layers == 1)
        return parts_of(whole, whole);
    return parts_of(whole, look_up(albedo, vndf_albedo_side(albedo, cosine < 0.0f) + 1, cosine, alpha));
}

VNDF_INLINE vndf_albedo_place average_place(const vndf_albedo *albedo, float alpha)
{
    return vndf_albedo_place_of(vndf_albedo_y(albedo, vndf_albedo_slope(albedo, alpha)), albedo->averages);
}

float vndf_albedo_average(const vndf_albedo *albedo, float alpha, int side)
{
    if (!albedo)
        return 1.0f;
    vndf_albedo_place y = average_place(albedo, alpha);
    return vndf_albedo_average_value(albedo, vndf_albedo_side(albedo, side < 0), &y);
}

vndf_albedo_parts vndf_albedo_average_split(const vndf_albedo *albedo, float alpha, int side)
{
    if (!albedo)
        return parts_of(1.0f, 1.0f);
    vndf_albedo_place y = average_place(albedo, alpha);
    uint32_t layer = vndf_albedo_side(albedo, side < 0);
    float whole = vndf_albedo_average_value(albedo, layer, &y);
    return parts_of(whole, albedo->layers > 1 ? vndf_albedo_average_value(albedo, layer + 1, &y) : whole);
}

/* ---- what it is ---------------------------------------------------------------------------------- */

vndf_albedo_properties vndf_albedo_info(const vndf_albedo *albedo)
{
    if (albedo)
        return albedo->is;
    vndf_albedo_properties nothing = {.source = "", .tool = ""};
    return nothing;
}
