/* Counts of samples beside the integrals over their bins. An integral errs, too: a bin that expects e and errs by a
 * standard deviation s has both of its counts multiplied by e/(e + s^2), after which their difference has the variance
 * that is expected, e^2/(e + s^2), and Pearson's sum takes them as they are.
 *
 * Chi-square over thousands of bins hardly sees a hole of a thousandth. So all blocks of neighbouring bins are looked
 * at, whose sides are powers of 2: a count o where e is expected is at most as likely as exp(-(o log(o/e) - o + e)), by
 * Chernoff's bound for Poisson's law, and one of n blocks at most n times as likely. */
#include <math.h>
#include <string.h>

#include "judge/judge.h"

typedef struct counts {
    double expected[JUDGE_BINS + 1], observed[JUDGE_BINS + 1];
} counts;

/* A density that is wrong by a factor alone has the right shape. */
static void scale(judge_view *v, size_t samples, counts *c)
{
    const double scale = v->total > 0 ? (double)samples / v->total : 0;
    for (size_t i = 0; i <= JUDGE_BINS; i++) {
        const double e = v->mass[i] * scale, variance = v->variance[i] * scale * scale;
        const double kept = variance > 0 ? e / (e + variance) : 1;
        c->expected[i] = kept * e;
        c->observed[i] = kept * v->observed[i];
        v->left_out += kept < 0.5 ? e / (double)samples : 0;
    }
}

/* ---- blocks -------------------------------------------------------------------------------------- */

enum { ACROSS = JUDGE_SIDE + 1 };

static void sums_of(const double bins[JUDGE_BINS], double sum[ACROSS][ACROSS])
{
    memset(sum[0], 0, sizeof sum[0]);
    for (size_t i = 0; i < JUDGE_SIDE; i++) {
        sum[i + 1][0] = 0;
        for (size_t k = 0; k < JUDGE_SIDE; k++)
            sum[i + 1][k + 1] = sum[i][k + 1] + sum[i + 1][k] - sum[i][k] + bins[i * JUDGE_SIDE + k];
    }
}

/* The logarithm of the bound. The edge of a support may cut slivers off bins that no point of the quadrature met: so
 * many samples more, or less, are nothing. */
static double chance(double expected, double observed)
{
    static const double SLIVERS = 2;
    const double e = expected < observed ? fmin(expected + SLIVERS, observed) : expected;
    return observed > 0 ? -(observed * log(observed / e) - observed + e) : -e;
}

/* The least likely block and its p, all of them taken into account. */
static judge_block find_block(const counts *c)
{
    double e[ACROSS][ACROSS], o[ACROSS][ACROSS], least = 1, blocks = 0;
    judge_block found = {{0, 1}, {0, 1}, 0, 0, 1};
    sums_of(c->expected, e);
    sums_of(c->observed, o);
    for (size_t high = 1; high < JUDGE_SIDE; high *= 2)
        for (size_t wide = 1; wide < JUDGE_SIDE; wide *= 2)
            for (size_t i = 0; i + high <= JUDGE_SIDE; i += (high + 1) / 2)
                for (size_t k = 0; k + wide <= JUDGE_SIDE; k += (wide + 1) / 2, blocks++) {
                    const size_t to = i + high, end = k + wide;
                    const double expected = fmax(e[to][end] - e[i][end] - e[to][k] + e[i][k], 0);
                    const double observed = o[to][end] - o[i][end] - o[to][k] + o[i][k];
                    const double p = chance(expected, observed);
                    if (p < least) {
                        least = p;
                        found = (judge_block){{i, to}, {k, end}, expected, observed, 0};
                    }
                }
    found.p = fmin(1, JUDGE_VIEWS * blocks * exp(least));
    return found;
}

/* The sample of the bin that has the most too many, or the density in the one that has the most too few. */
static exchange show(const judge_view *v, const counts *c)
{
    const judge_block *b = &v->block;
    const int too_many = b->observed > b->expected;
    size_t most = b->ring[0] * JUDGE_SIDE + b->sector[0];
    for (size_t ring = b->ring[0]; ring < b->ring[1]; ring++)
        for (size_t sector = b->sector[0]; sector < b->sector[1]; sector++) {
            const size_t i = ring * JUDGE_SIDE + sector;
            const double off = c->observed[i] - c->expected[i], of_most = c->observed[most] - c->expected[most];
            most = (too_many ? off > of_most : off < of_most) ? i : most;
        }
    return too_many ? v->sample[most] : v->density[most];
}

/* ---- chi-square ---------------------------------------------------------------------------------- */

/* Sums of blocks, high x wide. */
static pearson pearson_over(const counts *c, size_t high, size_t wide)
{
    counts sum = {{0}, {0}};
    const size_t across = JUDGE_SIDE / wide, bins = JUDGE_SIDE / high * across;
    for (size_t i = 0; i <= JUDGE_BINS; i++) {
        const size_t to = i < JUDGE_BINS ? i / JUDGE_SIDE / high * across + i % JUDGE_SIDE / wide : bins;
        sum.expected[to] += c->expected[i];
        sum.observed[to] += c->observed[i];
    }
    return pearson_of(sum.expected, sum.observed, bins + 1);
}

/* Of 16 x 16 bins, which expect 16 samples of 64 x 64. */
static double scatter_of(const judge_view *v)
{
    double stratified = 0;
    counts even;
    for (size_t i = 0; i <= JUDGE_BINS; i++)
        stratified += v->stratified[i];
    for (size_t i = 0; i <= JUDGE_BINS; i++) {
        even.expected[i] = v->total > 0 ? stratified * v->mass[i] / v->total : 0;
        even.observed[i] = v->stratified[i];
    }
    const pearson spread = pearson_over(&even, JUDGE_SIDE / 16, JUDGE_SIDE / 16);
    return spread.classes > 1 ? spread.statistic / (double)(spread.classes - 1) : 1;
}

/* Tests: the bins of each direction; bins, rings and sectors of all; blocks. */
void judge_counts(judgement *j, size_t samples)
{
    static const size_t sides[3][2] = {{1, 1}, {1, JUDGE_SIDE}, {JUDGE_SIDE, 1}};
    judge_fault *fault = &j->fault[JUDGE_CHI_SQUARE];
    double statistic[3] = {0}, p = 1, worst = 2;
    size_t freedom[3] = {0};
    counts c;
    for (judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        scale(v, samples, &c);
        for (int k = 0; k < 3; k++) {
            const pearson found = pearson_over(&c, sides[k][0], sides[k][1]);
            statistic[k] += found.statistic;
            freedom[k] += found.classes ? found.classes - 1 : 0;
            v->bins = k ? v->bins : found;
        }
        v->scatter = scatter_of(v);
        v->block = find_block(&c);
        p = fmin(p, fmin(v->bins.p, v->block.p));
        if (fmin(v->bins.p, v->block.p) < worst) {
            worst = fmin(v->bins.p, v->block.p);
            fault->shown = show(v, &c);
        }
    }
    for (int k = 0; k < 3; k++)
        p = fmin(p, statistics_chi_square_p(statistic[k], freedom[k]));
    fault->worst = p;
}
