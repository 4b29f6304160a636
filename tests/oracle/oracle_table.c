#include "oracle/oracle_table.h"

#include <stdint.h>

#include "harness/test.h"
#include "vndf_build.h"

/* ---- bytes ---- */

static uint64_t word_at(const unsigned char *at, int bytes)
{
    uint64_t word = 0;
    for (int i = 0; i < bytes; i++)
        word |= (uint64_t)at[i] << 8 * i;
    return word;
}

/* The numbers of cells, from byte `at` on. */
static int take_arrays(oracle_table *t, const unsigned char *at)
{
    double **array[] = {&t->knot, &t->g0, &t->g1, &t->m0,   &t->m1,   &t->m2,
                        &t->cube, &t->b0, &t->b1, &t->area, &t->slope};
    const size_t count = t->cells + 1;
    t->numbers = calloc(11 * count, sizeof *t->numbers);
    if (!t->numbers)
        return 0;
    for (size_t i = 0; i < 11; i++) {
        *array[i] = t->numbers + i * count;
        for (size_t j = 0; j < count && (i != 6 || t->moments == 4); j++, at += 4) {
            const uint32_t word = (uint32_t)word_at(at, 4);
            float value;
            memcpy(&value, &word, sizeof value);
            (*array[i])[j] = (double)value;
        }
    }
    return 1;
}

/* Magic, format, size, the numbers of the head, three texts, those of the cells; then a checksum, which is not read. */
static int read_table(oracle_table *t, const unsigned char *bytes, size_t size)
{
    size_t at = 100;
    if (size < 112 || memcmp(bytes, "VNDFtab\n", 8) != 0 || word_at(bytes + 8, 4) != 5 ||
        word_at(bytes + 12, 4) != size)
        return 0;
    const uint64_t scale = word_at(bytes + 24, 8);
    memcpy(&t->scale, &scale, sizeof scale);
    t->cells = (size_t)word_at(bytes + 32, 4);
    t->moments = (size_t)word_at(bytes + 36, 4);
    t->squarings = (size_t)word_at(bytes + 40, 4);
    for (int i = 0; i < 3 && at + 4 <= size; i++)
        at += 4 + (size_t)word_at(bytes + at, 4);
    return t->cells >= 2 && t->cells < 4096 && t->moments >= 2 && t->moments <= 4 && t->squarings <= 5 &&
           at + 4 * (t->cells + 1) * (t->moments == 4 ? 11 : 10) + 4 == size && take_arrays(t, bytes + at);
}

int oracle_table_of(oracle_table *t, const vndf_distribution *distribution)
{
    size_t size = vndf_distribution_info(distribution).bytes;
    unsigned char *bytes = malloc(size + 1);
    memset(t, 0, sizeof *t);
    int good = bytes && vndf_save_memory(distribution, bytes, size, NULL) == VNDF_OK && read_table(t, bytes, size);
    if (!good)
        fprintf(stderr, "oracle: this is no table of format 5\n");
    free(bytes);
    return good;
}

void oracle_table_free(oracle_table *t)
{
    free(t->numbers);
    t->numbers = NULL;
}

/* ---- cells ---- */

/* The rational density of mass m, with densities d0 and d1 at the ends, at xi = 1 - eta. */
static double rational(double m, double d0, double d1, double xi, double eta)
{
    double q = xi * eta, under = m + (d0 + d1 - 2 * m) * q;
    return m > 0 ? m / under * (m / under) * (d1 * xi * xi + 2 * m * q + d0 * eta * eta) : 0;
}

static size_t cell_of(const oracle_table *t, double r)
{
    size_t i = t->cells;
    while (i > 0 && r < t->knot[i])
        i--;
    return i;
}

/* xi and 1 - xi in a cell, and dR/dxi. */
typedef struct place {
    double xi, eta, width;
} place;

static place place_in(const oracle_table *t, size_t i, double r)
{
    double from = t->knot[i], z = 1 / (1 + r);
    place p;
    if (i == t->cells) {
        double power = pow(2, (double)t->squarings);
        p.eta = pow(z * (1 + from), 1 / power);
        p.xi = -expm1(log(z * (1 + from)) / power);
        p.width = power / (z * p.eta);
    } else {
        double to = t->knot[i + 1];
        p.xi = (r - from) / (to - from) * (1 + to) * z;
        p.eta = (to - r) / (to - from) * (1 + from) * z;
        p.width = (to - from) / ((1 + from) * (1 + to) * z * z);
    }
    return p;
}

