#include "judge/judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/random.h"
#include "cli/sort.h"
#include "cli/subject.h"
#include "evidence/measure/bins.h"
#include "evidence/measure/quadrature.h"

static const double pi = 3.14159265358979323846;

/* From straight down to grazing, at azimuths that no axis of a surface has. */
static const double angles[JUDGE_VIEWS][2] = {{0, 0}, {20, 40}, {45, 100}, {65, 200}, {80, 290}, {88, 335}};

enum { PILOTS = 2000, STRATA = 64, STRATIFIED = STRATA * STRATA };

/* The larger one; what is no number is the worst. */
static double worst(double a, double b)
{
    return isnan(b) ? HUGE_VAL : fmax(a, b);
}

/* ---- samples ------------------------------------------------------------------------------------- */

/* theta and the azimuth from wi; NaN of what is no direction. */
static void locate(const judge_view *v, const answer *a, double *theta, double *phi)
{
    *theta = isfinite(a->x + a->y + a->z) ? atan2(hypot(a->x, a->y), a->z) : NAN;
    *phi = remainder(atan2(a->y, a->x) - v->turn, 2 * pi);
}

static void place_bins(judge_view *v, const answer *pilots)
{
    double theta[PILOTS], phi[PILOTS];
    for (size_t i = 0; i < PILOTS; i++) {
        locate(v, &pilots[i], &theta[i], &phi[i]);
        phi[i] = isnan(theta[i]) ? 0 : phi[i];
        theta[i] = isnan(theta[i]) ? 0 : fmin(theta[i], pi / 2);
    }
    sort_numbers(theta, PILOTS);
    sort_numbers(phi, PILOTS);
    bins_borders(v->ring, JUDGE_RINGS, 0, pi / 2, theta, PILOTS);
    bins_borders(v->sector, JUDGE_SECTORS, -pi, pi, phi, PILOTS);
    sort_numbers(v->ring, JUDGE_RINGS + 1);
    sort_numbers(v->sector, JUDGE_SECTORS + 1);
}

static void take_sample(judge_view *v, const answer *a, double counts[JUDGE_BINS + 1])
{
    double theta, phi, length = sqrt(a->x * a->x + a->y * a->y + a->z * a->z);
    double facing = a->x * (double)v->wi.x + a->y * (double)v->wi.y + a->z * (double)v->wi.z;
    v->found[JUDGE_UNIT] = worst(v->found[JUDGE_UNIT], fabs(length - 1));
    v->found[JUDGE_FACING] = worst(v->found[JUDGE_FACING], -fmin(facing, a->z));
    v->found[JUDGE_VALID] += !(a->pdf > 0 && isfinite(a->pdf));
    locate(v, a, &theta, &phi);
    counts[theta <= pi / 2 + 1e-6 ? bins_interval(v->ring, JUDGE_RINGS, theta) * JUDGE_SECTORS +
                                        bins_interval(v->sector, JUDGE_SECTORS, phi)
                                  : JUDGE_BINS] += 1;
}

/* Queries with random numbers, of which the last 64 x 64 are stratified. */
static void fill_samples(query *to, const judge_view *v, size_t samples, random_stream *stream)
{
    for (size_t i = 0; i < PILOTS + samples + STRATIFIED; i++) {
        float u[3] = {random_float(stream), 0, 0};
        u[1] = random_float(stream);
        u[2] = random_float(stream);
        if (i >= PILOTS + samples) { /* of 18 bits in their stratum, so that none is rounded to 1 */
            u[0] = (floorf(u[0] * 0x1p18f) * 0x1p-18f + (float)(i % STRATA)) / STRATA;
            u[1] = (floorf(u[1] * 0x1p18f) * 0x1p-18f + (float)(i / STRATA % STRATA)) / STRATA;
        }
        to[i] = (query){'s', v->wi, {u[0], u[1], u[2]}};
    }
}

static int draw(const judge_task *task, judge_view *views)
{
    const size_t each = PILOTS + task->samples + STRATIFIED, count = each * JUDGE_VIEWS;
    random_stream stream = random_from(task->seed);
    query *asked = malloc(count * sizeof *asked);
    for (size_t i = 0; i < JUDGE_VIEWS && asked; i++)
        fill_samples(asked + i * each, &views[i], task->samples, &stream);
    answer *got = process_ask(task->who, task->command, asked, count);
    for (size_t i = 0; i < JUDGE_VIEWS && got; i++) {
        judge_view *v = &views[i];
        const answer *its = got + i * each;
        place_bins(v, its);
        memcpy(v->first, its + PILOTS, sizeof v->first);
        for (size_t k = PILOTS; k < each; k++)
            take_sample(v, &its[k], k < PILOTS + task->samples ? v->observed : v->stratified);
    }
    free(asked);
    free(got);
    return got != NULL;
}

