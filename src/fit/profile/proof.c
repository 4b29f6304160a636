/* How much the panels of a profile may have missed. A panel looked at ten points. Between points the proof follows a
 * source that can be bounded (vndf_reach) over pieces. It halves pieces with a wide bound, until all pieces together
 * stray by at most STRAY from a few values in each: the bound of a piece meets a narrow feature in it long before any
 * point does. Then it compares these values with the polynomials through the points of the panels. */
#include <math.h>
#include <stdlib.h>

#include "fit/profile/profile.h"

enum { PIECES_MAX = 400000, ROUNDS_MAX = 2000, SAMPLE_EDGES = 1 << 16 };

static const double STRAY = 5e-6, MISS = 5e-6; /* of all: how much may stray, and how much panels may miss */
static const double NOTHING = 1e-200;          /* a P22 that nowhere exceeds this counts as 0 */
static const double FINEST = 1e-3;             /* width of features that samples find, as a part of their slope */
static const double NARROW = 4e-16;            /* of its slope: a piece that cannot be halved */

/* From slope low to high: how much of the integral of P22 r^2 du may stray, and the integral by the value in the
 * middle. */
typedef struct piece {
    double low, high, stray, mass;
    size_t panel;
} piece;

typedef struct pieces {
    const vndf_profile *profile;
    piece *at, *before;
    size_t count;
    double mass, slope; /* integrals of P22 r and of P22 r^2 by the values of the pieces */
    double stray;       /* of all pieces, as a part of the integrals */
} pieces;

/* ---- pieces ---- */

static double integrand(const vndf_profile *profile, double r)
{
    return vndf_profile_p22(profile, r) * r * r;
}

static int is_narrow(const piece *p)
{
    return p->high - p->low <= NARROW * p->high;
}

/* The share that a part of a piece's mass, at its outer end, has in all mass and area together. */
static double share(const pieces *s, const piece *p, double part)
{
    return s->mass > 0.0 ? part * (1.0 / s->mass + p->high / s->slope) : part;
}

/* A pole between two neighbouring doubles, where no value lies, counts by the values at both. */
static void add(pieces *s, double low, double high, size_t panel)
{
    const vndf_profile *profile = s->profile;
    vndf_reach reach = {0, 0, 0};
    if (vndf_guard_spend(profile->guard, VNDF_REACH_OPERATIONS * profile->source->operations))
        reach = profile->source->reach(profile->source, low, high);
    double width = log(high / low);
    piece p = {low, high, profile->normalization * reach.stray, integrand(profile, sqrt(low) * sqrt(high)) * width,
               panel};
    if (isinf(reach.stray) && is_narrow(&p))
        p.stray = 2 * width * (integrand(profile, low) + integrand(profile, high));
    s->at[s->count++] = p;
}

static void measure(pieces *s)
{
    s->mass = s->slope = s->stray = 0.0;
    for (size_t i = 0; i < s->count; i++) {
        s->mass += s->at[i].mass;
        s->slope += s->at[i].mass * sqrt(s->at[i].low * s->at[i].high);
    }
    for (size_t i = 0; i < s->count; i++)
        s->stray += share(s, &s->at[i], s->at[i].stray);
}

/* Halves the pieces that exceed their part of what may stray; 0 if there are none. */
static int halve(pieces *s, double enough)
{
    double most = fmax(enough / 2, s->stray / 8) / (double)s->count;
    piece *old = s->at;
    size_t count = s->count, halved = 0;
    s->at = s->before;
    s->before = old;
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
            s->at[s->count++] = *p;
    }
    return halved > 0;
}

/* ---- what the panels have seen ---- */

/* The polynomials through the points on which a panel was accepted, one for each of its two parts. */
typedef struct view {
    double inner, middle, outer; /* log of slopes */
    double value[2][VNDF_GAUSS]; /* P22 r^2 */
} view;

static void view_panel(view *v, const vndf_profile *profile, size_t panel)
{
    double r[3] = {profile->panel[panel].r, 0, profile->panel[panel + 1].r};
    v->inner = log(r[0]);
    v->outer = log(r[2]);
    v->middle = v->inner + (v->outer - v->inner) * VNDF_UNEVEN;
    r[1] = exp(v->middle);
    for (int n = 0; n < 2; n++) {
        vndf_profile_point point[VNDF_GAUSS];
        double du = n ? v->outer - v->middle : v->middle - v->inner;
        vndf_profile_rule(profile, r[n], r[n + 1], point);
        for (int i = 0; i < VNDF_GAUSS; i++)
            v->value[n][i] =
                du > 0 ? point[i].weight / (vndf_gauss_weight[i] * log1p((r[n + 1] - r[n]) / r[n])) : 0;
    }
}

