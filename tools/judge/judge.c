#include "judge/judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/random.h"
#include "cli/sort.h"
#include "cli/subject.h"
#include "evidence/measure/bins.h"
#include "judge/process.h"

static const double pi = 3.14159265358979323846;

/* From straight down to grazing, at azimuths that no axis of a surface has. */
static const double angles[JUDGE_VIEWS][2] = {{0, 0}, {20, 40}, {45, 100}, {65, 200}, {80, 290}, {88, 335}};

enum { PILOTS = 2000, STRATA = 64, STRATIFIED = STRATA * STRATA, AGREED = 1000 };

/* The larger one; what is no number is the worst. */
static double worst(double a, double b)
{
    return isnan(b) ? HUGE_VAL : fmax(a, b);
}

/* Queries and answers; both NULL after a complaint: no memory. */
typedef struct talk {
    query *asked;
    answer *got;
} talk;

static talk talk_of(const judge_task *task, size_t count)
{
    talk t = {malloc(count * sizeof *t.asked), malloc(count * sizeof *t.got)};
    if (t.asked && t.got)
        return t;
    free(t.asked);
    free(t.got);
    complain(task->who, "no memory");
    return (talk){NULL, NULL};
}

static void talk_end(talk *t)
{
    free(t->asked);
    free(t->got);
}

/* ---- samples ------------------------------------------------------------------------------------- */

/* theta and the azimuth from wi of what need not be a unit vector, nor finite. */
static double theta_of(const answer *a)
{
    return atan2(hypot(a->x, a->y), a->z);
}

static double phi_of(const judge_view *v, const answer *a)
{
    return remainder(atan2(a->y, a->x) - v->turn, 2 * pi);
}

static void place_borders(double *border, size_t parts, double low, double high, double sorted[PILOTS])
{
    sort_numbers(sorted, PILOTS);
    for (size_t i = 0; i <= parts; i++)
        border[i] = i % 2 ? fmin(fmax(sorted[PILOTS * i / parts], low), high)
                          : low + (high - low) * (double)i / (double)parts;
    sort_numbers(border, parts + 1);
}

static void place_bins(judge_view *v, const answer *pilots)
{
    double theta[PILOTS], phi[PILOTS];
    for (size_t i = 0; i < PILOTS; i++) {
        int is_number = isfinite(pilots[i].x + pilots[i].y + pilots[i].z);
        theta[i] = is_number ? theta_of(&pilots[i]) : 0;
        phi[i] = is_number ? phi_of(v, &pilots[i]) : 0;
    }
    place_borders(v->ring, JUDGE_RINGS, 0, pi / 2, theta);
    place_borders(v->sector, JUDGE_SECTORS, -pi, pi, phi);
}

static size_t bin_of(const judge_view *v, const answer *a)
{
    double theta = theta_of(a), phi = phi_of(v, a);
    if (!(theta <= pi / 2 + 1e-6 && fabs(phi) <= pi))
        return JUDGE_BINS;
    return bins_interval(v->ring, JUDGE_RINGS, theta) * JUDGE_SECTORS +
           bins_interval(v->sector, JUDGE_SECTORS, phi);
}

static void look_at_sample(judge_view *v, const answer *a)
{
    double length = sqrt(a->x * a->x + a->y * a->y + a->z * a->z);
    double facing = a->x * (double)v->wi.x + a->y * (double)v->wi.y + a->z * (double)v->wi.z;
    v->found[JUDGE_UNIT] = worst(v->found[JUDGE_UNIT], fabs(length - 1));
    v->found[JUDGE_FACING] = worst(v->found[JUDGE_FACING], -fmin(facing, a->z));
    v->found[JUDGE_POSITIVE] += !(a->pdf > 0 && isfinite(a->pdf));
}

