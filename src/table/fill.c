/* From the numbers on disk to those that are drawn with: widths, turns and sums beyond each knot, in double. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "table/file.h"

/* The law of k~ begins at knot i for the rounded rho of its cell if that is less than NEAR times R_i, or nearer to R_i
 * than to the next knot. Down to 0.8 rho k~ is within 1.3% of k, for 2, 3 and 4 moments. In cell 0 there is no R_i to
 * compare with, and k~ has another form (kernel/law.h). */
static const double NEAR = 1.18, NEAR_FIRST = 0.75;

static float *row(const vndf_distribution *table, int group, size_t i)
{
    return table->numbers + VNDF_HEAD + VNDF_STRIDE * i + 4 * (size_t)group;
}

static int in_range(double value, double least, double most)
{
    return value >= least && value <= most;
}

/* What is wrong with the numbers of one knot and of the cell beyond it, whose last has no end. Moments are those of a
 * density in the cell, but for knots beside a needle, which are a few floats apart, and for numbers at the end of
 * floats. End densities are compared with the mean of the cell; builders stay below 300 times of it. The cubic of the
 * area has to stay above 0. */
static const char *knot_invalid(const vndf_table_draft *d, size_t i)
{
    static const double least = 1e-37, most = 1e36, steepest = 1e4;
    int last = i == d->cells;
    double r = d->knot[i], next = last ? HUGE_VAL : d->knot[i + 1], z0 = 1 / (1 + r), z1 = 1 / (1 + next);
    double m0 = d->m0[i], m1 = d->m1[i], m2 = d->m2[i], gap = 8 * (next - r), width = z0 - z1;
    double mean0 = m0 / (z0 * z0), mean1 = last ? m2 + r * (2 * m1 + r * m0) : m0 / (z1 * z1);
    double a0 = d->area[i], a1 = last ? 1 : d->area[i + 1], s0 = d->slope[i], s1 = last ? 1 : d->slope[i + 1];
    if (!(next > r))
        return "the knots do not ascend";
    if (!in_range(m0, least, most) || !in_range(m1, least, fmin(most, gap * m0 + 1e-35)) ||
        !in_range(m2, least, fmin(most, gap * m1 + 1e-35)) ||
        (d->cubes && !in_range(d->cubes[i], 0.0, i ? fmin(most, 1.0001 * pow(r, -3)) : most)))
        return "a moment is out of range";
    if (!in_range(d->g0[i], 0.0, steepest * mean0) || !in_range(d->g1[i], 0.0, steepest * mean1))
        return "a density is out of range";
    if (!in_range(d->b0[i], 0.0, 1e6) || !in_range(d->b1[i], 0.0, 1e6) || !(d->b0[i] + d->b1[i] > 1e-6f))
        return "a share is out of range";
    if (!in_range(a0, 1e-20, 1e20) || !in_range(s0, -1e20, 1e20) || width * s0 < -3 * a0 ||
        !(width * s1 <= 3 * a1))
        return "an area is out of range";
    return NULL;
}

static const char *draft_invalid(const vndf_table_draft *d)
{
    if (d->knot[0] != 0.0f || !(d->knot[1] > 1e-12f) || !(d->knot[d->cells] < 1e14f))
        return "the knots do not run from 0 to below 1e14";
    if (!(d->scale > 1e-18 && d->scale < 1e18) || !(d->normalization > 0.0) || !isfinite(d->normalization))
        return "the scale or normalization is out of range";
    for (size_t i = 0; i <= d->cells; i++) {
        const char *why = knot_invalid(d, i);
        if (why)
            return why;
    }
    const vndf_certificate *c = &d->certificate;
    const float claims[VNDF_CERTIFICATE_FLOATS] = {
        c->tv,         c->tv_theta,    c->tv_above,  c->tv_above_theta, c->max_weight, c->weight_bounded,
        c->area_error, c->consistency, c->ndf_error, c->hidden,         c->finest,     -c->horizon_power};
    for (int i = 0; i < VNDF_CERTIFICATE_FLOATS; i++)
        if (!in_range(claims[i], 0.0, HUGE_VAL))
            return "the certificate holds what is no measurement";
    return NULL;
}

