#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double INSIDE = 1.5e-7; /* of a slope: a float beyond an edge, where P22 may jump beside it */

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

static double edge_of(const maker *m)
{
    return m->to->at[m->to->count].edge;
}

/* The float at a slope or next to it, towards another; where no knot can be, the slope itself. */
static double float_at(double slope, float towards)
{
    float f = (float)slope;
    if (!(slope > 1e-30 && slope < 1e30) || (double)f == slope || ((double)f > slope) == (towards > f))
        return slope > 1e-30 && slope < 1e30 ? (double)f : slope;
    return (double)nextafterf(f, towards);
}

/* Ends a strip with two points of these masses. */
static void push(maker *m, double to, const double r[2], const double mass[2])
{
    vndf_strips *s = m->to;
    if (s->count + 2 >= m->capacity) {
        size_t capacity = 2 * m->capacity + 1024;
        vndf_strip *at = realloc(s->at, capacity * sizeof *at);
        m->starved |= !at;
        if (!at)
            return;
        s->at = at;
        m->capacity = capacity;
    }
    double from = edge_of(m), width = to - from, p[2] = {0, 0};
    if (to < HUGE_VAL) {
        const double end[2] = {from > 0 ? from + fmin(INSIDE * from, width / 3) : 1e-6 * to,
                               to - fmin(INSIDE * to, width / 3)};
        vndf_profile_p22_many(m->profile, end, 2, p);
    }
    vndf_strip *strip = &s->at[s->count];
    *strip = (vndf_strip){.edge = from, .p0 = p[0], .p1 = p[1]};
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

/* Two points of Gauss's rule between two slopes, even in x = R/(1 + R) as cells are. */
static void two_points(const vndf_profile *profile, double from, double to, double r[2], double mass[2])
{
    double width = to - from, p[2], dr[2];
    for (int i = 0; i < 2; i++) {
        double q = i ? 0.78867513459481288 : 0.21132486540518712, under = 1 + to - q * width;
        r[i] = from + q * width * (1 + from) / under;
        dr[i] = PI * width * (1 + from) * (1 + to) / (under * under);
    }
    vndf_profile_p22_many(profile, r, 2, p);
    for (int i = 0; i < 2; i++)
        mass[i] = p[i] * r[i] * dr[i];
}

static void add_strip(maker *m, double to)
{
    double r[2], mass[2], end = float_at(to, 0);
    if (!(end > edge_of(m)))
        return;
    two_points(m->profile, edge_of(m), end, r, mass);
    push(m, end, r, mass);
}

/* Gathers what lies between two slopes; takes it away where the second is the smaller. */
static void gather(maker *m, double from, double to)
{
    double r[2], mass[2];
    two_points(m->profile, from, to, r, mass);
    m->mass += mass[0] + mass[1];
    m->along += mass[0] * r[0] + mass[1] * r[1];
}

/* Ends what is gathered at a slope, as one point; at the float before it where that is next to nothing, else behind and
 * so far that knots can stand at both ends. */
static void end_gathered(maker *m, double slope)
{
    double from = edge_of(m), behind = fmin(fmax(slope, from * (1 + VNDF_GRAIN / 2)), m->knot);
    double to = m->little ? float_at(slope, 0) : float_at(behind, HUGE_VALF);
    if (m->pieces > 0 && to > from) {
        gather(m, slope, to);
        double mean = m->mass > 0 ? fmin(fmax(m->along / m->mass, from), to) : from + (to - from) / 2;
        const double r[2] = {mean, mean}, mass[2] = {m->mass, 0};
        push(m, to, r, mass);
    }
    m->mass = m->along = 0;
    m->pieces = 0;
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

/* How many strips a panel needs beside others: its width and how much P22 changes in it, for equal errors of strips
 * by the root of third order of what it holds, of all or of what is seen from below; 0 if it is gathered, -1 if it is
 * a gap before something that is seen from there. */
static double need_of(const vndf_profile *profile, size_t i)
{
    const double few = 1e-10, few_grazing = 1e-14, below = 2.5e-3, floor = 1e-4, near = 1e-4;
    const vndf_panel *p = &profile->panel[i];
    const vndf_profile_point *point = p->point;
    double value[VNDF_GAUSS], most = 0, change = 2 * log(p[1].r / p->r);
    double f = p->m0 / profile->f0, along = p[1].r * p->m0, beyond = p->s + p->r * p->t0;
    if (f < few && along < few_grazing * profile->f1)
        return p->r > near && p[1].s > few_grazing * profile->f1 ? -1 : 0;
    for (int k = 0; k < VNDF_GAUSS; k++)
        most = fmax(most, value[k] = point[k].weight / (vndf_gauss_weight[k] * point[k].r * point[k].r));
    for (int k = 1; k < VNDF_GAUSS && most > 0; k++)
        change += fabs(log((value[k] + floor * most) / (value[k - 1] + floor * most)));
    return change * cbrt(fmax(fmax(f, along / profile->f1), below * along / beyond));
}

/* Adds what lies in a panel from one slope to another, `parts` strips if it does not have to be gathered; in a gap they
 * are the narrower the nearer to what is seen from there. */
static void add_piece(maker *m, size_t i, double from, double to, double parts)
{
    const double closer = 1.5;
    const vndf_panel *p = &m->profile->panel[i];
    int whole = from == p->r && to == p[1].r, little = parts == 0;
    if (little || to - from < VNDF_GRAIN / 2 * to) {
        int full = to - edge_of(m) >= VNDF_GRAIN * to && float_at(from, HUGE_VALF) <= to; /* a float is in it */
        if (little != m->little || (!little && full))
            end_gathered(m, from);
        m->little = little;
        if (m->pieces++ == 0)
            gather(m, edge_of(m), from);
        if (whole) {
            m->mass += 2 * PI * p->m0;
            m->along += 2 * PI * (p->m1 + p->r * p->m0);
        } else
            gather(m, from, to);
        return;
    }
    end_gathered(m, from);
    double begin = edge_of(m), width = to - begin;
    size_t first = m->to->count;
    if (!(width > 0))
        return;
    for (double left = width / closer; parts < 0 && left > 2 * VNDF_GRAIN * to; left /= closer)
        add_strip(m, to - left);
    double count = ceil(fmin(parts, 2 * width / (VNDF_GRAIN * to))), step = log(to / begin) / count;
    for (double k = 1; k < count; k++)
        add_strip(m, begin * exp(k * step));
    add_strip(m, to);
    if (whole)
        scale(m->to, first, 2 * PI * p->m0 * (edge_of(m) - begin) / (to - from));
}

int vndf_strips_from(vndf_strips *strips, const vndf_profile *profile, const float *knot, size_t knots,
                     size_t cells)
{
    const double count = 6 * (double)cells + 360;
    maker m = {.to = strips, .profile = profile};
    double all = 0, *need = malloc((profile->count + 1) * sizeof *need);
    const vndf_panel *p = profile->panel;
    size_t next = 1;
    *strips = (vndf_strips){0, calloc(1, sizeof *strips->at)};
    for (size_t i = 0; need && i < profile->count; i++)
        all += fmax(need[i] = need_of(profile, i), 0);
    m.starved = !need || !strips->at;
    for (size_t i = 0; i < profile->count && !m.starved; i++) {
        double per = need[i] * count / (all * log(p[i + 1].r / p[i].r));
        for (double from = p[i].r, to; from < p[i + 1].r; from = to) {
            double end = p[i + 1].r, slope = m.knot = next < knots ? (double)knot[next] : HUGE_VAL;
            to = fmin(slope, end);
            if (to > from)
                add_piece(&m, i, from, to, per * log(to / from));
            if (slope <= end) {
                end_gathered(&m, slope);
                next++;
            }
        }
    }
    if (!m.starved) {
        double m0 = profile->tail_m0, end = p[profile->count].r; /* what lies beyond the panels, at one place */
        const double r[2] = {m0 > 0 ? end + profile->tail_m1 / m0 : 2 * end, 2 * end}, mass[2] = {2 * PI * m0, 0};
        end_gathered(&m, end);
        push(&m, HUGE_VAL, r, mass);
        scale(strips, 0, 1); /* two points are too few in panels that knots have cut where waves are many */
        for (vndf_strip *s = strips->at + strips->count; s-- > strips->at;) {
            s->beyond[0] = s[1].beyond[0] + s->along;
            s->beyond[1] = s[1].beyond[1] + s->f;
            s->beyond[2] = s[1].beyond[2] + s->m0;
        }
    }
    vndf_guard_spend(profile->guard, 2 * (double)strips->count);
    free(need);
    return !m.starved;
}

vndf_area vndf_strips_area(const vndf_strips *strips, size_t edge)
{
    const double far = 32; /* times rho: from there on two terms of the series in rho/R are enough */
    vndf_area sum = {0, 0, 0};
    double rho = strips->at[edge].edge;
    const vndf_strip *s = &strips->at[edge];
    for (; s < strips->at + strips->count && !(s->edge > far * rho); s++)
        for (int i = 0; i < 2; i++) {
            double r = s->r[i], mass = s->mass[i] / PI;
            double kernel = r > rho ? vndf_kernel_below(r, rho) : 0, root = sqrt(fmax((r - rho) * (r + rho), 0));
            sum.below += mass * kernel;
            sum.turned += mass * (rho > 0 ? (root - kernel) / rho : PI / 2);
            sum.along += mass * root;
        }
    sum.below += (s->beyond[0] - PI / 2 * rho * s->beyond[1] + rho * rho / 2 * s->beyond[2]) / PI;
    sum.turned += (PI / 2 * s->beyond[1] - rho * s->beyond[2]) / PI;
    sum.along += (s->beyond[0] - rho * rho / 2 * s->beyond[2]) / PI;
    sum.below /= 1 + rho;
    return sum;
}

void vndf_strips_free(vndf_strips *strips)
{
    free(strips->at);
    *strips = (vndf_strips){0, NULL};
}
