#include "table/layout.h"

#include <math.h>
#include <stdlib.h>

#include "table/area_piece.h"
#include "table/guide.h"
#include "table/moment_cubic.h"
#include "table/steep.h"
#include "table/window.h"

/* The eight arrays in one block. */
static int allocate_knots(vndf_knots *knots, uint32_t count, uint32_t multiple)
{
    uint32_t padded = (count + VNDF_WINDOW + multiple - 1) / multiple * multiple;
    float *block = calloc((size_t)8 * padded, sizeof *block);
    knots->count = padded;
    knots->x = block;
    if (!block)
        return 0;
    knots->z = block + padded;
    knots->e = block + 2 * (size_t)padded;
    knots->g = block + 3 * (size_t)padded;
    knots->s = block + 4 * (size_t)padded;
    knots->t = block + 5 * (size_t)padded;
    knots->f0 = block + 6 * (size_t)padded;
    knots->f1 = block + 7 * (size_t)padded;
    return 1;
}

static int allocate_wedge(vndf_wedge *wedge, uint32_t cells, uint32_t rows, uint32_t knots)
{
    uint32_t stride = (cells + VNDF_PADDING - 1) / VNDF_PADDING * VNDF_PADDING;
    size_t row_floats = (size_t)rows * stride, ends = (size_t)rows * (cells + 1), row_knots = vndf_row_knots(rows);
    size_t per_rows = row_knots + 2 * (size_t)rows, per_knots = 4 * (size_t)knots;
    float *block = calloc(2 * row_floats + ends + per_rows + per_knots + cells + 1 + VNDF_FEW, sizeof *block);
    wedge->cell_count = cells;
    wedge->row_count = rows;
    wedge->knot_count = knots;
    wedge->stride = stride;
    wedge->cdf = block;
    size_t per_piece = sizeof *wedge->piece + sizeof *wedge->quick;
    wedge->piece =
        calloc(1, knots * per_piece + row_floats * sizeof *wedge->row_cell + row_knots * sizeof *wedge->row_span);
    if (!block || !wedge->piece)
        return 0;
    wedge->quick = (vndf_area_quick *)(wedge->piece + knots);
    wedge->row_cell = (vndf_row_cell *)(wedge->quick + knots);
    wedge->row_span = (vndf_row_span *)(wedge->row_cell + row_floats);
    wedge->cell_mass = block + row_floats;
    wedge->density = block + 2 * row_floats;
    wedge->row_y = wedge->density + ends;
    wedge->aspect_p = wedge->row_y + row_knots;
    wedge->aspect_r = wedge->aspect_p + rows;
    wedge->knot_y = wedge->aspect_r + rows;
    wedge->mass = wedge->knot_y + knots;
    wedge->slope = wedge->mass + knots;
    wedge->curve = wedge->slope + knots;
    wedge->q = wedge->curve + knots;
    return 1;
}

static void free_wedge(vndf_wedge *wedge)
{
    free(wedge->cdf);
    free(wedge->piece);
    vndf_guide_free(&wedge->row_guide);
    vndf_guide_free(&wedge->knot_guide);
}

/* Each on a line of the cache, which calloc does not promise. */
static int allocate_cells(vndf_distribution *table, uint32_t count)
{
    size_t line = sizeof *table->cells;
    table->cells_memory = calloc((size_t)count + 1, line);
    if (!table->cells_memory)
        return 0;
    size_t past = (uintptr_t)table->cells_memory % line;
    table->cells = (vndf_radial_cell *)((char *)table->cells_memory + (past > 0 ? line - past : 0));
    return 1;
}

vndf_distribution *vndf_table_allocate(vndf_table_size size)
{
    vndf_distribution *table = calloc(1, sizeof *table);
    if (!table)
        return NULL;
    table->kind = VNDF_KIND_TABLE;
    table->radial_count = size.radial;
    table->slope = calloc(size.radial + 1, sizeof *table->slope);
    int whole = allocate_cells(table, size.radial);
    whole &= allocate_knots(&table->knots, size.radial + 1, VNDF_BLOCK);
    whole &= allocate_knots(&table->blocks, size.radial / VNDF_BLOCK + 1, VNDF_PADDING);
    whole &= allocate_wedge(&table->above, size.above_cells, size.above_rows, size.above_knots);
    whole &= allocate_wedge(&table->below, size.below_cells, size.below_rows, size.below_knots);
    if (whole && table->slope)
        return table;
    vndf_free(table);
    return NULL;
}