/* Random numbers, of which the last 64 x 64 are stratified. */
static void fill_samples(query *q, const judge_view *v, size_t samples, random_stream *stream)
{
    for (size_t i = 0; i < PILOTS + samples + STRATIFIED; i++) {
        double u1 = random_double(stream), u2 = random_double(stream), u3 = random_double(stream);
        if (i >= PILOTS + samples) {
            u1 = (u1 + (double)(i % STRATA)) / STRATA;
            u2 = (u2 + (double)(i / STRATA % STRATA)) / STRATA;
        }
        const float most = 0x1.fffffep-1f; /* numbers are below 1, after rounding as well */
        q[i] = (query){'s', v->wi, {fminf((float)u1, most), fminf((float)u2, most), fminf((float)u3, most)}};
    }
}

/* What was drawn, beside what is in the views. */
typedef struct drawn {
    double stratified[JUDGE_VIEWS][JUDGE_BINS + 1]; /* counts */
    answer first[JUDGE_VIEWS][AGREED];
} drawn;

static int draw(const judge_task *task, judge_view *views, drawn *to)
{
    const size_t each = PILOTS + task->samples + STRATIFIED;
    random_stream stream = random_from(task->seed);
    talk t = talk_of(task, each * JUDGE_VIEWS);
    for (size_t i = 0; i < JUDGE_VIEWS && t.asked; i++)
        fill_samples(t.asked + i * each, &views[i], task->samples, &stream);
    int good = t.asked && process_ask(task->who, task->command, t.asked, each * JUDGE_VIEWS, t.got);
    for (size_t i = 0; i < JUDGE_VIEWS && good; i++) {
        const answer *got = t.got + i * each;
        place_bins(&views[i], got);
        memcpy(to->first[i], got + PILOTS, sizeof to->first[i]);
        for (size_t k = PILOTS; k < each; k++) {
            double *count = k < PILOTS + task->samples ? views[i].observed : to->stratified[i];
            look_at_sample(&views[i], &got[k]);
            count[bin_of(&views[i], &got[k])] += 1;
        }
    }
    talk_end(&t);
    return good;
}

/* Densities of the first samples, asked for. What is no direction has none, so anything is asked in its place. */
static int agree(const judge_task *task, judge_view *views, const drawn *of)
{
    talk t = talk_of(task, JUDGE_VIEWS * AGREED);
    for (size_t i = 0; i < JUDGE_VIEWS * AGREED && t.asked; i++) {
        const answer *a = &of->first[i / AGREED][i % AGREED];
        vndf_vec3 wm = {(float)a->x, (float)a->y, (float)a->z}, up = {0, 0, 1};
        t.asked[i] = (query){'p', views[i / AGREED].wi, isfinite(wm.x + wm.y + wm.z) ? wm : up};
    }
    int good = t.asked && process_ask(task->who, task->command, t.asked, JUDGE_VIEWS * AGREED, t.got);
    for (size_t i = 0; i < JUDGE_VIEWS && good; i++) {
        double differs[AGREED];
        for (size_t k = 0; k < AGREED; k++)
            differs[k] = worst(0, fabs(of->first[i][k].pdf / t.got[i * AGREED + k].pdf - 1));
        sort_numbers(differs, AGREED);
        views[i].found[JUDGE_AGREES] = differs[AGREED * 99 / 100];
    }
    talk_end(&t);
    return good;
}

/* ---- integrals ----------------------------------------------------------------------------------- */

/* Gauss' 5 nodes on [-1, 1], exact to degree 9, and the rule of degree 3 on three of them. */
enum { NODES = 5, POINTS = NODES * NODES };
static const double node[NODES] = {-0.90617984593866399, -0.53846931010568309, 0, 0.53846931010568309,
                                   0.90617984593866399};
static const double fine[NODES] = {0.23692688505618909, 0.47862867049936647, 0.56888888888888889,
                                   0.47862867049936647, 0.23692688505618909};
static const double coarse[NODES] = {0.4059288770959664, 0, 1.1881422458080673, 0, 0.4059288770959664};

/* A cell counts when its two rules differ by so much of all mass, or in the last round. */
static const double CLOSE = 1e-6;
enum { ROUNDS = 8, CELLS_MAX = 40000 };

