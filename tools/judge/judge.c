#include "judge/judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/random.h"
#include "cli/sort.h"
#include "cli/subject.h"

static const double pi = 3.14159265358979323846;

/* Keeps the worst; what is no number is the worst of all. */
static void note(judge_fault *f, double amount, double beside, const exchange *shown)
{
    amount = isnan(amount) ? HUGE_VAL : amount;
    if (amount > f->worst)
        *f = (judge_fault){amount, beside, *shown};
}

/* Angles in degrees, and rings. The eight in the middle are inclined enough for a fault of one octant to matter. */
static const struct {
    double from, to;
    size_t rings;
} strata[JUDGE_VIEWS] = {{0, 0, 64},   {0, 0, 1024}, {0, 0, 4},      {0.01, 20, 64},    {20, 32, 64},
                         {32, 43, 64}, {43, 53, 64}, {53, 62, 64},   {62, 70, 64},      {70, 77, 64},
                         {77, 82, 64}, {82, 86, 64}, {86, 89.9, 64}, {89.99, 89.99, 64}};

static void place_views(judgement *j, size_t samples, random_stream *stream)
{
    const size_t coarser = samples < 50000 ? 2 : 1; /* bins are to expect samples */
    const size_t turn = random_bits(stream) >> 32, step = 2 * (random_bits(stream) >> 32) + 1;
    for (size_t i = 0; i < JUDGE_VIEWS; i++) {
        judge_view *v = &j->view[i];
        v->observed = j->observed + i * JUDGE_EACH;
        v->sum = j->sum + i * JUDGE_EACH;
        v->is_first = i == 0 || strata[i].to > 0;
        v->rings = strata[i].rings / coarser;
        v->sectors = JUDGE_BINS / strata[i].rings / coarser;
        v->theta = strata[i].from + (strata[i].to - strata[i].from) * random_double(stream);
        v->phi = v->theta > 0 ? 45 * ((double)((i * step + turn) % 8) + random_double(stream)) : 0;
        v->wi = direction_from(v->theta, v->phi);
        v->turn = atan2((double)v->wi.y, (double)v->wi.x);
    }
}

/* Of each direction, in this order: those that place the bins, those that are counted, stratified ones, those at the
 * ends of [0, 1), 27 kinds, each number at 0, at 1 - 2^-24 or random, and pairs that are close to an end. */
enum { PILOTS = BINS_PILOTS, STRATA = JUDGE_STRATA, STRATIFIED = STRATA * STRATA, ENDS = 27 * 8 };
enum { PAIRS = 16, PAIRED = 4 * 2 * PAIRS };

/* theta and the azimuth from wi; NaN of what is no direction. */
static void locate(const judge_view *v, const answer *a, double *theta, double *phi)
{
    *theta = isfinite(a->x + a->y + a->z) ? atan2(hypot(a->x, a->y), a->z) : NAN;
    *phi = remainder(atan2(a->y, a->x) - v->turn, 2 * pi);
}

static void place_bins(judge_view *v, const answer *pilots)
{
    double theta[BINS_PILOTS + BINS_EVEN], phi[BINS_PILOTS + BINS_EVEN];
    for (size_t i = 0; i < BINS_PILOTS; i++) {
        locate(v, &pilots[i], &theta[i], &phi[i]);
        phi[i] = isnan(theta[i]) ? 0 : phi[i];
        theta[i] = isnan(theta[i]) ? 0 : theta[i];
    }
    bins_borders(v->ring, v->rings, 0, pi / 2, theta);
    bins_borders(v->sector, v->sectors, -pi, pi, phi);
}

/* Its bin, JUDGE_BINS for none. */
static size_t take_sample(judgement *j, const judge_view *v, const exchange *e)
{
    const query *q = &e->asked;
    const answer *a = &e->got;
    const double length = sqrt(a->x * a->x + a->y * a->y + a->z * a->z);
    const double facing = a->x * (double)q->wi.x + a->y * (double)q->wi.y + a->z * (double)q->wi.z;
    double theta, phi;
    note(&j->fault[JUDGE_UNIT], fabs(length - 1), NAN, e);
    note(&j->fault[JUDGE_FACING], -fmin(facing, a->z), NAN, e);
    if (!(a->pdf > 0 && isfinite(a->pdf)))
        note(&j->fault[JUDGE_VALID], j->fault[JUDGE_VALID].worst + 1, NAN, e);
    locate(v, a, &theta, &phi);
    if (!(theta <= pi / 2 + 1e-6))
        return JUDGE_BINS;
    return bins_interval(v->ring, v->rings, theta) * v->sectors + bins_interval(v->sector, v->sectors, phi);
}

