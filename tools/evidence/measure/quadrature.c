/* A cell is measured by Lobatto's rule of 5 x 5 points, exact to degree 7 in x and y. Where Simpson's, on three of
 * them, differs too much along x or y, the cell is halved there, and asked for again. Both have points on the border of
 * the cell, drawn in by 1e-7 of half of it: a jump in a cell is seen wherever it is, one on its border from this
 * side. */
#include "evidence/measure/quadrature.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 5, POINTS = NODES * NODES };
static const double node[NODES] = {-0.9999999, -0.65465367070797714, 0, 0.65465367070797714, 0.9999999};
static const double lobatto[NODES] = {1.0 / 10, 49.0 / 90, 64.0 / 90, 49.0 / 90, 1.0 / 10};
static const double simpson[NODES] = {1.0 / 3, 0, 4.0 / 3, 0, 1.0 / 3};

static void place(const quadrature_cell *c, quadrature_point to[POINTS])
{
    const double x = (c->x[0] + c->x[1]) / 2, half_x = (c->x[1] - c->x[0]) / 2;
    const double y = (c->y[0] + c->y[1]) / 2, half_y = (c->y[1] - c->y[0]) / 2;
    for (int k = 0; k < POINTS; k++)
        to[k] = (quadrature_point){c->bin, x + half_x * node[k / NODES], y + half_y * node[k % NODES], 0};
}

/* differs[]: by how much the two rules do, along x and along y. */
static quadrature_sum measure(const quadrature_cell *c, const quadrature_point at[POINTS], double differs[2])
{
    const double half_y = (c->y[1] - c->y[0]) / 2, area = (c->x[1] - c->x[0]) / 2 * half_y;
    double few[2] = {0}, along[NODES] = {0};
    quadrature_sum sum = {0, 0, 0};
    for (int k = 0; k < POINTS; k++) {
        const int i = k / NODES, j = k % NODES;
        sum.value += area * lobatto[i] * lobatto[j] * at[k].value;
        few[0] += area * simpson[i] * lobatto[j] * at[k].value;
        few[1] += area * lobatto[i] * simpson[j] * at[k].value;
        along[i] += half_y * lobatto[j] * at[k].value;
    }
    for (int i = 0; i < 2; i++)
        differs[i] = fabs(few[i] - sum.value);
    for (int i = 1; i < NODES; i++)
        sum.change += fabs(along[i] - along[i - 1]);
    sum.error = fmax(differs[0], differs[1]);
    return sum;
}

/* In both directions if both differ too much; returns how many cells there are. */
static size_t halve(const quadrature_cell *c, const double differs[2], double allowed, quadrature_cell to[4])
{
    const int columns = differs[0] > allowed ? 2 : 1, count = columns * (differs[1] > allowed ? 2 : 1);
    const double x[3] = {c->x[0], columns == 1 ? c->x[1] : (c->x[0] + c->x[1]) / 2, c->x[1]};
    const double y[3] = {c->y[0], count == columns ? c->y[1] : (c->y[0] + c->y[1]) / 2, c->y[1]};
    for (int k = 0; k < count; k++) {
        const int i = k % columns, j = k / columns;
        to[k] = (quadrature_cell){c->bin, {x[i], x[i + 1]}, {y[j], y[j + 1]}, c->halvings + 1};
    }
    return (size_t)count;
}

static void add(quadrature_sum *to, const quadrature_sum *of)
{
    to->value += of->value;
    to->error += of->error;
    to->change += of->change;
}

/* The cells that wait are a stack, so that there are never many. */
int quadrature_run(const quadrature *q, const quadrature_cell *cells, size_t count, quadrature_sum *sum)
{
    quadrature_cell *waiting = malloc(count * sizeof *waiting);
    int good = waiting != NULL;
    if (good)
        memcpy(waiting, cells, count * sizeof *waiting);
    while (count > 0 && good) {
        const size_t now = count < q->at_once ? count : q->at_once;
        quadrature_cell *more = realloc(waiting, (count + 3 * now) * sizeof *more),
                        *cell = malloc(now * sizeof *cell);
        quadrature_point *at = malloc(now * POINTS * sizeof *at);
        waiting = more ? more : waiting;
        good = more && cell && at;
        count -= now;
        for (size_t i = 0; i < now && good; i++) {
            cell[i] = waiting[count + i];
            place(&cell[i], at + i * POINTS);
        }
        good = good && q->answer(q->of, at, now * POINTS);
        for (size_t i = 0; i < now && good; i++) {
            double differs[2];
            const quadrature_sum found = measure(&cell[i], at + i * POINTS, differs);
            const double allowed = fmax(fmax(q->absolute, q->relative * found.value), q->rounding * found.change);
            if (found.error <= allowed || cell[i].halvings == q->halvings)
                add(&sum[cell[i].bin], &found);
            else
                count += halve(&cell[i], differs, allowed, waiting + count);
        }
        free(cell);
        free(at);
    }
    free(waiting);
    return good;
}
