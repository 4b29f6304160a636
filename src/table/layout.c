#include "table/layout.h"

#include <math.h>

#include <stdlib.h>

#include "table/guide.h"

static int allocate_wedge(vndf_wedge *wedge, uint32_t cells, uint32_t rows, uint32_t knots)
{
    float *block = calloc((size_t)3 * rows + (size_t)3 * knots + cells + 1, sizeof *block);
    wedge->nodes = calloc((size_t)rows * (cells + 1), sizeof *wedge->nodes);
    wedge->cell_count = cells;
    wedge->row_count = rows;
    wedge->knot_count = knots;
    wedge->row_y = block;
    if (!block || !wedge->nodes)
        return 0;
    wedge->aspect_p = block + rows;
    wedge->aspect_r = block + 2 * rows;
    wedge->knot_y = block + 3 * rows;
    wedge->mass = wedge->knot_y + knots;
    wedge->slope = wedge->mass + knots;
    wedge->q = wedge->slope + knots;
    return 1;
}

static void free_wedge(vndf_wedge *wedge)
{
    free(wedge->row_y);
    free(wedge->nodes);
    free(wedge->row_guide.first);
    free(wedge->knot_guide.first);
}

vndf_distribution *vndf_table_allocate(vndf_table_size size)
{
    vndf_distribution *table = calloc(1, sizeof *table);
    if (!table)
        return NULL;
    table->kind = VNDF_KIND_TABLE;
    table->radial_count = size.radial;
    table->pole = calloc(size.radial + 1, sizeof *table->pole);
    table->tail = calloc(size.radial + 1, sizeof *table->tail);
    table->slope = calloc(size.radial + 1, sizeof *table->slope);
    table->cells = calloc(size.radial, sizeof *table->cells);
    int whole = allocate_wedge(&table->above, size.above_cells, size.above_rows, size.above_knots);
    whole &= allocate_wedge(&table->below, size.below_cells, size.below_rows, size.below_knots);
    if (whole && table->pole && table->tail && table->slope && table->cells)
        return table;
    vndf_free(table);
    return NULL;
}

void vndf_free(vndf_distribution *table)
{
    if (!table || table->kind != VNDF_KIND_TABLE)
        return;
    free(table->pole);
    free(table->tail);
    free(table->slope);
    free(table->cells);
    free(table->slope_guide.first);
    free_wedge(&table->above);
    free_wedge(&table->below);
    free((char *)table->source);
    free((char *)table->tool);
    free(table);
}

/* The cubic through f0, f1 with the moments mu0, mu1. */
static void derive_cells(vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        vndf_radial_cell *cell = &table->cells[j];
        const vndf_pole_knot *k = &table->pole[j];
        double f0 = cell->f0, f1 = cell->f1;
        double e0 = cell->mu0 - f0 / 3 - f1 / 6, e1 = cell->mu1 - f0 / 6 - f1 / 3;
        cell->a = (float)(36 * e0 - 24 * e1);
        cell->b = (float)(60 * (e1 - e0));
        cell->width = (float)((double)k[1].x * k[0].z - (double)k[0].x * k[1].z);
    }
}

/* F1 and E = F0 - F1 z/x from the pole outwards; every term is positive, so nothing cancels. */
static void derive_pole(vndf_distribution *table)
{
    double e = 0.0, f0 = 0.0, f1 = 0.0;
    table->pole[0].e = table->pole[0].g = 0.0f;
    for (uint32_t j = 0; j < table->radial_count; j++) {
        vndf_pole_knot *k = &table->pole[j];
        double mu0 = table->cells[j].mu0, mu1 = table->cells[j].mu1, x0 = k[0].x, z0 = k[0].z, x1 = k[1].x, z1 = k[1].z;
        double width = x1 * z0 - x0 * z1;
        e += (j ? f1 * width / (x0 * x1) : 0.0) + mu0 * width / x1;
        f0 += z0 * mu0 + z1 * mu1;
        f1 += x0 * mu0 + x1 * mu1;
        k[1].e = (float)e;
        k[1].g = (float)(f1 / x1);
    }
    table->f0_total = (float)f0;
    table->f1_total = (float)f1;
}

/* T0 and S = T1 - T0 x/z from infinity inwards. */
static void derive_tail(vndf_distribution *table)
{
    double s = 0.0, t0 = 0.0;
    uint32_t n = table->radial_count;
    for (uint32_t j = 0; j <= n; j++) {
        table->tail[j].x = table->pole[j].x;
        table->tail[j].z = table->pole[j].z;
    }
    for (uint32_t j = n; j-- > 0;) {
        vndf_tail_knot *k = &table->tail[j];
        double mu0 = table->cells[j].mu0, mu1 = table->cells[j].mu1, x0 = k[0].x, z0 = k[0].z, x1 = k[1].x, z1 = k[1].z;
        double width = x1 * z0 - x0 * z1;
        s += (z1 > 0 ? t0 * width / (z0 * z1) : 0.0) + mu1 * width / z0;
        t0 += z0 * mu0 + z1 * mu1;
        k[0].s = (float)s;
        k[0].t = (float)(t0 / z0);
    }
}

/* Running sums of each row, and each row scaled to mass 1. */
static void derive_rows(vndf_wedge *wedge)
{
    uint32_t cells = wedge->cell_count;
    for (uint32_t i = 0; i < wedge->row_count; i++) {
        vndf_azimuth_node *node = wedge->nodes + (size_t)i * (cells + 1);
        double total = 0.0, sum = 0.0;
        for (uint32_t j = 0; j < cells; j++)
            total += node[j].mass;
        for (uint32_t j = 0; j <= cells; j++) {
            node[j].cdf = (float)(sum / total);
            sum += node[j].mass;
            node[j].mass = (float)(node[j].mass / total);
            node[j].density = (float)(node[j].density / total);
        }
        node[cells].cdf = 1.0f;
    }
}

static int derive_wedge(vndf_wedge *wedge)
{
    derive_rows(wedge);
    return vndf_guide_make(&wedge->row_guide, wedge->row_y, wedge->row_count) &&
           vndf_guide_make(&wedge->knot_guide, wedge->knot_y, wedge->knot_count);
}

int vndf_table_derive(vndf_distribution *table)
{
    derive_cells(table);
    derive_pole(table);
    derive_tail(table);
    for (uint32_t j = 0; j <= table->radial_count; j++)
        table->slope[j] = table->pole[j].z > 0.0f ? table->pole[j].x / table->pole[j].z : HUGE_VALF;
    return vndf_guide_make(&table->slope_guide, table->slope, table->radial_count + 1) &&
           derive_wedge(&table->above) && derive_wedge(&table->below);
}