/* z^2 W in cell i at slope x/z, W = w1 R^2 + w0 R + wq + w4 <R^-3>, the mean in f/R of the cell. */
static double weigh(const oracle_table *t, size_t i, const double w[4], double x, double z)
{
    return w[0] * x * x + w[1] * x * z + (w[2] + w[3] * t->cube[i]) * z * z;
}

static double end_of(const oracle_table *t, size_t i, const double w[4], int right)
{
    double r = t->knot[right ? i + 1 : i];
    if (right && i == t->cells)
        return t->g1[i] * w[0];
    return (right ? t->g1 : t->g0)[i] * weigh(t, i, w, r / (1 + r), 1 / (1 + r));
}

static double mass_of(const oracle_table *t, size_t i, const double w[4])
{
    double r = t->knot[i];
    return w[0] * t->m2[i] + (2 * w[0] * r + w[1]) * t->m1[i] +
           ((w[0] * r + w[1]) * r + w[2] + w[3] * t->cube[i]) * t->m0[i];
}

/* The law W f/R in cell i, at slope r, per slope. */
static double law_in(const oracle_table *t, size_t i, const double w[4], double r)
{
    place p = place_in(t, i, r);
    return rational(mass_of(t, i, w), end_of(t, i, w, 0), end_of(t, i, w, 1), p.xi, p.eta) / p.width;
}

/* f by its own law; in the last cell by that of R f, which is smooth for heavy tails too. */
double oracle_table_p22(const oracle_table *t, double r)
{
    const double f[4] = {0, 1, 0, 0}, rf[4] = {1, 0, 0, 0};
    r = fmax(r, 1e-12); /* 0/0 */
    size_t i = cell_of(t, r);
    return i == t->cells ? law_in(t, i, rf, r) / (2 * PI * r * r) : law_in(t, i, f, r) / (2 * PI * r);
}

/* ---- area ---- */

/* A/(c + s) at x = c/(c + s), above the horizon. */
static double spline(const oracle_table *t, double x)
{
    size_t i = t->cells;
    while (i > 0 && x < t->knot[i] / (1 + t->knot[i]))
        i--;
    double x0 = t->knot[i] / (1 + t->knot[i]), y0 = t->area[i], d0 = t->slope[i], x1 = 1, y1 = 1, d1 = 1;
    if (i < t->cells)
        x1 = t->knot[i + 1] / (1 + t->knot[i + 1]), y1 = t->area[i + 1], d1 = t->slope[i + 1];
    double h = x1 - x0, u = (x - x0) / h, v = 1 - u;
    return v * v * (1 + 2 * u) * y0 + u * u * (1 + 2 * v) * y1 + h * u * v * (v * d0 - u * d1);
}

double oracle_circle(double c, double s)
{
    if (s <= fabs(c))
        return c > 0 ? 2 * PI * c : 0;
    double e = c < 0 ? 2 * atan2(sqrt(s + c), sqrt(s - c)) : acos(-c / s); /* seen for |a| < e */
    if (e > 0.3)
        return 2 * (c * e + s * sin(e));
    double e2 = e * e, series = 1 - e2 / 10 * (1 - e2 / 28 * (1 - e2 / 54 * (1 - e2 / 88)));
    return 2 * s * e * e2 / 3 * series; /* s (sin e - e cos e) loses digits */
}

/* ---- the law ---- */

static double turn(const oracle_table *t, size_t j)
{
    double here = t->knot[j], before = j > 0 ? t->knot[j - 1] : 0;
    return j == 0 ? 0 : j == 1 ? 0.75 * here : fmin(here, fmax(1.18 * before, sqrt(before * here)));
}

/* Rho in the middle of its eighth of an octave, from 2^-13 to 2^15. */
static double rounded(double rho)
{
    double within = fmin(fmax(rho, 0x1p-13), 0x1.ep14), octave = floor(log2(within));
    return exp2(octave) * (1 + (floor(8 * (within / exp2(octave) - 1)) + 0.5) / 8);
}