void vndf_free(vndf_distribution *table)
{
    if (!table || table->kind != VNDF_KIND_TABLE)
        return;
    free(table->knots.x);
    free(table->blocks.x);
    free(table->slope);
    free(table->cells_memory);
    vndf_guide_free(&table->slope_guide);
    free_wedge(&table->above);
    free_wedge(&table->below);
    free((char *)table->source);
    free((char *)table->tool);
    free(table);
}

/* X1 Z0 - X0 Z1. */
static double width_of(const vndf_knots *k, uint32_t j)
{
    return (double)k->x[j + 1] * k->z[j] - (double)k->x[j] * k->z[j + 1];
}

/* Whether (|e1 - e0| + 3 |e0 + e1 - 2 mass|) X1 Z0 <= VNDF_STEEP_CELL min(e0, e1, mass) width for W1/W0 = ratio; convex in it,
 * as W1/W0 is between two. */
static int is_calm_at(const vndf_radial_cell *cell, double reach, double ratio)
{
    double e0 = cell->f0, e1 = cell->f1 * ratio, mass = cell->mu0 + cell->mu1 * ratio;
    double change = fabs(e1 - e0) + 3.0 * fabs(e0 + e1 - 2.0 * mass);
    return change * reach <= VNDF_STEEP_CELL * fmin(fmin(e0, e1), mass) * cell->width;
}

static void derive_cells(vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        vndf_radial_cell *cell = &table->cells[j];
        vndf_moment_cubic cubic = vndf_moment_cubic_from(cell->f0, cell->f1, cell->mu0, cell->mu1);
        cell->a = (float)cubic.a;
        cell->b = (float)cubic.b;
        cell->width = (float)width_of(&table->knots, j);
        double x0 = table->knots.x[j], x1 = table->knots.x[j + 1];
        double z0 = table->knots.z[j], z1 = table->knots.z[j + 1];
        cell->calm =
            x0 > 0.0 && z1 > 0.0 && is_calm_at(cell, x1 * z0, z1 / z0) && is_calm_at(cell, x1 * z0, x1 / x0);
    }
}

/* Whether a cell and the next are calm, and D the same on both sides of the knot between them. */
static int is_smooth_after(const vndf_radial_cell *cell)
{
    double left = cell[0].f1 / (double)cell[0].width, right = cell[1].f0 / (double)cell[1].width;
    return cell[0].calm > 0.0f && cell[1].calm > 0.0f && fabs(left - right) <= VNDF_STEEP_KNOT * right;
}

static void derive_smooth(vndf_distribution *table)
{
    int before = 0;
    for (uint32_t j = 0; j + 1 < table->radial_count; j++) {
        int after = is_smooth_after(&table->cells[j]);
        if (before && after)
            table->cells[j].calm = 2.0f;
        before = after;
    }
}

/* What a cell repeats of its knots. */
static void derive_copies(vndf_distribution *table)
{
    const vndf_knots *k = &table->knots;
    for (uint32_t j = 0; j < table->radial_count; j++) {
        vndf_radial_cell *cell = &table->cells[j];
        cell->x0 = k->x[j];
        cell->x1 = k->x[j + 1];
        cell->z0 = k->z[j];
        cell->z1 = k->z[j + 1];
        cell->before0 = k->f0[j];
        cell->before1 = k->f1[j];
        cell->e = k->e[j];
        cell->g = k->g[j];
    }
}

