#include "table/layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "table/area_piece.h"
#include "table/guide.h"
#include "table/moment_cubic.h"
#include "table/steep.h"
#include "table/window.h"

/* ---- room ---- */

/* Arrays one after the other in a block, or only counted while there is none. The largest come first, so that
 * cells and pieces do not cross lines of the cache. */
typedef struct room {
    char *block;
    size_t used;
} room;

enum { LINE = 64 };

static void *take(room *r, size_t count, size_t size)
{
    void *array = r->block ? r->block + r->used : NULL;
    r->used += count * size;
    return array;
}

static void align(room *r)
{
    r->used = (r->used + LINE - 1) / LINE * LINE;
}

/* So many knots that neither a window nor a block reads beyond. */
static uint32_t padded(uint32_t knots, uint32_t multiple)
{
    uint32_t whole = (knots + multiple - 1) / multiple * multiple, window = knots - 1 + VNDF_WINDOW;
    return whole > window ? whole : window;
}

static uint32_t block_count(uint32_t radial)
{
    return (radial / VNDF_BLOCK + VNDF_PADDING) / VNDF_PADDING * VNDF_PADDING;
}

static int has_few_pieces(const vndf_wedge *w)
{
    return w->knot_count <= VNDF_FEW + 1;
}

static int has_few_rows(const vndf_wedge *w)
{
    return w->row_count / 2 < VNDF_FEW;
}

static void place_pieces(room *r, vndf_wedge *w, int above)
{
    w->piece = take(r, w->knot_count - 1, sizeof *w->piece);
    w->few_pitch = w->knot_count <= VNDF_FEW / 2 + 1 ? VNDF_FEW / 2 : VNDF_FEW;
    size_t few = (size_t)VNDF_AREA_SPAN * w->few_pitch;
    w->few_exact = has_few_pieces(w) ? take(r, few, sizeof *w->few_exact) : NULL;
    w->few = above && has_few_pieces(w) ? take(r, few, sizeof *w->few) : NULL;
    w->quick = above ? take(r, w->knot_count - 1, sizeof *w->quick) : NULL;
    w->row_span = take(r, vndf_row_knots(w->row_count), sizeof *w->row_span);
    w->row_line = above ? take(r, (size_t)w->row_count * w->cell_count, sizeof *w->row_line) : NULL;
}

static void place_rows(room *r, vndf_wedge *w)
{
    uint32_t knots = vndf_row_knots(w->row_count);
    w->stride = (w->cell_count + VNDF_PADDING - 1) / VNDF_PADDING * VNDF_PADDING;
    w->row_cell = take(r, (size_t)w->row_count * (w->cell_count + 1), sizeof *w->row_cell);
    w->cdf = take(r, (size_t)w->row_count * w->stride, sizeof *w->cdf);
    w->q = take(r, w->cell_count + 1, sizeof *w->q);
    w->row_y = take(r, has_few_rows(w) ? VNDF_FEW + 1 : knots, sizeof *w->row_y);
    w->few_aspects = has_few_rows(w) ? take(r, 4 * (size_t)knots, sizeof *w->few_aspects) : NULL;
    w->knot_y = take(r, w->knot_count, sizeof *w->knot_y);
    w->mass = take(r, w->knot_count, sizeof *w->mass);
    w->slope = take(r, w->knot_count, sizeof *w->slope);
    w->curve = take(r, w->knot_count, sizeof *w->curve);
}

static void place_knots(room *r, vndf_distribution *table)
{
    vndf_knots *k = &table->knots, *b = &table->blocks;
    k->count = padded(table->radial_count + 1, VNDF_BLOCK);
    k->at = take(r, k->count, sizeof *k->at);
    k->pole = take(r, k->count, sizeof *k->pole);
    k->tail = take(r, k->count, sizeof *k->tail);
    k->f0 = take(r, k->count, sizeof *k->f0);
    k->f1 = take(r, k->count, sizeof *k->f1);
    b->count = block_count(table->radial_count);
    b->at = take(r, b->count, sizeof *b->at);
    b->tail = take(r, b->count, sizeof *b->tail);
    table->bends = take(r, table->radial_count, sizeof *table->bends);
}

