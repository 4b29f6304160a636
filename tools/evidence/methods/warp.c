/* A bilinear warp of the unit square per incident direction, as renderers use for measured materials: J. Dupuy,
 * W. Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering", TOG 37(6), 2018.
 * For each of SLICES directions a table holds the density of visible normals over (p, q), with theta_m = p^2
 * pi/2 and the azimuth (2 q - 1) pi from wi: SIDE x SIDE nodes on the square, and a bilinear interpolant between
 * them. The marginal of p and the conditional of q at any p are then piecewise linear; a binary search of the
 * CDF and a quadratic draw from each. Between two directions the densities mix linearly, and so do all CDFs.
 *
 * The method draws with the density of the interpolant, and tells it. Its error to true visible normals comes
 * from the steps of direction, and from the horizon, where normals may face away; where the interpolant is 0 and
 * the reference is not, no weight can help.
 *
 * Departures: there are nodes on the horizon. Renderers have a table per material, and neither roughness nor
 * stretch; here the table is of the unit problem at median slope 1, and roughness stretches. Its directions are
 * even, from 0 to 90 degrees. */
#include <stdlib.h>

#include "evidence/methods/vector.h"

enum { SLICES = 8, SIDE = 128 };

/* Of each slice: the density of (p, q) at the nodes, its integral over q up to a node, and the integral of the whole
 * rows over p. */
typedef struct warp {
    float scale;
    float density[SLICES][SIDE * SIDE], conditional[SLICES][SIDE * SIDE], marginal[SLICES][SIDE];
} warp;

/* ---- preparing --------------------------------------------------------------------------------- */

static double density_at(const vndf_view *view, double p, double q)
{
    const double pi = acos(-1.0), theta = p * p * pi / 2, phi = (2 * q - 1) * pi;
    vndf_vec3 wm = {(float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)), (float)fmax(cos(theta), 0)};
    return (double)vndf_visible(view, wm) * 2 * pi * pi * p * sin(theta);
}

/* Integrals of a row's interpolant, with nodes 1/(SIDE - 1) apart. */
static void accumulate(const float value[SIDE], float sum[SIDE])
{
    double total = 0, step = 1.0 / (SIDE - 1);
    sum[0] = 0;
    for (size_t i = 1; i < SIDE; i++) {
        total += 0.5 * step * ((double)value[i - 1] + (double)value[i]);
        sum[i] = (float)total;
    }
}

/* On the horizon a density may be infinite though integrable, so it is at most twice the density half a cell
 * inside. */
static void fill_slice(warp *w, const method_reference *reference, size_t slice)
{
    const double theta = acos(-1.0) / 2 * (double)slice / (SLICES - 1), cell = 1.0 / (SIDE - 1);
    float *density = w->density[slice], *conditional = w->conditional[slice], *marginal = w->marginal[slice];
    float rows[SIDE];
    const vndf_vec3 wi = {(float)sin(theta), 0, slice == SLICES - 1 ? 0 : (float)cos(theta)};
    const vndf_view view = vndf_view_from(&reference->canonical, wi);
    for (size_t i = 0; i < SIDE; i++) {
        for (size_t j = 0; j < SIDE; j++) {
            double at = density_at(&view, (double)i * cell, (double)j * cell), most = INFINITY;
            if (i == SIDE - 1)
                most = 2 * density_at(&view, 1 - 0.5 * cell, (double)j * cell);
            density[i * SIDE + j] = (float)fmin(at, most);
        }
        accumulate(density + i * SIDE, conditional + i * SIDE);
        rows[i] = conditional[i * SIDE + SIDE - 1];
    }
    accumulate(rows, marginal);
    const float per_total = 1.0f / marginal[SIDE - 1];
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        density[i] *= per_total;
        conditional[i] *= per_total;
    }
    for (size_t i = 0; i < SIDE; i++)
        marginal[i] *= per_total;
}

/* ---- drawing ----------------------------------------------------------------------------------- */

/* Up to four rows of numbers that are mixed. */
typedef struct mix {
    const float *row[4];
    float weight[4];
    int count;
} mix;

