/* An interval of width h errs by about C h^n with a C of its own. Between two held knots, each interval is taken to
 * consist of so many equal pieces as the n-th root of its error says, and the knots move to where the count of pieces
 * is even. That is repeated, since C changes with the place. */
#include "fit/even.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows err by the third power of their distance. A higher one moves knots less, and does not overshoot. */
static const double ORDER = 4;

/* So small an error does not matter: an interval without any takes some room all the same. */
static const double NEGLIGIBLE = 1e-9;

/* The knots of one table while they are moved. */
typedef struct moved {
    const vndf_even *how;
    size_t count;
    double *knot;  /* now */
    double *best;  /* with the least error so far */
    double *piece; /* of the interval after each */
    double least;
} moved;

/* Fills the pieces of all intervals; the error of all. */
static double measure(moved *m)
{
    double share = 0.0, alone = 0.0;
    for (size_t i = 0; i + 1 < m->count; i++) {
        vndf_interval_miss miss = m->how->error(m->knot[i], m->knot[i + 1], m->how->user);
        double shared = (double)(m->count - 1) * miss.share;
        share += miss.share;
        alone = fmax(alone, miss.alone);
        m->piece[i] = pow(fmax(shared, miss.alone) + NEGLIGIBLE, 1 / ORDER);
    }
    return share + alone;
}

/* Whether knots may be moved from here. */
static int keep_best(moved *m)
{
    double error = measure(m);
    if (error < m->least) {
        m->least = error;
        memcpy(m->best, m->knot, m->count * sizeof *m->best);
    }
    return error < HUGE_VAL;
}

/* The knots between two that are held, from where they are in `old`. */
static void move_between(moved *m, const double *old, size_t from, size_t to)
{
    double all = 0.0, before = 0.0;
    size_t at = from;
    for (size_t i = from; i < to; i++)
        all += m->piece[i];
    for (size_t i = from + 1; i < to; i++) {
        double wanted = all * (double)(i - from) / (double)(to - from);
        while (at + 1 < to && before + m->piece[at] < wanted)
            before += m->piece[at++];
        m->knot[i] = old[at] + (old[at + 1] - old[at]) * fmin((wanted - before) / m->piece[at], 1.0);
    }
}

static int is_held(const moved *m, double knot)
{
    size_t i = 0;
    while (i < m->how->held_count && m->how->held[i] < knot)
        i++;
    return i < m->how->held_count && m->how->held[i] == knot;
}

/* Moves all knots from where they are in `old`. */
static void move_all(moved *m, const double *old)
{
    size_t from = 0;
    for (size_t i = 1; i < m->count; i++)
        if (i + 1 == m->count || is_held(m, old[i])) {
            move_between(m, old, from, i);
            from = i;
        }
}

int vndf_even_knots(double *knots, size_t count, const vndf_even *how)
{
    double *room = malloc(3 * count * sizeof *room), *old = room ? room + 2 * count : NULL;
    if (!room)
        return 0;
    moved m = {how, count, knots, room, room + count, HUGE_VAL};
    memcpy(m.best, knots, count * sizeof *knots);
    for (int i = 0; keep_best(&m) && i < how->rounds; i++) {
        memcpy(old, knots, count * sizeof *old);
        move_all(&m, old);
    }
    memcpy(knots, m.best, count * sizeof *knots);
    free(room);
    return 1;
}
