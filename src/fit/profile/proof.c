/* Pieces of log r, ascending. Each round halves the pieces that stray most. The bound of a piece meets a narrow
 * feature in it long before any point does. */
#include "fit/profile/proof.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIECES_MAX = 400000, ROUNDS_MAX = 2000 };

static const double STRAY = 5e-6, MISS = 5e-6; /* of all: how much may stray, and how much panels may miss */
static const double NOTHING = 1e-200;          /* a P22 that nowhere exceeds this counts as 0 */
static const double NARROW = 4e-16;            /* of its slope: a piece that cannot be halved */
static const double BESIDE = 1e-13;            /* pieces end on both sides of a known break */

/* From slope low to high, in the unit of the source: how much of the integral of P22 r^2 du may stray, and the
 * integral by the value in the middle. */
typedef struct piece {
    double low, high, stray, mass;
    size_t panel;
} piece;

typedef struct state {
    const vndf_profile *profile;
    piece *piece, *halves;
    size_t count;
    double mass, slope; /* integrals of P22 r and of P22 r^2 by the values of the pieces */
    double stray;       /* of all pieces, as a part of the integrals */
} state;

/* ---- a piece ---- */

static double integrand(const vndf_profile *profile, double slope)
{
    double r = slope / profile->scale;
    return vndf_profile_p22(profile, r) * r * r;
}

static int is_narrow(const piece *p)
{
    return p->high - p->low <= NARROW * p->high;
}

/* No value lies between neighbouring doubles. A pole between two of them counts by the values at both. */
static double between_doubles(const vndf_profile *profile, const piece *p)
{
    return 2 * log(p->high / p->low) * (integrand(profile, p->low) + integrand(profile, p->high));
}

static void look(const state *s, piece *p)
{
    const vndf_profile *profile = s->profile;
    vndf_reach reach = {0, 0, 0};
    if (vndf_guard_spend(profile->guard, VNDF_REACH_OPERATIONS * profile->source->operations))
        reach = profile->source->reach(profile->source, p->low, p->high);
    int pole = isinf(reach.stray) && is_narrow(p);
    p->stray = pole ? between_doubles(profile, p) : profile->normalization * reach.stray;
    p->mass = integrand(profile, sqrt(p->low) * sqrt(p->high)) * log(p->high / p->low);
}

/* The share that a part of a piece's mass, at its outer end, has in all mass and area together. */
static double share(const state *s, const piece *p, double part)
{
    return s->mass > 0.0 ? part * (1.0 / s->mass + p->high / s->slope) : part;
}

/* ---- all pieces ---- */

static void add(state *s, double low, double high, size_t panel)
{
    piece p = {low, high, 0, 0, panel};
    if (!(high > low) || s->count >= PIECES_MAX)
        return;
    look(s, &p);
    s->piece[s->count++] = p;
}

/* Moves ends inwards by BESIDE: at a known break doubles and bounds may be on different sides. */
static void begin_at_breaks(state *s, double low, double high, size_t panel)
{
    double inner = low * (1 + BESIDE), outer = high * (1 - BESIDE);
    if (outer > inner) {
        add(s, low, inner, panel);
        add(s, inner, outer, panel);
        add(s, outer, high, panel);
    } else
        add(s, low, high, panel);
}

static int meets_breaks(const vndf_source *source, double low, double high)
{
    size_t first = 0, end = source->break_count;
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        if (source->breaks[middle] > low * (1 - BESIDE))
            end = middle;
        else
            first = middle + 1;
    }
    return first < source->break_count && source->breaks[first] < high * (1 + BESIDE);
}

/* A piece for each panel. */
static void begin(state *s)
{
    const vndf_profile *profile = s->profile;
    for (size_t i = 0; i < profile->count; i++) {
        double low = profile->panel[i].r * profile->scale, high = profile->panel[i + 1].r * profile->scale;
        if (meets_breaks(profile->source, low, high))
            begin_at_breaks(s, low, high, i);
        else
            add(s, low, high, i);
    }
}