static inline float mixed(const mix *x, size_t i)
{
    float sum = x->weight[0] * x->row[0][i];
    for (int k = 1; k < x->count; k++)
        sum += x->weight[k] * x->row[k][i];
    return sum;
}

/* The cell of an ascending row where `value` falls: 0 to SIDE - 2. */
static inline size_t cell_of(const mix *x, float value)
{
    size_t low = 0, high = SIDE - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (mixed(x, middle) <= value)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The part of a cell of length 1 below which `rest` of the integral lies, for a density linear from a to b. */
static inline float part_of(float a, float b, float rest)
{
    float root = sqrtf(fmaxf(0.0f, a * a + 2.0f * rest * (b - a)));
    return a + root > 0 ? fminf(2.0f * rest / (a + root), 1.0f) : 0.5f;
}

/* Of rows i and i + 1 of two slices. */
static inline mix four_rows(const float table[SLICES][SIDE * SIDE], size_t slice, float t, size_t i, float v)
{
    const float *low = table[slice] + i * SIDE, *high = table[slice + 1] + i * SIDE;
    return (mix){{low, low + SIDE, high, high + SIDE}, {(1 - t) * (1 - v), (1 - t) * v, t * (1 - v), t * v}, 4};
}

/* A place on the square and its density there. */
static inline float square(const warp *w, float theta, float u1, float u2, float *p, float *q)
{
    const float cells = SIDE - 1;
    float place = theta * (2 / method_pi) * (SLICES - 1);
    size_t slice = (size_t)fminf(place, SLICES - 2);
    float t = fminf(place - (float)slice, 1.0f);
    mix marginal = {{w->marginal[slice], w->marginal[slice + 1]}, {1.0f - t, t}, 2};
    size_t i = cell_of(&marginal, u1);
    mix lower = four_rows(w->conditional, slice, t, i, 0), upper = four_rows(w->conditional, slice, t, i, 1);
    float a = mixed(&lower, SIDE - 1), b = mixed(&upper, SIDE - 1);
    float v = part_of(a, b, (u1 - mixed(&marginal, i)) * cells);
    mix conditional = four_rows(w->conditional, slice, t, i, v);
    float wanted = u2 * (a + v * (b - a));
    size_t j = cell_of(&conditional, wanted);
    mix density = four_rows(w->density, slice, t, i, v);
    float c = mixed(&density, j), d = mixed(&density, j + 1);
    float u = part_of(c, d, (wanted - mixed(&conditional, j)) * cells);
    *p = ((float)i + v) / cells;
    *q = ((float)j + u) / cells;
    return c + u * (d - c);
}

static inline vndf_vec3 draw(const method *m, const method_input *in, float *pdf)
{
    const warp *w = m->state;
    const vndf_vec3 wi = in->wi;
    float a = in->alpha * w->scale, p, q, across = sqrtf(wi.x * wi.x + wi.y * wi.y);
    float cos_phi = across > 0 ? wi.x / across : 1.0f, sin_phi = across > 0 ? wi.y / across : 0.0f;
    float density = square(w, atan2f(a * across, wi.z), in->u[0], in->u[1], &p, &q);
    p = fmaxf(p, 1e-4f);
    float theta = p * p * (method_pi / 2), phi = (2 * q - 1) * method_pi, s = sinf(theta), z = cosf(theta);
    float x = s * cosf(phi), y = s * sinf(phi);
    float length = sqrtf(a * a * s * s + z * z);
    *pdf = density / (2 * method_pi * method_pi * p * s) * length * length * length / (a * a);
    return method_unit(a * (cos_phi * x - sin_phi * y), a * (sin_phi * x + cos_phi * y), fmaxf(z, 0.0f));
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(draw, m, b, first, count);
}

method method_warp(const method_reference *reference)
{
    warp *w = malloc(sizeof *w);
    if (w)
        w->scale = reference->scale;
    for (size_t slice = 0; w && slice < SLICES; slice++)
        fill_slice(w, reference, slice);
    return (method){.name = "bilinear warps, 8 x 128^2",
                    .kind = ROW_PUBLISHED,
                    .memory = sizeof *w,
                    .state = w,
                    .release = free,
                    .each = w ? each : NULL,
                    .turned = 1};
}
