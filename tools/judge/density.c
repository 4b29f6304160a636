/* The integral of the density over bins, with an error that is measured. Bins are cells, rectangles of theta and the
 * azimuth. Where two points and a sample in a cell are off what its corners say, linear in theta and in the azimuth, it
 * is divided, the worst first: lines along which the density jumps, and peaks, show themselves there. Two pairs of
 * other points, drawn at random, each symmetric about the middle, measure it: their mean has no bias whatever the
 * density is. Its error is how much they differ, or the two points and the sample say if that is more. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/random.h"
#include "judge/judge.h"

/* A cell may err by this part of all mass; a fourth of it where the mass of a direction may err by more than 2e-3, four
 * times the root of MASS_MAY. */
static const double CLOSE = 4e-6, MASS_MAY = 2.5e-7;

/* Each round runs the command. In the first ones counts are heeded. */
enum { ROUNDS = 8, HEEDING = 5, CELLS_MAX = 40000 * JUDGE_VIEWS, POINTS = 10, PAIRS = 8 };

/* What is integrated; the efficiency is the reciprocal of SQUARE. */
enum { MASS, DISTANCE, SQUARE, UNCOVERED, VALUES };

typedef struct cell {
    size_t bin; /* of all directions, one after the other */
    double x[2], y[2];
    double value[VALUES], error;
    double urgency;  /* the error by corners, of the truth as well; negative: not asked yet */
    double along[2]; /* how much the corners differ along x, and along y */
} cell;

typedef struct integrating {
    const judge_task *task;
    judgement *j;
    vndf_view truth[JUDGE_VIEWS]; /* without a distribution all is 0 */
    random_stream stream;
    cell *cells;
    size_t count, bins;
} integrating;

/* ---- cells --------------------------------------------------------------------------------------- */

/* In parts of the cell: corners, drawn in a little, two pairs, and two that are not measured by. */
static void place(double at[POINTS][2], random_stream *stream)
{
    for (int k = 0; k < POINTS; k++)
        for (int i = 0; i < 2; i++)
            at[k][i] = k < 4                ? (k >> i & 1 ? 0.9999999 : 1e-7)
                       : k < PAIRS && k % 2 ? 1 - at[k - 1][i]
                                            : random_double(stream);
}

/* How much f, at (x, y) of the cell, is off what the corners say. */
static double off_corners(const double corner[4], const double at[2], double f)
{
    const double low = corner[0] + at[0] * (corner[1] - corner[0]),
                 high = corner[2] + at[0] * (corner[3] - corner[2]);
    return fabs(f - low - at[1] * (high - low));
}

static void take(integrating *of, cell *c, double at[POINTS][2], const query *asked, const answer *got)
{
    judge_view *v = &of->j->view[c->bin / JUDGE_BINS];
    const exchange *sample = &v->sample[c->bin % JUDGE_BINS], *most = &v->density[c->bin % JUDGE_BINS];
    const double area = (c->x[1] - c->x[0]) * (c->y[1] - c->y[0]);
    double p[POINTS], truth[POINTS], place[2], off = 0, true_off = 0;
    for (int k = 0; k < POINTS; k++) {
        const exchange its = {asked[k], got[k]};
        const double sine = sin(c->x[0] + at[k][0] * (c->x[1] - c->x[0])),
                     part = k < 4 || k >= PAIRS ? 0 : area / 4;
        const int is_valid = got[k].pdf >= 0 && isfinite(got[k].pdf);
        p[k] = is_valid ? got[k].pdf * sine : 0;
        truth[k] = (double)vndf_visible(&of->truth[c->bin / JUDGE_BINS], asked[k].x) * sine;
        const double apart = part * fabs(p[k] - truth[k]), lost = p[k] > 0 ? 0 : part * truth[k];
        const double value[VALUES] = {part * p[k], apart / 2, p[k] > 0 ? part * truth[k] / p[k] * truth[k] : 0,
                                      lost};
        for (int i = 0; i < VALUES; i++)
            c->value[i] += value[i];
        if (k >= PAIRS) {
            off = fmax(off, off_corners(p, at[k], p[k]));
            true_off = fmax(true_off, off_corners(truth, at[k], truth[k]));
        }
        if (!is_valid)
            judge_note(&of->j->fault[JUDGE_VALID], of->j->fault[JUDGE_VALID].worst + 1, NAN, &its);
        judge_note(&of->j->fault[JUDGE_NORMALS], apart, truth[k] / sine, &its);
        judge_note(&of->j->fault[JUDGE_COVERS], lost, truth[k] / sine, &its);
        if (p[k] >= most->got.pdf * sine)
            v->density[c->bin % JUDGE_BINS] = its;
    }
    judge_locate(v, &sample->got, &place[0], &place[1]);
    const double there[2] = {(place[0] - c->x[0]) / (c->x[1] - c->x[0]),
                             (place[1] - c->y[0]) / (c->y[1] - c->y[0])};
    if (sample->asked.kind && there[0] >= 0 && there[0] <= 1 && there[1] >= 0 && there[1] <= 1)
        off = fmax(off, off_corners(p, there, sample->got.pdf * sin(place[0])));
    c->error = fmax(area / 4 * fabs(p[4] + p[5] - p[6] - p[7]), area / 3 * off);
    c->urgency = area / 3 * fmax(off, true_off);
    c->along[0] = fabs(p[1] - p[0]) + fabs(p[3] - p[2]);
    c->along[1] = fabs(p[2] - p[0]) + fabs(p[3] - p[1]);
}

