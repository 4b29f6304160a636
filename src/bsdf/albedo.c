/* The table of albedos: the mean weight of single scattering in the nodes of a grid over cosine and roughness, and a
 * polynomial of degree 3 in each direction between them. With a = scale alpha, the median slope, and c = |cos_i|, its
 * coordinates are
 *
 *     x = (t + t^(1/4))/2,  t = c (1 + K a)/(c + K a)         from X to 1
 *     y = (a (1 + Q A)/(A (1 + Q a)))^(1/2),  A the largest a from 0 to 1
 *
 * E changes where c is of the size of a, at any roughness: in x that is one place, and E as a function of x tends
 * to a limit for a = 0. Near c = 0 1 - E falls as c log c or as a low power of c, which a root makes smooth;
 * elsewhere x is nearly even in c. What a dielectric transmits falls by a power so low that no root helps: there
 * the grid begins at X > 0.
 *
 * E is the mean of F G2/G1 over the normals that wi sees, and of both lobes that of (1 - F) G2/G1 too. The normals are
 * those of a Fibonacci lattice (Sloan & Joe, "Lattice Methods for Multiple Integration", 1994), whose second number is
 * crowded where slopes are steep, since these lose light: u2 = 1 - (1 - t)^2, so that a point counts for 2 (1 - t).
 * Within 4e-4 for a mirror and 2e-3 for a dielectric (beside Gauss's rule over slopes and azimuths in panels, GGX,
 * Beckmann and four tables, alpha 0.01 to 4, cosines from 1e-4 on). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bsdf/bsdf.h"
#include "core/error.h"

enum { COLUMNS = 32, ROWS = 24 };

struct vndf_albedo {
    float eta, scale, from;        /* eta 0: a mirror; from: X */
    float value[2][ROWS][COLUMNS]; /* of light from the side of z, and from the other side of a dielectric */
    float average[ROWS];           /* of light from the side of z */
    char source[];                 /* of the distribution, as vndf_info has it */
};

static const float knee = 4.0f;  /* K */
static const float bend = 0.25f; /* Q */

/* NaN becomes 0. */
static float clamp(float value, float most)
{
    return value > 0.0f ? value < most ? value : most : 0.0f;
}

/* ---- looking up ---- */

/* The first of four nodes, and their weights. */
typedef struct cell_place {
    int first;
    float weight[4];
} cell_place;

/* At a part of the way from the first of the nodes to the last. */
static cell_place place_of(float part, int nodes)
{
    float at = clamp(part, 1.0f) * (float)(nodes - 1);
    int first = (int)at - 1;
    first = first < 0 ? 0 : first > nodes - 4 ? nodes - 4 : first;
    float p = at - (float)first, q = p - 1.0f, r = p - 2.0f, s = p - 3.0f;
    return (cell_place){first, {q * r * s / -6.0f, p * r * s / 2.0f, p * q * s / -2.0f, p * q * r / 6.0f}};
}

static float sum_at(const float *value, const cell_place *at)
{
    const float *v = value + at->first;
    return (v[0] * at->weight[0] + v[1] * at->weight[1]) + (v[2] * at->weight[2] + v[3] * at->weight[3]);
}

/* a, from any alpha. */
static float slope_of(const vndf_albedo *albedo, float alpha)
{
    return clamp(alpha, VNDF_ALBEDO_ALPHA_MAX) * albedo->scale;
}

static cell_place row_of(const vndf_albedo *albedo, float slope)
{
    float most = VNDF_ALBEDO_ALPHA_MAX * albedo->scale;
    return place_of(sqrtf(slope * (1.0f + bend * most) / (most * (1.0f + bend * slope))), ROWS);
}

static cell_place column_of(const vndf_albedo *albedo, float cosine, float slope)
{
    float c = clamp(fabsf(cosine), 1.0f), bent = knee * slope;
    float t = c + bent > 0.0f ? c * (1.0f + bent) / (c + bent) : 0.0f;
    return place_of((0.5f * (t + sqrtf(sqrtf(t))) - albedo->from) / (1.0f - albedo->from), COLUMNS);
}

float vndf_albedo_directional(const vndf_albedo *albedo, float cosine, float alpha)
{
    if (!albedo)
        return 1.0f;
    float slope = slope_of(albedo, alpha), sum = 0.0f;
    cell_place x = column_of(albedo, cosine, slope), y = row_of(albedo, slope);
    int side = albedo->eta > 0.0f && cosine < 0.0f;
    for (int i = 0; i < 4; i++)
        sum += y.weight[i] * sum_at(albedo->value[side][y.first + i], &x);
    return clamp(sum, 1.0f);
}

float vndf_albedo_average(const vndf_albedo *albedo, float alpha)
{
    if (!albedo)
        return 1.0f;
    cell_place y = row_of(albedo, slope_of(albedo, alpha));
    return clamp(sum_at(albedo->average, &y), 1.0f);
}

/* ---- building ---- */

/* The inverse of the coordinate y. A thousandth of a node stands for 0. */
static double alpha_at(const vndf_albedo *albedo, int row)
{
    double y = row > 0 ? row / (ROWS - 1.0) : 1e-3 / ROWS, scale = (double)albedo->scale;
    double most = (double)VNDF_ALBEDO_ALPHA_MAX * scale, part = y * y * most;
    return part / (1.0 + (double)bend * (most - part)) / scale;
}