/* Densities of samples, asked for. What is no direction has none, so anything is asked in its place. */
static int agree(const judge_task *task, judge_view *views)
{
    query asked[JUDGE_VIEWS * JUDGE_ASKED];
    for (int i = 0; i < JUDGE_VIEWS * JUDGE_ASKED; i++) {
        const judge_view *v = &views[i / JUDGE_ASKED];
        const answer *a = &v->first[i % JUDGE_ASKED];
        vndf_vec3 wm = {(float)a->x, (float)a->y, (float)a->z};
        asked[i] = (query){'p', v->wi, isfinite(wm.x + wm.y + wm.z) ? wm : v->wi};
    }
    answer *got = process_ask(task->who, task->command, asked, JUDGE_VIEWS * JUDGE_ASKED);
    for (int i = 0; i < JUDGE_VIEWS && got; i++) {
        double differs[JUDGE_ASKED];
        for (int k = 0; k < JUDGE_ASKED; k++)
            differs[k] = worst(0, fabs(views[i].first[k].pdf / got[i * JUDGE_ASKED + k].pdf - 1));
        sort_numbers(differs, JUDGE_ASKED);
        views[i].found[JUDGE_AGREES] = differs[JUDGE_ASKED * 99 / 100];
    }
    free(got);
    return got != NULL;
}

/* ---- integrals ----------------------------------------------------------------------------------- */

/* A cell counts when its two rules differ by no more than this part of all mass, or in the last round: each of them
 * runs the command. */
static const double CLOSE = 1e-6;
enum { ROUNDS = 8, CELLS_MAX = 100000 };

/* What is integrated; the efficiency is the reciprocal of SQUARE. */
enum { MASS, TRUTH, DISTANCE, SQUARE, UNCOVERED };

typedef struct integrating {
    const judge_task *task;
    judge_view *views;
    vndf_view truth[JUDGE_VIEWS]; /* without a distribution all is 0 */
    progress *bar;
    double rounds;
    int gave_up; /* after a complaint */
} integrating;

/* By theta and the azimuth from wi. */
static int answer_densities(void *state, quadrature_point *at, size_t count)
{
    integrating *of = state;
    query *asked = malloc(count * sizeof *asked);
    for (size_t i = 0; i < count && asked; i++) {
        const judge_view *v = &of->views[at[i].bin / JUDGE_BINS];
        const double theta = at[i].x, phi = at[i].y + v->turn, sine = sin(theta);
        asked[i] = (query){'p', v->wi, {(float)(sine * cos(phi)), (float)(sine * sin(phi)), (float)cos(theta)}};
    }
    progress_show(++of->rounds / ROUNDS, "densities", of->bar);
    answer *got = process_ask(of->task->who, of->task->command, asked, count);
    for (size_t i = 0; i < count && got; i++) {
        const size_t view = at[i].bin / JUDGE_BINS;
        const int is_valid = got[i].pdf >= 0 && isfinite(got[i].pdf);
        const double p = is_valid ? got[i].pdf : 0, v = (double)vndf_visible(&of->truth[view], asked[i].x);
        const double value[] = {p, v, fabs(p - v) / 2, p > 0 ? v / p * v : 0, p > 0 ? 0 : v};
        for (int k = 0; k < QUADRATURE_VALUES; k++)
            at[i].value[k] = value[k] * sin(at[i].x);
        of->views[view].found[JUDGE_VALID] += !is_valid;
    }
    free(asked);
    free(got);
    of->gave_up = !got;
    return got != NULL;
}

static size_t divide(const judge_view *views, quadrature_cell *to)
{
    size_t count = 0;
    for (size_t i = 0; i < JUDGE_VIEWS * JUDGE_BINS; i++) {
        const judge_view *v = &views[i / JUDGE_BINS];
        const double *theta = &v->ring[i % JUDGE_BINS / JUDGE_SECTORS], *phi = &v->sector[i % JUDGE_SECTORS];
        if (theta[0] < theta[1] && phi[0] < phi[1])
            to[count++] = (quadrature_cell){i, {theta[0], theta[1]}, {phi[0], phi[1]}, 0};
    }
    return count;
}

