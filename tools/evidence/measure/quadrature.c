/* Six points of a cell, its corners and one of a side each, make a polynomial of degree 2. Two pairs of other points,
 * drawn at random, each symmetric about the middle, tell how much the mean of the function is off that of the
 * polynomial: without bias whatever the function is, and exactly for one of degree 3. Its error is how much the pairs
 * differ, or two more points say if that is more. Where those are off the polynomial, the cell is divided, the worst
 * first: lines along which the function jumps, and peaks, show themselves there. */
#include "evidence/measure/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/random.h"

enum { CORNERS = 4, SIDES = 6, PAIRS = 10, POINTS = 12 }; /* where they end */

/* In the first rounds counts are heeded, unless one bin of so many is off: then it is the sampler. */
enum { HEEDING = 5, OFTEN = 50 };

/* From -1 to 1 in the cell. Corners and sides are drawn in a little: a jump on the border is seen from this side. */
static void place(const quadrature_cell *c, random_stream *stream, quadrature_point to[POINTS])
{
    static const double END = 1 - 2e-7;
    double at[POINTS][2];
    for (int k = 0; k < POINTS; k++)
        for (int i = 0; i < 2; i++) {
            const double inside = 2 * random_double(stream) - 1;
            at[k][i] = k < CORNERS          ? (k >> i & 1 ? END : -END)
                       : k < SIDES          ? (k - CORNERS == i ? inside / 2 : copysign(END, inside))
                       : k < PAIRS && k % 2 ? -at[k - 1][i]
                                            : inside;
        }
    const double half_x = (c->x[1] - c->x[0]) / 2, half_y = (c->y[1] - c->y[0]) / 2;
    for (int k = 0; k < POINTS; k++)
        to[k] = (quadrature_point){.bin = c->bin,
                                   .x = c->x[0] + half_x * (1 + at[k][0]),
                                   .y = c->y[0] + half_y * (1 + at[k][1]),
                                   .part = k < SIDES || k >= PAIRS ? 0 : half_x * half_y};
}

/* What corners say, linear along x and along y, and a parabola along each. */
typedef struct polynomial {
    double mean, x, y, xy, xx, yy;
} polynomial;

static double part_of(const double of[2], double x)
{
    return (2 * x - of[0] - of[1]) / (of[1] - of[0]);
}

static double off(const polynomial *p, const quadrature_cell *c, const quadrature_point *at, int which)
{
    const double x = part_of(c->x, at->x), y = part_of(c->y, at->y);
    return at->value[which] - p->mean - x * p->x - y * p->y - x * y * p->xy - (1 - x * x) * p->xx -
           (1 - y * y) * p->yy;
}

static polynomial fit(const quadrature_cell *c, const quadrature_point at[POINTS], int which)
{
    const double low = at[0].value[which], right = at[1].value[which];
    const double up = at[2].value[which], high = at[3].value[which];
    const double x = part_of(c->x, at[4].x), y = part_of(c->y, at[5].y);
    polynomial p = {.mean = (low + right + up + high) / 4,
                    .x = (right + high - low - up) / 4,
                    .y = (up + high - low - right) / 4,
                    .xy = (low + high - right - up) / 4};
    const double along_x = off(&p, c, &at[4], which), along_y = off(&p, c, &at[5], which);
    p.xx = along_x / (1 - x * x);
    p.yy = along_y / (1 - y * y);
    return p;
}

static void measure(quadrature_cell *c, const quadrature_point at[POINTS])
{
    const double area = (c->x[1] - c->x[0]) * (c->y[1] - c->y[0]);
    double worst[2] = {0}, pair[2] = {0};
    polynomial p[2];
    for (int i = 0; i < 2; i++) {
        p[i] = fit(c, at, i);
        for (int k = PAIRS; k < POINTS; k++)
            worst[i] = fmax(worst[i], fabs(off(&p[i], c, &at[k], i)));
    }
    for (int k = SIDES; k < PAIRS; k++) {
        const double f = at[k].value[0], g = at[k].value[1], part = at[k].part;
        pair[k / 2 % 2] += off(&p[0], c, &at[k], 0) / 2;
        c->sum.distance += part * fabs(f - g) / 2;
        c->sum.square += f > 0 ? part * g / f * g : 0;
        c->sum.uncovered += f > 0 ? 0 : part * g;
    }
    const double error = area * fmax(fabs(pair[0] - pair[1]) / 2, worst[0] / 3);
    c->sum.value = area * (p[0].mean + (p[0].xx + p[0].yy) * 2 / 3 + (pair[0] + pair[1]) / 2);
    c->sum.variance = error * error;
    c->urgency = area / 3 * fmax(worst[0], worst[1]);
    c->along[0] = fabs(at[1].value[0] - at[0].value[0]) + fabs(at[3].value[0] - at[2].value[0]) + fabs(p[0].xx);
    c->along[1] = fabs(at[2].value[0] - at[0].value[0]) + fabs(at[3].value[0] - at[1].value[0]) + fabs(p[0].yy);
    c->is_asked = 1;
}

