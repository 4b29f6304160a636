/* A bilinear warp of the unit square per incident direction, as renderers use for measured materials: J. Dupuy,
 * W. Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering", TOG 37(6), 2018.
 * For each of SLICES directions a table holds the density of visible normals over (p, q), with theta_m = p^2
 * pi/2 and the azimuth (2 q - 1) pi from wi: side x side nodes on the square, and a bilinear interpolant between
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
#include <stdio.h>
#include <stdlib.h>

#include "evidence/methods/vector.h"

enum { SLICES = 8 };

/* Slice after slice: the density of (p, q) at the nodes, its integral over q up to a node, and the integral of the
 * whole rows over p. */
typedef struct warp {
    size_t side;
    float scale;
    float *density, *conditional; /* side*side */
    float *marginal;              /* side */
} warp;

/* ---- preparing --------------------------------------------------------------------------------- */

static double density_at(const vndf_view *view, double p, double q)
{
    const double pi = acos(-1.0);
    double theta = p * p * pi / 2, phi = (2 * q - 1) * pi;
    vndf_vec3 wm = {(float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)), (float)fmax(cos(theta), 0)};
    return (double)vndf_visible(view, wm) * 2 * pi * pi * p * sin(theta);
}

/* On the horizon a density may be infinite though integrable, so it is at most twice the density half a cell
 * inside. */
static double node_at(const vndf_view *view, double p, double q, double cell)
{
    double density = density_at(view, p, q);
    return p + 0.5 * cell < 1 ? density : fmin(density, 2 * density_at(view, p - 0.5 * cell, q));
}

/* Integrals of a row's interpolant, with nodes 1/(side - 1) apart. */
static void accumulate(const float *value, float *sum, size_t side)
{
    double total = 0, step = 1 / (double)(side - 1);
    sum[0] = 0;
    for (size_t i = 1; i < side; i++) {
        total += 0.5 * step * ((double)value[i - 1] + (double)value[i]);
        sum[i] = (float)total;
    }
}

static void scale_by(float *value, size_t count, float factor)
{
    for (size_t i = 0; i < count; i++)
        value[i] *= factor;
}

static int fill_slice(warp *w, const method_reference *reference, size_t slice)
{
    size_t n = w->side, last = n - 1;
    double theta = acos(-1.0) / 2 * (double)slice / (SLICES - 1), cell = 1 / (double)last;
    float *density = w->density + slice * n * n, *conditional = w->conditional + slice * n * n;
    float *marginal = w->marginal + slice * n, *rows = malloc(n * sizeof *rows);
    vndf_vec3 wi = {(float)sin(theta), 0, slice == SLICES - 1 ? 0 : (float)cos(theta)};
    vndf_view view = vndf_view_from(&reference->canonical, wi);
    if (!rows)
        return 0;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++)
            density[i * n + j] = (float)node_at(&view, (double)i * cell, (double)j * cell, cell);
        accumulate(density + i * n, conditional + i * n, n);
        rows[i] = conditional[i * n + last];
    }
    accumulate(rows, marginal, n);
    float per_total = 1.0f / marginal[last];
    scale_by(density, n * n, per_total);
    scale_by(conditional, n * n, per_total);
    scale_by(marginal, n, per_total);
    free(rows);
    return 1;
}

/* ---- drawing ----------------------------------------------------------------------------------- */

/* Up to four evidence_rows of numbers that are mixed. */
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

/* The cell of an ascending row where `value` falls: 0 to side - 2. */
static inline size_t cell_of(const mix *x, size_t side, float value)
{
    size_t low = 0, high = side - 1;
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

static inline mix rows_of(const float *table, size_t stride, size_t at, size_t slice, float t)
{
    return (mix){{table + slice * stride + at, table + (slice + 1) * stride + at}, {1.0f - t, t}, 2};
}

static inline mix four_rows(const float *table, size_t n, size_t slice, float t, size_t i, float v)
{
    const float *low = table + slice * n * n + i * n, *high = low + n * n;
    return (mix){{low, low + n, high, high + n}, {(1 - t) * (1 - v), (1 - t) * v, t * (1 - v), t * v}, 4};
}

/* A place on the square and its density there. */
static inline float square(const warp *w, float theta, float u1, float u2, float *p, float *q)
{
    size_t n = w->side;
    float cells = (float)(n - 1), place = theta * (2 / method_pi) * (SLICES - 1);
    size_t slice = (size_t)fminf(place, SLICES - 2);
    float t = fminf(place - (float)slice, 1.0f);
    mix marginal = rows_of(w->marginal, n, 0, slice, t);
    size_t i = cell_of(&marginal, n, u1);
    mix totals = rows_of(w->conditional, n * n, i * n + n - 1, slice, t);
    float a = mixed(&totals, 0), b = mixed(&totals, n);
    float v = part_of(a, b, (u1 - mixed(&marginal, i)) * cells);
    mix conditional = four_rows(w->conditional, n, slice, t, i, v);
    float wanted = u2 * (a + v * (b - a));
    size_t j = cell_of(&conditional, n, wanted);
    mix density = four_rows(w->density, n, slice, t, i, v);
    float c = mixed(&density, j), d = mixed(&density, j + 1);
    float u = part_of(c, d, (wanted - mixed(&conditional, j)) * cells);
    *p = ((float)i + v) / cells;
    *q = ((float)j + u) / cells;
    return c + u * (d - c);
}

static inline vndf_vec3 draw(const method *m, const method_input *in, float *pdf)
{
    const warp *w = m->state;
    float a = in->alpha * w->scale, p, q;
    method_turn turn = method_turn_from(in->wi, a);
    float density = square(w, acosf(fminf(turn.c, 1.0f)), in->u[0], in->u[1], &p, &q);
    p = fmaxf(p, 1e-4f);
    float theta = p * p * (method_pi / 2), phi = (2 * q - 1) * method_pi, s = sinf(theta), z = cosf(theta);
    float x = s * cosf(phi), y = s * sinf(phi);
    float length = sqrtf(a * a * s * s + z * z);
    *pdf = density / (2 * method_pi * method_pi * p * s) * length * length * length / (a * a);
    return method_unit(a * (turn.cos_phi * x - turn.sin_phi * y), a * (turn.sin_phi * x + turn.cos_phi * y),
                       fmaxf(z, 0.0f));
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(draw, m, b, first, count);
}

/* ---- the method -------------------------------------------------------------------------------- */

static void release(void *state)
{
    warp *w = state;
    free(w->density);
    free(w->conditional);
    free(w->marginal);
    free(w);
}

static warp *warp_of(const method_reference *reference, size_t side)
{
    warp *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->side = side;
    w->scale = reference->scale;
    w->density = malloc(SLICES * side * side * sizeof *w->density);
    w->conditional = malloc(SLICES * side * side * sizeof *w->conditional);
    w->marginal = malloc(SLICES * side * sizeof *w->marginal);
    int good = w->density && w->conditional && w->marginal;
    for (size_t slice = 0; good && slice < SLICES; slice++)
        good = fill_slice(w, reference, slice);
    if (good)
        return w;
    release(w);
    return NULL;
}

method method_warp(const method_reference *reference, size_t side)
{
    method m = {.instructions = "scalar", .kind = ROW_PUBLISHED, .release = release, .one = draw, .turned = 1};
    m.state = reference ? warp_of(reference, side) : NULL;
    m.memory = SLICES * (2 * side * side + side) * sizeof(float);
    m.each = m.state ? each : NULL;
    snprintf(m.name, sizeof m.name, "bilinear warps, %d x %zu^2", SLICES, side);
    return m;
}
