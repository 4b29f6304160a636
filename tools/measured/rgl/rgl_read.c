/* D of a .bsdf, and how well it explains what the file holds beside it. */
#include <math.h>
#include <stdlib.h>

#include "measured/model.h"
#include "measured/rgl/rgl.h"
#include "measured/rgl/fields.h"
#include "measured/rgl/warp.h"

enum { ANGLES_LEAST = 8, ANGLES_MOST = 65536, GRID_MOST = 4096, PROBES = 24 };

static const double pi = 3.14159265358979323846;

static double angle_at(double u)
{
    return pi / 2 * u * u;
}

/* ---- D ------------------------------------------------------------------------------------------- */

/* Azimuths begin and end at the same place. */
static double weight_of(size_t row, size_t rows)
{
    return rows > 2 && (row == 0 || row + 1 == rows) ? 0.5 : 1;
}

static double mean_at(const tensor_field *field, size_t column)
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
static double anisotropy_of(const tensor_field *ndf)
{
    size_t rows = ndf->shape[0], columns = ndf->shape[1];
    double off = 0, whole = 0;
    for (size_t j = 0; j < columns; j++) {
        double u = (double)j / (double)(columns - 1), theta = angle_at(u), mean = mean_at(ndf, j);
        double area = fmax(cos(theta), 0) * sin(theta) * u;
        for (size_t i = 0; i < rows; i++) {
            off += weight_of(i, rows) * fabs(tensor_at(ndf, i * columns + j) - mean) * area;
            whole += weight_of(i, rows) * mean * area;
        }
    }
    return whole > 0 ? off / 2 / whole : 0;
}

static int are_numbers(const tensor_field *field, const char *name, refusal *why)
{
    for (size_t i = 0; i < field->count; i++) {
        double value = tensor_at(field, i);
        if (!isfinite(value) || value < 0)
            return refuse_data(why, name, "number %zu of field '%s' is %.6g; it must be finite and not negative",
                               i, field->name, value);
    }
    return 1;
}

const tensor_field *rgl_ndf(const tensor_file *file, const char *name, refusal *why)
{
    const tensor_field *ndf = tensor_floats(file, "ndf", 2, name, why);
    if (!ndf || !are_numbers(ndf, name, why))
        return NULL;
    if (ndf->shape[0] >= 1 && ndf->shape[1] >= ANGLES_LEAST && ndf->shape[1] <= ANGLES_MOST)
        return ndf;
    refuse_data(why, name, "field 'ndf' is %zu x %zu; it needs from %d to %d angles", ndf->shape[0], ndf->shape[1],
                ANGLES_LEAST, ANGLES_MOST);
    return NULL;
}

static int read_rows(profile *rows, const tensor_field *ndf, const char *name, refusal *why)
{
    size_t count = ndf->shape[1];
    if (!profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, count))
        return refuse_data(why, name, "there is no memory for %zu rows", count);
    for (size_t j = 0; j < count; j++) {
        rows->x[j] = angle_at((double)j / (double)(count - 1));
        rows->value[j] = mean_at(ndf, j);
    }
    return 1;
}

/* ---- residuals ----------------------------------------------------------------------------------- */

/* The largest difference of sigma from the area of D, both scaled alike, over 0 to 85 degrees; relative. */
static void note_sigma(const tensor_file *file, const vndf_surface *surface, const char *name, notes *to)
{
    refusal ignored;
    const tensor_field *sigma = tensor_floats(file, "sigma", 2, name, &ignored);
    double both = 0, square = 0, worst = 0;
    if (!sigma || sigma->shape[1] < 2 || sigma->shape[1] > ANGLES_MOST || sigma->shape[0] < 1)
        return;
    for (int pass = 0; pass < 2; pass++)
        for (size_t j = 0; j < sigma->shape[1]; j++) {
            double theta = angle_at((double)j / (double)(sigma->shape[1] - 1));
            double area = model_area(surface, direction_at(theta, 0)), found = mean_at(sigma, j);
            if (theta > 85 * pi / 180)
                break;
            both += pass == 0 ? area * found : 0;
            square += pass == 0 ? area * area : 0;
            if (pass == 1)
                worst = fmax(worst, fabs(found * square / both / area - 1));
        }
    note(to, "residual_sigma %.3g", worst);
}

/* What is reflected at a place of the file, and what the model has there with F = 1 - rise and F = rise. */
typedef struct reflected {
    double found, low, high;
} reflected;

typedef struct probes {
    const tensor_field *theta_i, *vndf, *values; /* values: rgb or spectra */
    const vndf_surface *surface;
    reflected *at; /* owned */
    size_t count;
} probes;

static int is_flag(const tensor_file *file, const char *field)
{
    const tensor_field *found = tensor_find(file, field);
    return found && found->type == TENSOR_U8 && found->count == 1 && found->data[0] == 1;
}

/* The fields that are needed, of lengths that fit each other. */
static int open_probes(probes *p, const tensor_file *file, const char *name)
{
    refusal ignored;
    p->theta_i = tensor_floats(file, "theta_i", 1, name, &ignored);
    p->vndf = tensor_floats(file, "vndf", 4, name, &ignored);
    p->values = tensor_floats(file, "rgb", 5, name, &ignored);
    if (!p->values)
        p->values = tensor_floats(file, "spectra", 5, name, &ignored);
    if (!p->theta_i || !p->vndf || !p->values || !is_flag(file, "jacobian"))
        return 0;
    const size_t *v = p->vndf->shape, *s = p->values->shape;
    for (size_t i = 0; i < p->vndf->count; i++)
        if (!(tensor_at(p->vndf, i) >= 0))
            return 0;
    return v[0] > 0 && s[0] > 0 && v[1] == p->theta_i->count && s[1] == v[1] && v[2] >= 2 && v[3] >= 2 &&
           s[2] > 0 && s[3] >= 2 && s[4] >= 2 && v[2] <= GRID_MOST && v[3] <= GRID_MOST && s[3] <= GRID_MOST &&
           s[4] <= GRID_MOST;
}