/* The numbers of sample i; random ones are in u. */
static void place_numbers(float u[3], size_t i, size_t samples)
{
    static const float ends[2] = {0, 1 - 0x1p-24f};
    size_t k = i - PILOTS - samples; /* of what is before it is huge */
    if (i < PILOTS + samples)
        return;
    if (k < STRATIFIED) { /* of 18 bits in their stratum, so that none is rounded to 1 */
        u[0] = (floorf(u[0] * 0x1p18f) * 0x1p-18f + (float)(k % STRATA)) / STRATA;
        u[1] = (floorf(u[1] * 0x1p18f) * 0x1p-18f + (float)(k / STRATA % STRATA)) / STRATA;
    } else if ((k -= STRATIFIED) < ENDS) {
        for (int which = 0; which < 3; which++, k /= 3) {
            const size_t kind = k % 3;
            u[which] = kind < 2 ? ends[kind] : u[which];
        }
    } else {
        k -= ENDS;
        float *moved = &u[k / 2 % 2];
        *moved = k / 4 % 2 ? 1 - 0x1p-24f - floorf(*moved * 0x1p14f) * 0x1p-24f : *moved * 0x1p-10f;
    }
}

/* A fourth of those at the ends looks along an axis of the surface. A pair has u1 or u2 in common, and nothing else. */
static void fill_samples(query *to, const judge_view *v, size_t samples, double axis, random_stream *stream)
{
    const size_t ends = PILOTS + samples + STRATIFIED, pairs = ends + ENDS;
    for (size_t i = 0; i < pairs + PAIRED; i++) {
        const int is_turned = i >= ends && i < pairs && i % 4 == 0, is_second = i >= pairs && (i - pairs) % 2;
        float u[3];
        for (int k = 0; k < 3; k++)
            u[k] = random_float(stream);
        place_numbers(u, i, samples);
        if (is_second && (i - pairs) / 2 % 2)
            u[0] = to[i - 1].x.x;
        else if (is_second)
            u[1] = to[i - 1].x.y;
        to[i] = (query){'s', is_turned ? direction_from(v->theta, axis) : v->wi, {u[0], u[1], u[2]}};
    }
}

/* A sampler of two numbers, one of which does not move the sample, piles samples up on a line. */
static void compare_pairs(judgement *j, const query *asked, const answer *got)
{
    double same[4] = {0};
    for (size_t i = 0; i < PAIRED; i += 2) {
        const answer *a = &got[i], *b = &got[i + 1];
        const exchange its = {asked[i], *a};
        const size_t end = i / 2 % 4;
        same[end] += a->x == b->x && a->y == b->y && a->z == b->z ? 1.0 / PAIRS : 0;
        note(&j->fault[JUDGE_MOVES], same[end], NAN, &its);
    }
}

static int draw(const judge_task *task, judgement *j)
{
    const size_t each = PILOTS + task->samples + STRATIFIED + ENDS + PAIRED, count = each * JUDGE_VIEWS;
    random_stream stream = random_from(task->seed);
    query *asked = malloc(count * sizeof *asked);
    place_views(j, task->samples, &stream);
    for (size_t i = 0; i < JUDGE_VIEWS && asked; i++)
        fill_samples(asked + i * each, &j->view[i], task->samples, 90 * (double)i, &stream);
    answer *got = process_ask(task, asked, count);
    for (size_t i = 0; i < count && got; i++) {
        judge_view *v = &j->view[i / each];
        if (i % each == 0)
            place_bins(v, got + i);
        const exchange its = {asked[i], got[i]};
        const size_t bin = take_sample(j, v, &its), k = i % each - PILOTS; /* of pilots it is huge */
        if (k < JUDGE_ASKED)
            v->first[k] = its;
        if (k < task->samples) {
            v->observed[bin] += 1;
            v->sample[bin] = its;
        } else if (k - task->samples < STRATIFIED)
            v->stratified[bin] += 1;
        if (i % each == each - PAIRED)
            compare_pairs(j, asked + i, got + i);
    }
    free(asked);
    free(got);
    return got != NULL;
}

