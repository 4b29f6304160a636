/* What others published, written from the papers, in float and one by one.
 *
 * - Spherical caps: visible normals of GGX. J. Dupuy, A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps",
 *   HPG 2023. The yardstick: other times are multiples of its time.
 * - All normals, not only the visible ones, of any D: B. Walter et al., "Microfacet Models for Refraction through Rough
 *   Surfaces", EGSR 2007, eq. 28 and 35.
 * - A bilinear warp of the unit square for each incident direction, for any D, as renderers use for measured materials:
 *   J. Dupuy, W. Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering", TOG 37(6),
 *   2018. */
#include <math.h>
#include <stdlib.h>

#include "evidence/method.h"

static const float pi = 3.14159265f;

static inline vndf_vec3 unit(float x, float y, float z)
{
    float scale = 1.0f / sqrtf(x * x + y * y + z * z);
    return (vndf_vec3){x * scale, y * scale, z * scale};
}

/* wi is stretched to the unit problem w, where mirrored directions are uniform on the cap z > -w.z; the normal is half
 * way between, and stretched back. The density is Dv = wi.wm D/A with A = (wi.z + |stretched wi|)/2. The published code
 * guards nothing: at normal incidence u2 = 1 is a NaN. */
typedef struct ggx_view {
    vndf_vec3 wi, w;
    float alpha, per_area;
} ggx_view;

static inline ggx_view ggx_view_from(vndf_vec3 wi, float alpha)
{
    float x = alpha * wi.x, y = alpha * wi.y, length = sqrtf(x * x + y * y + wi.z * wi.z);
    return (ggx_view){.wi = wi,
                      .w = {x / length, y / length, wi.z / length},
                      .alpha = alpha,
                      .per_area = 2.0f / (wi.z + length)};
}

static inline vndf_vec3 ggx_draw(const ggx_view *v, const float u[3], float *pdf)
{
    float phi = 2 * pi * u[0], z = (1.0f - u[1]) * (1.0f + v->w.z) - v->w.z, a = v->alpha, a2 = a * a;
    float s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 m = unit(a * (s * cosf(phi) + v->w.x), a * (s * sinf(phi) + v->w.y), z + v->w.z);
    float across = (m.x * m.x + m.y * m.y) / a2 + m.z * m.z;
    float facing = fmaxf(0.0f, v->wi.x * m.x + v->wi.y * m.y + v->wi.z * m.z);
    *pdf = facing * v->per_area / (pi * a2 * across * across);
    return m;
}

static inline vndf_vec3 ggx_one(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    ggx_view v = ggx_view_from(in->wi, in->alpha);
    return ggx_draw(&v, in->u, pdf);
}

static void ggx_each(const method *m, block *b)
{
    method_loop(ggx_one, m, b);
}

static void ggx_shared(const method *m, block *b)
{
    (void)m;
    for (size_t first = 0; first < b->count; first += SHARE) {
        ggx_view v = ggx_view_from(b->in[first].wi, b->in[first].alpha);
        for (size_t i = first; i < first + SHARE; i++) {
            const vndf_vec3 wm = ggx_draw(&v, b->in[i].u, &b->pdf[i]);
            b->x[i] = wm.x, b->y[i] = wm.y, b->z[i] = wm.z;
        }
    }
}

method method_ggx_caps(void)
{
    return (method){.name = "spherical caps (2023)",
                    .kind = ROW_PUBLISHED,
                    .each = ggx_each,
                    .shared = ggx_shared,
                    .batch = method_caps_batch};
}

/* The density is D(wm) cos(theta_m), a radial law and an azimuth; no draw reads wi. The radial law is a CDF, so that it
 * serves any D. At the scale where the median slope is 1, y = sin^2(theta_m) has the density pi D(y) in [0, 1]. The CDF
 * has cells of equal mass with a constant D in each, so that the density told is the density drawn and a coarse table
 * only costs variance. Roughness stretches. */
enum { CELLS = 1024 };

typedef struct radial_cdf {
    float y[CELLS + 1]; /* sin^2(theta_m) at masses j/CELLS */
    float scale;
} radial_cdf;

static inline vndf_vec3 normals_one(const method *m, const method_input *in, float *pdf)
{
    const radial_cdf *t = m->state;
    float place = in->u[1] * CELLS, alpha = in->alpha * t->scale, phi = 2 * pi * in->u[0];
    int j = (int)place;
    j = j < CELLS ? j : CELLS - 1;
    float width = t->y[j + 1] - t->y[j], y = fminf(t->y[j] + (place - (float)j) * width, 1 - 0x1p-24f);
    float rest = 1.0f - y, slope = alpha * sqrtf(y / rest), z2 = 1.0f / (1.0f + slope * slope), z = sqrtf(z2);
    *pdf = rest * rest / ((float)CELLS * width) / (pi * alpha * alpha * z2 * z);
    return (vndf_vec3){slope * z * cosf(phi), slope * z * sinf(phi), z};
}

