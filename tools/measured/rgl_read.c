/* D of a .bsdf, and how well it explains what the file holds beside it. */
#include <math.h>
#include <stdlib.h>

#include "measured/grid.h"
#include "measured/model.h"
#include "measured/brdf.h"
#include "measured/slopes.h"
#include "measured/tensor.h"

enum { ANGLES_LEAST = 8, ANGLES_MOST = 65536, GRID_MOST = 4096, PROBES = 24, DRAWN = 1 << 18 };

static const double pi = 3.14159265358979323846;

static double angle_at(size_t column, size_t columns)
{
    double u = (double)column / (double)(columns - 1);
    return pi / 2 * u * u;
}

/* The field `ndf`, azimuths by angles. */
static int find_ndf(data_file *file, tensor *ndf)
{
    if (!tensor_find(file, "ndf", TENSOR_F32, 2, ndf))
        return 0;
    if (ndf->shape[0] < 1 || ndf->shape[1] < ANGLES_LEAST || ndf->shape[1] > ANGLES_MOST)
        return refuse(file, "field 'ndf' is %zu x %zu; it needs from %d to %d angles", ndf->shape[0],
                      ndf->shape[1], ANGLES_LEAST, ANGLES_MOST);
    for (size_t i = 0; i < tensor_count(ndf); i++)
        if (!(tensor_at(ndf, i) >= 0) || isinf(tensor_at(ndf, i)))
            return refuse(file, "number %zu of field 'ndf' is %.6g; it must be finite and not negative", i,
                          tensor_at(ndf, i));
    note(file, "ndf %zu x %zu", ndf->shape[0], ndf->shape[1]);
    return 1;
}

/* Azimuths begin and end at the same place. */
static double weight_of(size_t row, size_t rows)
{
    return rows > 2 && (row == 0 || row + 1 == rows) ? 0.5 : 1;
}

static double mean_at(const tensor *field, size_t column)
{
    size_t rows = field->shape[0];
    double sum = 0, whole = 0;
    for (size_t i = 0; i < rows; i++) {
        sum += weight_of(i, rows) * tensor_at(field, i * field->shape[1] + column);
        whole += weight_of(i, rows);
    }
    return sum / whole;
}

/* The part of all normals that would have to turn about z. */
static double anisotropy_of(const tensor *ndf)
{
    size_t rows = ndf->shape[0], columns = ndf->shape[1];
    double off = 0, whole = 0;
    for (size_t j = 0; j < columns; j++) {
        double theta = angle_at(j, columns), mean = mean_at(ndf, j);
        double area = fmax(cos(theta), 0) * sin(theta) * (double)j;
        for (size_t i = 0; i < rows; i++) {
            off += weight_of(i, rows) * fabs(tensor_at(ndf, i * columns + j) - mean) * area;
            whole += weight_of(i, rows) * mean * area;
        }
    }
    return whole > 0 ? off / 2 / whole : 0;
}

/* ---- residuals ----------------------------------------------------------------------------------- */

/* The largest difference of sigma from the area of D, both scaled alike, over 0 to 85 degrees; relative. */
static void note_sigma(data_file *file, const law *found)
{
    tensor sigma;
    double both = 0, square = 0, worst = 0;
    if (!tensor_find(file, "sigma", TENSOR_F32, 2, &sigma) || sigma.shape[0] < 1 || sigma.shape[1] < 2 ||
        sigma.shape[1] > ANGLES_MOST)
        return;
    for (int pass = 0; pass < 2; pass++)
        for (size_t j = 0; j < sigma.shape[1] && angle_at(j, sigma.shape[1]) <= 85 * pi / 180; j++) {
            double area = law_area(found, angle_at(j, sigma.shape[1])), given = mean_at(&sigma, j);
            both += pass == 0 ? area * given : 0;
            square += pass == 0 ? area * area : 0;
            if (pass == 1)
                worst = fmax(worst, fabs(given * square / both / area - 1));
        }
    if (isfinite(worst))
        note(file, "residual_sigma %.3g", worst);
}

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
    for (size_t channel = 0; channel < s[2]; channel++) {
        double value = tensor_at(&light->values, ((incident * s[2] + channel) * s[3] + row) * s[4] + column);
        found += isfinite(value) ? fmax(value, 0) / (double)s[2] : 0;
    }
    warp_sample(to, (double)column / (double)(s[4] - 1), (double)row / (double)(s[3] - 1), &u, &v);
    direction wi = direction_at(theta_i, 0), m = direction_at(pi / 2 * u * u, (2 * v - 1) * pi);
    direction wo = direction_mirrored(wi, m);
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