/* F1 and E = F0 - F1 z/x from the pole outwards; every term is positive, so nothing cancels. */
static void derive_pole(vndf_distribution *table)
{
    vndf_knots *k = &table->knots;
    double e = 0.0, f0 = 0.0, f1 = 0.0;
    for (uint32_t j = 0; j < table->radial_count; j++) {
        double mu0 = table->cells[j].mu0, mu1 = table->cells[j].mu1, x1 = k->x[j + 1], width = width_of(k, j);
        e += (j ? f1 * width / (k->x[j] * x1) : 0.0) + mu0 * width / x1;
        f0 += k->z[j] * mu0 + k->z[j + 1] * mu1;
        f1 += k->x[j] * mu0 + x1 * mu1;
        k->e[j + 1] = (float)e;
        k->g[j + 1] = (float)(f1 / x1);
        k->f0[j + 1] = (float)f0;
        k->f1[j + 1] = (float)f1;
    }
    table->f0_total = (float)f0;
    table->f1_total = (float)f1;
}

/* T0 and S = T1 - T0 x/z from infinity inwards. */
static void derive_tail(vndf_distribution *table)
{
    vndf_knots *k = &table->knots;
    double s = 0.0, t0 = 0.0;
    for (uint32_t j = table->radial_count; j-- > 0;) {
        double mu0 = table->cells[j].mu0, mu1 = table->cells[j].mu1;
        double z0 = k->z[j], z1 = k->z[j + 1], width = width_of(k, j);
        s += (z1 > 0 ? t0 * width / (z0 * z1) : 0.0) + mu1 * width / z0;
        t0 += z0 * mu0 + z1 * mu1;
        k->s[j] = (float)s;
        k->t[j] = (float)(t0 / z0);
    }
}

/* Sums that are beyond every target from the pole, and below every one from the tail. */
static void pad_knots(vndf_knots *k, uint32_t from)
{
    for (uint32_t j = from; j < k->count; j++) {
        k->x[j] = 1.0f;
        k->z[j] = k->s[j] = k->t[j] = 0.0f;
        k->e[j] = k->g[j] = k->f0[j] = k->f1[j] = 1e30f;
    }
}

static void derive_blocks(vndf_distribution *table)
{
    const vndf_knots *k = &table->knots;
    vndf_knots *b = &table->blocks;
    uint32_t blocks = table->radial_count / VNDF_BLOCK + 1;
    pad_knots(&table->knots, table->radial_count + 1);
    pad_knots(b, blocks);
    b->count = (blocks + VNDF_PADDING - 1) / VNDF_PADDING * VNDF_PADDING; /* as far as a search goes */
    for (uint32_t i = 0; i < blocks; i++) {
        uint32_t j = i * VNDF_BLOCK;
        b->x[i] = k->x[j];
        b->z[i] = k->z[j];
        b->s[i] = k->s[j];
        b->t[i] = k->t[j];
    }
}

/* Running sums of each row, and each row scaled to mass 1 - but for rounding, so that a table saved and read again
 * keeps its bits; padding is beyond every target. */
static void derive_rows(vndf_wedge *wedge)
{
    for (uint32_t i = 0; i < wedge->row_count; i++) {
        float *cdf = wedge->cdf + (size_t)i * wedge->stride, *mass = wedge->cell_mass + (size_t)i * wedge->stride;
        float *density = wedge->density + (size_t)i * (wedge->cell_count + 1);
        double total = 0.0, sum = 0.0;
        for (uint32_t j = 0; j < wedge->cell_count; j++)
            total += mass[j];
        if (fabs(total - 1.0) < 3e-7)
            total = 1.0;
        for (uint32_t j = 0; j < wedge->stride; j++) {
            cdf[j] = j < wedge->cell_count ? (float)(sum / total) : 2.0f;
            sum += mass[j];
            mass[j] = (float)(mass[j] / total);
        }
        for (uint32_t j = 0; j <= wedge->cell_count; j++)
            density[j] = (float)(density[j] / total);
        for (uint32_t j = 0; j < wedge->cell_count; j++) {
            vndf_row_cell cell = {cdf[j], mass[j], density[j], density[j + 1]};
            wedge->row_cell[(size_t)i * wedge->stride + j] = cell;
        }
    }
}

