/* From the numbers on disk to those that are drawn with: widths, turns and sums beyond each knot, in double. */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "table/table.h"

/* The law of k~ begins at knot i for the rounded rho of its cell if that is less than NEAR times R_i, or nearer to R_i
 * than to the next knot. Down to 0.8 rho k~ is within 1.3% of k, for 2, 3 and 4 moments. In cell 0 there is no R_i to
 * compare with, and k~ has another form (kernel/law.h). */
static const double NEAR = 1.18, NEAR_FIRST = 0.75;

static int in_range(double value, double least, double most)
{
    return value >= least && value <= most;
}

/* What is wrong with the numbers of one knot and of the cell beyond it, whose last has no end. Moments are those of a
 * density in the cell, but for knots beside a needle, which are a few floats apart, and for numbers at the end of
 * floats. End densities are compared with the mean of the cell; builders stay below 300 times of it. The cubic of the
 * area has to stay above 0. */
static const char *knot_invalid(const vndf_distribution *t, size_t i)
{
    static const double least = 1e-37, most = 1e36, steepest = 1e4;
    int last = i == (size_t)t->cells;
    const vndf_knot_numbers *k = vndf_knot_at(t, i);
    double r = k->r, next = last ? HUGE_VAL : k[1].r, z0 = 1 / (1 + r), z1 = 1 / (1 + next);
    double m0 = k->m0, m1 = k->m1, m2 = k->m2, gap = 8 * (next - r), width = z0 - z1;
    double mean0 = m0 / (z0 * z0), mean1 = last ? m2 + r * (2 * m1 + r * m0) : m0 / (z1 * z1);
    double a0 = k->area, a1 = last ? 1 : k[1].area, s0 = k->slope, s1 = last ? 1 : k[1].slope;
    if (!(next > r))
        return "the knots do not ascend";
    if (!in_range(m0, least, most) || !in_range(m1, least, fmin(most, gap * m0 + 1e-35)) ||
        !in_range(m2, least, fmin(most, gap * m1 + 1e-35)) ||
        !in_range(k->cube, 0.0, i ? fmin(most, 1.0001 * pow(r, -3)) : most))
        return "a moment is out of range";
    if (!in_range(k->left, 0.0, steepest * mean0) || !in_range(k->right, 0.0, steepest * mean1))
        return "a density is out of range";
    if (!in_range(k->b0, 0.0, 1e6) || !in_range(k->b1, 0.0, 1e6) || !(k->b0 + k->b1 > 1e-6f))
        return "a share is out of range";
    if (!in_range(a0, 1e-20, 1e20) || !in_range(s0, -1e20, 1e20) || width * s0 < -3 * a0 ||
        !(width * s1 <= 3 * a1))
        return "an area is out of range";
    return NULL;
}

static const char *numbers_invalid(const vndf_distribution *t)
{
    const vndf_knot_numbers *k = vndf_knot_at(t, 0);
    if (k->r != 0.0f || !(k[1].r > 1e-12f) || !(k[t->cells].r < 1e14f))
        return "the knots do not run from 0 to below 1e14";
    if (!in_range(t->scale, 1e-18, 1e18) || !in_range(t->normalization, DBL_TRUE_MIN, DBL_MAX))
        return "the scale or normalization is out of range";
    for (size_t i = 0; i <= (size_t)t->cells; i++) {
        const char *why = knot_invalid(t, i);
        if (why)
            return why;
    }
    const vndf_certificate *c = &t->certificate;
    const float claims[VNDF_CERTIFICATE_FLOATS] = {
        c->tv,          c->tv_theta,    c->tv_above,  c->tv_above_theta, c->max_weight, c->weight_bounded,
        c->area_error,  c->consistency, c->ndf_error, c->hidden,         c->finest,     -c->horizon_power,
        c->floor_above, c->floor};
    for (int i = 0; i < VNDF_CERTIFICATE_FLOATS; i++)
        if (!in_range(claims[i], 0.0, HUGE_VAL))
            return "the certificate holds what is no measurement";
    return NULL;
}

/* Places of knots, and from which rho on the law of k~ begins there. */
static void fill_knots(vndf_distribution *t)
{
    double before = 0;
    for (int i = 0; i <= t->cells; i++) {
        vndf_knot_numbers *k = vndf_knot_at(t, (size_t)i);
        double r = k->r, z = 1 / (1 + r), width = ldexp(z, t->squarings);
        if (i < t->cells)
            width = (k[1].r - r) * z / (1 + (double)k[1].r);
        k->z = (float)z;
        k->width = (float)width;
        k->turn = (float)fmin(i > 1 ? fmax(NEAR * before, sqrt(before * r)) : NEAR_FIRST * r, r);
        before = r;
    }
}

/* Sums beyond each knot, from the last one; returns that of all mass. In the first cell k~ is a_1 y + pi, so that knot
 * 0 has the sum of f R from there on, and those of knot 1. */
static double fill_sums(vndf_distribution *t)
{
    double t1 = 0, t0 = 0, tq = 0, t4 = 0, n1 = 0, n2 = 0;
    for (size_t i = (size_t)t->cells + 1; i-- > 0;) {
        vndf_knot_numbers *k = vndf_knot_at(t, i);
        double r = k->r, gap = i < (size_t)t->cells ? k[1].r - r : 0, m0 = k->m0, m1 = k->m1, m2 = k->m2;
        n2 += gap * (2 * n1 + gap * tq) + m2;
        n1 += gap * tq + m1;
        tq += m0;
        t0 += m1 + r * m0;
        t1 += m2 + r * (2 * m1 + r * m0);
        t4 += i > 0 ? k->cube * m0 : 0.0;
        k->along = (float)t1;
        k->all = i ? (float)t0 : k[1].all;
        k->over = i ? (float)tq : k[1].over;
        k->over4 = i ? (float)t4 : k[1].over4;
        k->t1 = (float)n1;
        k->t2 = (float)n2;
    }
    return t0;
}

