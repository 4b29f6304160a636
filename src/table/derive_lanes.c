/* Copies numbers of a wedge into the orders in which lanes load them: cells of rows as lines of four floats; and
 * member by member what is few enough to be looked up in registers. */
#include "table/derive.h"
#include "table/layout.h"

static void derive_row_lines(vndf_wedge *wedge)
{
    vndf_row_line *line = wedge->row_line;
    for (uint32_t i = 0; i < wedge->row_count; i++) {
        const vndf_row_cell *cell = vndf_row_cells(wedge, i);
        for (uint32_t j = 0; j < wedge->cell_count; j++, line++) {
            line->before = wedge->cdf[(size_t)i * wedge->stride + j];
            line->mass = cell[j].mass;
            line->begin = cell[j].density;
            line->end = cell[j + 1].density;
        }
    }
}

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
}

void vndf_derive_lanes(vndf_wedge *wedge)
{
    if (wedge->row_line)
        derive_row_lines(wedge);
    if (wedge->few_aspects)
        derive_few_rows(wedge);
    if (wedge->few)
        derive_few(wedge);
    if (wedge->few_exact)
        derive_few_exact(wedge);
}