/* Densities of samples, asked for. What is no direction has none, so anything is asked in its place. */
static int agree(const judge_task *task, judgement *j)
{
    query asked[JUDGE_VIEWS * JUDGE_ASKED];
    for (int i = 0; i < JUDGE_VIEWS * JUDGE_ASKED; i++) {
        const judge_view *v = &j->view[i / JUDGE_ASKED];
        const answer *a = &v->first[i % JUDGE_ASKED].got;
        const vndf_vec3 wm = {(float)a->x, (float)a->y, (float)a->z};
        asked[i] = (query){'p', v->wi, isfinite(wm.x + wm.y + wm.z) ? wm : v->wi};
    }
    answer *got = process_ask(task, asked, JUDGE_VIEWS * JUDGE_ASKED);
    for (int i = 0; i < JUDGE_VIEWS && got; i++) {
        double differs[JUDGE_ASKED];
        judge_fault most = {.worst = -1};
        for (int k = 0; k < JUDGE_ASKED; k++) {
            const exchange *e = &j->view[i].first[k];
            const double beside = got[i * JUDGE_ASKED + k].pdf, differ = fabs(e->got.pdf / beside - 1);
            differs[k] = isnan(differ) ? HUGE_VAL : differ;
            note(&most, differ, beside, e);
        }
        sort_numbers(differs, JUDGE_ASKED);
        most.worst = differs[JUDGE_ASKED * 99 / 100];
        if (most.worst > j->fault[JUDGE_AGREES].worst)
            j->fault[JUDGE_AGREES] = most;
    }
    free(got);
    return got != NULL;
}

/* The integral of the density over bins (evidence/measure/measure.h), of theta and the azimuth, and what is seen on
 * the way: densities that are none, and how far they are from the true visible normals. */

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
        note(&fault[JUDGE_VALID], fault[JUDGE_VALID].worst + 1, NAN, its);
    note(&fault[JUDGE_NORMALS], at->part * fabs(at->value[0] - at->value[1]), truth, its);
    note(&fault[JUDGE_COVERS], at->value[0] > 0 ? 0 : at->part * at->value[1], truth, its);
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
            note(&fault[JUDGE_MASS], fabs(v->total - 1) - v->error, NAN, &v->first[0]);
    }
}

static int integrate(const judge_task *task, progress *bar, judgement *j)
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

/* The total variation to the visible normals of a roughness is the mean over samples of (1 - Dv/p)+, which is bounded:
 * samples whose density was asked for will do. */
static double apart(const judgement *j, const vndf_distribution *distribution, float alpha_x, float alpha_y)
{
    const vndf_surface surface = vndf_rough(distribution, alpha_x, alpha_y);
    double sum = 0;
    for (const judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        const vndf_view view = vndf_view_from(&surface, v->wi);
        for (int k = 0; k < JUDGE_ASKED; k++) {
            const answer *a = &v->first[k].got;
            const vndf_vec3 wm = {(float)a->x, (float)a->y, (float)a->z};
            const double part = 1 - (double)vndf_visible(&view, wm) / a->pdf;
            sum += part > 0 ? part : 0;
        }
    }
    return sum / (JUDGE_VIEWS * JUDGE_ASKED);
}

/* The roughness whose normals are nearest: steps from the one that is meant, along both axes and along each, of 8 at
 * first, down to 2^(1/1024). */
static void fit_roughness(const judge_task *task, judgement *j)
{
    double at[2] = {log2((double)task->surface.xx), log2((double)task->surface.yy)}, step = 3;
    j->fits_tv = HUGE_VAL;
    while (step > 0x1p-10) {
        const double from[2] = {at[0], at[1]}, before = j->fits_tv;
        for (int k = 0; k < 9; k++) {
            const double x = from[0] + step * (k % 3 - 1), y = from[1] + step * (double)(k / 3 - 1);
            const double tv = apart(j, task->surface.distribution, (float)exp2(x), (float)exp2(y));
            if (tv < j->fits_tv)
                j->fits_tv = tv, at[0] = x, at[1] = y;
        }
        step = j->fits_tv < before ? step : step / 2;
    }
    j->fits[0] = exp2(at[0]);
    j->fits[1] = exp2(at[1]);
}

int judge_sampler(const judge_task *task, progress *bar, judgement *j)
{
    progress_step(bar, 0.5);
    progress_show(0, "samples", bar);
    if (!draw(task, j) || !agree(task, j))
        return 0;
    progress_step(bar, 1);
    if (!integrate(task, bar, j))
        return 0;
    judge_counts(j, task->samples);
    if (task->surface.distribution)
        fit_roughness(task, j);
    return 1;
}
