/* The intervals stand in a tournament, which at any time knows the next one to halve and the error of all. */
#include "fit/refine.h"

#include <stdlib.h>
#include <string.h>

#include "math/ascending.h"

/* ---- the tournament ---- */

/* A summary of some intervals. */
typedef struct summary {
    double share, alone; /* sum of the shares, largest alone */
    double urgency;      /* of the interval to halve next */
    size_t next;         /* its index */
} summary;

typedef struct interval {
    double a, b;
} interval;

/* A complete binary tree over the intervals: node i sums up nodes 2i and 2i + 1, node leaves + i is interval i. A
 * change costs one path to the root. It adds the sums anew and subtracts nothing, so that no sum loses digits. */
typedef struct tournament {
    size_t count, leaves;
    summary *node; /* 2 leaves; node 1 is the root */
    interval *interval;
} tournament;

static summary together(summary l, summary r)
{
    const summary *first = r.urgency > l.urgency ? &r : &l;
    summary both = {l.share + r.share, l.alone > r.alone ? l.alone : r.alone, first->urgency, first->next};
    return both;
}

static int tournament_from(tournament *t, size_t most)
{
    t->count = 0;
    for (t->leaves = 1; t->leaves < most;)
        t->leaves *= 2;
    t->node = calloc(2 * t->leaves, sizeof *t->node);
    t->interval = malloc(most * sizeof *t->interval);
    return t->node && t->interval;
}

static void tournament_free(tournament *t)
{
    free(t->node);
    free(t->interval);
}

/* In a default table some fifty intervals have shares that matter, so an error met alone counts as fifty
 * shares. */
static const double SHARERS = 50;

static void put(tournament *t, size_t place, interval at, vndf_interval_error *error, void *user)
{
    vndf_interval_miss miss = error(at.a, at.b, user);
    double shared = SHARERS * miss.share;
    summary leaf = {miss.share, miss.alone, shared > miss.alone ? shared : miss.alone, place};
    size_t i = t->leaves + place;
    t->interval[place] = at;
    t->node[i] = leaf;
    while (i /= 2)
        t->node[i] = together(t->node[2 * i], t->node[2 * i + 1]);
}

/* ---- halving ---- */

static double arithmetic_middle(double a, double b)
{
    return a + (b - a) / 2;
}

/* Halves intervals until there is a reason to stop. */
static void halve_the_worst(vndf_refinement *r, tournament *t, size_t limit, double enough,
                            vndf_interval_middle *middle, vndf_interval_error *error, void *user)
{
    for (;;) {
        summary all = t->node[1];
        r->error[r->count] = all.share + all.alone;
        if (r->count == limit || r->error[r->count] <= enough || all.urgency <= 0.0)
            return;
        interval whole = t->interval[all.next];
        double at = middle(whole.a, whole.b);
        interval left = {whole.a, at}, right = {at, whole.b};
        r->knot[r->start + r->count++] = at;
        put(t, all.next, left, error, user);
        put(t, t->count++, right, error, user);
    }
}

int vndf_refine(vndf_refinement *r, const double *start, size_t start_count, size_t limit, double enough,
                vndf_interval_middle *middle, vndf_interval_error *error, void *user)
{
    tournament t;
    int good = tournament_from(&t, start_count - 1 + limit);
    r->start = start_count;
    r->count = 0;
    r->knot = malloc((start_count + limit) * sizeof *r->knot);
    r->error = malloc((limit + 1) * sizeof *r->error);
    if (good && r->knot && r->error) {
        memcpy(r->knot, start, start_count * sizeof *start);
        while (t.count + 1 < start_count) {
            interval given = {start[t.count], start[t.count + 1]};
            put(&t, t.count++, given, error, user);
        }
        halve_the_worst(r, &t, limit, enough, middle ? middle : arithmetic_middle, error, user);
    } else
        good = 0;
    tournament_free(&t);
    return good;
}

uint32_t vndf_refinement_needed(const vndf_refinement *r, double error)
{
    size_t n = 0;
    while (n < r->count && r->error[n] > error)
        n++;
    return (uint32_t)(r->start + n);
}

void vndf_refinement_knots(const vndf_refinement *r, size_t count, double *knots)
{
    memcpy(knots, r->knot, count * sizeof *knots);
    qsort(knots, count, sizeof *knots, vndf_ascending);
}

void vndf_refinement_free(vndf_refinement *r)
{
    free(r->knot);
    free(r->error);
    memset(r, 0, sizeof *r);
}