static void note_light(data_file *file, const law *found)
{
    measured_light light = {.law = found};
    reflectance fitted;
    if (!find_light(file, &light))
        return;
    double *density = malloc(light.vndf.shape[2] * light.vndf.shape[3] * sizeof *density);
    light.probes = malloc((light.theta_i.shape[0] * PROBES * PROBES + 1) * sizeof *light.probes);
    for (size_t i = 0; i < light.theta_i.shape[0] && density && light.probes; i++)
        probe_incident(&light, i, density);
    if (model_reflectance(light.probes, light.count, &fitted)) {
        note(file, "f0 %.4g", fitted.f0);
        note(file, "f90 %.4g", fitted.f90);
        note(file, "residual_reflectance %.3g", fitted.residual);
    }
    free(light.probes);
    free(density);
}

/* ---- an isotropic D ------------------------------------------------------------------------------ */

/* Fields that the residuals need and that are not there, or not right, are no reason to refuse D. */
static int note_residuals(data_file *file, const profile *rows)
{
    vndf_source *source = profile_source(rows, file);
    law *found = malloc(sizeof *found);
    int good = source && (found || refuse(file, "there is no memory"));
    if (good && law_of_source(found, source) > 0) {
        note_sigma(file, found);
        note_light(file, found);
        file->refused[0] = '\0';
    }
    free(found);
    vndf_source_free(source);
    return good;
}

int rgl_read(data_file *file, profile *rows)
{
    tensor ndf;
    *rows = (profile){0};
    if (!find_ndf(file, &ndf))
        return 0;
    double anisotropy = anisotropy_of(&ndf);
    if (anisotropy > RGL_ANISOTROPY_MOST)
        return refuse(
            file,
            "D is anisotropic: %.3g of all normals would have to turn about z to make it isotropic, %.3g is "
            "the most; --matrix fits the matrix of an isotropic one",
            anisotropy, RGL_ANISOTROPY_MOST);
    note(file, "residual_isotropy %.3g", anisotropy);
    if (!profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, ndf.shape[1], file))
        return 0;
    for (size_t j = 0; j < rows->count; j++) {
        rows->x[j] = angle_at(j, rows->count);
        rows->value[j] = mean_at(&ndf, j);
    }
    if (profile_smooth(rows, file) && note_residuals(file, rows))
        return 1;
    profile_free(rows);
    return 0;
}

/* ---- an anisotropic one -------------------------------------------------------------------------- */

/* Bits in the reverse order: van der Corput's numbers. */
static double reversed(unsigned i)
{
    double value = 0, digit = 0.5;
    for (; i; i >>= 1, digit /= 2)
        value += (i & 1u) * digit;
    return value;
}

/* Normals as D cos has them, through the warp of the grid that D stands on: D cos dm is D cos sin u, but for a
 * constant, over the unit square. DRAWN points of Hammersley's, finest along theta, over all parts of the set. */
static int draw_slopes(data_file *file, const tensor *ndf, double *density, slope_set *made)
{
    size_t rows = ndf->shape[0], columns = ndf->shape[1];
    warp from;
    for (size_t i = 0; i < rows * columns; i++) {
        double theta = angle_at(i % columns, columns);
        density[i] = tensor_at(ndf, i) * fmax(cos(theta), 0) * sin(theta) * sqrt(theta);
    }
    if (!warp_make(&from, density, (int)columns, (int)rows))
        return refuse(file, "D is 0 everywhere");
    for (unsigned i = 0; i < DRAWN; i++) {
        double u, v;
        warp_sample(&from, (i + 0.5) / DRAWN, reversed(i) + 0.5 / DRAWN, &u, &v);
        double r = tan(fmin(pi / 2 * u * u, pi / 2 - 1e-9)), phi = (2 * v - 1) * pi;
        slopes_add(made, -r * cos(phi), -r * sin(phi), (int)(i * 2654435761u >> 16 & (SLOPE_PARTS - 1)));
    }
    warp_free(&from);
    return 1;
}

int rgl_read_matrix(data_file *file, profile *rows)
{
    tensor ndf;
    slope_set slopes;
    *rows = (profile){0};
    if (!find_ndf(file, &ndf))
        return 0;
    if (ndf.shape[0] < 2 || ndf.shape[0] > GRID_MOST)
        return refuse(file, "field 'ndf' has %zu azimuths; from 2 to %d are needed", ndf.shape[0], GRID_MOST);
    if (!slopes_make(&slopes, DRAWN, file))
        return 0;
    double *density = malloc(tensor_count(&ndf) * sizeof *density);
    int good = density ? draw_slopes(file, &ndf, density, &slopes) : refuse(file, "there is no memory");
    free(density);
    good = good && slopes_law(&slopes, file, rows);
    slopes_free(&slopes);
    return good;
}
