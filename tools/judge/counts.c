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
    double expected[JUDGE_EACH], observed[JUDGE_EACH];
} counts;

/* A density that is wrong by a factor alone has the right shape. */
static void scale(judge_view *v, size_t samples, counts *c)
{
    const double scale = v->total > 0 ? (double)samples / v->total : 0;
    for (size_t i = 0; i < JUDGE_EACH; i++) {
        const double e = fmax(v->sum[i].value, 0) * scale, variance = v->sum[i].variance * scale * scale;
        const double kept = variance > 0 ? e / (e + variance) : 1;
        c->expected[i] = kept * e;
        c->observed[i] = kept * v->observed[i];
        v->left_out = fmin(1, v->left_out + (kept < 0.5 ? e / (double)samples : 0));
    }
}

enum { SUMS_MAX = JUDGE_BINS + 2 * JUDGE_SIDE };

static void sums_of(const judge_view *v, const double *bins, double *sum)
{
    const size_t across = v->sectors + 1;
    memset(sum, 0, across * sizeof *sum);
    for (size_t i = 0; i < v->rings; i++) {
        double *row = sum + (i + 1) * across;
        row[0] = 0;
        for (size_t k = 0; k < v->sectors; k++)
            row[k + 1] = row[k - across + 1] + row[k] - row[k - across] + bins[i * v->sectors + k];
    }
}

static double sum_over(const judge_view *v, const double *sum, size_t ring, size_t high, size_t sector,
                       size_t wide)
{
    const double *at = sum + ring * (v->sectors + 1) + sector, *end = at + high * (v->sectors + 1);
    return end[wide] - at[wide] - end[0] + at[0];
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
static judge_block find_block(const judge_view *v, const counts *c)
{
    double e[SUMS_MAX], o[SUMS_MAX], least = 1, blocks = 0;
    judge_block found = {{0, 1}, {0, 1}, 0, 0, 1};
    sums_of(v, c->expected, e);
    sums_of(v, c->observed, o);
    for (size_t high = 1; high <= v->rings; high *= 2)
        for (size_t wide = 1; wide <= v->sectors && high * wide < v->rings * v->sectors; wide *= 2)
            for (size_t i = 0; i + high <= v->rings; i += (high + 1) / 2)
                for (size_t k = 0; k + wide <= v->sectors; k += (wide + 1) / 2, blocks++) {
                    const double expected = fmax(sum_over(v, e, i, high, k, wide), 0);
                    const double observed = sum_over(v, o, i, high, k, wide);
                    const double p = chance(expected, observed);
                    if (p < least) {
                        least = p;
                        found = (judge_block){{i, i + high}, {k, k + wide}, expected, observed, 0};
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
    size_t most = b->ring[0] * v->sectors + b->sector[0];
    for (size_t ring = b->ring[0]; ring < b->ring[1]; ring++)
        for (size_t sector = b->sector[0]; sector < b->sector[1]; sector++) {
            const size_t i = ring * v->sectors + sector;
            const double off = c->observed[i] - c->expected[i], of_most = c->observed[most] - c->expected[most];
            most = (too_many ? off > of_most : off < of_most) ? i : most;
        }
    return too_many ? v->sample[most] : v->density[most];
}

/* Of so many rings and sectors, in which bins are put together. */
static pearson pearson_over(const judge_view *v, const counts *c, size_t rings, size_t sectors)
{
    counts sum = {{0}, {0}};
    const size_t bins = rings * sectors;
    for (size_t i = 0; i < JUDGE_EACH; i++) {
        const size_t ring = i / v->sectors * rings / v->rings, sector = i % v->sectors * sectors / v->sectors;
        const size_t to = i < v->rings * v->sectors ? ring * sectors + sector : bins;
        sum.expected[to] += c->expected[i];
        sum.observed[to] += c->observed[i];
    }
    return pearson_of(sum.expected, sum.observed, bins + 1);
}

/* Tests: squares of 16 bins of each direction, since many small ones add up what integrals err; those, rings and
 * sectors of all directions; blocks. */
void judge_counts(judgement *j, size_t samples)
{
    judge_fault *fault = &j->fault[JUDGE_CHI_SQUARE];
    double statistic[3] = {0}, p = 1, least = 2;
    size_t freedom[3] = {0};
    counts c;
    for (judge_view *v = j->view; v < j->view + JUDGE_VIEWS; v++) {
        scale(v, samples, &c);
        const size_t rings = (v->rings + 3) / 4, sectors = (v->sectors + 3) / 4;
        const pearson of[3] = {pearson_over(v, &c, rings, sectors), pearson_over(v, &c, rings, 1),
                               pearson_over(v, &c, 1, sectors)};
        for (int k = 0; k < 3; k++) {
            statistic[k] += of[k].statistic;
            freedom[k] += of[k].classes ? of[k].classes - 1 : 0;
        }
        v->bins = of[0];
        v->block = find_block(v, &c);
        p = fmin(p, fmin(v->bins.p, v->block.p));
        fault->shown = p < least ? show(v, &c) : fault->shown;
        least = fmin(least, p);
        for (size_t i = 0; i < JUDGE_EACH; i++) {
            c.expected[i] *= (double)(JUDGE_STRATA * JUDGE_STRATA) / (double)samples;
            c.observed[i] = v->stratified[i];
        }
        const pearson even = pearson_over(v, &c, rings, sectors);
        v->scatter = even.classes > 1 ? even.statistic / (double)(even.classes - 1) : 1;
    }
    for (int k = 0; k < 3; k++)
        p = fmin(p, statistics_chi_square_p(statistic[k], freedom[k]));
    fault->worst = p;
}
