/* The .bsdf files of EPFL's realistic graphics lab (J. Dupuy, W. Jakob, "An Adaptive Parameterization for Efficient
 * Material Acquisition and Rendering", TOG 37(6), 2018): tensor files that Mitsuba 3 (plugin `measured`) and pbrt-v4
 * render. An angle theta from z stands at u = sqrt(2 theta/pi), an azimuth phi at (phi + pi)/(2 pi); of an isotropic
 * material azimuths of normals are counted from wi.
 *
 *     theta_i [n], phi_i [1]     incident directions, radians
 *     ndf [2][.]                 D over u: the material's own, at any scale
 *     sigma [2][.]               projected area A over u of wi, at the same scale
 *     vndf [1][n][phi][theta]    density of visible normals over the unit square of (u, v)
 *     luminance, rgb or spectra  [1][n](channels)[y][x]: what is reflected over what single scattering without masking
 *                                of wo would, f cos_o 4 A / D, at the normal where the vndf's warp sends (x, y)
 *     wavelengths                of spectra, nm
 *     jacobian [1] = 1           rgb and spectra are still to be multiplied by D/(4 A)
 *
 * Out: D stands at NORMALS + 1 angles. The vndf is coarser in theta by FINE, and each of its numbers is the mean over
 * the cells beside it, so that no ring of D falls between two of them: what is reflected there has to be drawn as
 * well. rgb is fitted (tensor.h) to R = G2/G1(wi) at POINTS^2 places of each cell, so that the light of a cell where wo
 * meets the horizon is right. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"
#include "measured/measured.h"
#include "measured/tensor.h"
#include "render/vector.h"

enum { ANGLES_LEAST = 8, ANGLES_MOST = 65536, PASSES_MOST = 1 << 14 }; /* in */
static const double anisotropy_most = 0.05;
enum { NORMALS = 2048, FINE = 8, THETAS = NORMALS / FINE + 1, PHIS = 65, INCIDENTS = 48, AREAS = 257 }; /* out */
enum { SIDE = 32, POINTS = 4, FINE_SIDE = (SIDE - 1) * POINTS, STEPS = 8 };

/* Where u = part/whole lies. */
static double angle_at(double part, double whole)
{
    const double u = part / whole;
    return PI / 2 * u * u;
}

/* ---- in ------------------------------------------------------------------------------------------ */

/* The means of the field `ndf` over azimuths, which begin and end at the same place, unless D is too anisotropic. */
static int read_ndf(data_file *file, profile *rows)
{
    tensor ndf;
    double off = 0, whole = 0;
    if (!tensor_find(file, "ndf", 2, &ndf))
        return 0;
    const size_t azimuths = ndf.shape[0], angles = ndf.shape[1];
    if (azimuths < 1 || angles < ANGLES_LEAST || angles > ANGLES_MOST)
        return refuse(file, "field 'ndf' is %zu x %zu; it needs from %d to %d angles", azimuths, angles,
                      ANGLES_LEAST, ANGLES_MOST);
    for (size_t i = 0; i < azimuths * angles; i++)
        if (!(tensor_at(&ndf, i) >= 0) || isinf(tensor_at(&ndf, i)))
            return refuse(file, "number %zu of field 'ndf' is %.6g; it must be finite and not negative", i,
                          tensor_at(&ndf, i));
    note(file, "ndf %zu x %zu", azimuths, angles);
    if (!profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, angles, file))
        return 0;
    const double ends = azimuths > 2 ? 0.5 : 1, all = (double)azimuths - (azimuths > 2);
    for (size_t j = 0; j < angles; j++) {
        const double theta = rows->x[j] = angle_at((double)j, (double)(angles - 1));
        const double area = fmax(cos(theta), 0) * sin(theta) * (double)j;
        for (size_t i = 0; i < azimuths; i++)
            rows->value[j] += (i == 0 || i + 1 == azimuths ? ends : 1) / all * tensor_at(&ndf, i * angles + j);
        for (size_t i = 0; i < azimuths; i++)
            off += (i == 0 || i + 1 == azimuths ? ends : 1) / all * area *
                   fabs(tensor_at(&ndf, i * angles + j) - rows->value[j]);
        whole += rows->value[j] * area;
    }
    off = whole > 0 ? off / 2 / whole : 0;
    note(file, "residual_isotropy %.3g", off);
    return off <= anisotropy_most ||
           refuse(file,
                  "D is anisotropic: %.3g of all normals would have to turn about z to make it isotropic, %.3g is "
                  "the most",
                  off, anisotropy_most);
}