static void measure(state *s)
{
    s->mass = s->slope = s->stray = 0.0;
    for (size_t i = 0; i < s->count; i++) {
        s->mass += s->piece[i].mass;
        s->slope += s->piece[i].mass * sqrt(s->piece[i].low * s->piece[i].high);
    }
    for (size_t i = 0; i < s->count; i++)
        s->stray += share(s, &s->piece[i], s->piece[i].stray);
}

static double enough(const state *s)
{
    return s->mass > 0.0 ? STRAY : NOTHING;
}

/* Halves the pieces that exceed their part of the allowance; returns how many. */
static size_t halve(state *s)
{
    double most = fmax(enough(s) / 2, s->stray / 8) / (double)s->count;
    piece *old = s->piece;
    size_t count = s->count, halved = 0;
    s->piece = s->halves;
    s->halves = old;
    s->count = 0;
    for (size_t i = 0; i < count; i++) {
        const piece *p = &old[i];
        double part = share(s, p, p->stray);
        if ((part > most || isinf(part)) && !is_narrow(p) && count + halved < PIECES_MAX) {
            double middle = sqrt(p->low) * sqrt(p->high);
            middle = middle > p->low && middle < p->high ? middle : p->low + (p->high - p->low) / 2;
            add(s, p->low, middle, p->panel);
            add(s, middle, p->high, p->panel);
            halved++;
        } else
            s->piece[s->count++] = *p;
    }
    return halved;
}

static void refine(state *s)
{
    measure(s);
    for (int i = 0; i < ROUNDS_MAX && !(s->stray <= enough(s)) && !vndf_guard_stopped(s->profile->guard); i++) {
        if (!halve(s))
            return;
        measure(s);
    }
}

/* ---- what the panels have seen ---- */

/* The polynomials through the points on which a panel was accepted, one for each of its two parts. */
typedef struct view {
    double inner, middle, outer; /* log of slopes in the source's unit */
    double value[2][VNDF_GAUSS];
} view;

static void view_panel(view *v, const vndf_profile *profile, size_t panel)
{
    v->inner = log(profile->panel[panel].r * profile->scale);
    v->outer = log(profile->panel[panel + 1].r * profile->scale);
    v->middle = v->inner + (v->outer - v->inner) * VNDF_UNEVEN;
    for (int n = 0; n < 2; n++) {
        double from = n ? v->middle : v->inner, to = n ? v->outer : v->middle, r[VNDF_GAUSS];
        for (int i = 0; i < VNDF_GAUSS; i++)
            r[i] = exp(from + (to - from) * vndf_gauss_node[i]) / profile->scale;
        vndf_profile_p22_many(profile, r, VNDF_GAUSS, v->value[n]);
        for (int i = 0; i < VNDF_GAUSS; i++)
            v->value[n][i] = v->value[n][i] * r[i] * r[i];
    }
}

/* P22 r^2 at exp(u) by these polynomials. */
static double seen(const view *v, double u)
{
    int part = u > v->middle;
    double from = part ? v->middle : v->inner, to = part ? v->outer : v->middle, sum = 0.0, weight = 0.0;
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double gap = (u - from) / (to - from) - vndf_gauss_node[i];
        if (gap == 0.0 || !(to > from))
            return v->value[part][i];
        sum += vndf_gauss_barycentric[i] / gap * v->value[part][i];
        weight += vndf_gauss_barycentric[i] / gap;
    }
    return sum / weight;
}

/* The integral over a piece of |P22 r^2 - the polynomials| by a few values. */
static double missed(const vndf_profile *profile, const view *v, const piece *p)
{
    enum { PLACES = 3 };
    double inner = log(p->low), h = log(p->high / p->low), sum = 0.0;
    for (int i = 0; i < PLACES; i++) {
        double u = inner + h * (i + 0.5) / PLACES;
        sum += fabs(integrand(profile, exp(u)) - seen(v, u)) * h / PLACES;
    }
    return sum;
}

/* ---- what came out ---- */

static void take_edge(vndf_proof *proof, double r)
{
    if (proof->edge_count == 0 || r > proof->edge[proof->edge_count - 1])
        proof->edge[proof->edge_count++] = r;
}

