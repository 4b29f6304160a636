/* The integral of the density over bins (evidence/measure/measure.h), of theta and the azimuth, and what is seen on
 * the way: densities that are none, and how far they are from the true visible normals. */
#include <math.h>
#include <stdlib.h>

#include "cli/arguments.h"
#include "judge/judge.h"

/* What a cell may err, of all mass. Each round runs the command. */
static const double CLOSE = 4e-6;
enum { ROUNDS = 8, CELLS_MAX = 40000 * JUDGE_VIEWS };

typedef struct integrating {
    const judge_task *task;
    judgement *j;
    progress *bar;
    int round;
    vndf_view truth[JUDGE_VIEWS]; /* without a distribution all is 0 */
} integrating;

/* Both densities per theta and azimuth, and what they show. */
static void take(integrating *of, quadrature_point *at, const exchange *its)
{
    const size_t view = at->bin / JUDGE_EACH;
    exchange *most = &of->j->view[view].density[at->bin % JUDGE_EACH];
    judge_fault *fault = of->j->fault;
    const double sine = sin(at->x), p = its->got.pdf;
    const double truth = (double)vndf_visible(&of->truth[view], its->asked.x);
    const int is_valid = p >= 0 && isfinite(p);
    at->value[0] = is_valid ? p * sine : 0;
    at->value[1] = truth * sine;
    if (!is_valid)
        judge_note(&fault[JUDGE_VALID], fault[JUDGE_VALID].worst + 1, NAN, its);
    judge_note(&fault[JUDGE_NORMALS], at->part * fabs(at->value[0] - at->value[1]), truth, its);
    judge_note(&fault[JUDGE_COVERS], at->value[0] > 0 ? 0 : at->part * at->value[1], truth, its);
    if (at->value[0] >= most->got.pdf * sine)
        *most = *its;
}

static int ask(void *user, quadrature_point *at, size_t count)
{
    integrating *of = user;
    query *asked = malloc(count * sizeof *asked);
    progress_show((double)of->round++ / ROUNDS, "densities", of->bar);
    for (size_t i = 0; i < count && asked; i++) {
        const judge_view *v = &of->j->view[at[i].bin / JUDGE_EACH];
        const double sine = sin(at[i].x), phi = at[i].y + v->turn;
        asked[i] = (query){'p', v->wi, {(float)(sine * cos(phi)), (float)(sine * sin(phi)), (float)cos(at[i].x)}};
    }
    answer *got = process_ask(of->task, at ? asked : NULL, count);
    for (size_t i = 0; i < count && got; i++)
        take(of, &at[i], &(exchange){asked[i], got[i]});
    free(asked);
    free(got);
    return got != NULL;
}

/* Of the bins of each direction, and the worst of them. */
static void sum_up(judgement *j)
{
    judge_fault *fault = j->fault;
    fault[JUDGE_NORMALS].worst = fault[JUDGE_COVERS].worst = 0;
    for (judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        for (const quadrature_sum *sum = v->sum; sum < v->sum + JUDGE_BINS; sum++) {
            v->total += sum->value;
            v->error += sum->variance;
            v->tv += sum->distance;
            v->efficiency += sum->square;
            v->uncovered += sum->uncovered;
        }
        v->error = 4 * sqrt(v->error);
        v->efficiency = v->efficiency > 0 ? 1 / (v->efficiency * v->total) : 0;
        fault[JUDGE_NORMALS].worst = fmax(fault[JUDGE_NORMALS].worst, v->tv);
        fault[JUDGE_COVERS].worst = fmax(fault[JUDGE_COVERS].worst, v->uncovered);
        if (v->is_first)
            judge_note(&fault[JUDGE_MASS], fabs(v->total - 1) - v->error, NAN, &v->first[0]);
    }
}

int judge_integrate(const judge_task *task, progress *bar, judgement *j)
{
    integrating of = {.task = task, .j = j, .bar = bar};
    const quadrature q = {.answer = ask,
                          .of = &of,
                          .bins = JUDGE_VIEWS * JUDGE_EACH,
                          .most = CELLS_MAX,
                          .close = CLOSE,
                          .rounds = ROUNDS,
                          .seed = task->seed ^ 0x5851F42D4C957F2Du,
                          .observed = j->observed,
                          .samples = (double)task->samples};
    quadrature_cell *cells = malloc(CELLS_MAX * sizeof *cells);
    size_t count = 0;
    for (size_t i = 0; i < JUDGE_VIEWS; i++) {
        const judge_view *v = &j->view[i];
        of.truth[i] = vndf_view_from(&task->surface, v->wi);
        if (cells)
            count += bins_cells(v->ring, v->rings, v->sector, v->sectors, i * JUDGE_EACH, cells + count);
    }
    const int good = cells ? quadrature_run(&q, cells, count, j->sum) : denied(task->who, "no memory");
    if (good)
        sum_up(j);
    free(cells);
    return good;
}