/* Finds the relative noise of D, which is symmetric about theta = 0, and smooths it by as much as keeps it within that.
 * Noise is seen in the fourth differences of logarithms, which a curve that is smooth at these steps hardly has: one
 * deviation gives them sqrt(70), and their median does not see jumps. Passes of (1 2 1)/4 smooth until the next one
 * would move the values by more than that. */
static int smooth(profile *p, data_file *file)
{
    size_t n = 0;
    double noise = 0;
    while (n < p->count && p->value[n] > 0)
        n++;
    double *given = malloc((3 * n + 1) * sizeof *given), *now = given + n, *next = now + n;
    if (!given)
        return refuse(file, "there is no memory for %zu rows", p->count);
    for (size_t i = 0; i < n; i++)
        now[i] = given[i] = log(p->value[i]);
    for (size_t i = 4; i < n; i++)
        next[i - 4] = fabs(now[i - 4] - 4 * now[i - 3] + 6 * now[i - 2] - 4 * now[i - 1] + now[i]);
    if (n > 4) {
        sort_numbers(next, n - 4);
        noise = next[(n - 4) / 2] / (0.6745 * sqrt(70));
    }
    note(file, "noise %.2g", noise);
    for (int pass = 0; pass < PASSES_MOST && n > 4; pass++) {
        double square = 0;
        for (size_t i = 0; i < n; i++) {
            next[i] = i + 1 == n ? now[i] : (now[i ? i - 1 : 1] + 2 * now[i] + now[i + 1]) / 4;
            square += (next[i] - given[i]) * (next[i] - given[i]) / (double)n;
        }
        if (!(sqrt(square) <= noise))
            break;
        memcpy(now, next, n * sizeof *now);
    }
    for (size_t i = 0; i < n; i++)
        p->value[i] = exp(now[i]);
    free(given);
    return 1;
}

int rgl_read(data_file *file, profile *rows)
{
    *rows = (profile){0};
    if (read_ndf(file, rows) && smooth(rows, file))
        return 1;
    profile_free(rows);
    return 0;
}

/* ---- out ----------------------------------------------------------------------------------------- */

typedef struct rgl_arrays {
    const vndf_surface *surface;
    float theta_i[INCIDENTS], phi_i[1];
    float ndf[2][NORMALS + 1], sigma[2][AREAS];
    float vndf[INCIDENTS][PHIS][THETAS];
    float luminance[INCIDENTS][SIDE][SIDE];
    float spectra[INCIDENTS * RGL_CHANNELS][SIDE][SIDE]; /* packed, `channels` for each incident direction */
    double density[PHIS][THETAS];                        /* vndf of one incident direction */
    double along[NORMALS + 1], across[NORMALS + 1];      /* of visible normals at fine angles, see fill_ndf */
    /* R (1 - rise), R rise, their luminance, and where wo is above the horizon, in POINTS^2 places of each cell */
    float low[FINE_SIDE * FINE_SIDE], high[FINE_SIDE * FINE_SIDE], light[FINE_SIDE * FINE_SIDE];
    float is_seen[FINE_SIDE * FINE_SIDE];
    double low_grid[SIDE * SIDE], high_grid[SIDE * SIDE], light_grid[SIDE * SIDE];
} rgl_arrays;