/* Where all arrays stand in the block; after the last, room for lanes that read all of what is few. */
static size_t place_all(vndf_distribution *table, char *block)
{
    room r = {block, 0};
    table->cells = take(&r, table->radial_count, sizeof *table->cells);
    align(&r);
    place_pieces(&r, &table->above, 1);
    align(&r);
    place_pieces(&r, &table->below, 0);
    place_knots(&r, table);
    place_rows(&r, &table->above);
    place_rows(&r, &table->below);
    take(&r, VNDF_FEW, sizeof(float));
    return r.used;
}

static int allocate_block(vndf_distribution *table)
{
    table->block_bytes = place_all(table, NULL) + LINE - 1;
    table->block = calloc(table->block_bytes, 1);
    if (!table->block)
        return 0;
    size_t past = (uintptr_t)table->block % LINE;
    place_all(table, (char *)table->block + (past > 0 ? LINE - past : 0));
    return 1;
}

static void count_wedge(vndf_wedge *wedge, uint32_t cells, uint32_t rows, uint32_t knots)
{
    wedge->cell_count = cells;
    wedge->row_count = rows;
    wedge->knot_count = knots;
}

vndf_distribution *vndf_table_allocate(vndf_table_size size)
{
    vndf_distribution *table = calloc(1, sizeof *table);
    if (!table)
        return NULL;
    vndf_make_table(table);
    table->radial_count = size.radial;
    count_wedge(&table->above, size.above_cells, size.above_rows, size.above_knots);
    count_wedge(&table->below, size.below_cells, size.below_rows, size.below_knots);
    if (allocate_block(table))
        return table;
    vndf_free(table);
    return NULL;
}

static void free_guides(vndf_wedge *wedge)
{
    vndf_guide_free(&wedge->row_guide);
    vndf_guide_free(&wedge->knot_guide);
}

void vndf_free(vndf_distribution *table)
{
    if (!table || !vndf_is_table(table))
        return;
    vndf_windows_free(&table->windows);
    vndf_guide_free(&table->slope_guide);
    free_guides(&table->above);
    free_guides(&table->below);
    free(table->block);
    free((char *)table->source);
    free((char *)table->tool);
    free(table);
}

/* ---- what follows from the arrays of the file ---- */

/* X1 Z0 - X0 Z1. */
static double width_of(const vndf_knots *k, uint32_t j)
{
    return (double)k->at[j + 1].x * k->at[j].z - (double)k->at[j].x * k->at[j + 1].z;
}

/* Whether (|e1 - e0| + 3 |e0 + e1 - 2 mass|) X1 Z0 <= VNDF_STEEP_CELL min(e0, e1, mass) width for W1/W0 = ratio. This
 * is convex in the ratio, so it holds between two ratios where it holds at both. */
static int is_calm_at(const vndf_radial_cell *cell, double reach, double ratio)
{
    double e0 = cell->f0, e1 = cell->f1 * ratio, mass = cell->mu0 + cell->mu1 * ratio;
    double change = fabs(e1 - e0) + 3.0 * fabs(e0 + e1 - 2.0 * mass);
    return reach <= VNDF_NARROW * cell->width &&
           change * reach <= VNDF_STEEP_CELL * fmin(fmin(e0, e1), mass) * cell->width;
}

