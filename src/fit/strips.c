#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>

#include "math/ascending.h"

static const double PI = 3.14159265358979323846;
static const double SAME = 1.3e-7; /* of a slope: a knot may be the end of a panel, rounded */
static const double CLOSER = 1.5;  /* times nearer to an end is the next strip there */
static const double INSIDE = 4e-7; /* of a slope: some floats beyond an edge, where P22 may jump beside it */

/* Strips while they are made. Panels that are narrower than the grain together, or hold next to nothing, are gathered
 * to one strip. */
typedef struct maker {
    vndf_strips *to;
    const vndf_profile *profile;
    size_t capacity;
    double mass, along; /* of what is gathered: integrals of f and R f, */
    int pieces, little; /* of how many panels; whether that is next to nothing */
    int starved;
    double knot; /* the next */
} maker;

static int grow(maker *m)
{
    vndf_strips *s = m->to;
    if (s->count + 2 < m->capacity)
        return 1;
    size_t capacity = 2 * m->capacity + 1024;
    vndf_strip *at = realloc(s->at, capacity * sizeof *at);
    s->at = at ? at : s->at;
    m->capacity = at ? capacity : m->capacity;
    m->starved |= !at;
    return at != NULL;
}

static double edge_of(const maker *m)
{
    return m->to->at[m->to->count].edge;
}

/* Ends a strip with two points; P22 beside both ends. */
static void push(maker *m, double to, const double r[2], const double mass[2], double p0, double p1)
{
    vndf_strips *s = m->to;
    double from = edge_of(m);
    if (!(to > from) || !grow(m))
        return;
    vndf_strip *strip = &s->at[s->count];
    *strip = (vndf_strip){.edge = from, .p0 = p0, .p1 = p1};
    for (size_t i = 0; i < 2; i++) {
        double t = r[i] - from, part = mass[i] / r[i];
        strip->r[i] = r[i];
        strip->mass[i] = mass[i];
        strip->m0 += part;
        strip->m1 += part * t;
        strip->m2 += part * t * t;
        strip->m4 += part / (r[i] * r[i] * r[i]);
        strip->f += mass[i];
        strip->along += mass[i] * r[i];
    }
    s->at[++s->count] = (vndf_strip){.edge = to};
}

/* Slopes beside both ends of a strip. */
static void put_ends(double from, double to, double r[2])
{
    double width = to - from;
    r[0] = from > 0 ? from + fmin(INSIDE * from, width / 3) : 1e-6 * to;
    r[1] = to - fmin(INSIDE * to, width / 3);
}

/* Ends what is gathered at a slope, as one point; P22 of its ends is that of slopes between them and the point, so that
 * both are on its side of a jump. */
static void end_gathered(maker *m, double to)
{
    double from = edge_of(m), p[2];
    if (m->pieces > 0 && to > from) {
        double at = m->mass > 0 ? fmin(fmax(m->along / m->mass, from), to) : from + (to - from) / 2;
        const double r[2] = {at, at}, mass[2] = {m->mass, 0}, end[2] = {at - (at - from) / 3, at + (to - at) / 3};
        vndf_profile_p22_many(m->profile, end, 2, p);
        push(m, to, r, mass, p[0], p[1]);
        m->to->at[m->to->count - 1].gathered = 1;
    }
    m->mass = m->along = 0;
    m->pieces = 0;
}

/* Gathers a panel, or what lies between two slopes. */
static void gather(maker *m, const vndf_panel *panel, double from, double to)
{
    const double gauss = 0.57735026918962576;
    double middle = from + (to - from) / 2, away = gauss * (to - from) / 2, r[2] = {middle - away, middle + away},
           p[2];
    m->pieces++;
    if (panel) {
        m->mass += 2 * PI * panel->m0;
        m->along += 2 * PI * (panel->m1 + panel->r * panel->m0);
        return;
    }
    vndf_profile_p22_many(m->profile, r, 2, p);
    for (int i = 0; i < 2; i++) {
        m->mass += PI * (to - from) * r[i] * p[i];
        m->along += PI * (to - from) * r[i] * r[i] * p[i];
    }
}

/* Ends what is gathered before a slope, at a knot that is the same as a float, or a little after it, so that floats
 * tell both ends apart; returns where. */
