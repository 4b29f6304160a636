/* The density of a table's samples: azimuth a first, then the slope length R given a
 * (src/sampler/tabulated/theory.h derives both; here they are written out with every sum and no shortcut).
 *
 * Azimuth. Mass is even in a; half a turn consists of a front (c >= 0, cos a >= 0) of density c F0 + s F1 cos a,
 * and a wedge, whose row is a mix of three, (1-m)^2, 2 m (1-m), m^2.
 * Radius. Cells of f(xi) W(xi), W = c Z + k X, k = s cos a, divided by the mass of all that is visible. In the
 * cell of the cut, in all beyond it, in the two inside it and without a cut in the last two the variable is
 * zeta = xi (v0 + V)/(v0 + v1) of a linear V(xi) and the end densities are those of f W/V. V is W, but for the
 * knot towards the cut of the second cell inside it: there it is 16 h of the way to W of the other knot, h the
 * visible part of the cell of the cut, all of it from 1/16 on. */
#include "harness/constants.h"
#include "oracle/oracle_table.h"

#include <math.h>

/* The direction over s + |c|, and the normal over its length, as oracle_table.h has them. */
typedef struct seen {
    const oracle_table *t;
    double s, c, cosine, sine, x, z;
    double w;        /* (s, 0, c) . normal */
    double per_area; /* 1/(ax ay) */
} seen;

/* Which sides of jumps are taken: of the radial knot, and of the seam. */
typedef struct sides {
    int radial, seam;
} sides;

double oracle_rational(double e0, double e1, double mass, double xi, double eta)
{
    double k = (e0 + e1) / mass, q = 1 + (k - 2) * xi * eta;
    return (e1 * xi * xi + 2 * mass * xi * eta + e0 * eta * eta) / (q * q);
}

/* ---- azimuth ---- */

/* A cell of some row that holds q, and where. */
typedef struct within {
    double width, xi, eta;
} within;

/* q and `rest` = 1 - q, between two nodes. */
static within within_of(double from, double to, double q, double rest)
{
    double width = to - from, eta = to == 1 ? rest / width : (to - q) / width;
    within at = {width, (q - from) / width, eta};
    return at;
}

/* Per radian and mass of the wedge at the angle from its middle, cosine and sine >= 0. */
static double wedge_density(const oracle_wedge *w, double y, double cosine, double sine)
{
    size_t i = 0, j = 0;
    while (i + 2 < (w->rows + 1) / 2 && w->row_y[i + 1] <= y)
        i++;
    double m = (y - w->row_y[i]) / (w->row_y[i + 1] - w->row_y[i]),
           rest = (w->row_y[i + 1] - y) / (w->row_y[i + 1] - w->row_y[i]),
           share[3] = {rest * rest, 2 * rest * m, m * m};
    double p = 0, r = 0, e0 = 0, e1 = 0, mass = 0;
    for (size_t n = 0; n < 3; n++) {
        p += share[n] * w->aspect_p[2 * i + n];
        r += share[n] * w->aspect_r[2 * i + n];
    }
    double c = r * cosine, s = p * sine, length = hypot(c, s);
    if (!(length > 0))
        return 0;
    double q = s / (c + length), beyond = (c + c * (c / (length + s))) / (c + length);
    while (j + 1 < w->cells && w->q[j + 1] <= q)
        j++;
    for (size_t n = 0; n < 3; n++) {
        size_t end = (2 * i + n) * (w->cells + 1) + j;
        e0 += share[n] * w->density[end];
        e1 += share[n] * w->density[end + 1];
        mass += share[n] * w->mass[(2 * i + n) * w->cells + j];
    }
    within at = within_of(w->q[j], w->q[j + 1], q, beyond);
    double per_q = oracle_rational(e0 * at.width, e1 * at.width, mass, at.xi, at.eta) / at.width;
    double x = p * beyond * (1 + q), z = 2 * r * q; /* p (1 - q^2) */
    return per_q * (x * x + z * z) / (2 * p * r * (1 + q * q));
}

/* Per radian, of mass 1 over the whole turn. */
static double azimuth_density(const seen *v, int toward)
{
    double cosine = fabs(v->cosine);
    if (v->c < 0)
        return toward ? 0.5 * wedge_density(&v->t->below, v->s, cosine, v->sine) : 0;
    double front = v->c * v->t->total0 * PI / 2 + v->s * v->t->total1;
    double wedge = oracle_wedge_mass(&v->t->above, v->c);
    double here = toward      ? v->c * v->t->total0 + v->s * v->t->total1 * cosine
                  : wedge > 0 ? wedge * wedge_density(&v->t->above, v->c, cosine, v->sine)
                              : 0;
    return 0.5 * here / (front + wedge);
}

/* ---- radius ---- */

/* A cell's visible part: f, W and V at its ends, where it begins and how long it is. */
typedef struct piece {
    double f0, f1, mass, w0, w1, v0, v1, begin, length;
    int weighted;
} piece;

