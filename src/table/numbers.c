/* The numbers of a table in the order in which exported kernels read them (tools/export/kernel.glsl). */
#include "table/moment_cubic.h"
#include "table/table.h"

/* The numbers written so far; those beyond the capacity are counted alone. */
typedef struct numbers {
    float *to;
    size_t count, capacity;
} numbers;

static void put(numbers *n, double x)
{
    if (n->count < n->capacity)
        n->to[n->count] = (float)x;
    n->count++;
}

/* Writes number `at`, which was left free, to be the count of now. */
static void put_place(numbers *n, size_t at)
{
    if (at < n->capacity)
        n->to[at] = (float)n->count;
}

static size_t leave(numbers *n, size_t places)
{
    size_t at = n->count;
    for (size_t i = 0; i < places; i++)
        put(n, 0.0);
    return at;
}

static void put_knots(numbers *n, const vndf_distribution *d)
{
    const vndf_knots *k = &d->knots;
    for (uint32_t j = 0; j <= d->radial_count; j++) {
        put(n, k->at[j].x);
        put(n, k->at[j].z);
        put(n, k->f0[j]);
        put(n, k->f1[j]);
        put(n, k->pole[j].e);
        put(n, k->pole[j].g);
        put(n, k->tail[j].s);
        put(n, k->tail[j].t);
    }
}

static void put_cells(numbers *n, const vndf_distribution *d)
{
    for (uint32_t j = 0; j < d->radial_count; j++) {
        const vndf_radial_cell *cell = &d->cells[j];
        vndf_moment_cubic cubic =
            vndf_moment_cubic_from((double)cell->f0, (double)cell->f1, (double)cell->mu0, (double)cell->mu1);
        put(n, cell->f0);
        put(n, cell->f1);
        put(n, cell->mu0);
        put(n, cell->mu1);
        put(n, cell->width);
        put(n, cubic.a);
        put(n, cubic.b);
    }
}

static void put_row(numbers *n, const vndf_wedge *wedge, uint32_t row)
{
    const vndf_row_cell *cell = vndf_row_cells(wedge, row);
    put(n, *vndf_aspect_p(wedge, row));
    put(n, *vndf_aspect_r(wedge, row));
    for (uint32_t j = 0; j < wedge->cell_count; j++)
        put(n, wedge->cdf[(size_t)row * wedge->stride + j]);
    for (uint32_t j = 0; j < wedge->cell_count; j++) {
        put(n, cell[j].density);
        put(n, cell[j].mass);
    }
    put(n, cell[wedge->cell_count].density);
}

static void put_pieces(numbers *n, const vndf_wedge *wedge)
{
    for (uint32_t i = 0; i + 1 < wedge->knot_count; i++) {
        for (int k = 0; k < VNDF_AREA_ORDER; k++)
            put(n, wedge->piece[i].coefficient[k]);
        put(n, wedge->piece[i].begin);
        put(n, wedge->piece[i].per_width);
    }
}

/* `head` is where the counts and places of the wedge belong. */
static void put_wedge(numbers *n, const vndf_wedge *wedge, size_t head)
{
    const uint32_t counts[3] = {wedge->cell_count, wedge->row_count / 2, wedge->knot_count - 1};
    for (size_t i = 0; i < 3; i++)
        if (head + i < n->capacity)
            n->to[head + i] = (float)counts[i];
    put_place(n, head + 3);
    for (uint32_t j = 0; j <= wedge->cell_count; j++)
        put(n, wedge->q[j]);
    put_place(n, head + 4);
    for (uint32_t i = 0; i < wedge->row_count / 2; i++) {
        put(n, wedge->row_span[i].begin);
        put(n, wedge->row_span[i].per_width);
    }
    put_place(n, head + 5);
    for (uint32_t row = 0; row < wedge->row_count; row++)
        put_row(n, wedge, row);
    put_place(n, head + 6);
    put_pieces(n, wedge);
}

size_t vndf_numbers(const vndf_distribution *d, float *to, size_t capacity)
{
    numbers n = {to, 0, to ? capacity : 0};
    if (!d || !vndf_is_table(d))
        return 0;
    put(&n, d->radial_count);
    size_t places = leave(&n, 2);
    put(&n, d->f0_total);
    put(&n, d->f1_total);
    put(&n, d->scale);
    size_t above = leave(&n, 7), below = leave(&n, 7);
    put_place(&n, places);
    put_knots(&n, d);
    put_place(&n, places + 1);
    put_cells(&n, d);
    put_wedge(&n, &d->above, above);
    put_wedge(&n, &d->below, below);
    return n.count;
}