static double end_before(maker *m, double slope)
{
    double least = fmin(edge_of(m) * (1 + VNDF_GRAIN / 2), m->knot);
    least = fmax(slope, least) * (1 + SAME) > m->knot ? m->knot : least;
    if (!m->little && m->pieces > 0 && slope < least) {
        gather(m, NULL, slope, least);
        slope = least;
    }
    end_gathered(m, slope);
    return slope;
}

/* Two points of Gauss's rule, even in x = R/(1 + R) as cells are. */
static void add_strip(maker *m, double to)
{
    double from = edge_of(m), width = to - from, p[4], r[4], dr[2];
    for (int i = 0; i < 2; i++) {
        double q = i ? 0.78867513459481288 : 0.21132486540518712, under = 1 + to - q * width;
        r[i] = from + q * width * (1 + from) / under;
        dr[i] = PI * width * (1 + from) * (1 + to) / (under * under);
    }
    put_ends(from, to, r + 2);
    vndf_profile_p22_many(m->profile, r, 4, p);
    const double mass[2] = {p[0] * r[0] * dr[0], p[1] * r[1] * dr[1]};
    push(m, to, r, mass, p[2], p[3]);
}

/* Scales strips so that they hold what they should. */
static void scale(vndf_strips *s, size_t first, double mass)
{
    double sum = 0;
    for (size_t i = first; i < s->count; i++)
        sum += s->at[i].f;
    double factor = sum > 0 ? mass / sum : 1;
    for (size_t i = first; i < s->count; i++) {
        vndf_strip *t = &s->at[i];
        t->m0 *= factor, t->m1 *= factor, t->m2 *= factor, t->m4 *= factor;
        t->f *= factor, t->along *= factor;
        t->mass[0] *= factor;
        t->mass[1] *= factor;
    }
}

/* P22 at the points of a panel, in a unit of its own. Returns the largest. */
static double p22_of(const vndf_panel *p, double value[VNDF_GAUSS])
{
    double most = 0;
    for (int k = 0; k < VNDF_GAUSS; k++)
        most = fmax(most, value[k] = p->point[k].weight / (vndf_gauss_weight[k] * p->point[k].r * p->point[k].r));
    return most;
}

/* How many strips a panel has at least: more if P22 varies in it, since ten points may show more than one wave; few if
 * it is slim, as beside a jump. */
static double least_of(const vndf_profile *profile, const vndf_panel *p)
{
    const double worth = 1e-7, wave = 0.02, slim = 1e-3; /* of the mass; of P22; of the slope */
    double value[VNDF_GAUSS], most = p22_of(p, value), least = most;
    for (int k = 0; k < VNDF_GAUSS; k++)
        least = fmin(least, value[k]);
    if (!(p->m0 > worth * profile->f0))
        return 1;
    return most - least > wave * most ? 6 : p[1].r - p->r > slim * p->r ? 4 : 2;
}

/* How many strips a panel needs beside others: its width and how much P22 changes in it, for equal errors of strips
 * by the root of third order of what it holds, of all or of what is seen from below; 0 if it is gathered, -1 if it is
 * a gap before something that is seen from there. */
static double need_of(const vndf_profile *profile, size_t i)
{
    const double few = 1e-10, few_grazing = 1e-16, below = 2.5e-3, floor = 1e-4, near = 1e-4;
    const vndf_panel *p = &profile->panel[i];
    double value[VNDF_GAUSS], most = p22_of(p, value), change = 2 * log(p[1].r / p->r);
    double f = p->m0 / profile->f0, along = p[1].r * p->m0, beyond = p->s + p->r * p->t0;
    if (f < few && along < few_grazing * profile->f1)
        return p->r > near && p[1].s > few_grazing * profile->f1 ? -1 : 0;
    for (int k = 1; k < VNDF_GAUSS && most > 0; k++)
        change += fabs(log((value[k] + floor * most) / (value[k - 1] + floor * most)));
    return change * cbrt(fmax(fmax(f, along / profile->f1), below * along / beyond));
}

/* Ends a panel. Where a support ends with it, next to nothing of what is seen from below from its last strip lies
 * beyond: that strip is cut closer and closer to the end. */