static double weight_at(const seen *v, size_t knot)
{
    return fmax(v->c * v->t->z[knot] + v->s * v->cosine * v->t->x[knot], 0);
}

/* integral of f (1 - t) over the visible part, t from its seen end to the cut: Gauss with three points is exact.
 * Not less than a thousandth of what the straight line gives. */
static double part_integral(const oracle_table *t, size_t j, int from_end, double part)
{
    double node = sqrt(0.6), sum = 0, line = 0;
    for (int i = -1; i <= 1; i++) {
        double at = 0.5 + 0.5 * i * node, weight = i ? 5.0 / 18 : 8.0 / 18, near = part * at, far = 1 - near;
        double xi = from_end ? far : near, eta = from_end ? near : far;
        sum += weight * (1 - at) * oracle_table_cubic(t, j, xi, eta);
        line += weight * (1 - at) * (t->f0[j] * eta + t->f1[j] * xi);
    }
    return fmax(sum, 1e-3 * line);
}

/* The cell that the cut W = 0 runs through; `count` if nothing is cut. */
static size_t find_cut(const seen *v)
{
    double k = v->s * v->cosine;
    oracle_place at = {v->t->count, 0, 0};
    if (v->c * k < 0)
        oracle_table_place(v->t, fabs(v->c), fabs(k), 0, &at);
    return at.cell;
}

/* The part of the cut's cell that is seen. */
static piece cut_piece(const seen *v, size_t j)
{
    const oracle_table *t = v->t;
    double k = v->s * v->cosine, w0 = v->c * t->z[j] + k * t->x[j], w1 = v->c * t->z[j + 1] + k * t->x[j + 1];
    if (v->c > 0) {
        double part = w1 < 0 ? fmax(w0, 0) / (fmax(w0, 0) - w1) : 1, w = fmax(w0, 0);
        double end = fmax(oracle_table_cubic(t, j, part, 1 - part), 0);
        piece p = {t->f0[j], end, w * part * part_integral(t, j, 0, part), w, 0, w, 0, 0, part, 1};
        return p;
    }
    double part = w0 < 0 ? fmax(w1, 0) / (fmax(w1, 0) - w0) : 1, w = fmax(w1, 0);
    double end = fmax(oracle_table_cubic(t, j, 1 - part, part), 0);
    piece p = {end, t->f1[j], w * part * part_integral(t, j, 1, part), 0, w, 0, w, 1 - part, part, 1};
    return p;
}

static piece piece_of(const seen *v, size_t j, size_t cut)
{
    const oracle_table *t = v->t;
    if (j == cut)
        return cut_piece(v, j);
    double w0 = weight_at(v, j), w1 = weight_at(v, j + 1);
    piece p = {t->f0[j], t->f1[j], w0 * t->mu0[j] + w1 * t->mu1[j], w0, w1, w0, w1, 0, 1, j + 2 >= cut};
    double way = cut < t->count && p.weighted ? fmin(16 * cut_piece(v, cut).length, 1) : 0;
    if (j + 2 == cut)
        p.v1 += way * (w0 - w1);
    return p;
}

static double visible_mass(const seen *v, size_t cut)
{
    size_t from = v->c < 0 ? cut : 0, to = v->c > 0 && v->cosine < 0 && cut < v->t->count ? cut + 1 : v->t->count;
    double sum = 0;
    for (size_t j = from; j < to; j++)
        sum += piece_of(v, j, cut).mass;
    return sum;
}

/* W/V at an end, where both may vanish. */
static double over(double w, double v)
{
    return v > 0 ? w / v : 1;
}

/* Mass per xi over X, w being W at the place: where f, and with it e0, begins at 0 as X does, both are over xi. */
static double per_xi_over_x(const seen *v, const piece *p, oracle_place at, double w)
{
    const oracle_table *t = v->t;
    size_t j = at.cell;
    double x = at.eta * t->x[j] + at.xi * t->x[j + 1], xi = at.xi / p->length, eta = at.eta / p->length;
    if (p->begin > 0)
        xi = fmax(1 - eta, 0);
    else if (p->length < 1)
        eta = fmax(1 - xi, 0);
    double zeta = xi, rest = eta, e0 = p->f0 * p->w0, e1 = p->f1 * p->w1, per = 1, ratio = 1; /* zeta/xi */
    if (p->weighted) {
        double half = (p->v0 + p->v1) / 2, here = p->v0 * eta + p->v1 * xi;
        ratio = (p->v0 + here) / (2 * half);
        zeta = xi * ratio;
        rest = eta * (here + p->v1) / (2 * half);
        e0 = p->f0 * over(p->w0, p->v0) * half;
        e1 = p->f1 * over(p->w1, p->v1) * half;
        per = (p->begin > 0 || p->length < 1 ? w : here) / half;
    }
    e0 *= p->length;
    e1 *= p->length;
    if (j > 0 || e0 > 0)
        return per / p->length * oracle_rational(e0, e1, p->mass, zeta, rest) / x;
    double q = 1 + (e1 / p->mass - 2) * zeta * rest, over_zeta = (e1 * zeta + 2 * p->mass * rest) / (q * q);
    return per / p->length * over_zeta * ratio / (p->length * t->x[1]);
}