static void look_above(oracle_law *l)
{
    static const double powers[3][4] = {{.934604, 2.206989, 0, 0},
                                        {1.00473604, 1.48847826, .64837836, 0},
                                        {.99928177, 1.58441365, .47441838, .08347885}};
    const oracle_table *t = l->t;
    const double *a = powers[t->moments - 2];
    while (l->first < t->cells && turn(t, l->first + 1) <= rounded(l->rho))
        l->first++;
    l->w[0] = l->s * a[0] / PI;
    l->w[1] = l->c * a[1] / PI;
    l->w[2] = l->s > 0 ? l->c * l->rho * a[2] / PI : 0;
    l->w[3] = l->s > 0 && l->rho >= 1e-3 ? l->c * pow(l->rho, 4) * a[3] / PI : 0;
}

/* W = (R - rho)(b0 R + b1 (R - rho)). */
static void weights_below(double b0, double b1, double rho, double w[4])
{
    w[0] = b0 + b1, w[1] = -(b0 + 2 * b1) * rho, w[2] = b1 * rho * rho, w[3] = 0;
}

/* r W_r (G1/3 + G_rho/6), W_r and G of the right end, r the part of the cell. */
static double rough_part(const oracle_table *t, size_t i, const double w[4], double xi)
{
    double ends = t->g1[i] / 3 + (t->g0[i] + xi * (t->g1[i] - t->g0[i])) / 6;
    return (1 - xi) * end_of(t, i, w, 1) / t->g1[i] * ends;
}

static void look_below(oracle_law *l)
{
    const oracle_table *t = l->t;
    size_t i = l->first = cell_of(t, l->rho), next = i < t->cells ? i + 1 : i;
    double b0, b1, at_knot[4]; /* there the mass is exact */
    l->part = place_in(t, i, l->rho).xi;
    b0 = t->b0[i] + l->part * (t->b0[next] - t->b0[i]);
    b1 = t->b1[i] + l->part * (t->b1[next] - t->b1[i]);
    weights_below(b0, b1, l->rho, l->w);
    weights_below(b0, b1, t->knot[i], at_knot);
    l->part_mass = rough_part(t, i, l->w, l->part) * mass_of(t, i, at_knot) / rough_part(t, i, at_knot, 0);
}

/* The polynomial of cell i. */
static void weights_in(const oracle_law *l, size_t i, double w[4])
{
    int flat = l->c >= 0 && (i < l->first || i == 0 || l->first == l->t->cells || l->rho >= 0x1.ep14);
    memcpy(w, l->w, sizeof l->w);
    if (flat)
        w[0] = i < l->first ? 0 : w[0], w[1] = l->c, w[2] = w[3] = 0;
}

oracle_law oracle_law_from(const oracle_table *t, double s, double c)
{
    oracle_law l = {.t = t, .s = s, .c = c, .rho = s > 0 ? fabs(c) / s : HUGE_VAL};
    double w[4], sum = 0, up = s + fabs(c), above = up * spline(t, fabs(c) / up);
    if (!(c >= 0) && !(s > 0))
        return l;
    (c >= 0 ? look_above : look_below)(&l);
    for (size_t i = c >= 0 ? 0 : l.first + 1; i <= t->cells; i++) {
        weights_in(&l, i, w);
        sum += mass_of(t, i, w);
    }
    l.drawn = c >= 0 ? sum : s / PI * (l.part_mass + sum);
    double part = fmin(fmax((l.drawn / above - 4e-4) / 1.6e-3, 0), 1);
    l.area = c >= 0 ? above : l.drawn + part * (above + c - l.drawn);
    return l;
}

/* The density of R in the drawn law, per slope length. */
static double radius_density(const oracle_law *l, double r)
{
    size_t i = cell_of(l->t, r);
    double w[4], part = 1 - l->part;
    weights_in(l, i, w);
    if (l->c >= 0)
        return law_in(l->t, i, w, r) / l->drawn;
    if (r <= l->rho)
        return 0;
    if (i > l->first)
        return l->s / PI * law_in(l->t, i, w, r) / l->drawn;
    place p = place_in(l->t, i, r);
    double end = fmin(part * end_of(l->t, i, w, 1), 1e4 * l->part_mass), eta = p.eta / part;
    return l->s / PI * rational(l->part_mass, 0, end, (p.xi - l->part) / part, eta) / (p.width * part) / l->drawn;
}

double oracle_law_density(const oracle_law *l, double r, double azimuth)
{
    double facing = l->c + l->s * r * cos(azimuth);
    r = fmax(r, 1e-12); /* 0/0 */
    return facing > 0 ? radius_density(l, r) / r * facing / oracle_circle(l->c, l->s * r) : 0;
}