/* The inverse of the coordinate x: q^4 + q = 2 x has q = t^(1/4), by Newton's steps from above. */
static double cosine_at(const vndf_albedo *albedo, int column, double alpha)
{
    double from = (double)albedo->from, twice = 2.0 * (from + (1.0 - from) * column / (COLUMNS - 1)), q = 1.0;
    for (int i = 0; i < 12; i++)
        q -= (q * q * q * q + q - twice) / (4.0 * q * q * q + 1.0);
    double t = q > 0.0 ? (q * q) * (q * q) : 0.0, bent = (double)knee * (double)albedo->scale * alpha;
    double cosine = t * bent / (bent + (1.0 - t));
    return cosine < 1.0 ? cosine : 1.0;
}

/* E from the side of z, or the other; `lobe` has a material of each lobe that light takes. */
static float kept_of(const vndf_material *lobe, int lobes, double cosine, double alpha, int side)
{
    enum { POINTS = 2584, STEP = 1597 }; /* neighbours in Fibonacci's series */
    const float c = cosine > 1e-15 ? (float)cosine : 1e-15f, rough = (float)alpha;
    const vndf_surface of = vndf_rough(NULL, rough, rough);
    vndf_bsdf hit[2];
    double sum = 0.0, all = 0.0;
    for (int k = 0; k < lobes; k++)
        vndf_bsdf_on(&hit[k], &lobe[k], &of, vndf_vec3_of(sqrtf((1.0f - c) * (1.0f + c)), 0.0f, side ? -c : c));
    for (int i = 0; i < POINTS; i++) {
        double t = (i + 0.5) / POINTS, u = t * STEP - floor(t * STEP), rest = 1.0 - t;
        vndf_drawn_normal n = vndf_sample_visible(&hit[0].own.view.of.one, (float)u, (float)(1.0 - rest * rest));
        all += rest * (double)n.weight;
        for (int k = 0; k < lobes; k++) {
            vndf_scattered s;
            if (vndf_scatter(&hit[k], &n, 0.0f, &s))
                sum += rest * (double)s.weight[0];
        }
    }
    return (float)(sum / all);
}

static void fill(vndf_albedo *albedo, const vndf_material *lobe, int lobes)
{
    enum { NODES = 1024 }; /* of E_avg: midpoints of the root of mu, since E changes most at small cosines */
    for (int i = 0; i < ROWS; i++) {
        double alpha = alpha_at(albedo, i), sum = 0.0;
        for (int j = 0; j < COLUMNS * lobes; j++) {
            int side = j / COLUMNS, column = j % COLUMNS;
            albedo->value[side][i][column] = kept_of(lobe, lobes, cosine_at(albedo, column, alpha), alpha, side);
        }
        for (int n = 0; n < NODES; n++) {
            double root = (n + 0.5) / NODES, mu = root * root;
            sum += mu * root * (double)vndf_albedo_directional(albedo, (float)mu, (float)alpha);
        }
        albedo->average[i] = (float)(4.0 * sum / NODES);
    }
}

vndf_albedo *vndf_albedo_build(const vndf_distribution *distribution, float eta, vndf_error *error)
{
    const vndf_info info = vndf_distribution_info(distribution);
    const size_t letters = strlen(info.source) + 1;
    vndf_albedo *albedo = NULL;
    if (!distribution)
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "no distribution: NULL was given");
    else if (!(eta == 0.0f || (eta >= 0.01f && eta <= 100.0f && fabsf(eta - 1.0f) >= 1e-3f)))
        vndf_fail(error, VNDF_ERROR_ARGUMENT,
                  "eta %g; 0 is a mirror, else it is from 0.01 to 100 and farther than 0.001 from 1", (double)eta);
    else if (!(info.scale >= 1e-6 && info.scale <= 1e6))
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the median slope is %g; from 1e-6 to 1e6 are possible", info.scale);
    else if (!(albedo = malloc(sizeof *albedo + letters)))
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of albedos");
    if (!albedo)
        return NULL;
    *albedo = (vndf_albedo){.eta = eta, .scale = (float)info.scale, .from = eta > 0.0f ? 0.03f : 0.0f};
    memcpy(albedo->source, info.source, letters);
    vndf_description is = {.surface = vndf_rough(distribution, 1.0f, 1.0f), .wavelengths = 1};
    vndf_material lobe[2];
    is.eta = eta;
    is.effects.fresnel = eta > 0.0f ? VNDF_FRESNEL_DIELECTRIC : VNDF_FRESNEL_NONE;
    is.effects.transport = VNDF_TRANSPORT_IMPORTANCE;
    vndf_material_resolve(&is, &lobe[0], NULL);
    is.effects.lobes = VNDF_LOBES_TRANSMISSION;
    if (eta > 0.0f)
        vndf_material_resolve(&is, &lobe[1], NULL);
    fill(albedo, lobe, eta > 0.0f ? 2 : 1);
    return albedo;
}

void vndf_albedo_free(vndf_albedo *albedo)
{
    free(albedo);
}

/* An albedo of something else would keep the wrong energy. */
vndf_status vndf_albedo_check(const vndf_description *is, vndf_error *error)
{
    const char *source = vndf_distribution_info(is->surface.distribution).source;
    float eta = is->effects.lobes == VNDF_LOBES_BOTH ? is->eta : 0.0f;
    if (!is->albedo)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "albedo is NULL: compensation needs the albedos of the distribution (vndf_albedo_build)");
    if (!(fabsf(is->albedo->eta - eta) <= 1e-6f * eta))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "albedo is made for eta %g; this material needs %g (0: a mirror)",
                         (double)is->albedo->eta, (double)eta);
    if (strcmp(is->albedo->source, source) != 0)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "albedo is that of %.80s, the distribution is %.80s",
                         is->albedo->source, source);
    return VNDF_OK;
}