/* ---- both ---- */

static int is_at_seam(const seen *v)
{
    return v->c >= 0 && fabs(v->cosine) <= 0x1p-22;
}

/* Returns 0 if there is no such side. */
static int density_on(const seen *v, sides side, double *value)
{
    const oracle_table *t = v->t;
    oracle_place at;
    size_t cut = find_cut(v);
    if ((side.seam && !is_at_seam(v)) || !oracle_table_place(t, v->x, v->z, side.radial, &at))
        return 0;
    *value = 0;
    double azimuth = azimuth_density(v, (v->cosine >= 0) != side.seam);
    if (!(azimuth > 0) || (v->c <= 0 && v->cosine <= 0))
        return 1;
    if (cut < t->count && (v->c > 0 ? at.cell > cut : at.cell < cut)) {
        /* W > 0: this is the cut, but for rounding */
        double part = cut_piece(v, cut).length;
        oracle_place end = {cut, v->c > 0 ? part : 1 - part, v->c > 0 ? 1 - part : part};
        at = end;
    }
    size_t j = at.cell;
    double grow = (at.eta * (t->x[j] + t->z[j]) + at.xi * (t->x[j + 1] + t->z[j + 1])) / (v->x + v->z);
    double width = t->x[j + 1] * t->z[j] - t->x[j] * t->z[j + 1], mass = visible_mass(v, cut);
    piece p = piece_of(v, j, cut);
    if (p.length > 0 && mass > 0)
        *value = azimuth * per_xi_over_x(v, &p, at, grow * v->w) / mass / width * grow * grow * grow * v->per_area;
    return 1;
}

/* a + b + c for numbers that cancel, in order of size: the first sum is then exact or the last is small beside
 * it. */
static double sum_of(double a, double b, double c)
{
    double n[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        int j = i % 2; /* three exchanges sort three */
        if (fabs(n[j]) < fabs(n[j + 1])) {
            double swap = n[j];
            n[j] = n[j + 1];
            n[j + 1] = swap;
        }
    }
    double first = n[0] + n[1], lost = n[1] - (first - n[0]);
    return (first + n[2]) + lost;
}

static seen seen_from(const oracle_table *t, const oracle_query *q)
{
    const double *i = q->wi, *m = q->wm;
    double ax = q->alpha[0] * t->scale, ay = q->alpha[1] * t->scale, length = hypot(hypot(m[0], m[1]), m[2]);
    double level = i[0] * m[0] + i[1] * m[1], s = hypot(ax * i[0], ay * i[1]), c = i[2];
    double x = hypot(m[0] / ax, m[1] / ay), sum = s + fabs(c), w = sum_of(i[0] * m[0], i[1] * m[1], c * m[2]);
    seen v = {t, s / sum, c / sum, 1, 0, x / length, m[2] / length, w / length / sum, 1 / (ax * ay)};
    if (s > 0 && x > 0) {
        v.cosine = level / (s * x);
        v.sine = fabs(ax * i[0] * (m[1] / ay) - ay * i[1] * (m[0] / ax)) / (s * x);
    } else if (x > 0) { /* straight up or down the azimuth is that of the normal */
        v.cosine = m[0] / ax / x;
        v.sine = fabs(m[1] / ay) / x;
    }
    return v;
}

size_t oracle_table_densities(const oracle_table *t, const oracle_query *q, double value[ORACLE_SIDES])
{
    seen v = seen_from(t, q);
    size_t n = 0;
    value[0] = 0;
    if (!(v.w > 0) || !(v.z >= 0))
        return 1;
    for (int i = 0; i < ORACLE_SIDES; i++) { /* 0 is the exact one */
        static const int aside[3] = {0, -1, 1};
        sides side = {aside[i % 3], i / 3};
        n += (size_t)density_on(&v, side, &value[n]);
    }
    return n > 0 ? n : 1;
}

void oracle_table_blur(const oracle_table *t, const oracle_query *q, int ndf, double range[2])
{
    range[0] = HUGE_VAL;
    range[1] = 0;
    for (int i = 0; i < 4; i++) {
        double value[ORACLE_SIDES] = {0}, step = i % 2 ? 1 + 0x1p-50 : 1 - 0x1p-50;
        oracle_query moved = *q;
        seen v = seen_from(t, q);
        sides exact = {0, 0};
        v.x *= i < 2 ? step : 1;
        v.c *= i < 2 ? 1 : step;
        moved.wm[2] /= step;
        if (ndf)
            oracle_table_ndfs(t, &moved, value);
        else
            density_on(&v, exact, &value[0]);
        range[0] = fmin(range[0], value[0]);
        range[1] = fmax(range[1], value[0]);
    }
}
