/* The integral of the density over bins, with an error that is measured. Bins are cells, rectangles of theta and the
 * azimuth. Where a cell is not what its corners say, it is divided in four, the worst cells first;
 * a line across a cell, along which the density jumps, shows itself there. Where they have settled, each cell is asked
 * at fresh points: two pairs, drawn at random, each symmetric about the middle. Their mean has no bias whatever
 * the density is, and their difference is its error. */
#include <math.h>
#include <stdlib.h>

#include "cli/random.h"
#include "judge/judge.h"

/* A cell may err by this part of all mass. */
static const double CLOSE = 4e-6;

/* Each round runs the command. In the first ones bins are divided whose count is far from their integral, too: there
 * may be a peak between the points. */
enum { ROUNDS = 7, COUNTING = 3, CELLS_MAX = 40000 * JUDGE_VIEWS };

typedef struct cell {
    size_t bin; /* of all directions, one after the other */
    double x[2], y[2], mass, error;
    double urgency;  /* the error, or more; negative: not measured yet */
    double along[2]; /* how much the corners differ along x, and along y */
} cell;

typedef struct point {
    size_t bin;
    double x, y, p, truth; /* densities of theta and the azimuth */
    exchange shown;
} point;

typedef struct integrating {
    const judge_task *task;
    judgement *j;
    vndf_view truth[JUDGE_VIEWS]; /* without a distribution all is 0 */
    progress *bar;
    double round;
    cell *cells;
    size_t count;
} integrating;

/* ---- points -------------------------------------------------------------------------------------- */

static int ask(integrating *of, point *at, size_t count)
{
    query *asked = malloc(count * sizeof *asked);
    for (size_t i = 0; i < count && asked; i++) {
        const judge_view *v = &of->j->view[at[i].bin / JUDGE_BINS];
        const double phi = at[i].y + v->turn, sine = sin(at[i].x);
        asked[i] = (query){'p', v->wi, {(float)(sine * cos(phi)), (float)(sine * sin(phi)), (float)cos(at[i].x)}};
    }
    progress_show(++of->round / (ROUNDS + 1), "densities", of->bar);
    answer *got = process_ask(of->task, asked, count);
    for (size_t i = 0; i < count && got; i++) {
        judge_fault *invalid = &of->j->fault[JUDGE_VALID];
        const int is_valid = got[i].pdf >= 0 && isfinite(got[i].pdf);
        at[i].shown = (exchange){asked[i], got[i]};
        at[i].p = is_valid ? got[i].pdf * sin(at[i].x) : 0;
        at[i].truth = (double)vndf_visible(&of->truth[at[i].bin / JUDGE_BINS], asked[i].x) * sin(at[i].x);
        if (!is_valid)
            judge_note(invalid, invalid->worst + 1, NAN, &at[i].shown);
    }
    free(asked);
    free(got);
    return got != NULL;
}

/* Half of its sides away from the middle by (x, y), of -1 to 1. */
static point place(const cell *c, double x, double y)
{
    return (point){.bin = c->bin,
                   .x = (c->x[0] + c->x[1]) / 2 + (c->x[1] - c->x[0]) / 2 * x,
                   .y = (c->y[0] + c->y[1]) / 2 + (c->y[1] - c->y[0]) / 2 * y};
}

static double area_of(const cell *c)
{
    return (c->x[1] - c->x[0]) * (c->y[1] - c->y[0]);
}

/* ---- cells --------------------------------------------------------------------------------------- */

static double between(const cell *c, const double corner[4], const point *p)
{
    const double x = (p->x - c->x[0]) / (c->x[1] - c->x[0]), y = (p->y - c->y[0]) / (c->y[1] - c->y[0]);
    return (1 - y) * ((1 - x) * corner[0] + x * corner[1]) + y * ((1 - x) * corner[2] + x * corner[3]);
}

