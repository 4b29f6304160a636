/* Visible slopes by two tables of inverse CDFs: the general way of the supplement of E. Heitz, E. d'Eon,
 * "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals", EGSR 2014, which a
 * renderer shipped for Beckmann from 2014 to 2023. In the unit problem
 *
 *     slope along wi    from a table over (theta, u1),    law max(0, cos(theta) - x sin(theta)) P2(x)
 *     slope across      from a table over (x, u2),        law P22(x, y) given x
 *
 * Both are bilinear and side x side; x and y are cut off at CUT median slopes on either side, and x has even
 * steps. The method tells the density of the true visible normals, from fine 1D tables of P22 and of the
 * projected area: it is not the density with which these tables draw. They are biased, and `vndf bench` shows
 * how much.
 *
 * Departures: the laws are integrated finer than the tables, so that only interpolation and cut-off err; only
 * directions above the horizon. */
#include <stdio.h>
#include <stdlib.h>

#include "evidence/methods/vector.h"

enum { FINE = 1024, CUT = 16 };

typedef struct inverse_tables {
    size_t side;
    float scale;
    float p22[FINE + 1];   /* P22 (1 + r)^4 over q = r/(1 + r) */
    float area[FINE + 1];  /* over cos(theta) */
    float *along, *across; /* rows theta and x, columns u */
} inverse_tables;

/* ---- preparing --------------------------------------------------------------------------------- */

static double p22_at(const method_reference *reference, double x, double y)
{
    return (double)vndf_p22(&reference->canonical, (float)x, (float)y);
}

static double slope_at(double part)
{
    return CUT * (2 * part - 1);
}

/* Quantiles of the law with masses mass[i] in FINE even cells of [-CUT, CUT]; a law without mass becomes
 * uniform. */
static void fill_quantiles(float *row, size_t side, const double *mass)
{
    double total = 0, below = 0;
    size_t cell = 0;
    for (size_t i = 0; i < FINE; i++)
        total += mass[i];
    for (size_t j = 0; j < side; j++) {
        double u = (double)j / (double)(side - 1) * total;
        while (cell < FINE - 1 && (below + mass[cell] < u || !(mass[cell] > 0)))
            below += mass[cell++];
        double part = mass[cell] > 0 ? (u - below) / mass[cell] : (double)j / (double)(side - 1);
        row[j] = (float)slope_at(((double)cell + fmin(fmax(part, 0), 1)) / FINE);
    }
}

static void fill_across(inverse_tables *t, const method_reference *reference, double *mass)
{
    for (size_t i = 0; i < t->side; i++) {
        double x = slope_at((double)i / (double)(t->side - 1));
        for (size_t k = 0; k < FINE; k++)
            mass[k] = p22_at(reference, x, slope_at(((double)k + 0.5) / FINE));
        fill_quantiles(t->across + i * t->side, t->side, mass);
    }
}

/* P2 at the middles of the cells. */
static void fill_marginal(const method_reference *reference, double *marginal)
{
    for (size_t i = 0; i < FINE; i++) {
        marginal[i] = 0;
        for (size_t k = 0; k < FINE / 2; k++)
            marginal[i] +=
                p22_at(reference, slope_at(((double)i + 0.5) / FINE), slope_at(((double)k + 0.5) / FINE));
    }
}

static void fill_along(inverse_tables *t, const double *marginal, double *mass)
{
    for (size_t i = 0; i < t->side; i++) {
        double theta = acos(-1.0) / 2 * (double)i / (double)(t->side - 1);
        for (size_t k = 0; k < FINE; k++)
            mass[k] = fmax(0, cos(theta) - sin(theta) * slope_at(((double)k + 0.5) / FINE)) * marginal[k];
        fill_quantiles(t->along + i * t->side, t->side, mass);
    }
}

static void fill_densities(inverse_tables *t, const method_reference *reference)
{
    for (size_t i = 0; i <= FINE; i++) {
        double c = (double)i / FINE, q = fmin(c, 1 - 0.5 / FINE);
        vndf_vec3 w = {(float)sqrt(1 - c * c), 0, (float)c};
        t->p22[i] = (float)(p22_at(reference, q / (1 - q), 0) / pow(1 - q, 4));
        t->area[i] = vndf_projected_area(&reference->canonical, w);
    }
}

/* ---- drawing ----------------------------------------------------------------------------------- */

static inline float between(const float *table, float place)
{
    int i = (int)(place *= FINE);
    i = i < FINE ? i : FINE - 1;
    return table[i] + (place - (float)i) * (table[i + 1] - table[i]);
}

/* row and column in [0, 1]. */
static inline float bilinear(const float *table, size_t side, float row, float column)
{
    float last = (float)(side - 1), y = row * last, x = column * last;
    size_t i = (size_t)fminf(y, last - 1), j = (size_t)fminf(x, last - 1);
    const float *low = table + i * side + j, *high = low + side;
    float v = y - (float)i, u = x - (float)j;
    return (1 - v) * ((1 - u) * low[0] + u * low[1]) + v * ((1 - u) * high[0] + u * high[1]);
}

static inline vndf_vec3 draw(const method *m, const method_input *in, float *pdf)
{
    const inverse_tables *t = m->state;
    float a = in->alpha * t->scale;
    method_turn turn = method_turn_from(in->wi, a);
    float c = fminf(turn.c, 1.0f);
    float x = bilinear(t->along, t->side, acosf(c) * (2 / method_pi), in->u[0]);
    float y = bilinear(t->across, t->side, x * (0.5f / CUT) + 0.5f, in->u[1]);
    vndf_vec3 wm = method_normal(&turn, a, x, y);
    float q = 1.0f / (1.0f + sqrtf(x * x + y * y)), q2 = q * q, z2 = wm.z * wm.z;
    float ndf = between(t->p22, 1.0f - q) * q2 * q2 / (a * a * z2 * z2);
    *pdf = fmaxf(0.0f, method_dot(in->wi, wm)) * ndf / (turn.length * between(t->area, c));
    return wm;
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(draw, m, b, first, count);
}

/* ---- the method -------------------------------------------------------------------------------- */

static void release(void *state)
{
    inverse_tables *t = state;
    free(t->along);
    free(t->across);
    free(t);
}

static inverse_tables *tables_of(size_t side, float scale)
{
    inverse_tables *t = calloc(1, sizeof *t);
    if (!t)
        return NULL;
    t->side = side;
    t->scale = scale;
    t->along = malloc(side * side * sizeof *t->along);
    t->across = malloc(side * side * sizeof *t->across);
    if (t->along && t->across)
        return t;
    release(t);
    return NULL;
}

method method_inverse_tables(const method_reference *reference, size_t side)
{
    method m = {.instructions = "scalar",
                .kind = ROW_PUBLISHED,
                .release = release,
                .one = draw,
                .biased = 1,
                .turned = 1};
    snprintf(m.name, sizeof m.name, "inverse CDFs (2014), 2 x %zu^2", side);
    if (!reference)
        return m;
    inverse_tables *t = tables_of(side, reference->scale);
    double *mass = malloc(2 * FINE * sizeof *mass);
    m.memory = 2 * side * side * sizeof(float) + sizeof t->p22 + sizeof t->area;
    if (t && mass) {
        fill_across(t, reference, mass);
        fill_marginal(reference, mass + FINE);
        fill_along(t, mass + FINE, mass);
        fill_densities(t, reference);
        m.state = t;
        m.each = each;
    } else if (t) {
        release(t);
    }
    free(mass);
    return m;
}