/* Columns of slopes and of sums beyond them, and their pivots. */
static void fill_columns(vndf_distribution *t)
{
    float *pivot = t->columns + VNDF_COLUMNS * t->column;
    for (int c = 0; c < VNDF_COLUMNS; c++) {
        float *column = t->columns + c * t->column, beyond = c ? -1.0f : 3e38f;
        for (int i = 0; i < t->column; i++) {
            const vndf_knot_numbers *k = vndf_knot_at(t, (size_t)i);
            column[i] = i > t->cells ? beyond : c ? (&k->along)[c - 1] : k->r;
        }
        for (int i = 0; i < t->pivots; i++) {
            int knot = (i + 1) * VNDF_COLUMN_STEP;
            pivot[c * t->pivots + i] = knot < t->column ? column[knot] : beyond;
        }
    }
}

/* By the rounded rho of each part, of which the last has all that are larger. */
static void fill_first(vndf_distribution *t)
{
    int knot = 0;
    for (int i = 0; i < VNDF_RHO_PARTS; i++) {
        union {
            int32_t bits;
            float rho;
        } middle = {((VNDF_RHO_FIRST + i) << 20) + (1 << 19)};
        while (knot < t->cells && vndf_knot_at(t, (size_t)knot + 1)->turn <= middle.rho)
            knot++;
        t->layout->first[i] = knot;
    }
}

/* Entry `at` of the levels is knot i. */
static void fill_level(const vndf_distribution *t, int at, int i)
{
    float of[VNDF_SEARCHED] = {HUGE_VALF, 0.0f, -1.0f, -1.0f, -1.0f, -1.0f, -1.0f, -1.0f};
    if (i <= t->cells) {
        const vndf_knot_numbers *k = vndf_knot_at(t, (size_t)i);
        const float knot[VNDF_SEARCHED] = {k->r * k->r, k->r, k->along, k->all, k->over, k->over4, k->t1, k->t2};
        memcpy(of, knot, sizeof of);
    }
    for (int c = 0; c < VNDF_SEARCHED; c++)
        t->layout->level[c][at] = of[c];
}

static void fill_layout(const vndf_distribution *t)
{
    const int steps = t->steps > VNDF_STEPS_LEAST ? t->steps : VNDF_STEPS_LEAST;
    for (int level = 0; level < VNDF_LEVELS && level < steps; level++)
        for (int n = 1 << level; n < 2 << level; n++)
            fill_level(t, n, (2 * n + 1 - (2 << level)) << (steps - level - 1));
    for (int i = 0; i < VNDF_COPIED && t->cells < VNDF_COPIED; i++)
        for (int k = 0; k < VNDF_STRIDE; k++)
            t->layout->column[k / 4][k % 4][i] = (&vndf_knot_at(t, (size_t)(i < t->cells ? i : t->cells))->r)[k];
}

enum { LINE = 64 }; /* bytes of a line of a cache, and of the widest register */

static size_t layout_bytes(const vndf_distribution *t)
{
    return t->cells < VNDF_COPIED ? sizeof(vndf_layout) : offsetof(vndf_layout, column);
}

static size_t column_floats(const vndf_distribution *t)
{
    return (size_t)VNDF_COLUMNS * (size_t)(t->column + t->pivots);
}

vndf_distribution *vndf_table_allocate(unsigned cells, unsigned moments, unsigned squarings)
{
    vndf_distribution *t = calloc(1, sizeof *t);
    if (!t)
        return NULL;
    t->cells = (int32_t)cells;
    t->moments = (int32_t)moments;
    t->squarings = (int32_t)squarings;
    t->column = t->cells / VNDF_COLUMN_STEP * VNDF_COLUMN_STEP + VNDF_COLUMN_STEP + 1;
    t->pivots = (t->cells / VNDF_COLUMN_STEP + 3) / 4 * 4;
    t->number_count = VNDF_HEAD + VNDF_STRIDE * ((size_t)cells + 1);
    t->numbers = calloc(t->number_count, sizeof(float));
    t->columns = malloc(column_floats(t) * sizeof(float));
    t->room = calloc(1, layout_bytes(t) + LINE);
    if (t->numbers && t->columns && t->room) {
        t->layout = (vndf_layout *)(void *)((char *)t->room + LINE - (uintptr_t)t->room % LINE);
        return t;
    }
    vndf_free(t);
    return NULL;
}

const char *vndf_table_fill(vndf_distribution *t)
{
    const char *why = numbers_invalid(t);
    if (why)
        return why;
    for (t->highest = t->steps = 1; 2 * t->highest <= t->cells; t->steps++)
        t->highest *= 2;
    t->unit = (float)t->scale;
    const float head[VNDF_HEAD] = {(float)t->cells, (float)t->moments, (float)t->squarings,
                                   t->unit,         (float)t->highest, (float)t->steps};
    memcpy(t->numbers, head, sizeof head);
    fill_knots(t);
    if (!(fabs(fill_sums(t) - 1) < 1e-4))
        return "the masses of the cells do not add up to 1";
    for (size_t i = 0; i < t->number_count; i++)
        if (!isfinite(t->numbers[i]))
            return "a sum of moments is not finite";
    fill_columns(t);
    fill_first(t);
    fill_layout(t);
    return NULL;
}

size_t vndf_table_memory(const vndf_distribution *table)
{
    size_t floats = table->number_count + column_floats(table);
    size_t letters = strlen(table->source) + strlen(table->tool) + strlen(table->notes);
    return sizeof *table + floats * sizeof(float) + layout_bytes(table) + LINE + letters + 3;
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