static void derive_cells(vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        vndf_radial_cell *cell = &table->cells[j];
        vndf_moment_cubic cubic = vndf_moment_cubic_from(cell->f0, cell->f1, cell->mu0, cell->mu1);
        table->bends[j].a = (float)cubic.a;
        table->bends[j].b = (float)cubic.b;
        cell->width = (float)width_of(&table->knots, j);
        double x0 = table->knots.at[j].x, x1 = table->knots.at[j + 1].x;
        double z0 = table->knots.at[j].z, z1 = table->knots.at[j + 1].z;
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

/* What a cell repeats of its first knot. */
static void derive_copies(vndf_distribution *table)
{
    for (uint32_t j = 0; j < table->radial_count; j++) {
        table->cells[j].before0 = table->knots.f0[j];
        table->cells[j].before1 = table->knots.f1[j];
    }
}

/* F1 and E = F0 - F1 z/x from the pole outwards; every term is positive, so nothing cancels. */
static void derive_pole(vndf_distribution *table)
{
    vndf_knots *k = &table->knots;
    double e = 0.0, f0 = 0.0, f1 = 0.0;
    for (uint32_t j = 0; j < table->radial_count; j++) {
        double mu0 = table->cells[j].mu0, mu1 = table->cells[j].mu1, width = width_of(k, j);
        vndf_knot from = k->at[j], to = k->at[j + 1];
        double x1 = to.x;
        e += (j ? f1 * width / (from.x * x1) : 0.0) + mu0 * width / x1;
        f0 += from.z * mu0 + to.z * mu1;
        f1 += from.x * mu0 + x1 * mu1;
        k->pole[j + 1].e = (float)e;
        k->pole[j + 1].g = (float)(f1 / x1);
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
        double z0 = k->at[j].z, z1 = k->at[j + 1].z, width = width_of(k, j);
        s += (z1 > 0 ? t0 * width / (z0 * z1) : 0.0) + mu1 * width / z0;
        t0 += z0 * mu0 + z1 * mu1;
        k->tail[j].s = (float)s;
        k->tail[j].t = (float)(t0 / z0);
    }
}

/* Sums that are beyond every target from the pole, and, as they are 0, below every one from the tail. */
static void pad_knots(vndf_knots *k, uint32_t from)
{
    for (uint32_t j = from; j < k->count; j++) {
        k->at[j].x = 1.0f;
        k->pole[j].e = k->pole[j].g = k->f0[j] = k->f1[j] = 1e30f;
    }
}

static void derive_blocks(vndf_distribution *table)
{
    const vndf_knots *k = &table->knots;
    vndf_knots *b = &table->blocks;
    for (uint32_t i = 0; i < b->count; i++) {
        uint32_t j = i * VNDF_BLOCK;
        b->at[i].x = 1.0f; /* beyond the last as in pad_knots */
        if (j <= table->radial_count) {
            b->at[i] = k->at[j];
            b->tail[i] = k->tail[j];
        }
    }
}

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

static vndf_area_quick area_quick(const vndf_area_span *span)
{
    vndf_area_quick quick = {.begin = (float)span->begin, .per_width = (float)span->per_width};
    for (int n = 0; n < VNDF_AREA_ORDER; n++)
        quick.coefficient[n] = (float)span->coefficient[n];
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

static int derive_wedge(vndf_wedge *wedge)
{
    derive_rows(wedge);
    derive_row_spans(wedge);
    derive_area(wedge);
    if (wedge->row_line)
        derive_row_lines(wedge);
    if (wedge->few_aspects)
        derive_few_rows(wedge);
    if (wedge->few)
        derive_few(wedge);
    if (wedge->few_exact)
        derive_few_exact(wedge);
    return vndf_guide_make(&wedge->row_guide, wedge->row_y, vndf_row_knots(wedge->row_count)) &&
           vndf_guide_make(&wedge->knot_guide, wedge->knot_y, wedge->knot_count);
}

/* X/Z of the knots, ascending, the last infinite: only their guide stays. */
static int derive_slopes(vndf_distribution *table)
{
    uint32_t count = table->radial_count + 1;
    float *slope = malloc(count * sizeof *slope);
    if (!slope)
        return 0;
    for (uint32_t j = 0; j < count; j++)
        slope[j] = vndf_knot_slope(table, j);
    int made = vndf_guide_make(&table->slope_guide, slope, count);
    free(slope);
    return made;
}

int vndf_table_derive(vndf_distribution *table)
{
    derive_cells(table);
    derive_smooth(table);
    derive_pole(table);
    derive_tail(table);
    derive_copies(table);
    pad_knots(&table->knots, table->radial_count + 1);
    derive_blocks(table);
    return vndf_windows_make(table) && derive_slopes(table) && derive_wedge(&table->above) &&
           derive_wedge(&table->below);
}

static size_t guide_bytes(const vndf_wedge *wedge)
{
    return vndf_guide_bytes(&wedge->row_guide, vndf_row_knots(wedge->row_count)) +
           vndf_guide_bytes(&wedge->knot_guide, wedge->knot_count);
}

size_t vndf_table_memory(const vndf_distribution *table)
{
    size_t texts = strlen(table->source) + strlen(table->tool) + 2;
    size_t guides = vndf_guide_bytes(&table->slope_guide, table->radial_count + 1) + guide_bytes(&table->above) +
                    guide_bytes(&table->below);
    return sizeof *table + table->block_bytes + vndf_windows_bytes(&table->windows) + guides + texts;
}