static int ask(const quadrature *q, quadrature_cell *cells, size_t count, random_stream *stream)
{
    size_t asked = 0;
    for (size_t i = 0; i < count; i++)
        asked += !cells[i].is_asked;
    quadrature_point *at = malloc((asked + 1) * POINTS * sizeof *at), *next = at;
    for (size_t i = 0; i < count && at; i++)
        if (!cells[i].is_asked) {
            place(&cells[i], stream, next);
            next += POINTS;
        }
    const int good = q->answer(q->of, at, at ? asked * POINTS : 0) && at;
    next = at;
    for (size_t i = 0; i < count && good; i++)
        if (!cells[i].is_asked) {
            measure(&cells[i], next);
            next += POINTS;
        }
    free(at);
    return good;
}

static void add_up(const quadrature *q, const quadrature_cell *cells, size_t count, quadrature_sum *sum)
{
    memset(sum, 0, q->bins * sizeof *sum);
    for (const quadrature_cell *c = cells; c < cells + count; c++) {
        quadrature_sum *to = &sum[c->bin];
        to->value += c->sum.value;
        to->variance += c->sum.variance;
        to->distance += c->sum.distance;
        to->square += c->sum.square;
        to->uncovered += c->sum.uncovered;
    }
}

static int most_urgent(const void *a, const void *b)
{
    const double x = ((const quadrature_cell *)a)->urgency, y = ((const quadrature_cell *)b)->urgency;
    return (x < y) - (x > y);
}

/* By bins: who answers may prepare what it needs for a whole. */
static int in_order(const void *a, const void *b)
{
    const size_t x = ((const quadrature_cell *)a)->bin, y = ((const quadrature_cell *)b)->bin;
    return (x > y) - (x < y);
}

static int is_accused(const quadrature *q, size_t bin, const quadrature_sum *sum)
{
    const double count = q->observed ? q->observed[bin] : 0;
    const double expected = q->observed ? sum[bin].value * q->samples : 0;
    return fabs(count - expected) > 3 * sqrt(fmax(count, expected)) + 1;
}

/* Along x, along y, or both if both matter, into the cell and behind the others; returns how many there are. */
static size_t halve(quadrature_cell *of, quadrature_cell *cells, size_t count)
{
    const quadrature_cell c = *of;
    const int columns = c.along[1] > 4 * c.along[0] ? 1 : 2, rows = c.along[0] > 4 * c.along[1] ? 1 : 2;
    const double wide = (c.x[1] - c.x[0]) / columns, high = (c.y[1] - c.y[0]) / rows;
    for (int k = 0; k < columns * rows; k++) {
        const double x = c.x[0] + wide * (k % columns), y = c.y[0] + high * (double)(k / columns);
        *(k ? &cells[count++] : of) = (quadrature_cell){.bin = c.bin, {x, x + wide}, {y, y + high}};
    }
    return count;
}

/* The worst first, and those of a bin whose count is far from its integral. */
static size_t divide(const quadrature *q, quadrature_cell *cells, size_t count, const quadrature_sum *sum,
                     int round)
{
    const size_t before = count;
    size_t accused = 0;
    for (size_t i = 0; i < q->bins; i++)
        accused += (size_t)is_accused(q, i, sum);
    const int is_heeded = round < HEEDING && accused < q->bins / OFTEN;
    qsort(cells, before, sizeof *cells, most_urgent);
    for (size_t i = 0; i < before && count + 3 <= q->most; i++)
        if ((cells[i].urgency > q->close && cells[i].x[1] - cells[i].x[0] > q->finest) ||
            (is_heeded && is_accused(q, cells[i].bin, sum)))
            count = halve(&cells[i], cells, count);
    qsort(cells, count, sizeof *cells, in_order);
    return count;
}

int quadrature_run(const quadrature *q, quadrature_cell *cells, size_t count, quadrature_sum *sum)
{
    random_stream stream = random_from(q->seed);
    for (int round = 0;; round++) {
        if (!ask(q, cells, count, &stream))
            return 0;
        add_up(q, cells, count, sum);
        const size_t before = count;
        if (round + 1 < q->rounds)
            count = divide(q, cells, count, sum, round);
        if (count == before)
            return 1;
    }
}
