/* A bilinear warp of the unit square for each incident direction, for any D, as renderers use for measured materials:
 * J. Dupuy, W. Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering", TOG 37(6), 2018.
 *
 * For each of SLICES directions a table holds the density of visible normals over (p, q), with theta_m = p^2 pi/2 and
 * the azimuth (2 q - 1) pi from wi: SIDE x SIDE nodes, bilinear between them. The marginal of p and the conditional of
 * q are then piecewise linear: a binary search of a CDF and a quadratic draw from each. Between two directions
 * densities mix linearly, and so do all CDFs. The density that is told is that of the interpolant.
 *
 * Departures: there are nodes on the horizon; the directions are even, from 0 to 90 degrees. Renderers have a table per
 * material, and neither roughness nor stretch; here it is of the unit problem at median slope 1, and roughness
 * stretches. */
#include <math.h>
#include <stdlib.h>

#include "evidence/method.h"

enum { SLICES = 8, SIDE = 128, CELLS = SIDE - 1 };

static const float pi = 3.14159265f;

/* Of each slice: the density at the nodes, its integral over q up to each, that of whole rows over p. */
typedef struct warp {
    float scale, density[SLICES][SIDE][SIDE], conditional[SLICES][SIDE][SIDE], marginal[SLICES][SIDE];
} warp;

/* The density at (p, q), but for a factor. On the horizon D may be infinite though integrable: a density there is at
 * most twice the one half a cell inside. */
static double density_at(const vndf_view *view, double p, double q)
{
    const double theta = p * p * acos(0), phi = (2 * q - 1) * acos(-1);
    const vndf_vec3 wm = {(float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                          (float)fmax(cos(theta), 0)};
    const double at = (double)vndf_visible(view, wm) * p * sin(theta);
    return p < 1 ? at : fmin(at, 2 * density_at(view, 1 - 0.5 / CELLS, q));
}

/* Integrals of a row's interpolant up to each node, the cell being one wide. */
static float accumulate(const float value[SIDE], float sum[SIDE])
{
    double total = 0;
    for (size_t i = 0; i < SIDE; i++)
        sum[i] = (float)(total += i ? 0.5 * ((double)value[i - 1] + (double)value[i]) : 0);
    return sum[CELLS];
}

static void fill_slice(warp *w, const vndf_view *view, size_t slice)
{
    float rows[SIDE];
    for (size_t i = 0; i < SIDE; i++) {
        for (size_t j = 0; j < SIDE; j++)
            w->density[slice][i][j] = (float)density_at(view, (double)i / CELLS, (double)j / CELLS);
        rows[i] = accumulate(w->density[slice][i], w->conditional[slice][i]);
    }
    const float total = accumulate(rows, w->marginal[slice]);
    for (size_t i = 0; i < SIDE; i++) {
        w->marginal[slice][i] /= total;
        for (size_t j = 0; j < SIDE; j++) {
            w->density[slice][i][j] *= (float)CELLS * CELLS / total;
            w->conditional[slice][i][j] *= (float)CELLS / total;
        }
    }
}

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

/* A row at v between i and i + 1, mixed at t between two slices. */
static inline mix four_rows(const float table[][SIDE][SIDE], float t, size_t i, float v)
{
    return (mix){{table[0][i], table[0][i + 1], table[1][i], table[1][i + 1]},
                 {(1 - t) * (1 - v), (1 - t) * v, t * (1 - v), t * v},
                 4};
}

/* The cell of an ascending row where `value` falls. */
static inline size_t cell_of(const mix *x, float value)
{
    size_t low = 0, high = CELLS;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
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
    const float root = sqrtf(fmaxf(0.0f, a * a + 2.0f * rest * (b - a)));
    return a + root > 0 ? fminf(2.0f * rest / (a + root), 1.0f) : 0.5f;
}

static inline vndf_vec3 warp_one(const method *m, const method_input *in, float *pdf)
{
    const warp *w = m->state;
    const float a = in->alpha * w->scale, across = sqrtf(in->wi.x * in->wi.x + in->wi.y * in->wi.y);
    const float place = atan2f(a * across, in->wi.z) * (2 / pi) * (SLICES - 1);
    const size_t s = (size_t)fminf(place, SLICES - 2);
    const float t = fminf(place - (float)s, 1.0f);
    const mix marginal = {{w->marginal[s], w->marginal[s + 1]}, {1.0f - t, t}, 2};
    const size_t i = cell_of(&marginal, in->u[0]);
    const mix lower = four_rows(w->conditional + s, t, i, 0), upper = four_rows(w->conditional + s, t, i, 1);
    const float low = mixed(&lower, CELLS), high = mixed(&upper, CELLS);
    const float v = part_of(low, high, (in->u[0] - mixed(&marginal, i)) * CELLS);
    const mix conditional = four_rows(w->conditional + s, t, i, v), density = four_rows(w->density + s, t, i, v);
    const float wanted = in->u[1] * (low + v * (high - low));
    const size_t j = cell_of(&conditional, wanted);
    const float c = mixed(&density, j), d = mixed(&density, j + 1);
    const float along = part_of(c, d, (wanted - mixed(&conditional, j)) * CELLS);

    const float p = fmaxf(((float)i + v) / CELLS, 1e-4f), theta = p * p * (pi / 2);
    const float phi = (2 * ((float)j + along) / CELLS - 1) * pi, sine = sinf(theta), z = fmaxf(cosf(theta), 0.0f);
    const float cos_phi = across > 0 ? in->wi.x / across : 1.0f, sin_phi = across > 0 ? in->wi.y / across : 0.0f;
    const float x = a * sine * cosf(phi), y = a * sine * sinf(phi), length = sqrtf(x * x + y * y + z * z);
    *pdf = (c + along * (d - c)) / (2 * pi * pi * p * sine) * length * length * length / (a * a);
    return (vndf_vec3){(cos_phi * x - sin_phi * y) / length, (sin_phi * x + cos_phi * y) / length, z / length};
}

static void warp_each(const method *m, block *b)
{
    method_loop(warp_one, m, b);
}

method method_warp(const method_reference *reference)
{
    warp *w = malloc(sizeof *w);
    for (size_t slice = 0; w && slice < SLICES; slice++) {
        const double theta = acos(0) * (double)slice / (SLICES - 1);
        const vndf_vec3 wi = {(float)sin(theta), 0, slice == SLICES - 1 ? 0 : (float)cos(theta)};
        const vndf_view view = vndf_view_from(&reference->canonical, wi);
        fill_slice(w, &view, slice);
    }
    if (w)
        w->scale = reference->scale;
    method m = {.name = "bilinear warps, 8 x 128^2", .kind = ROW_PUBLISHED, .memory = sizeof *w, .turned = 1};
    m.state = w, m.release = free, m.each = w ? warp_each : NULL;
    return m;
}