static void compare(cell *c, const point at[7])
{
    const double p[4] = {at[0].p, at[1].p, at[2].p, at[3].p}, area = area_of(c);
    const double truth[4] = {at[0].truth, at[1].truth, at[2].truth, at[3].truth};
    double error = 0, true_error = 0;
    for (int k = 4; k < 7; k++) {
        error = fmax(error, fabs(at[k].p - between(c, p, &at[k])));
        true_error = fmax(true_error, fabs(at[k].truth - between(c, truth, &at[k])));
    }
    c->mass = area * ((p[0] + p[1] + p[2] + p[3]) / 12 + (at[4].p + at[5].p + at[6].p) * 2 / 9);
    c->error = area / 3 * error;
    c->urgency = area / 3 * fmax(error, true_error);
    c->along[0] = fabs(p[1] - p[0]) + fabs(p[3] - p[2]);
    c->along[1] = fabs(p[2] - p[0]) + fabs(p[3] - p[1]);
}

/* What is new: by its corners, drawn in a little, and three points between; what these differ by from what the corners
 * say of them, linear along x and y, is an error. */
static int look(integrating *of, random_stream *stream)
{
    enum { POINTS = 7 };
    static const double in = 0.9999999;
    point *at = malloc(of->count * POINTS * sizeof *at);
    size_t asked = 0, next = 0;
    for (size_t i = 0; i < of->count && at; i++)
        for (int k = 0; k < POINTS && of->cells[i].urgency < 0; k++) {
            const double x = k & 1 ? in : -in, y = k & 2 ? in : -in;
            const double u = 2 * random_double(stream) - 1, v = 2 * random_double(stream) - 1;
            at[asked++] = k < 4 ? place(&of->cells[i], x, y) : place(&of->cells[i], u, v);
        }
    const int good = at && ask(of, at, asked);
    for (size_t i = 0; i < of->count && good; i++)
        if (of->cells[i].urgency < 0)
            compare(&of->cells[i], at + POINTS * next++);
    free(at);
    return good;
}

/* More than five standard deviations of the count. */
static void heed_counts(integrating *of)
{
    static double mass[JUDGE_VIEWS * JUDGE_BINS], parts[JUDGE_VIEWS * JUDGE_BINS];
    const double samples = (double)of->task->samples;
    for (size_t i = 0; i < JUDGE_VIEWS * JUDGE_BINS; i++)
        mass[i] = parts[i] = 0;
    for (size_t i = 0; i < of->count; i++) {
        mass[of->cells[i].bin] += of->cells[i].mass;
        parts[of->cells[i].bin] += 1;
    }
    for (size_t i = 0; i < of->count; i++) {
        const size_t bin = of->cells[i].bin;
        const double count = of->j->view[bin / JUDGE_BINS].observed[bin % JUDGE_BINS];
        const double off = fabs(count - samples * mass[bin]);
        if (off > 5 * sqrt(fmax(count, samples * mass[bin])) + 5)
            of->cells[i].urgency = fmax(of->cells[i].urgency, off / samples / parts[bin]);
    }
}

static int most_urgent(const void *a, const void *b)
{
    const double x = ((const cell *)a)->urgency, y = ((const cell *)b)->urgency;
    return (x < y) - (x > y);
}

/* Of directions: a sampler may prepare what it needs for one. */
static int in_order(const void *a, const void *b)
{
    const size_t x = ((const cell *)a)->bin, y = ((const cell *)b)->bin;
    return (x > y) - (x < y);
}

/* Along x, along y, or both if both matter. Returns whether any was divided. */
static int divide(integrating *of)
{
    const size_t before = of->count;
    qsort(of->cells, before, sizeof *of->cells, most_urgent);
    for (size_t i = 0; i < before && of->cells[i].urgency > CLOSE && of->count + 3 <= CELLS_MAX; i++) {
        const cell c = of->cells[i];
        const int columns = c.along[1] > 4 * c.along[0] ? 1 : 2, rows = c.along[0] > 4 * c.along[1] ? 1 : 2;
        const double wide = (c.x[1] - c.x[0]) / columns, high = (c.y[1] - c.y[0]) / rows;
        for (int k = 0; k < columns * rows; k++) {
            const double x = c.x[0] + wide * (k % columns), y = c.y[0] + high * (double)(k / columns);
            of->cells[k ? of->count++ : i] = (cell){.bin = c.bin, {x, x + wide}, {y, y + high}, .urgency = -1};
        }
    }
    qsort(of->cells, of->count, sizeof *of->cells, in_order);
    return of->count > before;
}

/* ---- integrals ----------------------------------------------------------------------------------- */

