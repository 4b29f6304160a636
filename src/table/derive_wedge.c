/* Scales the azimuth rows of a wedge to mass 1, and makes their running sums, the pieces of the area spline and the
 * guides of both. */
#include "table/derive.h"

#include <math.h>

#include "table/area_piece.h"
#include "table/guide.h"
#include "table/layout.h"

/* Running sums of each row, and each row scaled to mass 1 - but for rounding, so that a table saved and read again
 * keeps its bits; padding is beyond every target. */
static void derive_rows(vndf_wedge *wedge)
{
    for (uint32_t i = 0; i < wedge->row_count; i++) {
        float *cdf = wedge->cdf + (size_t)i * wedge->stride;
        vndf_row_cell *cell = vndf_row_cells(wedge, i);
        double total = 0.0, sum = 0.0;
        for (uint32_t j = 0; j < wedge->cell_count; j++)
            total += cell[j].mass;
        if (fabs(total - 1.0) < 3e-7)
            total = 1.0;
        for (uint32_t j = 0; j < wedge->stride; j++) {
            cdf[j] = j < wedge->cell_count ? (float)(sum / total) : 2.0f;
            sum += j < wedge->cell_count ? cell[j].mass : 0.0f;
        }
        for (uint32_t j = 0; j <= wedge->cell_count; j++) {
            cell[j].mass = (float)(cell[j].mass / total);
            cell[j].density = (float)(cell[j].density / total);
        }
    }
}

/* Piece i in double, and in float. */
static vndf_area_span area_span(const vndf_wedge *wedge, uint32_t i)
{
    double begin = wedge->knot_y[i], width = wedge->knot_y[i + 1] - begin;
    vndf_area_knot from = {wedge->mass[i], wedge->slope[i], wedge->curve[i]};
    vndf_area_knot to = {wedge->mass[i + 1], wedge->slope[i + 1], wedge->curve[i + 1]};
    vndf_area_span span = {.begin = begin, .per_width = 1.0 / width};
    vndf_area_piece(width, from, to, span.coefficient);
    return span;
}

/* Bernstein coefficients times their binomials become powers of y - begin. */
static vndf_area_quick area_quick(const vndf_area_span *span)
{
    static const double from[VNDF_AREA_ORDER][VNDF_AREA_ORDER] = {
        {1}, {-5, 1}, {10, -4, 1}, {-10, 6, -3, 1}, {5, -4, 3, -2, 1}, {-1, 1, -1, 1, -1, 1}};
    vndf_area_quick quick = {.begin = (float)span->begin, .per_width = (float)span->per_width};
    double power = 1.0;
    for (int n = 0; n < VNDF_AREA_ORDER; n++, power *= span->per_width) {
        double sum = 0.0;
        for (int i = 0; i <= n; i++)
            sum += from[n][i] * span->coefficient[i];
        quick.coefficient[n] = (float)(power * sum);
    }
    return quick;
}

/* The spline of a wedge's mass, piece by piece. */
static void derive_area(vndf_wedge *wedge)
{
    for (uint32_t i = 0; i + 1 < wedge->knot_count; i++) {
        wedge->piece[i] = area_span(wedge, i);
        if (wedge->quick)
            wedge->quick[i] = area_quick(&wedge->piece[i]);
    }
}

static void derive_row_spans(vndf_wedge *wedge)
{
    uint32_t last = vndf_row_knots(wedge->row_count) - 1;
    for (uint32_t i = 0; i <= last; i++)
        wedge->row_span[i].begin = wedge->row_y[i];
    for (uint32_t i = 0; i < last; i++) {
        vndf_row_span *span = &wedge->row_span[i];
        span->per_width = (float)(1.0 / ((double)span[1].begin - span->begin));
        span->p[2] = span[1].p[0];
        span->r[2] = span[1].r[0];
    }
}

int vndf_derive_wedge(vndf_wedge *wedge)
{
    derive_rows(wedge);
    derive_row_spans(wedge);
    derive_area(wedge);
    vndf_derive_lanes(wedge);
    return vndf_guide_make(&wedge->row_guide, wedge->row_y, vndf_row_knots(wedge->row_count)) &&
           vndf_guide_make(&wedge->knot_guide, wedge->knot_y, wedge->knot_count);
}