double vndf_table_turn(const vndf_table_draft *d, size_t i)
{
    if (i == 0)
        return 0.0;
    double a = d->knot[i - 1], b = d->knot[i];
    return fmin(i > 1 ? fmax(NEAR * a, sqrt(a * b)) : NEAR_FIRST * b, b);
}

static void put(float *to, double a, double b, double c, double d)
{
    to[0] = (float)a;
    to[1] = (float)b;
    to[2] = (float)c;
    to[3] = (float)d;
}

/* The rows of knot i that know of no other knot but the next. */
static void fill_cell(vndf_distribution *table, const vndf_table_draft *d, size_t i)
{
    double r = d->knot[i], z = 1 / (1 + r), h = ldexp(z, (int)d->squarings);
    if (i < d->cells)
        h = (d->knot[i + 1] - r) * z / (1 + (double)d->knot[i + 1]);
    put(row(table, VNDF_KNOT, i), r, z, h, vndf_table_turn(d, i));
    put(row(table, VNDF_LAW, i), d->g0[i], d->g1[i], d->m0[i], d->m1[i]);
    put(row(table, VNDF_MORE, i), d->m2[i], d->cubes ? d->cubes[i] : 0.0, d->b0[i], d->b1[i]);
}

/* Sums beyond each knot, from the last one; *mass becomes that of all. In the first cell k~ is a_1 y + pi, so that knot
 * 0 has the sum of f R from there on, and those of knot 1. */
static void fill_sums(vndf_distribution *table, const vndf_table_draft *d, double *mass)
{
    const float *first = row(table, VNDF_TAIL, 1);
    double t1 = 0, t0 = 0, tq = 0, t4 = 0, n1 = 0, n2 = 0;
    for (size_t i = d->cells + 1; i-- > 0;) {
        double r = d->knot[i], gap = i < d->cells ? d->knot[i + 1] - r : 0, m0 = d->m0[i], m1 = d->m1[i],
               m2 = d->m2[i];
        n2 += gap * (2 * n1 + gap * tq) + m2;
        n1 += gap * tq + m1;
        tq += m0;
        t0 += m1 + r * m0;
        t1 += m2 + r * (2 * m1 + r * m0);
        t4 += d->cubes && i > 0 ? d->cubes[i] * m0 : 0.0;
        put(row(table, VNDF_TAIL, i), t1, i ? t0 : first[1], i ? tq : first[2], i ? t4 : first[3]);
        put(row(table, VNDF_LOW, i), n1, n2, d->area[i], d->slope[i]);
    }
    *mass = t0;
}

/* Columns of slopes and of sums beyond them, and their pivots. */
static void fill_columns(vndf_distribution *table)
{
    int n = table->cells, size = vndf_column_size(n), pivots = vndf_pivot_count(n);
    float *pivot = table->columns + VNDF_COLUMNS * size;
    table->column = size;
    table->pivots = pivots;
    for (int c = 0; c < VNDF_COLUMNS; c++) {
        float *column = table->columns + c * size;
        for (int i = 0; i < size; i++)
            column[i] =
                i > n ? (c ? -1.0f : 3e38f) : row(table, c ? VNDF_TAIL : VNDF_KNOT, (size_t)i)[c ? c - 1 : 0];
        for (int i = 0; i < pivots; i++) {
            int knot = (i + 1) * VNDF_COLUMN_STEP;
            pivot[c * pivots + i] = knot < size ? column[knot] : c ? -1.0f : 3e38f;
        }
    }
}

static void fill_first(vndf_distribution *table)
{
    int knot = 0;
    for (int i = 0; i < VNDF_RHO_PARTS; i++) {
        while (knot < table->cells && row(table, VNDF_KNOT, (size_t)knot + 1)[3] <= vndf_rounded_rho(i))
            knot++;
        table->first[i] = (uint16_t)knot;
    }
}

static size_t column_floats(const vndf_distribution *table)
{
    return (size_t)VNDF_COLUMNS * (size_t)(vndf_column_size(table->cells) + vndf_pivot_count(table->cells));
}