typedef struct cell {
    int view, bin;
    double theta[2], phi[2]; /* radians, the azimuth from wi */
} cell;

/* Of a density p and the true one v over a cell. */
typedef struct integrals {
    double p, error, distance, square, uncovered, invalid;
} integrals;

static void ask_cell(const cell *c, const judge_view *v, query *to)
{
    for (int k = 0; k < POINTS; k++) {
        double theta = (c->theta[0] + c->theta[1] + node[k / NODES] * (c->theta[1] - c->theta[0])) / 2;
        double phi = (c->phi[0] + c->phi[1] + node[k % NODES] * (c->phi[1] - c->phi[0])) / 2 + v->turn;
        to[k] = (query){
            'p', v->wi, {(float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)), (float)cos(theta)}};
    }
}

static integrals integrate_cell(const cell *c, const vndf_view *truth, const query *asked, const answer *got)
{
    integrals sum = {0, 0, 0, 0, 0, 0};
    double area = (c->theta[1] - c->theta[0]) * (c->phi[1] - c->phi[0]) / 4, few_p = 0, few_v = 0, all_v = 0;
    for (int k = 0; k < POINTS; k++) {
        const int i = k / NODES, j = k % NODES;
        double sine = sin((c->theta[0] + c->theta[1] + node[i] * (c->theta[1] - c->theta[0])) / 2);
        double weight = area * sine * fine[i] * fine[j], few = area * sine * coarse[i] * coarse[j];
        int is_valid = got[k].pdf >= 0 && isfinite(got[k].pdf);
        double p = is_valid ? got[k].pdf : 0, v = truth ? (double)vndf_visible(truth, asked[k].x) : 0;
        sum.invalid += !is_valid;
        sum.p += weight * p;
        few_p += few * p;
        all_v += weight * v;
        few_v += few * v;
        sum.distance += weight * fabs(p - v) / 2;
        sum.square += p > 0 ? weight * v / p * v : 0;
        sum.uncovered += p > 0 ? 0 : weight * v;
    }
    sum.error = fmax(fabs(few_p - sum.p), fabs(few_v - all_v));
    return sum;
}

static void add_cell(judge_view *v, int bin, const integrals *of)
{
    v->expected[bin] += of->p;
    v->mass += of->p;
    v->mass_error += of->error;
    v->tv += of->distance;
    v->efficiency += of->square; /* its reciprocal, until all is there */
    v->found[JUDGE_COVERS] += of->uncovered;
    v->found[JUDGE_VALID] += of->invalid;
}

static size_t first_cells(const judge_view *views, cell *to)
{
    size_t count = 0;
    for (int i = 0; i < JUDGE_VIEWS; i++)
        for (int bin = 0; bin < JUDGE_BINS; bin++) {
            const double *theta = &views[i].ring[bin / JUDGE_SECTORS],
                         *phi = &views[i].sector[bin % JUDGE_SECTORS];
            if (theta[0] < theta[1] && phi[0] < phi[1])
                to[count++] = (cell){i, bin, {theta[0], theta[1]}, {phi[0], phi[1]}};
        }
    return count;
}

static size_t quarter(const cell *c, cell *to)
{
    double theta = (c->theta[0] + c->theta[1]) / 2, phi = (c->phi[0] + c->phi[1]) / 2;
    for (int k = 0; k < 4; k++) {
        to[k] = *c;
        to[k].theta[k / 2 == 0] = theta;
        to[k].phi[k % 2 == 0] = phi;
    }
    return 4;
}