static double ndf_at(const vndf_surface *surface, double theta)
{
    return (double)vndf_ndf(surface, (vndf_vec3){(float)sin(theta), 0.0f, (float)fmax(cos(theta), 0)});
}

static double area_at(const vndf_surface *surface, double theta)
{
    return (double)vndf_projected_area(surface, (vndf_vec3){(float)sin(theta), 0.0f, (float)cos(theta)});
}

/* What wi at theta_i sees at (u, v) of the vndf: R with heights correlated, finite at grazing incidence, and
 * (1 - wi.m)^5. 0 if wo is below the horizon. */
static int model_at(const vndf_surface *surface, double theta_i, double u, double v, double *left, double *rise)
{
    const double theta = angle_at(u, 1), phi = (2 * v - 1) * PI, cos_i = fmax(cos(theta_i), 0);
    const vec3 wi = vec(sin(theta_i), 0, cos(theta_i));
    const vec3 m = vec(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
    const double cos_o = 2 * dot(wi, m) * m.z - wi.z, area_i = area_at(surface, theta_i);
    *rise = pow(1 - fmax(dot(wi, m), 0), 5);
    *left = 0;
    if (cos_o > 0)
        *left = area_i * cos_o / (area_i * cos_o + area_at(surface, acos(fmin(cos_o, 1))) * cos_i - cos_i * cos_o);
    return cos_o > 0;
}

/* D, its areas, and of visible normals what does not depend on wi: D max(0, wi.m) over the unit square is, but for a
 * constant, the positive part of cos(theta_i) along + sin(theta_i) cos(phi) across. At 90 degrees D may have no
 * bound: the last number gives its cell, which is linear in u, the integral of D. */
static void fill_ndf(rgl_arrays *a)
{
    enum { PARTS = 64 };
    double last = 0;
    for (int i = 0; i < NORMALS; i++)
        a->ndf[0][i] = (float)ndf_at(a->surface, angle_at(i, NORMALS));
    for (int i = 0; i < PARTS; i++)
        last += 2 * ndf_at(a->surface, angle_at(NORMALS - 1 + (i + 0.5) / PARTS, NORMALS)) / PARTS;
    a->ndf[0][NORMALS] = (float)fmax(last - (double)a->ndf[0][NORMALS - 1], 0);
    for (int i = 0; i < AREAS; i++)
        a->sigma[0][i] = (float)area_at(a->surface, angle_at(i, AREAS - 1));
    memcpy(a->ndf[1], a->ndf[0], sizeof a->ndf[0]);
    memcpy(a->sigma[1], a->sigma[0], sizeof a->sigma[0]);
    for (int i = 0; i <= NORMALS; i++) {
        double theta = angle_at(i, NORMALS), part = (double)a->ndf[0][i] * i / NORMALS * sin(theta);
        a->along[i] = part * fmax(cos(theta), 0);
        a->across[i] = part * sin(theta);
    }
}

/* The visible normals of one incident direction, the mean over the cells on both sides of each point, weighed by a
 * hat; and what is reflected from there. Luminance, by which hosts may draw, is not 0 where a neighbour is not. */
static int fill_incident(rgl_arrays *a, int incident, const rgl_form *form)
{
    static const double of_channel[3] = {0.2126, 0.7152, 0.0722};
    const double theta_i = (double)a->theta_i[incident];
    double f0 = 0, u, v, left, rise;
    warp to;
    for (int i = 0; i < PHIS * THETAS; i++) {
        const int row = i / THETAS, middle = i % THETAS * FINE;
        double sum = 0, whole = 0, across = sin(theta_i) * cos((2.0 * row / (PHIS - 1) - 1) * PI);
        for (int k = middle - FINE + 1; k < middle + FINE; k++) {
            const double weight = k < 0 || k > NORMALS ? 0 : FINE - abs(k - middle);
            sum += weight > 0 ? weight * fmax(cos(theta_i) * a->along[k] + across * a->across[k], 0) : 0;
            whole += weight;
        }
        a->density[row][i % THETAS] = sum / whole;
        a->vndf[incident][row][i % THETAS] = (float)(sum / whole);
    }
    if (!warp_make(&to, &a->density[0][0], THETAS, PHIS))
        return 0;
    for (int k = 0; k < form->channels; k++)
        f0 += form->f0[k] * (form->is_spectral ? 1.0 / form->channels : of_channel[k]);
    for (int i = 0; i < FINE_SIDE * FINE_SIDE; i++) {
        warp_sample(&to, (i % FINE_SIDE + 0.5) / FINE_SIDE, ((double)(i / FINE_SIDE) + 0.5) / FINE_SIDE, &u, &v);
        a->is_seen[i] = model_at(a->surface, theta_i, u, v, &left, &rise) ? 1.0f : 0.0f;
        a->low[i] = (float)(left * (1 - rise));
        a->high[i] = (float)(left * rise);
        a->light[i] = (float)(left * (f0 * (1 - rise) + rise));
    }
    warp_free(&to);
    grid_fit(a->low, a->is_seen, SIDE, POINTS, STEPS, a->low_grid);
    grid_fit(a->high, a->is_seen, SIDE, POINTS, STEPS, a->high_grid);
    grid_fit(a->light, NULL, SIDE, POINTS, 1, a->light_grid);
    for (int i = 0; i < SIDE * SIDE; i++) {
        a->luminance[incident][i / SIDE][i % SIDE] = (float)a->light_grid[i];
        for (int k = 0; k < form->channels; k++)
            a->spectra[incident * form->channels + k][i / SIDE][i % SIDE] =
                (float)fmax(form->f0[k] * a->low_grid[i] + a->high_grid[i], 0);
    }
    return 1;
}

static int write_arrays(FILE *file, const rgl_arrays *a, const rgl_form *form)
{
    static const unsigned char one = 1;
    size_t channels = (size_t)form->channels;
    const tensor fields[] = {
        {"description", TENSOR_U8, 1, {strlen(form->description)}, form->description},
        {"theta_i", TENSOR_F32, 1, {INCIDENTS}, a->theta_i},
        {"phi_i", TENSOR_F32, 1, {1}, a->phi_i},
        {"ndf", TENSOR_F32, 2, {2, NORMALS + 1}, a->ndf},
        {"sigma", TENSOR_F32, 2, {2, AREAS}, a->sigma},
        {"vndf", TENSOR_F32, 4, {1, INCIDENTS, PHIS, THETAS}, a->vndf},
        {"luminance", TENSOR_F32, 4, {1, INCIDENTS, SIDE, SIDE}, a->luminance},
        {form->is_spectral ? "spectra" : "rgb", TENSOR_F32, 5, {1, INCIDENTS, channels, SIDE, SIDE}, a->spectra},
        {"jacobian", TENSOR_U8, 1, {1}, &one},
        {"wavelengths", TENSOR_F32, 1, {channels}, form->wavelength},
    };
    return tensor_write(file, fields, sizeof fields / sizeof fields[0] - !form->is_spectral);
}

int rgl_write(FILE *file, const vndf_distribution *distribution, const rgl_form *form)
{
    const vndf_surface surface = {distribution, form->alpha, form->alpha};
    rgl_arrays *a = calloc(1, sizeof *a);
    int good = a != NULL;
    if (good) {
        a->surface = &surface;
        fill_ndf(a);
    }
    for (int i = 0; i < INCIDENTS && good; i++) { /* closest to grazing incidence, where most changes */
        double left = 1 - (double)i / (INCIDENTS - 1);
        a->theta_i[i] = (float)(PI / 2 * (1 - left * left));
        good = fill_incident(a, i, form);
    }
    good = good && write_arrays(file, a, form);
    free(a);
    return good;
}
