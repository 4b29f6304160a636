/* Says where the arrays of a table stand, allocates, frees and counts them. */
#include "table/layout.h"

#include <stdlib.h>
#include <string.h>

#include "table/derive.h"
#include "table/guide.h"
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

/* The number of knots with padding, so that neither a window nor a block reads beyond the last. */
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
}

static void place_rows(room *r, vndf_wedge *w, int above)
{
    uint32_t knots = vndf_row_knots(w->row_count);
    w->stride = (w->cell_count + VNDF_PADDING - 1) / VNDF_PADDING * VNDF_PADDING;
    w->row_cell = take(r, (size_t)w->row_count * (w->cell_count + 1), sizeof *w->row_cell);
    w->cdf = take(r, (size_t)w->row_count * w->stride, sizeof *w->cdf);
    w->q = take(r, w->cell_count + 1, sizeof *w->q);
    w->row_y = take(r, has_few_rows(w) ? VNDF_FEW + 1 : knots, sizeof *w->row_y);
    w->few_aspects = has_few_rows(w) ? take(r, 5 * (size_t)knots, sizeof *w->few_aspects) : NULL;
    size_t inner = (size_t)w->row_count * (w->cell_count - 1);
    w->few_cdf = above && has_few_rows(w) ? take(r, inner, sizeof *w->few_cdf) : NULL;
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
    size_t few = 2 * (VNDF_STEP - 1) * (size_t)vndf_step_count(table);
    table->few_sums = table->radial_count <= VNDF_STEP * VNDF_FEW ? take(r, few, sizeof *table->few_sums) : NULL;
}

/* Places all arrays in the block; after the last is room for lanes, which read VNDF_FEW numbers at once. */
static size_t place_all(vndf_distribution *table, char *block)
{
    room r = {block, 0};
    table->cells = take(&r, table->radial_count, sizeof *table->cells);
    align(&r);
    place_pieces(&r, &table->above, 1);
    align(&r);
    place_pieces(&r, &table->below, 0);
    place_knots(&r, table);
    place_rows(&r, &table->above, 1);
    place_rows(&r, &table->below, 0);
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

int vndf_table_derive(vndf_distribution *table)
{
    return vndf_derive_radial(table) && vndf_derive_wedge(&table->above) && vndf_derive_wedge(&table->below);
}

/* ---- bytes ---- */

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