/* The mean of the channels at a point of the grid of one incident direction; what is negative is noise. */
static double found_at(const probes *p, size_t incident, size_t row, size_t column)
{
    const size_t *s = p->values->shape;
    double sum = 0;
    for (size_t channel = 0; channel < s[2]; channel++) {
        double value = tensor_at(p->values, ((incident * s[2] + channel) * s[3] + row) * s[4] + column);
        sum += isfinite(value) ? fmax(value, 0) / (double)s[2] : 0;
    }
    return sum;
}

static void probe(probes *p, const warp *to, double theta_i, size_t incident, size_t row, size_t column)
{
    const size_t *s = p->values->shape;
    double u, v;
    warp_sample(to, (double)column / (double)(s[4] - 1), (double)row / (double)(s[3] - 1), &u, &v);
    direction wi = direction_at(theta_i, 0), m = direction_at(angle_at(u), (2 * v - 1) * pi);
    direction wo = direction_mirrored(wi, m);
    double left = model_masked(model_area(p->surface, wi), wi.z, model_area(p->surface, wo), wo.z);
    double rise = model_schlick(fmax(direction_dot(wi, m), 0));
    if (wo.z > 0)
        p->at[p->count++] = (reflected){found_at(p, incident, row, column), left * (1 - rise), left * rise};
}

/* Of up to PROBES x PROBES places for one incident direction. */
static void probe_incident(probes *p, size_t incident, double *density)
{
    const size_t *s = p->values->shape, *v = p->vndf->shape;
    double theta_i = tensor_at(p->theta_i, incident);
    warp to;
    if (!(theta_i >= 0 && theta_i < 85 * pi / 180))
        return;
    for (size_t i = 0; i < v[2] * v[3]; i++)
        density[i] = tensor_at(p->vndf, incident * v[2] * v[3] + i);
    if (!warp_make(&to, density, (int)v[3], (int)v[2]))
        return;
    for (size_t i = 0; i < PROBES && i < s[3]; i++)
        for (size_t j = 0; j < PROBES && j < s[4]; j++) {
            size_t row = s[3] <= PROBES ? i : (2 * i + 1) * s[3] / (2 * PROBES);
            size_t column = s[4] <= PROBES ? j : (2 * j + 1) * s[4] / (2 * PROBES);
            probe(p, &to, theta_i, incident, row, column);
        }
    warp_free(&to);
}

/* The F0 and F90 whose reflectances are nearest, by least squares, and the part of the light that they miss. */
static void note_reflected(const probes *p, notes *to)
{
    double aa = 0, ab = 0, bb = 0, fa = 0, fb = 0, off = 0, whole = 0;
    for (size_t i = 0; i < p->count; i++) {
        const reflected *r = &p->at[i];
        aa += r->low * r->low;
        ab += r->low * r->high;
        bb += r->high * r->high;
        fa += r->found * r->low;
        fb += r->found * r->high;
    }
    double det = aa * bb - ab * ab, f0 = (fa * bb - fb * ab) / det, f90 = (fb * aa - fa * ab) / det;
    for (size_t i = 0; i < p->count; i++) {
        off += fabs(p->at[i].found - f0 * p->at[i].low - f90 * p->at[i].high) / 2;
        whole += p->at[i].found;
    }
    if (!(det > 0) || !(whole > 0))
        return;
    note(to, "f0 %.4g", f0);
    note(to, "f90 %.4g", f90);
    note(to, "residual_reflectance %.3g", off / whole);
}

void rgl_residuals(const vndf_surface *surface, const char *name, const unsigned char *bytes, size_t size,
                   notes *to)
{
    tensor_file file;
    refusal ignored;
    probes p = {NULL, NULL, NULL, surface, NULL, 0};
    if (!tensor_read(&file, name, bytes, size, &ignored))
        return;
    note_sigma(&file, surface, name, to);
    if (!open_probes(&p, &file, name))
        return;
    double *density = malloc(p.vndf->shape[2] * p.vndf->shape[3] * sizeof *density);
    p.at = malloc(p.theta_i->count * PROBES * PROBES * sizeof *p.at);
    for (size_t i = 0; i < p.theta_i->count && density && p.at; i++)
        probe_incident(&p, i, density);
    note_reflected(&p, to);
    free(p.at);
    free(density);
}

/* ---- the whole ----------------------------------------------------------------------------------- */

int rgl_read(profile *rows, const char *name, const unsigned char *bytes, size_t size, notes *to, refusal *why)
{
    tensor_file file;
    *rows = (profile){VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, NULL, NULL, 0, NULL};
    if (!tensor_read(&file, name, bytes, size, why))
        return 0;
    const tensor_field *ndf = rgl_ndf(&file, name, why);
    if (!ndf)
        return 0;
    double anisotropy = anisotropy_of(ndf);
    if (anisotropy > RGL_ANISOTROPY_MOST)
        return refuse_data(
            why, name,
            "D is anisotropic: %.3g of all normals would have to turn about z to make it isotropic, %.3g "
            "is the most; --matrix fits the matrix of an isotropic one",
            anisotropy, RGL_ANISOTROPY_MOST);
    if (!read_rows(rows, ndf, name, why))
        return 0;
    note(to, "ndf %zu x %zu", ndf->shape[0], ndf->shape[1]);
    note(to, "residual_isotropy %.3g", anisotropy);
    return 1;
}