static void end_panel(maker *m, const vndf_panel *p, double to)
{
    const double few = 1.0 / 16, enough = 1.0 / 4, worth = 1e-13, nearest = 1e-5;
    vndf_strips *s = m->to;
    double from = edge_of(m), left = to - from;
    add_strip(m, to);
    const vndf_strip *last = &s->at[s->count - 1];
    double beyond = p[1].s, f = p[1].t0 + last->f / (2 * PI), along = (last->along - from * last->f) / (2 * PI),
           seen = beyond + p[1].t0 * left + along;
    if (!(last->edge == from && beyond < few * seen && seen > worth * m->profile->f1))
        return;
    s->count--;
    while ((left /= CLOSER) > nearest * to && beyond < enough * seen) {
        add_strip(m, to - left);
        last = &s->at[s->count - 1];
        f -= last->f / (2 * PI);
        seen -= (last->along - last->edge * last->f) / (2 * PI) + f * (last[1].edge - last->edge);
    }
    add_strip(m, to);
}

/* Adds what lies in a panel from one slope to another, `parts` strips to `edge` if it does not have to be gathered; in
 * a gap they are the narrower the nearer to what is seen from there. */
static void add_piece(maker *m, size_t i, double from, double to, double edge, double parts)
{
    const vndf_panel *p = &m->profile->panel[i];
    int whole = from == p->r && to == p[1].r, slim = to - from < VNDF_GRAIN / 2 * to, little = parts == 0;
    if (slim || little) {
        if (little != m->little || (!little && to - edge_of(m) >= VNDF_GRAIN * to))
            whole &= end_before(m, from) == from;
        m->little = little;
        gather(m, whole ? p : NULL, fmin(fmax(from, edge_of(m)), to), to);
        return;
    }
    double begin = end_before(m, from), width = to - begin;
    size_t first = m->to->count;
    double count = ceil(fmin(fmax(parts, least_of(m->profile, p)), 2 * width / (VNDF_GRAIN * to))),
           step = log(to / begin) / count;
    for (double k = 1; k < count; k++)
        add_strip(m, begin * exp(k * step));
    for (double left = width / CLOSER; parts < 0 && left > 2 * VNDF_GRAIN * to; left /= CLOSER)
        add_strip(m, to - left);
    if (to == p[1].r)
        end_panel(m, p, edge);
    else
        add_strip(m, edge);
    if (whole && begin == from && edge == to)
        scale(m->to, first, 2 * PI * p->m0);
}

int vndf_strips_from(vndf_strips *strips, const vndf_profile *profile, const float *knot, size_t knots,
                     size_t cells)
{
    const double count = 3 * (double)cells + 280;
    maker m = {.to = strips, .profile = profile};
    double all = 0, *need = malloc((profile->count + 1) * sizeof *need);
    const vndf_panel *p = profile->panel;
    size_t next = 1;
    *strips = (vndf_strips){.first = malloc((knots + 1) * sizeof *strips->first)};
    if (!need || !strips->first || !grow(&m)) {
        free(need);
        return 0;
    }
    strips->at[0] = (vndf_strip){.edge = 0};
    for (size_t i = 0; i < profile->count; i++)
        all += fmax(need[i] = need_of(profile, i), 0);
    for (size_t i = 0; i < profile->count && !m.starved; i++) {
        double per = need[i] * count / (all * log(p[i + 1].r / p[i].r));
        for (double from = p[i].r, to; from < p[i + 1].r; from = to) {
            double end = p[i + 1].r, slope = m.knot = next < knots ? (double)knot[next] : HUGE_VAL;
            to = fmin(slope, end);
            if (to > from)
                add_piece(&m, i, from, to, slope < end * (1 + SAME) ? slope : to, per * log(to / from));
            if (slope <= end) {
                end_gathered(&m, slope);
                next++;
            }
        }
    }
    end_gathered(&m, p[profile->count].r);
    double m0 = profile->tail_m0, end = p[profile->count].r; /* what lies beyond the panels, at one place */
    const double r[2] = {m0 > 0 ? end + profile->tail_m1 / m0 : 2 * end, 2 * end}, mass[2] = {2 * PI * m0, 0};
    push(&m, HUGE_VAL, r, mass, 0, 0);
    scale(strips, 0, 1); /* two points are too few in panels that knots have cut where waves are many */
    for (size_t i = 0; i < knots; i++)
        strips->first[i] = vndf_last_before(&strips->at->edge, sizeof *strips->at, strips->count, knot[i]);
    strips->first[knots] = strips->count;
    vndf_guard_spend(profile->guard, 2 * (double)strips->count);
    free(need);
    return !m.starved;
}

void vndf_strips_free(vndf_strips *strips)
{
    free(strips->at);
    free(strips->first);
    *strips = (vndf_strips){0, NULL, NULL};
}
