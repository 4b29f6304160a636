/* Chebyshev series through NODES values of each piece of a panel, written as polynomials. A series is taken if its last
 * terms, and its error halfway between two nodes, vanish beside the least value in the piece: S falls by many powers
 * of ten in a panel of the tail. If that fails the panel is cut into more pieces; if that fails, too, sums stay. */
#include "fit/profile/strip.h"

#include <math.h>
#include <stdlib.h>

enum { NODES = 24, OFTEN = 20, MORE_PIECES = 4, PIECES_MOST = 16, TURN = 4 * NODES };

static const double PI = 3.14159265358979323846;
static const double AGREE = 3e-14;        /* relative error of a series */
static const double NOTHING = 2e-17;      /* of a value: smaller terms are left out */
static const double PIECE_OPERATIONS = 2; /* of a value by a polynomial */

/* The sum of c[k] t^k, t from -1 to 1. */
typedef struct polynomial {
    int count;
    double c[NODES];
} polynomial;

typedef struct panel {
    int asked;    /* how often, until there are pieces */
    int pieces;   /* 0: sums */
    size_t first; /* of its pieces */
    double per;   /* pieces to a slope */
} panel;

struct vndf_strip {
    const vndf_profile *profile;
    int beyond;
    size_t last;         /* the panel that was asked last: the next one is near */
    double cosine[TURN]; /* of one turn: the zeros of T_NODES are the odd ones of its first half */
    panel *panel;
    polynomial *piece; /* of all panels */
    size_t count, capacity;
};

static double sum_at(const vndf_strip *s, double rho)
{
    return s->beyond ? vndf_profile_s(s->profile, rho) : vndf_profile_e(s->profile, rho);
}

/* ---- a piece ---- */

static double value_at(const polynomial *p, double t)
{
    double even = 0.0, odd = 0.0, square = t * t;
    for (int k = p->count - 2; k >= 0; k -= 2) {
        odd = odd * square + p->c[k + 1];
        even = even * square + p->c[k];
    }
    return even + t * odd;
}

/* The coefficients of the Chebyshev series through values at the zeros of T_NODES. */
static void series_of(const vndf_strip *s, const double *value, double *term)
{
    for (int k = 0; k < NODES; k++) {
        double sum = 0.0;
        for (int i = 0; i < NODES; i++)
            sum += value[i] * s->cosine[k * (2 * i + 1) % TURN];
        term[k] = sum * (k ? 2.0 : 1.0) / NODES;
    }
}

/* The same function by powers, by T_(k+1) = 2 t T_k - T_(k-1). */
static polynomial powers_of(const double *term, int count)
{
    polynomial p = {count, {0.0}};
    double before[NODES] = {1.0}, now[NODES] = {0.0, 1.0};
    for (int k = 0; k < count; k++) {
        for (int j = 0; j <= k; j++)
            p.c[j] += term[k] * before[j];
        for (int j = NODES - 1; j >= 0; j--) {
            double next = (j ? 2 * now[j - 1] : 0.0) - before[j];
            before[j] = now[j];
            now[j] = next;
        }
    }
    return p;
}

/* The place of t, from -1 to 1, in a piece. */
static double place(double from, double width, double t)
{
    return from + width * (0.5 + 0.5 * t);
}

/* Fills a piece; 0 if no polynomial is near enough. */
static int fill_piece(const vndf_strip *s, double from, double width, polynomial *p)
{
    double value[NODES], term[NODES], least = HUGE_VAL, between = s->cosine[NODES / 2];
    for (int i = 0; i < NODES; i++) {
        value[i] = sum_at(s, place(from, width, s->cosine[2 * i + 1]));
        least = fmin(least, fabs(value[i]));
    }
    series_of(s, value, term);
    if (!(fabs(term[NODES - 1]) + fabs(term[NODES - 2]) <= AGREE * least))
        return 0;
    int count = NODES;
    while (count > 2 && fabs(term[count - 1]) + fabs(term[count - 2]) <= NOTHING * least)
        count -= 2;
    *p = powers_of(term, count);
    return fabs(value_at(p, between) - sum_at(s, place(from, width, between))) <= AGREE * least;
}

/* ---- panels ---- */

static int fill_pieces(const vndf_strip *s, size_t at, int pieces, polynomial *piece)
{
    double from = s->profile->panel[at].r, width = (s->profile->panel[at + 1].r - from) / pieces;
    for (int i = 0; i < pieces; i++)
        if (!fill_piece(s, from + i * width, width, &piece[i]))
            return 0;
    return 1;
}

/* Makes room for the pieces of one more panel; 0, and a note to the guard, if there is no memory. */
static int grow(vndf_strip *s)
{
    if (s->count + PIECES_MOST <= s->capacity)
        return 1;
    size_t capacity = s->capacity ? 2 * s->capacity : 256;
    polynomial *piece = realloc(s->piece, capacity * sizeof *piece);
    if (!piece) {
        s->profile->guard->starved = 1;
        return 0;
    }
    s->piece = piece;
    s->capacity = capacity;
    return 1;
}

static void fill_panel(vndf_strip *s, size_t at)
{
    panel *p = &s->panel[at];
    const vndf_panel *of = &s->profile->panel[at];
    for (int pieces = 1; grow(s) && pieces <= PIECES_MOST && p->pieces == 0; pieces *= MORE_PIECES)
        if (fill_pieces(s, at, pieces, s->piece + s->count)) {
            p->pieces = pieces;
            p->per = pieces / (of[1].r - of[0].r);
            p->first = s->count;
            s->count += (size_t)pieces;
        }
}

/* The panel of rho, which lies between the first and the last edge. */
static size_t panel_of(vndf_strip *s, double rho)
{
    const vndf_panel *p = s->profile->panel;
    size_t low = 0, high = s->profile->count;
    if (p[s->last].r <= rho && rho < p[s->last + 1].r)
        return s->last;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (p[middle].r <= rho)
            low = middle;
        else
            high = middle;
    }
    return s->last = low;
}

double vndf_strip_at(vndf_strip *s, double rho)
{
    const vndf_profile *profile = s->profile;
    if (!(rho > profile->panel[0].r && rho < profile->panel[profile->count].r))
        return sum_at(s, rho);
    size_t at = panel_of(s, rho);
    panel *p = &s->panel[at];
    if (p->asked <= OFTEN && p->asked++ == OFTEN)
        fill_panel(s, at);
    if (p->pieces == 0 || !vndf_guard_spend(profile->guard, PIECE_OPERATIONS))
        return sum_at(s, rho);
    double way = (rho - profile->panel[at].r) * p->per;
    int i = (int)way;
    i = i < p->pieces ? i : p->pieces - 1;
    return value_at(&s->piece[p->first + (size_t)i], 2 * (way - i) - 1);
}

vndf_strip *vndf_strip_from(const vndf_profile *profile, int beyond)
{
    vndf_strip *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->profile = profile;
    s->beyond = beyond;
    for (int i = 0; i < TURN; i++)
        s->cosine[i] = cos(2 * PI * i / TURN);
    s->panel = calloc(profile->count, sizeof *s->panel);
    if (s->panel)
        return s;
    free(s);
    return NULL;
}

void vndf_strip_free(vndf_strip *s)
{
    if (s) {
        free(s->panel);
        free(s->piece);
    }
    free(s);
}