int vndf_table_fill(vndf_distribution *table, const vndf_table_draft *d, const char **why)
{
    double mass = 0;
    *why = draft_invalid(d);
    if (*why)
        return 0;
    table->cells = (int32_t)d->cells;
    for (table->highest = table->steps = 1; 2 * table->highest <= table->cells; table->steps++)
        table->highest *= 2;
    table->moments = (int32_t)d->moments;
    table->squarings = (int32_t)d->squarings;
    table->unit = (float)d->scale;
    table->normalization = d->normalization;
    table->scale = d->scale;
    table->certificate = d->certificate;
    table->number_count = VNDF_HEAD + 4 * VNDF_GROUPS * ((size_t)d->cells + 1);
    table->numbers = malloc(table->number_count * sizeof(float));
    table->columns = malloc(column_floats(table) * sizeof(float));
    if (!table->numbers || !table->columns)
        return 0;
    put(table->numbers, d->cells, d->moments, d->squarings, d->scale);
    put(table->numbers + 4, table->highest, table->steps, 0, 0);
    for (size_t i = 0; i <= d->cells; i++)
        fill_cell(table, d, i);
    fill_sums(table, d, &mass);
    if (!(fabs(mass - 1) < 1e-4))
        *why = "the masses of the cells do not add up to 1";
    for (size_t i = 0; i < table->number_count && !*why; i++)
        *why = isfinite(table->numbers[i]) ? NULL : "a sum of moments is not finite";
    for (size_t i = 0; i <= d->cells && !*why; i++)
        *why = row(table, VNDF_KNOT, i)[2] > 1e-30f ? NULL : "two knots coincide";
    fill_columns(table);
    fill_first(table);
    return !*why;
}

/* ---- the way back ---- */

int vndf_table_draft_allocate(vndf_table_draft *draft)
{
    size_t n = (size_t)draft->cells + 1;
    float *block = calloc(VNDF_ARRAYS * n, sizeof *block);
    for (size_t a = 0; block && a < VNDF_ARRAYS; a++)
        draft->array[a] = block + a * n;
    return block != NULL;
}

/* The draft of a table, in its own numbers. */
static vndf_table_draft draft_within(const vndf_distribution *t)
{
    static const int places[VNDF_ARRAYS][2] = {{VNDF_KNOT, 0}, {VNDF_LAW, 0},  {VNDF_LAW, 1},  {VNDF_LAW, 2},
                                               {VNDF_LAW, 3},  {VNDF_MORE, 0}, {VNDF_MORE, 1}, {VNDF_MORE, 2},
                                               {VNDF_MORE, 3}, {VNDF_LOW, 2},  {VNDF_LOW, 3}};
    vndf_table_draft draft = {.cells = (unsigned)t->cells,
                              .moments = (unsigned)t->moments,
                              .squarings = (unsigned)t->squarings,
                              .stride = VNDF_STRIDE,
                              .normalization = t->normalization,
                              .scale = t->scale,
                              .certificate = t->certificate,
                              .source = t->source,
                              .tool = t->tool};
    for (int a = 0; a < VNDF_ARRAYS; a++)
        draft.array[a] = row(t, places[a][0], 0) + places[a][1];
    draft.cubes = t->moments == 4 ? draft.cubes : NULL;
    return draft;
}

void vndf_table_write_loaded(const vndf_distribution *table, vndf_writer *writer)
{
    vndf_table_draft draft = draft_within(table);
    vndf_table_write(&draft, writer);
}

size_t vndf_table_memory(const vndf_distribution *table)
{
    size_t floats = table->number_count + column_floats(table);
    return sizeof *table + floats * sizeof(float) + strlen(table->source) + strlen(table->tool) + 2;
}

size_t vndf_numbers(const vndf_distribution *distribution, float *numbers, size_t capacity)
{
    if (!distribution || !vndf_is_table(distribution))
        return 0;
    size_t count = distribution->number_count, written = count < capacity ? count : capacity;
    if (written)
        memcpy(numbers, distribution->numbers, written * sizeof *numbers);
    return count;
}