static int integrate(const judge_task *task, judge_view *views, progress *bar)
{
    enum { ALL = JUDGE_VIEWS * JUDGE_BINS };
    integrating of = {task, views, {{0}}, bar, 0, 0};
    const quadrature q = {answer_densities, &of, CLOSE, 0, 0, CELLS_MAX, CELLS_MAX, ROUNDS - 1};
    quadrature_cell *cells = malloc(ALL * sizeof *cells);
    quadrature_sum *sum = calloc(ALL, sizeof *sum);
    for (int i = 0; i < JUDGE_VIEWS; i++)
        of.truth[i] = vndf_view_from(&task->surface, views[i].wi);
    const int good = cells && sum && quadrature_run(&q, cells, divide(views, cells), sum);
    for (size_t i = 0; i < ALL && good; i++) {
        judge_view *v = &views[i / JUDGE_BINS];
        v->expected[i % JUDGE_BINS] = sum[i].value[MASS];
        v->mass += sum[i].value[MASS];
        v->mass_error += sum[i].error;
        v->tv += sum[i].value[DISTANCE];
        v->efficiency += sum[i].value[SQUARE]; /* its reciprocal, until all is there */
        v->found[JUDGE_COVERS] += sum[i].value[UNCOVERED];
    }
    free(cells);
    free(sum);
    if (!good && !of.gave_up)
        complain(task->who, "no memory");
    return good;
}

/* ---- counts -------------------------------------------------------------------------------------- */

int judge_is_hole(const judge_view *view, size_t bin)
{
    return view->expected[bin] >= 20 && view->observed[bin] == 0;
}

/* From integrals to what is expected of the samples: a density that is wrong by a factor alone has the right shape. */
static void compare_counts(judge_view *v, size_t samples)
{
    double ring[2][JUDGE_RINGS + 1] = {{0}}, sector[2][JUDGE_SECTORS + 1] = {{0}}, even[JUDGE_BINS + 1];
    double scale = v->mass > 0 ? (double)samples / v->mass : 0;
    for (size_t i = 0; i <= JUDGE_BINS; i++) {
        size_t its_sector = i < JUDGE_BINS ? i % JUDGE_SECTORS : JUDGE_SECTORS;
        v->expected[i] *= scale;
        even[i] = v->expected[i] * STRATIFIED / (double)samples;
        ring[0][i / JUDGE_SECTORS] += v->expected[i];
        ring[1][i / JUDGE_SECTORS] += v->observed[i];
        sector[0][its_sector] += v->expected[i];
        sector[1][its_sector] += v->observed[i];
        v->found[JUDGE_HOLES] += judge_is_hole(v, i);
    }
    v->bins = pearson_of(v->expected, v->observed, JUDGE_BINS + 1);
    v->rings = pearson_of(ring[0], ring[1], JUDGE_RINGS + 1);
    v->sectors = pearson_of(sector[0], sector[1], JUDGE_SECTORS + 1);
    pearson spread = pearson_of(even, v->stratified, JUDGE_BINS + 1);
    v->scatter = spread.classes > 1 ? spread.statistic / (double)(spread.classes - 1) : 1;
    v->found[JUDGE_MASS] = worst(0, fabs(v->mass - 1) - v->mass_error);
    v->efficiency = v->efficiency > 0 ? 1 / (v->efficiency * v->mass) : 0;
}

double judge_least_p(const judge_view *views)
{
    double p = 1, statistic[2] = {0, 0};
    size_t freedom[2] = {0, 0};
    for (int i = 0; i < JUDGE_VIEWS; i++) {
        const pearson *sums[] = {&views[i].rings, &views[i].sectors};
        p = fmin(p, views[i].bins.p);
        for (int k = 0; k < 2; k++) {
            statistic[k] += sums[k]->statistic;
            freedom[k] += sums[k]->classes ? sums[k]->classes - 1 : 0;
        }
    }
    for (int k = 0; k < 2; k++)
        p = fmin(p, statistics_chi_square_p(statistic[k], freedom[k]));
    return p;
}

int judge_views(const judge_task *task, progress *bar, judge_view views[JUDGE_VIEWS])
{
    for (int i = 0; i < JUDGE_VIEWS; i++) {
        vndf_vec3 wi = direction_from(angles[i][0], angles[i][1]);
        double turn = atan2((double)wi.y, (double)wi.x);
        views[i] = (judge_view){.theta = angles[i][0], .phi = angles[i][1], .wi = wi, .turn = turn};
    }
    progress_step(bar, 0.5);
    progress_show(0, "samples", bar);
    if (!draw(task, views) || !agree(task, views))
        return 0;
    progress_step(bar, 1);
    if (!integrate(task, views, bar))
        return 0;
    for (int i = 0; i < JUDGE_VIEWS; i++)
        compare_counts(&views[i], task->samples);
    return 1;
}
