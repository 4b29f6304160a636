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
typedef struct vndf_tournament {
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
    for (t->leaves = 1; t->leaves < most;)
        t->leaves *= 2;
    t->node = calloc(2 * t->leaves, sizeof *t->node);
    t->interval = malloc(most * sizeof *t->interval);
    return t->node && t->interval;
}

static void tournament_free(tournament *t)
{
    if (t) {
        free(t->node);
        free(t->interval);
    }
    free(t);
}

/* In a default table some fifty intervals have shares that matter, so an error met alone counts as fifty
 * shares. */
static const double SHARERS = 50;

static void put(const vndf_refinement *r, size_t place, interval at)
{
    tournament *t = r->tournament;
    vndf_interval_miss miss = r->measure(at.a, at.b, r->user);
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

static void note_error(vndf_refinement *r)
{
    summary all = r->tournament->node[1];
    r->error[r->count] = all.share + all.alone;
}

static int begin(vndf_refinement *r, const double *start)
{
    tournament *t = r->tournament;
    if (!t || !tournament_from(t, r->start - 1 + r->limit) || !r->knot || !r->error)
        return 0;
    memcpy(r->knot, start, r->start * sizeof *start);
    while (t->count + 1 < r->start) {
        interval given = {start[t->count], start[t->count + 1]};
        put(r, t->count++, given);
    }
    note_error(r);
    return 1;
}

int vndf_refine_begin(vndf_refinement *r, const double *start, size_t start_count, size_t limit,
                      vndf_interval_middle *middle, vndf_interval_error *error, void *user)
{
    vndf_refinement made = {.start = start_count,
                            .limit = limit,
                            .middle = middle ? middle : arithmetic_middle,
                            .measure = error,
                            .user = user};
    *r = made;
    r->knot = malloc((start_count + limit) * sizeof *r->knot);
    r->error = malloc((limit + 1) * sizeof *r->error);
    r->tournament = calloc(1, sizeof *r->tournament);
    return begin(r, start);
}

void vndf_refine_to(vndf_refinement *r, double enough)
{
    tournament *t = r->tournament;
    while (r->count < r->limit && r->error[r->count] > enough && t->node[1].urgency > 0.0) {
        size_t next = t->node[1].next;
        interval whole = t->interval[next];
        double at = r->middle(whole.a, whole.b);
        interval left = {whole.a, at}, right = {at, whole.b};
        r->knot[r->start + r->count++] = at;
        put(r, next, left);
        put(r, t->count++, right);
        note_error(r);
    }
}

int vndf_refinement_reaches(const vndf_refinement *r, double enough)
{
    return r->error[r->count] <= enough;
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
    tournament_free(r->tournament);
    memset(r, 0, sizeof *r);
}