/* What was not asked yet. */
static int ask(integrating *of)
{
    double(*at)[POINTS][2] = malloc(of->count * sizeof *at);
    query *asked = malloc(of->count * POINTS * sizeof *asked);
    size_t count = 0;
    for (size_t i = 0; i < of->count && at && asked; i++) {
        const cell *c = &of->cells[i];
        const judge_view *v = &of->j->view[c->bin / JUDGE_BINS];
        if (c->urgency >= 0)
            continue;
        place(at[count], &of->stream);
        for (int k = 0; k < POINTS; k++) {
            const double theta = c->x[0] + at[count][k][0] * (c->x[1] - c->x[0]), sine = sin(theta);
            const double phi = c->y[0] + at[count][k][1] * (c->y[1] - c->y[0]) + v->turn;
            const vndf_vec3 wm = {(float)(sine * cos(phi)), (float)(sine * sin(phi)), (float)cos(theta)};
            asked[count * POINTS + (size_t)k] = (query){'p', v->wi, wm};
        }
        count++;
    }
    answer *got = process_ask(of->task, at ? asked : NULL, count * POINTS);
    for (size_t i = 0, next = 0; i < of->count && got; i++)
        if (of->cells[i].urgency < 0) {
            take(of, &of->cells[i], at[next], asked + next * POINTS, got + next * POINTS);
            next++;
        }
    free(at);
    free(asked);
    free(got);
    return got != NULL;
}

/* ---- rounds -------------------------------------------------------------------------------------- */

static int most_urgent(const void *a, const void *b)
{
    const double x = ((const cell *)a)->urgency, y = ((const cell *)b)->urgency;
    return (x < y) - (x > y);
}

/* By directions: a sampler may prepare what it needs for one. */
static int in_order(const void *a, const void *b)
{
    const size_t x = ((const cell *)a)->bin, y = ((const cell *)b)->bin;
    return (x > y) - (x < y);
}

static int is_accused(const integrating *of, size_t bin, double mass)
{
    const double count = of->j->view[bin / JUDGE_BINS].observed[bin % JUDGE_BINS];
    const double expected = mass * (double)of->task->samples;
    return fabs(count - expected) > 3 * sqrt(fmax(count, expected)) + 1;
}

/* Along x, along y, or both if both matter; the worst first, and those of a bin whose count is far from its integral,
 * unless so many are that it is the sampler. Returns whether any was divided. */
