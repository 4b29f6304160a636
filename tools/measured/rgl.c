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
 * In: D, and how well the model explains the light that the file holds beside it.
 *
 * Out: D stands at NORMALS + 1 angles. The vndf is coarser in theta by FINE, and each of its numbers is the mean over
 * the cells beside it, so that no ring of D falls between two of them: what is reflected there has to be drawn as
 * well. rgb is fitted (tensor.h) to R at POINTS^2 places of each cell, so that the light of a cell where wo meets the
 * horizon is right. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measured/brdf.h"
#include "measured/tensor.h"

enum { ANGLES_LEAST = 8, ANGLES_MOST = 65536, GRID_MOST = 4096, PROBES = 24 };                          /* in */
enum { NORMALS = 2048, FINE = 8, THETAS = NORMALS / FINE + 1, PHIS = 65, INCIDENTS = 48, AREAS = 257 }; /* out */
enum { SIDE = 32, POINTS = 4, FINE_SIDE = (SIDE - 1) * POINTS, STEPS = 8 };

/* Where u = part/whole lies. */
static double angle_at(double part, double whole)
{
    const double u = part / whole;
    return PI / 2 * u * u;
}

/* ---- in: D --------------------------------------------------------------------------------------- */

/* The means of the field `ndf` over azimuths, which begin and end at the same place, unless D is too anisotropic. */
static int read_ndf(data_file *file, profile *rows)
{
    tensor ndf;
    double off = 0, whole = 0;
    if (!tensor_find(file, "ndf", TENSOR_F32, 2, &ndf))
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
    return off <= RGL_ANISOTROPY_MOST ||
           refuse(file,
                  "D is anisotropic: %.3g of all normals would have to turn about z to make it isotropic, %.3g is "
                  "the most",
                  off, RGL_ANISOTROPY_MOST);
}

/* ---- model --------------------------------------------------------------------------------------- */

/* What wi at theta_i sees at (u, v) of the vndf: R of the model, given areas at an angle from z, and (1 - wi.m)^5. 0
 * if wo is below the horizon. */
static int model_at(double area(const void *of, double theta), const void *of, double theta_i, double u, double v,
                    double *left, double *rise)
{
    const vec3 wi = direction_at(theta_i, 0), m = direction_at(angle_at(u, 1), (2 * v - 1) * PI);
    const vec3 wo = direction_mirrored(wi, m);
    *rise = model_schlick(fmax(dot(wi, m), 0));
    *left = wo.z > 0 ? model_masked(area(of, theta_i), fmax(wi.z, 0), area(of, acos(fmin(wo.z, 1))), wo.z) : 0;
    return wo.z > 0;
}

/* ---- in: how well D explains the light ----------------------------------------------------------- */

/* The fields that are needed, of lengths that fit each other. */
static int find_light(data_file *file, tensor *theta_i, tensor *vndf, tensor *values)
{
    tensor flag;
    if (!tensor_find(file, "theta_i", TENSOR_F32, 1, theta_i) || !tensor_find(file, "vndf", TENSOR_F32, 4, vndf) ||
        !(tensor_find(file, "rgb", TENSOR_F32, 5, values) ||
          tensor_find(file, "spectra", TENSOR_F32, 5, values)) ||
        !tensor_find(file, "jacobian", TENSOR_U8, 1, &flag) || flag.shape[0] != 1 ||
        *(const unsigned char *)flag.data != 1)
        return 0;
    const size_t *v = vndf->shape, *s = values->shape, sides[4] = {v[2], v[3], s[3], s[4]};
    int good = v[0] > 0 && s[0] > 0 && v[1] == theta_i->shape[0] && s[1] == v[1] && s[2] > 0;
    for (int i = 0; i < 4; i++)
        good = good && sides[i] >= 2 && sides[i] <= GRID_MOST;
    for (size_t i = 0; i < tensor_count(vndf) && good; i++)
        good = tensor_at(vndf, i) >= 0;
    return good;
}

static double area_of_law(const void *of, double theta)
{
    return law_area(of, theta);
}

/* Up to PROBES x PROBES places of the grid of one incident direction: the mean of the channels, of which negative ones
 * are noise, and R of the model; returns how many. */