static int integrate(const judge_task *task, judge_view *views, progress *bar)
{
    cell *cells = malloc(2 * CELLS_MAX * sizeof *cells), *next = cells + CELLS_MAX;
    vndf_view truth[JUDGE_VIEWS];
    size_t count = cells ? first_cells(views, cells) : 0;
    int good = cells || (complain(task->who, "no memory"), 0);
    for (int i = 0; i < JUDGE_VIEWS && task->surface; i++)
        truth[i] = vndf_view_from(task->surface, views[i].wi);
    for (int round = 1; good && count > 0; round++) {
        size_t more = 0;
        talk t = talk_of(task, count * POINTS);
        progress_show((double)round / ROUNDS, "densities", bar);
        for (size_t i = 0; i < count && t.asked; i++)
            ask_cell(&cells[i], &views[cells[i].view], t.asked + i * POINTS);
        good = t.asked && process_ask(task->who, task->command, t.asked, count * POINTS, t.got);
        for (size_t i = 0; i < count && good; i++) {
            const cell *c = &cells[i];
            integrals of = integrate_cell(c, task->surface ? &truth[c->view] : NULL, t.asked + i * POINTS,
                                          t.got + i * POINTS);
            if (of.error > CLOSE && round < ROUNDS && more + 4 <= CELLS_MAX)
                more += quarter(c, next + more);
            else
                add_cell(&views[c->view], c->bin, &of);
        }
        talk_end(&t);
        memcpy(cells, next, more * sizeof *cells);
        count = more;
    }
    free(cells);
    return good;
}

/* ---- counts -------------------------------------------------------------------------------------- */

int judge_is_hole(const judge_view *view, size_t bin)
{
    return view->expected[bin] >= 20 && view->observed[bin] == 0;
}

/* From integrals to what is expected of the samples: a density that is wrong by a factor alone has the right shape. */
static void compare_counts(judge_view *v, size_t samples, const double *stratified)
{
    double ring[2][JUDGE_RINGS + 1] = {{0}}, sector[2][JUDGE_SECTORS + 1] = {{0}}, even[JUDGE_BINS + 1];
    double scale = v->mass > 0 ? (double)samples / v->mass : 0;
    for (size_t i = 0; i <= JUDGE_BINS; i++) {
        size_t of_sector = i < JUDGE_BINS ? i % JUDGE_SECTORS : JUDGE_SECTORS;
        v->expected[i] *= scale;
        even[i] = v->expected[i] * STRATIFIED / (double)samples;
        ring[0][i / JUDGE_SECTORS] += v->expected[i];
        ring[1][i / JUDGE_SECTORS] += v->observed[i];
        sector[0][of_sector] += v->expected[i];
        sector[1][of_sector] += v->observed[i];
        v->found[JUDGE_HOLES] += judge_is_hole(v, i);
    }
    v->bins = pearson_of(v->expected, v->observed, NULL, JUDGE_BINS + 1, 5);
    v->rings = pearson_of(ring[0], ring[1], NULL, JUDGE_RINGS + 1, 5);
    v->sectors = pearson_of(sector[0], sector[1], NULL, JUDGE_SECTORS + 1, 5);
    pearson spread = pearson_of(even, stratified, NULL, JUDGE_BINS + 1, 5);
    v->scatter = spread.classes > 1 ? spread.statistic / (double)(spread.classes - 1) : 1;
    v->found[JUDGE_MASS] = worst(0, fabs(v->mass - 1) - v->mass_error);
    v->efficiency = v->efficiency > 0 ? 1 / (v->efficiency * v->mass) : 0;
}

int judge_views(const judge_task *task, progress *bar, judge_view views[JUDGE_VIEWS])
{
    drawn *samples = calloc(1, sizeof *samples);
    if (!samples)
        return complain(task->who, "no memory"), 0;
    for (int i = 0; i < JUDGE_VIEWS; i++) {
        vndf_vec3 wi = direction_from(angles[i][0], angles[i][1]);
        views[i] = (judge_view){.theta = angles[i][0], .phi = angles[i][1], .wi = wi};
        views[i].turn = atan2((double)wi.y, (double)wi.x);
    }
    progress_step(bar, 0.5);
    progress_show(0, "samples", bar);
    int good = draw(task, views, samples) && agree(task, views, samples);
    progress_step(bar, 1);
    good = good && integrate(task, views, bar);
    for (int i = 0; i < JUDGE_VIEWS && good; i++)
        compare_counts(&views[i], task->samples, samples->stratified[i]);
    free(samples);
    return good;
}