static int divide(integrating *of, int round)
{
    static double mass[JUDGE_VIEWS * JUDGE_BINS];
    const size_t before = of->count;
    double squares[JUDGE_VIEWS] = {0};
    size_t accused = 0;
    memset(mass, 0, sizeof mass);
    for (const cell *c = of->cells; c < of->cells + before; c++) {
        squares[c->bin / JUDGE_BINS] += c->error * c->error;
        mass[c->bin] += c->value[MASS];
    }
    for (size_t i = 0; i < JUDGE_VIEWS * JUDGE_BINS; i++)
        accused += (size_t)is_accused(of, i, mass[i]);
    const int is_heeded = round < HEEDING && accused < of->bins / 50;
    qsort(of->cells, before, sizeof *of->cells, most_urgent);
    for (size_t i = 0; i < before && of->count + 3 <= CELLS_MAX; i++) {
        const cell c = of->cells[i];
        const int is_mass = of->j->view[c.bin / JUDGE_BINS].is_first && squares[c.bin / JUDGE_BINS] > MASS_MAY;
        const int columns = c.along[1] > 4 * c.along[0] ? 1 : 2, rows = c.along[0] > 4 * c.along[1] ? 1 : 2;
        if (c.urgency <= (is_mass ? CLOSE / 4 : CLOSE) && !(is_heeded && is_accused(of, c.bin, mass[c.bin])))
            continue;
        const double wide = (c.x[1] - c.x[0]) / columns, high = (c.y[1] - c.y[0]) / rows;
        for (int k = 0; k < columns * rows; k++) {
            const double x = c.x[0] + wide * (k % columns), y = c.y[0] + high * (double)(k / columns);
            of->cells[k ? of->count++ : i] = (cell){.bin = c.bin, {x, x + wide}, {y, y + high}, .urgency = -1};
        }
    }
    qsort(of->cells, of->count, sizeof *of->cells, in_order);
    return of->count > before;
}

/* Sums over the bins of each direction, and the worst of them. */
static void sum_up(const integrating *of)
{
    judgement *j = of->j;
    j->fault[JUDGE_NORMALS].worst = j->fault[JUDGE_COVERS].worst = 0;
    for (const cell *c = of->cells; c < of->cells + of->count; c++) {
        judge_view *v = &j->view[c->bin / JUDGE_BINS];
        v->mass[c->bin % JUDGE_BINS] += c->value[MASS];
        v->variance[c->bin % JUDGE_BINS] += c->error * c->error;
        v->total += c->value[MASS];
        v->error += c->error * c->error;
        v->tv += c->value[DISTANCE];
        v->efficiency += c->value[SQUARE];
        v->uncovered += c->value[UNCOVERED];
    }
    for (judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        v->error = 4 * sqrt(v->error);
        v->efficiency = v->efficiency > 0 ? 1 / (v->efficiency * v->total) : 0;
        j->fault[JUDGE_NORMALS].worst = fmax(j->fault[JUDGE_NORMALS].worst, v->tv);
        j->fault[JUDGE_COVERS].worst = fmax(j->fault[JUDGE_COVERS].worst, v->uncovered);
        if (v->is_first)
            judge_note(&j->fault[JUDGE_MASS], fabs(v->total - 1) - v->error, NAN, &v->first[0]);
    }
}

int judge_integrate(const judge_task *task, progress *bar, judgement *j)
{
    integrating of = {.task = task, .j = j, .stream = random_from(task->seed ^ 0x5851F42D4C957F2Du)};
    int good = (of.cells = malloc(CELLS_MAX * sizeof *of.cells)) != NULL;
    for (size_t i = 0; i < JUDGE_VIEWS && good; i++) {
        const judge_view *v = &j->view[i];
        of.truth[i] = vndf_view_from(&task->surface, v->wi);
        for (size_t k = 0; k < v->rings * v->sectors; k++) {
            const double *theta = &v->ring[k / v->sectors], *phi = &v->sector[k % v->sectors];
            if (theta[0] < theta[1] && phi[0] < phi[1])
                of.cells[of.count++] = (cell){
                    .bin = i * JUDGE_BINS + k, .x = {theta[0], theta[1]}, .y = {phi[0], phi[1]}, .urgency = -1};
        }
    }
    of.bins = of.count;
    for (int round = 0; round < ROUNDS && good; round++) {
        progress_show((double)round / ROUNDS, "densities", bar);
        good = ask(&of);
        if (good && (round == ROUNDS - 1 || !divide(&of, round)))
            break;
    }
    if (good)
        sum_up(&of);
    free(of.cells);
    return good;
}
