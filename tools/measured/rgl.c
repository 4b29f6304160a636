/* A .bsdf in and out; brdf.h says what its fields are.
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

static const double pi = 3.14159265358979323846;

/* Where u = part/whole lies. */
static double angle_at(double part, double whole)
{
    double u = part / whole;
    return pi / 2 * u * u;
}

/* What wi at theta_i sees at (u, v) of the vndf: its normal and wo. */
static void directions_at(double theta_i, double u, double v, direction *wi, direction *m, direction *wo)
{
    *wi = direction_at(theta_i, 0);
    *m = direction_at(angle_at(u, 1), (2 * v - 1) * pi);
    *wo = direction_mirrored(*wi, *m);
}

/* ---- in: D --------------------------------------------------------------------------------------- */

/* Azimuths begin and end at the same place. */
static double weight_of(size_t row, size_t rows)
{
    return rows > 2 && (row == 0 || row + 1 == rows) ? 0.5 : 1;
}

/* The mean over azimuths; *off: the mean difference from it. */
static double mean_at(const tensor *field, size_t column, double *off)
{
    size_t rows = field->shape[0], columns = field->shape[1];
    double sum = 0, whole = 0;
    for (size_t i = 0; i < rows; i++) {
        sum += weight_of(i, rows) * tensor_at(field, i * columns + column);
        whole += weight_of(i, rows);
    }
    *off = 0;
    for (size_t i = 0; i < rows; i++)
        *off += weight_of(i, rows) / whole * fabs(tensor_at(field, i * columns + column) - sum / whole);
    return sum / whole;
}