/* The spline of a wedge's mass, piece by piece. */
static void derive_area(vndf_wedge *wedge)
{
    for (uint32_t i = 0; i < VNDF_FEW; i++)
        wedge->few_exact[VNDF_AREA_ORDER][i] = wedge->few[VNDF_AREA_ORDER][i] = 2.0f; /* beyond every y */
    for (uint32_t i = 0; i + 1 < wedge->knot_count; i++) {
        vndf_area_span *span = &wedge->piece[i];
        double begin = wedge->knot_y[i], width = wedge->knot_y[i + 1] - begin;
        vndf_area_knot from = {wedge->mass[i], wedge->slope[i], wedge->curve[i]};
        vndf_area_knot to = {wedge->mass[i + 1], wedge->slope[i + 1], wedge->curve[i + 1]};
        vndf_area_piece(width, from, to, span->coefficient);
        span->begin = begin;
        span->per_width = 1.0 / width;
        vndf_area_quick *quick = &wedge->quick[i];
        for (int n = 0; n < VNDF_AREA_ORDER; n++)
            quick->coefficient[n] = (float)span->coefficient[n];
        quick->begin = (float)begin;
        quick->per_width = (float)span->per_width;
        for (int n = 0; n < VNDF_AREA_ORDER && i < VNDF_FEW; n++)
            wedge->few[n][i] = quick->coefficient[n];
        if (i < VNDF_FEW) {
            wedge->few[VNDF_AREA_ORDER][i] = quick->begin;
            wedge->few[VNDF_AREA_ORDER + 1][i] = quick->per_width;
            for (int n = 0; n < VNDF_AREA_ORDER; n++)
                wedge->few_exact[n][i] = span->coefficient[n];
            wedge->few_exact[VNDF_AREA_ORDER][i] = span->begin;
            wedge->few_exact[VNDF_AREA_ORDER + 1][i] = span->per_width;
        }
    }
}

/* What is looked up in registers; beyond the last row all y are less. */
static void derive_few_rows(vndf_wedge *wedge)
{
    for (uint32_t i = 0; i <= VNDF_FEW; i++)
        wedge->few_y[i] = 2.0f;
    for (uint32_t i = 0; i < wedge->row_count && i / 2 <= VNDF_FEW; i++) {
        wedge->few_aspects[i % 2][i / 2] = wedge->aspect_p[i];
        wedge->few_aspects[2 + i % 2][i / 2] = wedge->aspect_r[i];
        if (i % 2 == 0)
            wedge->few_y[i / 2] = wedge->row_y[i / 2];
    }
}

static void derive_row_spans(vndf_wedge *wedge)
{
    for (uint32_t i = 0; i + 1 < vndf_row_knots(wedge->row_count); i++) {
        vndf_row_span *span = &wedge->row_span[i];
        span->begin = wedge->row_y[i];
        span->per_width = (float)(1.0 / ((double)wedge->row_y[i + 1] - wedge->row_y[i]));
        for (uint32_t n = 0; n < 3; n++) {
            span->p[n] = wedge->aspect_p[2 * i + n];
            span->r[n] = wedge->aspect_r[2 * i + n];
        }
    }
}

static int derive_wedge(vndf_wedge *wedge)
{
    derive_rows(wedge);
    derive_few_rows(wedge);
    derive_row_spans(wedge);
    derive_area(wedge);
    return vndf_guide_make(&wedge->row_guide, wedge->row_y, vndf_row_knots(wedge->row_count)) &&
           vndf_guide_make(&wedge->knot_guide, wedge->knot_y, wedge->knot_count);
}

int vndf_table_derive(vndf_distribution *table)
{
    derive_cells(table);
    derive_smooth(table);
    derive_pole(table);
    derive_tail(table);
    derive_copies(table);
    derive_blocks(table);
    vndf_windows_make(table);
    for (uint32_t j = 0; j <= table->radial_count; j++)
        table->slope[j] = table->knots.z[j] > 0.0f ? table->knots.x[j] / table->knots.z[j] : HUGE_VALF;
    return vndf_guide_make(&table->slope_guide, table->slope, table->radial_count + 1) &&
           derive_wedge(&table->above) && derive_wedge(&table->below);
}