/* The misses of all pieces, as parts of the integrals; returns their sum. */
static double compare(const state *s, double *miss)
{
    double sum = 0.0;
    view v;
    for (size_t i = 0; i < s->count; i++) {
        const piece *p = &s->piece[i];
        if (i == 0 || p->panel != p[-1].panel)
            view_panel(&v, s->profile, p->panel);
        sum += miss[i] = share(s, p, missed(s->profile, &v, p));
    }
    return sum;
}

static void find_worst(vndf_proof *proof, const state *s)
{
    for (size_t i = 0; i < s->count; i++) {
        double part = share(s, &s->piece[i], s->piece[i].stray);
        if (part > proof->worst) {
            proof->worst = part;
            proof->where = s->piece[i].low;
        }
    }
}

/* 0 if there is no memory. */
static int judge(vndf_proof *proof, const state *s)
{
    double *miss = malloc((s->count + 1) * sizeof *miss), found;
    proof->edge = malloc((2 * s->count + 1) * sizeof *proof->edge);
    if (miss && proof->edge) {
        found = compare(s, miss);
        find_worst(proof, s);
        proof->hidden = s->stray + found;
        proof->proven = s->mass > 0.0 ? proof->hidden <= STRAY + MISS : s->stray <= NOTHING;
        for (size_t i = 0; found > MISS && i < s->count; i++)
            if (miss[i] > MISS / 2 / (double)s->count) {
                take_edge(proof, s->piece[i].low);
                take_edge(proof, s->piece[i].high);
            }
    }
    int good = miss && proof->edge;
    free(miss);
    return good;
}

int vndf_proof_from(vndf_proof *proof, const vndf_profile *profile)
{
    state s = {.profile = profile};
    memset(proof, 0, sizeof *proof);
    s.piece = malloc(PIECES_MAX * sizeof *s.piece);
    s.halves = malloc(PIECES_MAX * sizeof *s.halves);
    int good = s.piece && s.halves;
    if (good) {
        begin(&s);
        refine(&s);
        good = judge(proof, &s);
    }
    free(s.piece);
    free(s.halves);
    return good;
}

/* ---- samples ---- */

enum { SAMPLE_EDGES = 1 << 16 };

/* |P22 r^2 - the polynomials| du at a sample that represents du, as a part of the integrals. */
static double missed_at(const vndf_profile *profile, const view *v, double u, double du)
{
    double slope = exp(u), miss = fabs(integrand(profile, slope) - seen(v, u)) * du;
    return profile->f0 > 0.0 ? miss * (1.0 / profile->f0 + slope / profile->scale / profile->f1) : miss;
}

/* Adds the miss of a panel to the sum; keeps the places that hold more than `least`. */
static void sample_panel(vndf_proof *proof, const vndf_profile *profile, size_t panel, double width, double least)
{
    view v;
    view_panel(&v, profile, panel);
    double count = ceil((v.outer - v.inner) / (width / 2)), du = (v.outer - v.inner) / count;
    for (double i = 0; i < count && !vndf_guard_stopped(profile->guard); i++) {
        double u = v.inner + (i + 0.5) * du, miss = missed_at(profile, &v, u, du);
        proof->hidden += miss;
        if (miss > least && proof->edge_count + 2 < SAMPLE_EDGES) {
            take_edge(proof, exp(u - width));
            take_edge(proof, exp(u + width));
        }
    }
}

int vndf_proof_by_samples(vndf_proof *proof, const vndf_profile *profile, double width)
{
    double samples = 2 / width * log(profile->panel[profile->count].r / profile->panel[0].r);
    memset(proof, 0, sizeof *proof);
    proof->edge = malloc(SAMPLE_EDGES * sizeof *proof->edge);
    for (size_t i = 0; proof->edge && i < profile->count; i++)
        sample_panel(proof, profile, i, width, MISS / samples);
    proof->proven = proof->hidden <= MISS || !(profile->f0 > 0.0);
    if (proof->hidden <= MISS)
        proof->edge_count = 0;
    proof->hidden = 1.0;
    return proof->edge != NULL;
}

void vndf_proof_free(vndf_proof *proof)
{
    free(proof->edge);
    proof->edge = NULL;
}
