/* Area, Lambda, G1 and D of a table. The mass of a wedge is a quintic spline in y = s/(s + |c|) below the
 * horizon: the piece with given values, slopes and second derivatives at both ends in Bernstein form, its
 * coefficients held in ascending order between the end values. Above the horizon A(w) = cos + A(-w). */
#include "oracle/oracle_table.h"

#include <math.h>

static double held(double value, double least, double most)
{
    return fmin(fmax(value, least), most);
}

/* De Casteljau's construction. */
static double bernstein(double b[6], double t)
{
    for (int n = 5; n > 0; n--)
        for (int i = 0; i < n; i++)
            b[i] = (1 - t) * b[i] + t * b[i + 1];
    return b[0];
}

double oracle_wedge_mass(const oracle_wedge *w, double y)
{
    size_t i = 0;
    while (i + 2 < w->knots && w->knot_y[i + 1] <= y)
        i++;
    double h = w->knot_y[i + 1] - w->knot_y[i], t = (y - w->knot_y[i]) / h;
    double first = w->area[i], last = w->area[i + 1];
    double a1 = first + h * w->slope[i] / 5, a2 = 2 * a1 - first + h * h * w->curve[i] / 20;
    double b1 = last - h * w->slope[i + 1] / 5, b2 = 2 * b1 - last + h * h * w->curve[i + 1] / 20;
    a1 = held(a1, first, last);
    a2 = held(a2, a1, last);
    b1 = held(b1, a2, last);
    b2 = held(b2, a2, b1);
    double b[6] = {first, a1, a2, b2, b1, last};
    return bernstein(b, held(t, 0, 1));
}

/* What the mirrored direction sees, and the length of wi. */
static double below_of(const oracle_table *t, const oracle_query *q, double *length)
{
    double x = q->alpha[0] * t->scale * q->wi[0], y = q->alpha[1] * t->scale * q->wi[1];
    double s = hypot(x, y), c = fabs(q->wi[2]);
    *length = hypot(hypot(q->wi[0], q->wi[1]), q->wi[2]);
    return 2 * (s + c) * oracle_wedge_mass(&t->below, s / (s + c));
}

double oracle_table_area(const oracle_table *t, const oracle_query *q)
{
    double length, below = below_of(t, q, &length);
    return (below + fmax(q->wi[2], 0)) / length;
}

double oracle_table_lambda(const oracle_table *t, const oracle_query *q)
{
    double length, lambda = below_of(t, q, &length) / fabs(q->wi[2]);
    return q->wi[2] < 0 ? -1 - lambda : lambda;
}

double oracle_table_g1(const oracle_table *t, const oracle_query *q)
{
    double length, below = below_of(t, q, &length);
    return q->wi[2] > 0 ? q->wi[2] / (below + q->wi[2]) : 0;
}

/* ---- places and D ---- */

/* Whether the slope x/z lies within two ulps (2^-22) of a knot. */
static int is_at_knot(const oracle_table *t, double x, double z, size_t knot)
{
    double difference = x * t->z[knot] - z * t->x[knot], size = x * t->z[knot] + z * t->x[knot];
    return fabs(difference) <= 0x1p-22 * 0.5 * size;
}

int oracle_table_place(const oracle_table *t, double x, double z, int aside, oracle_place *at)
{
    size_t low = 0, high = t->count; /* bisection: the knot `low` is not beyond, `high` is */
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (x * t->z[middle] >= z * t->x[middle])
            low = middle;
        else
            high = middle;
    }
    if (aside != 0) {
        if ((aside < 0 && low == 0) || (aside > 0 && low + 1 == t->count) ||
            !is_at_knot(t, x, z, aside < 0 ? low : low + 1))
            return 0;
        oracle_place end = {aside < 0 ? low - 1 : low + 1, aside < 0 ? 1 : 0, aside < 0 ? 0 : 1};
        *at = end;
        return 1;
    }
    double inner = x * t->z[low] - z * t->x[low], outer = z * t->x[low + 1] - x * t->z[low + 1];
    oracle_place place = {low, inner / (inner + outer), outer / (inner + outer)};
    *at = place;
    return 1;
}

double oracle_table_cubic(const oracle_table *t, size_t cell, double xi, double eta)
{
    double f0 = t->f0[cell], f1 = t->f1[cell];
    double e0 = t->mu0[cell] - f0 / 3 - f1 / 6, e1 = t->mu1[cell] - f0 / 6 - f1 / 3;
    double a = 36 * e0 - 24 * e1, b = 60 * (e1 - e0);
    return f0 * eta + f1 * xi + xi * eta * (a + b * xi);
}

/* P22 R dR = f Z dxi, dR = width/Z^2 dxi, so P22 = f Z^4/(X width), and D = P22/(ax ay wm.z^4), where
 * Z/wm.z = (X + Z)/(x + wm.z) holds up to the horizon. */
static double ndf_at(const oracle_table *t, oracle_place at, double sum, double per_area)
{
    size_t j = at.cell;
    double x = at.eta * t->x[j] + at.xi * t->x[j + 1], z = at.eta * t->z[j] + at.xi * t->z[j + 1];
    double width = t->x[j + 1] * t->z[j] - t->x[j] * t->z[j + 1], grow = (x + z) / sum;
    double f = oracle_table_cubic(t, j, at.xi, at.eta);
    if (j == 0) { /* f and X begin at 0 together */
        double least = fmax(at.xi, 1e-300);
        f = oracle_table_cubic(t, j, least, 1 - least);
        x = least * t->x[1];
    }
    return fmax(f, 0) / (x * width) * grow * grow * grow * grow * per_area;
}

size_t oracle_table_ndfs(const oracle_table *t, const oracle_query *q, double value[ORACLE_SIDES])
{
    double ax = q->alpha[0] * t->scale, ay = q->alpha[1] * t->scale;
    double length = hypot(hypot(q->wm[0], q->wm[1]), q->wm[2]), z = q->wm[2] / length;
    double x = hypot(q->wm[0] / ax, q->wm[1] / ay) / length;
    size_t n = 0;
    for (int aside = 0; aside < 3; aside++) {
        oracle_place at;
        if (oracle_table_place(t, x, z, aside < 2 ? aside : -1, &at))
            value[n++] = ndf_at(t, at, x + z, 1 / (ax * ay));
    }
    return n;
}