static void add(judgement *j, const cell *c, const point at[4])
{
    judge_view *v = &j->view[c->bin / JUDGE_BINS];
    const size_t bin = c->bin % JUDGE_BINS;
    const double area = area_of(c), a = (at[0].p + at[1].p) / 2, b = (at[2].p + at[3].p) / 2;
    const double error = fmax(area * fabs(a - b) / 2, c->error);
    v->mass[bin] += area * (a + b) / 2;
    v->variance[bin] += error * error;
    for (const point *q = at; q < at + 4; q++) {
        const double off = area / 4 * fabs(q->p - q->truth), sine = sin(q->x);
        v->tv += off / 2;
        v->efficiency += q->p > 0 ? area / 4 * q->truth / q->p * q->truth : 0; /* its reciprocal, for now */
        v->uncovered += q->p > 0 ? 0 : area / 4 * q->truth;
        judge_note(&j->fault[JUDGE_NORMALS], off, q->truth / sine, &q->shown);
        judge_note(&j->fault[JUDGE_COVERS], q->p > 0 ? 0 : off, q->truth / sine, &q->shown);
        if (q->shown.got.pdf >= v->density[bin].got.pdf)
            v->density[bin] = q->shown;
    }
}

static int measure(integrating *of, random_stream *stream)
{
    point *at = malloc(of->count * 4 * sizeof *at);
    for (size_t i = 0; i < of->count * 4 && at; i += 2) {
        const double x = 2 * random_double(stream) - 1, y = 2 * random_double(stream) - 1;
        at[i] = place(&of->cells[i / 4], x, y);
        at[i + 1] = place(&of->cells[i / 4], -x, -y);
    }
    const int good = at && ask(of, at, of->count * 4);
    for (size_t i = 0; i < of->count && good; i++)
        add(of->j, &of->cells[i], at + 4 * i);
    free(at);
    return good;
}

/* Sums over the bins of each direction, and the worst of them. */
static void sum_up(judgement *j)
{
    double most[JUDGE_NUMBERS] = {0};
    for (judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        for (size_t i = 0; i < JUDGE_BINS; i++) {
            v->total += v->mass[i];
            v->error += v->variance[i];
        }
        v->error = 4 * sqrt(v->error);
        v->efficiency = v->efficiency > 0 ? 1 / (v->efficiency * v->total) : 0;
        most[JUDGE_NORMALS] = fmax(most[JUDGE_NORMALS], v->tv);
        most[JUDGE_COVERS] = fmax(most[JUDGE_COVERS], v->uncovered);
        if (v->is_first)
            judge_note(&j->fault[JUDGE_MASS], fabs(v->total - 1) - v->error, NAN, &v->first[0]);
    }
    j->fault[JUDGE_NORMALS].worst = most[JUDGE_NORMALS];
    j->fault[JUDGE_COVERS].worst = most[JUDGE_COVERS];
}

int judge_integrate(const judge_task *task, progress *bar, judgement *j)
{
    integrating of = {.task = task, .j = j, .bar = bar};
    random_stream stream = random_from(task->seed ^ 0x5851F42D4C957F2Du); /* apart from that of the samples */
    int good = (of.cells = malloc(CELLS_MAX * sizeof *of.cells)) != NULL;
    for (size_t i = 0; i < JUDGE_VIEWS * JUDGE_BINS && good; i++) {
        const judge_view *v = &j->view[i / JUDGE_BINS];
        const double *theta = &v->ring[i % JUDGE_BINS / v->sectors], *phi = &v->sector[i % v->sectors];
        if (theta[0] < theta[1] && phi[0] < phi[1])
            of.cells[of.count++] = (cell){i, {theta[0], theta[1]}, {phi[0], phi[1]}, .urgency = -1};
    }
    for (int i = 0; i < JUDGE_VIEWS; i++)
        of.truth[i] = vndf_view_from(&task->surface, j->view[i].wi);
    for (int round = 0; round < ROUNDS && good; round++) {
        good = look(&of, &stream);
        if (round < COUNTING && good)
            heed_counts(&of);
        if (!good || !divide(&of))
            break;
    }
    good = good && measure(&of, &stream);
    free(of.cells);
    if (good)
        sum_up(j);
    return good;
}