static size_t probe_incident(const tensor *values, size_t incident, double theta_i, const warp *to, const law *of,
                             probe *probes)
{
    const size_t *s = values->shape;
    size_t count = 0;
    for (size_t i = 0; i < PROBES * PROBES; i++) {
        const size_t row = s[3] <= PROBES ? i / PROBES : (2 * (i / PROBES) + 1) * s[3] / (2 * PROBES);
        const size_t column = s[4] <= PROBES ? i % PROBES : (2 * (i % PROBES) + 1) * s[4] / (2 * PROBES);
        double u, v, left, rise, found = 0;
        if (row >= s[3] || column >= s[4])
            continue;
        for (size_t channel = 0; channel < s[2]; channel++) {
            const double value = tensor_at(values, ((incident * s[2] + channel) * s[3] + row) * s[4] + column);
            found += isfinite(value) ? fmax(value, 0) / (double)s[2] : 0;
        }
        warp_sample(to, (double)column / (double)(s[4] - 1), (double)row / (double)(s[3] - 1), &u, &v);
        if (model_at(area_of_law, of, theta_i, u, v, &left, &rise))
            probes[count++] = (probe){found, left * (1 - rise), left * rise, 1, 1};
    }
    return count;
}

/* Fields that are not there, or not right, are no reason to refuse D. */
static int note_light(data_file *file, const profile *rows)
{
    vndf_source *source = profile_source(rows, file);
    law *found = source ? malloc(sizeof *found) : NULL;
    tensor theta, vndf, values;
    reflectance fitted;
    warp to;
    const int good = found || (source && refuse(file, "there is no memory"));
    if (found && law_of_source(found, source) > 0 && find_light(file, &theta, &vndf, &values)) {
        const size_t incidents = theta.shape[0], cells = vndf.shape[2] * vndf.shape[3];
        double *density = malloc(cells * sizeof *density);
        probe *probes = malloc((incidents * PROBES * PROBES + 1) * sizeof *probes);
        size_t count = 0;
        for (size_t i = 0; i < incidents && density && probes; i++) {
            const double theta_i = tensor_at(&theta, i);
            for (size_t k = 0; k < cells; k++)
                density[k] = tensor_at(&vndf, i * cells + k);
            if (!(theta_i >= 0 && theta_i < 85 * PI / 180) ||
                !warp_make(&to, density, (int)vndf.shape[3], (int)vndf.shape[2]))
                continue;
            count += probe_incident(&values, i, theta_i, &to, found, probes + count);
            warp_free(&to);
        }
        if (model_reflectance(probes, count, &fitted))
            note(file, "f0 %.4g\nf90 %.4g\nresidual_reflectance %.3g", fitted.f0, fitted.f90, fitted.residual);
        free(probes);
        free(density);
    }
    if (good)
        file->refused[0] = '\0';
    free(found);
    vndf_source_free(source);
    return good;
}

int rgl_read(data_file *file, profile *rows)
{
    *rows = (profile){0};
    if (read_ndf(file, rows) && profile_smooth(rows, file) && note_light(file, rows))
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

/* D, its areas, and of visible normals what does not depend on wi: D max(0, wi.m) over the unit square is, but for a
 * constant, the positive part of cos(theta_i) along + sin(theta_i) cos(phi) across. At 90 degrees D may have no
 * bound: the last number gives its cell, which is linear in u, the integral of D. */
static void fill_ndf(rgl_arrays *a)
{
    enum { PARTS = 64 };
    double last = 0;
    for (int i = 0; i < NORMALS; i++)
        a->ndf[0][i] = (float)model_ndf(a->surface, angle_at(i, NORMALS));
    for (int i = 0; i < PARTS; i++)
        last += 2 * model_ndf(a->surface, angle_at(NORMALS - 1 + (i + 0.5) / PARTS, NORMALS)) / PARTS;
    a->ndf[0][NORMALS] = (float)fmax(last - (double)a->ndf[0][NORMALS - 1], 0);
    for (int i = 0; i < AREAS; i++)
        a->sigma[0][i] = (float)model_area(a->surface, angle_at(i, AREAS - 1));
    memcpy(a->ndf[1], a->ndf[0], sizeof a->ndf[0]);
    memcpy(a->sigma[1], a->sigma[0], sizeof a->sigma[0]);
    for (int i = 0; i <= NORMALS; i++) {
        double theta = angle_at(i, NORMALS), part = (double)a->ndf[0][i] * i / NORMALS * sin(theta);
        a->along[i] = part * fmax(cos(theta), 0);
        a->across[i] = part * sin(theta);
    }
}

static double area_of_surface(const void *of, double theta)
{
    return model_area(of, theta);
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
        a->is_seen[i] = model_at(area_of_surface, a->surface, theta_i, u, v, &left, &rise) ? 1.0f : 0.0f;
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