/* P22 r^2 at exp(u) by these polynomials, in barycentric form. */
static double seen(const view *v, double u)
{
    static const double factor[VNDF_GAUSS] = {
        -0.10901071252451058, 0.3607713161652364, -0.6388981226524656, 0.8699308691932656, -1.0, 1.0,
        -0.8699308691932656,  0.6388981226524656, -0.3607713161652364, 0.10901071252451058};
    int part = u > v->middle;
    double from = part ? v->middle : v->inner, to = part ? v->outer : v->middle, sum = 0.0, weight = 0.0;
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double gap = (u - from) / (to - from) - vndf_gauss_node[i];
        if (gap == 0.0 || !(to > from))
            return v->value[part][i];
        sum += factor[i] / gap * v->value[part][i];
        weight += factor[i] / gap;
    }
    return sum / weight;
}

/* The integral over `width` about u of |P22 r^2 - the polynomials|, by `places` values. */
static double missed(const vndf_profile *profile, const view *v, double inner, double width, int places)
{
    double sum = 0.0;
    for (int i = 0; i < places; i++) {
        double u = inner + width * (i + 0.5) / places;
        sum += fabs(integrand(profile, exp(u)) - seen(v, u)) * width / places;
    }
    return sum;
}

static void take_edge(vndf_proof *proof, double r)
{
    if (proof->edge_count == 0 || r > proof->edge[proof->edge_count - 1])
        proof->edge[proof->edge_count++] = r;
}

/* ---- what came out ---- */

/* Adds what panels missed in each piece; where that is too much, pieces that missed more than their part give edges. */
static void judge(vndf_proof *proof, const pieces *s, double *miss)
{
    double found = 0;
    view v;
    for (size_t i = 0; i < s->count; i++) {
        const piece *p = &s->at[i];
        if (i == 0 || p->panel != p[-1].panel)
            view_panel(&v, s->profile, p->panel);
        found += miss[i] = share(s, p, missed(s->profile, &v, log(p->low), log(p->high / p->low), 3));
        double stray = share(s, p, p->stray);
        if (stray > proof->worst) {
            proof->worst = stray;
            proof->where = p->low;
        }
    }
    proof->hidden = s->stray + found;
    proof->proven = s->mass > 0.0 ? proof->hidden <= STRAY + MISS : s->stray <= NOTHING;
    for (size_t i = 0; found > MISS && i < s->count; i++)
        if (miss[i] > MISS / 2 / (double)s->count) {
            take_edge(proof, s->at[i].low);
            take_edge(proof, s->at[i].high);
        }
}

static int prove(vndf_proof *proof, const vndf_profile *profile)
{
    pieces s = {
        .profile = profile, .at = malloc(PIECES_MAX * sizeof *s.at), .before = malloc(PIECES_MAX * sizeof *s.at)};
    double *miss = NULL;
    if (s.at && s.before) {
        for (size_t i = 0; i < profile->count; i++)
            add(&s, profile->panel[i].r, profile->panel[i + 1].r, i);
        measure(&s);
        for (int i = 0; i < ROUNDS_MAX && !vndf_guard_stopped(profile->guard); i++) {
            double enough = s.mass > 0.0 ? STRAY : NOTHING;
            if (s.stray <= enough || !halve(&s, enough))
                break;
            measure(&s);
        }
        miss = malloc((s.count + 1) * sizeof *miss);
        proof->edge = malloc((2 * s.count + 1) * sizeof *proof->edge);
        if (miss && proof->edge)
            judge(proof, &s, miss);
    }
    int good = miss && proof->edge;
    free(miss);
    free(s.at);
    free(s.before);
    return good;
}

/* By values at most half of `width` times their slope apart, which meet a feature of that width. Narrower features are
 * not excluded; `proven` then means that no more was found. */
static int sample(vndf_proof *proof, const vndf_profile *profile, double width)
{
    double least = MISS * width / (2 * log(profile->panel[profile->count].r / profile->panel[0].r));
    *proof = (vndf_proof){.edge = malloc(SAMPLE_EDGES * sizeof *proof->edge)};
    for (size_t i = 0; proof->edge && i < profile->count; i++) {
        view v;
        view_panel(&v, profile, i);
        double count = ceil((v.outer - v.inner) / (width / 2)), du = (v.outer - v.inner) / count;
        for (double k = 0; k < count && !vndf_guard_stopped(profile->guard); k++) {
            double from = v.inner + k * du, r = exp(from + du / 2), miss = missed(profile, &v, from, du, 1);
            miss *= profile->f0 > 0.0 ? 1.0 / profile->f0 + r / profile->f1 : 1.0;
            proof->hidden += miss;
            if (miss > least && proof->edge_count + 2 < SAMPLE_EDGES) {
                take_edge(proof, r * exp(-width));
                take_edge(proof, r * exp(width));
            }
        }
    }
    proof->proven = proof->hidden <= MISS || !(profile->f0 > 0.0);
    if (proof->hidden <= MISS)
        proof->edge_count = 0;
    proof->hidden = 1.0;
    return proof->edge != NULL;
}

int vndf_proof_from(vndf_proof *proof, vndf_profile *profile)
{
    *proof = (vndf_proof){0};
    profile->finest = profile->source->reach ? 0.0 : FINEST;
    if (profile->source->reach)
        return prove(proof, profile);
    return sample(proof, profile, profile->finest);
}
