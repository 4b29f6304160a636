/* Copies numbers of a wedge into the order in which lanes load them: member by member, where they are few enough to be
 * looked up in registers. */
#include "table/derive.h"
#include "table/layout.h"

/* Pieces as they are looked up in registers: a member of all side by side. Beyond the last all y are less. */
static void derive_few_exact(vndf_wedge *wedge)
{
    const uint32_t pitch = wedge->few_pitch, pieces = wedge->knot_count - 1;
    double *begin = wedge->few_exact + VNDF_AREA_ORDER * pitch;
    for (uint32_t i = 0; i < pieces; i++) {
        const vndf_area_span *span = &wedge->piece[i];
        for (uint32_t n = 0; n < VNDF_AREA_ORDER; n++)
            wedge->few_exact[n * pitch + i] = span->coefficient[n];
        begin[i] = span->begin;
        begin[pitch + i] = span->per_width;
    }
    for (uint32_t i = pieces; i < pitch; i++)
        begin[i] = 2.0;
}

static void derive_few(vndf_wedge *wedge)
{
    const uint32_t pitch = wedge->few_pitch;
    float *begin = wedge->few + VNDF_AREA_ORDER * pitch;
    for (uint32_t i = 0; i + 1 < wedge->knot_count; i++) {
        const vndf_area_quick *quick = &wedge->quick[i];
        for (uint32_t n = 0; n < VNDF_AREA_ORDER; n++)
            wedge->few[n * pitch + i] = quick->coefficient[n];
        begin[i] = quick->begin;
        begin[pitch + i] = quick->per_width;
    }
}

/* Rows likewise. */
static void derive_few_rows(vndf_wedge *wedge)
{
    const uint32_t knots = vndf_row_knots(wedge->row_count);
    for (uint32_t i = knots; i <= VNDF_FEW; i++)
        wedge->row_y[i] = 2.0f;
    for (uint32_t i = 0; i < wedge->row_count; i++) {
        wedge->few_aspects[i % 2 * knots + i / 2] = *vndf_aspect_p(wedge, i);
        wedge->few_aspects[(2 + i % 2) * knots + i / 2] = *vndf_aspect_r(wedge, i);
    }
    for (uint32_t i = 0; i + 1 < knots; i++)
        wedge->few_aspects[4 * knots + i] = wedge->row_span[i].per_width;
}

static void derive_few_cdf(vndf_wedge *wedge)
{
    const uint32_t knots = vndf_row_knots(wedge->row_count);
    float *to = wedge->few_cdf;
    for (uint32_t j = 1; j < wedge->cell_count; j++, to += wedge->row_count)
        for (uint32_t i = 0; i < wedge->row_count; i++)
            to[i % 2 * knots + i / 2] = wedge->cdf[(size_t)i * wedge->stride + j];
}

void vndf_derive_lanes(vndf_wedge *wedge)
{
    if (wedge->few_aspects)
        derive_few_rows(wedge);
    if (wedge->few_cdf)
        derive_few_cdf(wedge);
    if (wedge->few)
        derive_few(wedge);
    if (wedge->few_exact)
        derive_few_exact(wedge);
}
