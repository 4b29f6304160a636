/* An interval of width h errs by about C h^n with a C of its own. Between two held knots, each interval is taken to
 * consist of so many equal pieces as the n-th root of its error says, and the knots move to where the count of pieces
 * is even. That is repeated, since C changes with the place. */
#include "fit/even.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows err by the third power of their distance, radial cells by the fourth. The higher power moves knots less. */
static const double ORDER = 4;

/* So small an error does not matter: an interval without any takes some room all the same. */
static const double NEGLIGIBLE = 1e-9;

enum { ROUNDS = 5 };

typedef struct even {
    size_t count;  /* of knots */
    double *knot;  /* now */
    double *best;  /* with the least error so far */
    double *moved; /* where they will be */
    double *piece; /* of each interval */
    double least;
} even;

/* Fills the pieces of all intervals; the error of all. */
static double measure(even *e, vndf_interval_error *error, void *user)
{
    double share = 0.0, alone = 0.0;
    for (size_t i = 0; i + 1 < e->count; i++) {
        vndf_interval_miss miss = error(e->knot[i], e->knot[i + 1], user);
        double shared = (double)(e->count - 1) * miss.share;
        share += miss.share;
        alone = fmax(alone, miss.alone);
        e->piece[i] = pow(fmax(shared, miss.alone) + NEGLIGIBLE, 1 / ORDER);
    }
    return share + alone;
}

static void keep_best(even *e, double error)
{
    if (error < e->least) {
        e->least = error;
        memcpy(e->best, e->knot, e->count * sizeof *e->best);
    }
}

/* The knots between two that are held. */
static void move_between(even *e, size_t from, size_t to, vndf_interval_place *place)
{
    double all = 0.0, before = 0.0;
    size_t at = from;
    for (size_t i = from; i < to; i++)
        all += e->piece[i];
    for (size_t i = from + 1; i < to; i++) {
        double wanted = all * (double)(i - from) / (double)(to - from);
        while (at + 1 < to && before + e->piece[at] < wanted)
            before += e->piece[at++];
        e->moved[i] = place(e->knot[at], e->knot[at + 1], fmin((wanted - before) / e->piece[at], 1.0));
    }
}

static void move_all(even *e, const double *held, size_t held_count, vndf_interval_place *place)
{
    size_t from = 0;
    memcpy(e->moved, e->knot, e->count * sizeof *e->moved);
    for (size_t i = 1; i < e->count; i++) {
        size_t h = 0;
        while (h < held_count && held[h] < e->knot[i])
            h++;
        if (i + 1 < e->count && !(h < held_count && held[h] == e->knot[i]))
            continue;
        move_between(e, from, i, place);
        from = i;
    }
    memcpy(e->knot, e->moved, e->count * sizeof *e->knot);
}

int vndf_even_knots(double *knots, size_t count, const double *held, size_t held_count, vndf_interval_place *place,
                    vndf_interval_error *error, void *user)
{
    double *room = malloc(3 * count * sizeof *room);
    if (!room)
        return 0;
    even e = {count, knots, room, room + count, room + 2 * count, HUGE_VAL};
    keep_best(&e, measure(&e, error, user));
    for (int i = 0; i < ROUNDS; i++) {
        move_all(&e, held, held_count, place);
        keep_best(&e, measure(&e, error, user));
    }
    memcpy(knots, e.best, count * sizeof *knots);
    free(room);
    return 1;
}