static void normals_each(const method *m, block *b)
{
    method_loop(normals_one, m, b);
}

/* sin^2(theta_m) of the normal that a part `mass` of D cos(theta_m) lies within. From straight above all normals are
 * visible, and u2 is that part; but of Beckmann it moves one of two slopes. */
static double sine2_at(const vndf_surface *surface, double mass)
{
    if (surface->distribution == vndf_beckmann())
        return 1 / (1 + 1 / (-log1p(-mass) * (double)surface->xx * (double)surface->xx));
    vndf_view view = vndf_view_from(surface, (vndf_vec3){0, 0, 1});
    vndf_vec3 wm = vndf_sample(&view, 0.5f, (float)mass, NULL);
    return (double)wm.x * (double)wm.x + (double)wm.y * (double)wm.y;
}

method method_all_normals(const method_reference *reference)
{
    radial_cdf *t = malloc(sizeof *t);
    for (int j = 0; t && j <= CELLS; j++)
        t->y[j] = (float)sine2_at(&reference->canonical, (double)j / CELLS);
    if (t)
        t->scale = reference->scale;
    method m = {.name = "all normals (2007)", .kind = ROW_PUBLISHED, .memory = sizeof *t, .turned = 1};
    m.state = t, m.release = free, m.each = t ? normals_each : NULL;
    return m;
}

/* ---- bilinear warps ------------------------------------------------------------------------------ */

/* For each of SLICES directions a table holds the density of visible normals over (p, q), with theta_m = p^2 pi/2 and
 * the azimuth (2 q - 1) pi from wi: SIDE x SIDE nodes, bilinear between them. The marginal of p and the conditional of
 * q are then piecewise linear: a binary search of a CDF and a quadratic draw from each. Between two directions
 * densities mix linearly, and so do all CDFs. The density that is told is that of the interpolant.
 *
 * Departures: there are nodes on the horizon; the directions are even, from 0 to 90 degrees. Renderers have a table per
 * material, and neither roughness nor stretch; here it is of the unit problem at median slope 1, and roughness
 * stretches. */
enum { SLICES = 8, SIDE = 128, LAST = SIDE - 1 };

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
    return p < 1 ? at : fmin(at, 2 * density_at(view, 1 - 0.5 / LAST, q));
}

/* Integrals of a row's interpolant up to each node, the cell being one wide. */
static float accumulate(const float value[SIDE], float sum[SIDE])
{
    double total = 0;
    for (size_t i = 0; i < SIDE; i++)
        sum[i] = (float)(total += i ? 0.5 * ((double)value[i - 1] + (double)value[i]) : 0);
    return sum[LAST];
}

static void fill_slice(warp *w, const vndf_view *view, size_t slice)
{
    float rows[SIDE];
    for (size_t i = 0; i < SIDE; i++) {
        for (size_t j = 0; j < SIDE; j++)
            w->density[slice][i][j] = (float)density_at(view, (double)i / LAST, (double)j / LAST);
        rows[i] = accumulate(w->density[slice][i], w->conditional[slice][i]);
    }
    const float total = accumulate(rows, w->marginal[slice]);
    for (size_t i = 0; i < SIDE; i++) {
        w->marginal[slice][i] /= total;
        for (size_t j = 0; j < SIDE; j++) {
            w->density[slice][i][j] *= (float)LAST * LAST / total;
            w->conditional[slice][i][j] *= (float)LAST / total;
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
    size_t low = 0, high = LAST;
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
    const float low = mixed(&lower, LAST), high = mixed(&upper, LAST);
    const float v = part_of(low, high, (in->u[0] - mixed(&marginal, i)) * LAST);
    const mix conditional = four_rows(w->conditional + s, t, i, v), density = four_rows(w->density + s, t, i, v);
    const float wanted = in->u[1] * (low + v * (high - low));
    const size_t j = cell_of(&conditional, wanted);
    const float c = mixed(&density, j), d = mixed(&density, j + 1);
    const float along = part_of(c, d, (wanted - mixed(&conditional, j)) * LAST);

    const float p = fmaxf(((float)i + v) / LAST, 1e-4f), theta = p * p * (pi / 2);
    const float phi = (2 * ((float)j + along) / LAST - 1) * pi, sine = sinf(theta), z = fmaxf(cosf(theta), 0.0f);
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
