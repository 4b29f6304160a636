/* Visible slopes by two tables of inverse CDFs: the general way of the supplement of E. Heitz, E. d'Eon,
 * "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals", EGSR 2014, which a
 * renderer shipped for Beckmann from 2014 to 2023. In the unit problem
 *
 *     slope along wi    from a table over (theta, u1),    law max(0, cos(theta) - x sin(theta)) P2(x)
 *     slope across      from a table over (x, u2),        law P22(x, y) given x
 *
 * Both are bilinear and SIDE x SIDE; x and y are cut off at CUT median slopes on either side, and x has even
 * steps. The method tells the density of the true visible normals, from fine 1D tables of P22 and of the
 * projected area: it is not the density with which these tables draw. They are biased, and `vndf bench` shows
 * how much.
 *
 * Departures: the laws are integrated finer than the tables, so that only interpolation and cut-off err; only
 * directions above the horizon. */
#include <stdlib.h>

#include "evidence/methods/vector.h"

enum { SIDE = 256, FINE = 1024, CUT = 16 };

typedef struct inverse_tables {
    float scale;
    float p22[FINE + 1];                         /* P22 (1 + r)^4 over q = r/(1 + r) */
    float area[FINE + 1];                        /* over cos(theta) */
    float along[SIDE][SIDE], across[SIDE][SIDE]; /* rows theta and x, columns u */
} inverse_tables;

/* ---- preparing --------------------------------------------------------------------------------- */

static double p22_at(const method_reference *reference, double x, double y)
{
    return (double)vndf_p22(&reference->canonical, (float)x, (float)y);
}

/* The middle of one of FINE even cells of [-CUT, CUT]. */
static double slope_of(size_t cell)
{
    return CUT * (2 * ((double)cell + 0.5) / FINE - 1);
}

/* Quantiles of the law with masses mass[i] in FINE cells; a law without mass becomes uniform. */
static void fill_quantiles(float row[SIDE], const double mass[FINE])
{
    double total = 0, below = 0;
    size_t cell = 0;
    for (size_t i = 0; i < FINE; i++)
        total += mass[i];
    for (size_t j = 0; j < SIDE; j++) {
        double even = (double)j / (SIDE - 1), u = even * total;
        while (cell < FINE - 1 && (below + mass[cell] < u || !(mass[cell] > 0)))
            below += mass[cell++];
        double part = mass[cell] > 0 ? fmin(fmax((u - below) / mass[cell], 0), 1) : even;
        row[j] = (float)(CUT * (2 * ((double)cell + part) / FINE - 1));
    }
}

static void fill(inverse_tables *t, const method_reference *reference)
{
    double mass[FINE], marginal[FINE] = {0}; /* marginal: P2 at the middles of the cells */
    for (size_t i = 0; i < SIDE; i++) {
        for (size_t k = 0; k < FINE; k++)
            mass[k] = p22_at(reference, CUT * (2 * (double)i / (SIDE - 1) - 1), slope_of(k));
        fill_quantiles(t->across[i], mass);
    }
    for (size_t i = 0; i < FINE; i++)
        for (size_t k = 0; k < FINE / 2; k++)
            marginal[i] += p22_at(reference, slope_of(i), slope_of(k));
    for (size_t i = 0; i < SIDE; i++) {
        double theta = acos(-1.0) / 2 * (double)i / (SIDE - 1);
        for (size_t k = 0; k < FINE; k++)
            mass[k] = fmax(0, cos(theta) - sin(theta) * slope_of(k)) * marginal[k];
        fill_quantiles(t->along[i], mass);
    }
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
static inline float bilinear(const float *table, float row, float column)
{
    const float last = SIDE - 1;
    float y = row * last, x = column * last;
    size_t i = (size_t)fminf(y, last - 1), j = (size_t)fminf(x, last - 1);
    const float *low = table + i * SIDE + j, *high = low + SIDE;
    float v = y - (float)i, u = x - (float)j;
    return (1 - v) * ((1 - u) * low[0] + u * low[1]) + v * ((1 - u) * high[0] + u * high[1]);
}

static inline vndf_vec3 draw(const method *m, const method_input *in, float *pdf)
{
    const inverse_tables *t = m->state;
    float a = in->alpha * t->scale;
    method_turn turn = method_turn_from(in->wi, a);
    float c = fminf(turn.c, 1.0f);
    float x = bilinear(t->along[0], acosf(c) * (2 / method_pi), in->u[0]);
    float y = bilinear(t->across[0], x * (0.5f / CUT) + 0.5f, in->u[1]);
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

method method_inverse_tables(const method_reference *reference)
{
    inverse_tables *t = reference ? malloc(sizeof *t) : NULL;
    if (t) {
        t->scale = reference->scale;
        fill(t, reference);
    }
    return (method){.name = "inverse CDFs (2014), 2 x 256^2",
                    .instructions = "scalar",
                    .kind = ROW_PUBLISHED,
                    .memory = sizeof *t,
                    .state = t,
                    .release = free,
                    .one = draw,
                    .each = t ? each : NULL,
                    .biased = 1,
                    .turned = 1};
}