/* The means of the field `ndf`, unless D is too anisotropic. */
static int read_ndf(data_file *file, profile *rows)
{
    tensor ndf;
    double off = 0, whole = 0, here;
    if (!tensor_find(file, "ndf", TENSOR_F32, 2, &ndf))
        return 0;
    if (ndf.shape[0] < 1 || ndf.shape[1] < ANGLES_LEAST || ndf.shape[1] > ANGLES_MOST)
        return refuse(file, "field 'ndf' is %zu x %zu; it needs from %d to %d angles", ndf.shape[0], ndf.shape[1],
                      ANGLES_LEAST, ANGLES_MOST);
    for (size_t i = 0; i < tensor_count(&ndf); i++)
        if (!(tensor_at(&ndf, i) >= 0) || isinf(tensor_at(&ndf, i)))
            return refuse(file, "number %zu of field 'ndf' is %.6g; it must be finite and not negative", i,
                          tensor_at(&ndf, i));
    note(file, "ndf %zu x %zu", ndf.shape[0], ndf.shape[1]);
    if (!profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, ndf.shape[1], file))
        return 0;
    for (size_t j = 0; j < rows->count; j++) {
        double theta = rows->x[j] = angle_at((double)j, (double)(rows->count - 1));
        double area = fmax(cos(theta), 0) * sin(theta) * (double)j;
        rows->value[j] = mean_at(&ndf, j, &here);
        off += here * area;
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

/* ---- in: how well D explains the light ----------------------------------------------------------- */

typedef struct measured_light {
    tensor theta_i, vndf, values; /* values: rgb or spectra */
    const law *law;
    probe *probes; /* owned */
    size_t count;
} measured_light;

/* The fields that are needed, of lengths that fit each other. */
static int find_light(data_file *file, measured_light *light)
{
    tensor flag;
    if (!tensor_find(file, "theta_i", TENSOR_F32, 1, &light->theta_i) ||
        !tensor_find(file, "vndf", TENSOR_F32, 4, &light->vndf) ||
        !(tensor_find(file, "rgb", TENSOR_F32, 5, &light->values) ||
          tensor_find(file, "spectra", TENSOR_F32, 5, &light->values)) ||
        !tensor_find(file, "jacobian", TENSOR_U8, 1, &flag) || flag.shape[0] != 1 ||
        *(const unsigned char *)flag.data != 1)
        return 0;
    const size_t *v = light->vndf.shape, *s = light->values.shape;
    for (size_t i = 0; i < tensor_count(&light->vndf); i++)
        if (!(tensor_at(&light->vndf, i) >= 0))
            return 0;
    return v[0] > 0 && s[0] > 0 && v[1] == light->theta_i.shape[0] && s[1] == v[1] && v[2] >= 2 && v[3] >= 2 &&
           s[2] > 0 && s[3] >= 2 && s[4] >= 2 && v[2] <= GRID_MOST && v[3] <= GRID_MOST && s[3] <= GRID_MOST &&
           s[4] <= GRID_MOST;
}

/* At a point of the grid of one incident direction: the mean of the channels, of which negative ones are noise, and R
 * of the model. */
static void probe_at(measured_light *light, const warp *to, size_t incident, size_t row, size_t column)
{
    const size_t *s = light->values.shape;
    double u, v, found = 0, theta_i = tensor_at(&light->theta_i, incident);
    direction wi, m, wo;
    for (size_t channel = 0; channel < s[2]; channel++) {
        double value = tensor_at(&light->values, ((incident * s[2] + channel) * s[3] + row) * s[4] + column);
        found += isfinite(value) ? fmax(value, 0) / (double)s[2] : 0;
    }
    warp_sample(to, (double)column / (double)(s[4] - 1), (double)row / (double)(s[3] - 1), &u, &v);
    directions_at(theta_i, u, v, &wi, &m, &wo);
    if (!(wo.z > 0))
        return;
    double area_o = law_area(light->law, acos(fmin(wo.z, 1)));
    double left = model_masked(law_area(light->law, theta_i), wi.z, area_o, wo.z);
    double rise = model_schlick(fmax(direction_dot(wi, m), 0));
    light->probes[light->count++] = (probe){found, left * (1 - rise), left * rise, 1, 1};
}

/* Of up to PROBES x PROBES places for one incident direction. */
static void probe_incident(measured_light *light, size_t incident, double *density)
{
    const size_t *s = light->values.shape, *v = light->vndf.shape;
    double theta_i = tensor_at(&light->theta_i, incident);
    warp to;
    for (size_t i = 0; i < v[2] * v[3]; i++)
        density[i] = tensor_at(&light->vndf, incident * v[2] * v[3] + i);
    if (!(theta_i >= 0 && theta_i < 85 * pi / 180) || !warp_make(&to, density, (int)v[3], (int)v[2]))
        return;
    for (size_t i = 0; i < PROBES && i < s[3]; i++)
        for (size_t j = 0; j < PROBES && j < s[4]; j++)
            probe_at(light, &to, incident, s[3] <= PROBES ? i : (2 * i + 1) * s[3] / (2 * PROBES),
                     s[4] <= PROBES ? j : (2 * j + 1) * s[4] / (2 * PROBES));
    warp_free(&to);
}

/* Fields that are not there, or not right, are no reason to refuse D. */
static int note_light(data_file *file, const profile *rows)
{
    vndf_source *source = profile_source(rows, file);
    law *found = source ? malloc(sizeof *found) : NULL;
    measured_light light = {.law = found};
    reflectance fitted;
    int good = found || (source && refuse(file, "there is no memory"));
    if (good && law_of_source(found, source) > 0 && find_light(file, &light)) {
        double *density = malloc(light.vndf.shape[2] * light.vndf.shape[3] * sizeof *density);
        light.probes = malloc((light.theta_i.shape[0] * PROBES * PROBES + 1) * sizeof *light.probes);
        for (size_t i = 0; i < light.theta_i.shape[0] && density && light.probes; i++)
            probe_incident(&light, i, density);
        if (model_reflectance(light.probes, light.count, &fitted))
            note(file, "f0 %.4g\nf90 %.4g\nresidual_reflectance %.3g", fitted.f0, fitted.f90, fitted.residual);
        free(light.probes);
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
    const rgl_form *form;
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

/* The visible normals of one incident direction: the mean over the cells on both sides of each point, weighed by a
 * hat. */
static void fill_density(rgl_arrays *a, int incident)
{
    double theta_i = (double)a->theta_i[incident];
    for (int row = 0; row < PHIS; row++)
        for (int column = 0; column < THETAS; column++) {
            double sum = 0, whole = 0, across = sin(theta_i) * cos((2.0 * row / (PHIS - 1) - 1) * pi);
            for (int i = column * FINE - FINE + 1; i < column * FINE + FINE; i++) {
                double weight = FINE - abs(i - column * FINE);
                if (i < 0 || i > NORMALS)
                    continue;
                sum += weight * fmax(cos(theta_i) * a->along[i] + across * a->across[i], 0);
                whole += weight;
            }
            a->density[row][column] = sum / whole;
            a->vndf[incident][row][column] = (float)a->density[row][column];
        }
}

static void look_up(rgl_arrays *a, const warp *to, double theta_i, double f0)
{
    double area_i = model_area(a->surface, theta_i), u, v;
    direction wi, m, wo;
    for (int i = 0; i < FINE_SIDE * FINE_SIDE; i++) {
        warp_sample(to, (i % FINE_SIDE + 0.5) / FINE_SIDE, ((double)(i / FINE_SIDE) + 0.5) / FINE_SIDE, &u, &v);
        directions_at(theta_i, u, v, &wi, &m, &wo);
        double rise = model_schlick(fmax(direction_dot(wi, m), 0)), area_o = 0;
        if (wo.z > 0)
            area_o = model_area(a->surface, acos(fmin(wo.z, 1)));
        double left = model_masked(area_i, fmax(wi.z, 0), area_o, wo.z);
        a->low[i] = (float)(left * (1 - rise));
        a->high[i] = (float)(left * rise);
        a->light[i] = (float)(left * (f0 * (1 - rise) + rise));
        a->is_seen[i] = wo.z > 0;
    }
}

/* What is reflected from one incident direction. Luminance, by which hosts may draw, is not 0 where a neighbour is
 * not. */
static int fill_reflected(rgl_arrays *a, int incident)
{
    const rgl_form *form = a->form;
    double f0 = 0.2126 * form->f0[0] + 0.7152 * form->f0[1] + 0.0722 * form->f0[2];
    warp to;
    for (int i = 0; i < form->channels && form->is_spectral; i++)
        f0 = (i ? f0 : 0) + form->f0[i] / form->channels;
    fill_density(a, incident);
    if (!warp_make(&to, &a->density[0][0], THETAS, PHIS))
        return 0;
    look_up(a, &to, (double)a->theta_i[incident], f0);
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
        a->form = form;
        fill_ndf(a);
    }
    for (int i = 0; i < INCIDENTS && good; i++) { /* closest to grazing incidence, where most changes */
        double left = 1 - (double)i / (INCIDENTS - 1);
        a->theta_i[i] = (float)(pi / 2 * (1 - left * left));
        good = fill_reflected(a, i);
    }
    good = good && write_arrays(file, a, form);
    free(a);
    return good;
}
