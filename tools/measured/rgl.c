/* The .bsdf files of EPFL's realistic graphics lab (J. Dupuy, W. Jakob, "An Adaptive Parameterization for Efficient
 * Material Acquisition and Rendering", TOG 37(6), 2018), which Mitsuba 3 (plugin `measured`) and pbrt-v4 render. They
 * are lists of fields: "tensor_file\0", the version 1.0 as two bytes, the number of fields (u32), then for each the
 * length of its name (u16), the name, the number of dimensions (u16), a type (u8), where its numbers begin (u64) and
 * the length of each dimension (u64), the slowest first. All numbers have the least byte first.
 *
 * An angle theta from z stands at u = sqrt(2 theta/pi), an azimuth phi at v = (phi + pi)/(2 pi); of an isotropic
 * material azimuths of normals are counted from wi.
 *
 *     theta_i [n], phi_i [1]     incident directions, radians
 *     ndf [2][.]                 D over u: the material's own, at any scale
 *     sigma [2][.]               projected area A over u of wi, at the same scale
 *     vndf [1][n][v][u]          a density on the unit square: its warp, u last, sends (x, y) to a normal (u, v)
 *     luminance [1][n][y][x]     the density of (x, y), by which hosts draw
 *     rgb or spectra [1][n](channels)[y][x]: f cos_o 4 A/D at the normal where the warp sends (x, y)
 *     wavelengths                of spectra, nm
 *     jacobian [1] = 1           rgb and spectra are still to be multiplied by D/(4 A)
 *
 * Written is a warp that leaves v alone and is the same for all incident directions: x goes by the square root of D, so
 * that tails have places, too. What is left to the luminance, (wi.m) sqrt(D) and what is reflected, is smooth. */
#include <stdlib.h>
#include <string.h>

#include "measured/measured.h"
#include "render/vector.h"

static const unsigned char head[14] = "tensor_file\0\1\0";
enum { HEAD = sizeof head + 4, ANGLES_LEAST = 8, ANGLES_MOST = 65536 };
static const double anisotropy_most = 0.05;
enum { NORMALS = 2048, INCIDENTS = 48, AREAS = 257, SIDE = 64 };

static size_t tensor_count(const tensor *of)
{
    size_t count = 1;
    for (int i = 0; i < of->dimensions; i++)
        count *= of->shape[i];
    return count;
}

static double angle_at(double part, double whole)
{
    const double u = part / whole;
    return PI / 2 * u * u;
}

/* ---- in ------------------------------------------------------------------------------------------ */

double tensor_at(const tensor *of, size_t i)
{
    return little_number((const unsigned char *)of->data + 4 * i, 4);
}

int tensor_find(data_file *file, const char *name, int dimensions, tensor *found)
{
    const unsigned char *b = file->bytes;
    if (file->size < HEAD || memcmp(b, head, sizeof head) != 0)
        return refuse(file, "this is no tensor file of version 1.0; it would begin with tensor_file");
    const unsigned long count = (unsigned long)little_whole(b + sizeof head, 4);
    size_t at = HEAD;
    for (unsigned long i = 0; i < count; i++) {
        const size_t left = file->size - at, length = left >= 2 ? (size_t)little_whole(b + at, 2) : 0;
        const unsigned char *text = b + at + 2, *behind = text + length, *sides = behind + 11;
        const int many = left >= 2 + length + 11 ? (int)little_whole(behind, 2) : 0;
        if (left < 2 + length + 11 + 8 * (size_t)many)
            return refuse(file, "the list of fields is cut off at field %lu of %lu", i + 1, count);
        at += 2 + length + 11 + 8 * (size_t)many;
        if (length != strlen(name) || memcmp(text, name, length) != 0)
            continue;
        if (many != dimensions || behind[2] != TENSOR_F32)
            return refuse(file, "field '%s' has the type %d and %d dimensions; the type %d and %d are needed",
                          name, behind[2], many, TENSOR_F32, dimensions);
        const uint64_t begin = little_whole(behind + 3, 8);
        if (begin > file->size)
            return refuse(file, "the numbers of field '%s' begin behind the end of the file", name);
        uint64_t room = (file->size - begin) / 4;
        *found = (tensor){.name = name, .type = TENSOR_F32, .dimensions = dimensions, .data = b + begin};
        for (int d = 0; d < many; d++, room /= found->shape[d - 1] ? found->shape[d - 1] : 1)
            if ((found->shape[d] = (size_t)little_whole(sides + 8 * d, 8)) > room)
                return refuse(file, "the file ends before the numbers of field '%s' do", name);
        return 1;
    }
    return refuse(file, "it has no field '%s'", name);
}

/* Rows are the means of the field `ndf` over azimuths, which begin and end at the same place, unless D is too
 * anisotropic. */
static int read_ndf(data_file *file, const tensor *ndf, profile *rows)
{
    const size_t azimuths = ndf->shape[0], angles = ndf->shape[1];
    const double ends = azimuths > 2 ? 0.5 : 1, all = (double)azimuths - (azimuths > 2);
    double off = 0, whole = 0;
    for (size_t j = 0; j < angles; j++) {
        const double theta = rows->x[j] = angle_at((double)j, (double)(angles - 1));
        const double area = fmax(cos(theta), 0) * sin(theta) * (double)j;
        for (size_t i = 0; i < azimuths; i++) {
            const double value = tensor_at(ndf, i * angles + j);
            if (!(value >= 0) || isinf(value))
                return refuse(file, "number %zu of field 'ndf' is %.6g; it must be finite and not negative",
                              i * angles + j, value);
            rows->value[j] += (i == 0 || i + 1 == azimuths ? ends : 1) / all * value;
        }
        for (size_t i = 0; i < azimuths; i++)
            off += (i == 0 || i + 1 == azimuths ? ends : 1) / all * area *
                   fabs(tensor_at(ndf, i * angles + j) - rows->value[j]);
        whole += rows->value[j] * area;
    }
    off = whole > 0 ? off / 2 / whole : 0;
    note(file, "ndf %zu x %zu\nresidual_isotropy %.3g", azimuths, angles, off);
    return off <= anisotropy_most ||
           refuse(file, "D is anisotropic: %.3g of all normals would have to turn about z, %.3g is the most", off,
                  anisotropy_most);
}

int rgl_read(data_file *file, profile *rows)
{
    tensor ndf;
    *rows = (profile){0};
    if (!tensor_find(file, "ndf", 2, &ndf))
        return 0;
    if (ndf.shape[0] < 1 || ndf.shape[1] < ANGLES_LEAST || ndf.shape[1] > ANGLES_MOST)
        return refuse(file, "field 'ndf' is %zu x %zu; it needs from %d to %d angles", ndf.shape[0], ndf.shape[1],
                      ANGLES_LEAST, ANGLES_MOST);
    if (profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, ndf.shape[1], file) &&
        read_ndf(file, &ndf, rows))
        return 1;
    profile_free(rows);
    return 0;
}

/* ---- out ----------------------------------------------------------------------------------------- */

/* Numbers begin at multiples of 8, for hosts that map files. */
int tensor_write(FILE *file, const tensor *fields, size_t count)
{
    uint64_t at = HEAD;
    for (size_t i = 0; i < count; i++)
        at += 2 + strlen(fields[i].name) + 2 + 1 + 8 + 8 * (uint64_t)fields[i].dimensions;
    const size_t gap = (size_t)((8 - at % 8) % 8);
    at += gap;
    fwrite(head, 1, sizeof head, file);
    put_little(file, count, 4);
    for (size_t i = 0; i < count; i++) {
        put_little(file, strlen(fields[i].name), 2);
        fputs(fields[i].name, file);
        put_little(file, (uint64_t)fields[i].dimensions, 2);
        put_little(file, (uint64_t)fields[i].type, 1);
        put_little(file, at, 8);
        for (int d = 0; d < fields[i].dimensions; d++)
            put_little(file, fields[i].shape[d], 8);
        at += (tensor_count(&fields[i]) * (fields[i].type == TENSOR_F32 ? 4 : 1) + 7) / 8 * 8;
    }
    put_little(file, 0, gap);
    for (size_t i = 0; i < count; i++) {
        const size_t numbers = tensor_count(&fields[i]);
        if (fields[i].type == TENSOR_F32)
            put_floats(file, fields[i].data, numbers);
        else
            fwrite(fields[i].data, 1, numbers, file);
        put_little(file, 0, (8 - numbers * (fields[i].type == TENSOR_F32 ? 4 : 1) % 8) % 8);
    }
    return fflush(file) == 0 && !ferror(file);
}

typedef struct rgl_arrays {
    vndf_surface surface;
    float theta_i[INCIDENTS], phi_i[1];
    float ndf[2][NORMALS + 1], sigma[2][AREAS];
    float vndf[INCIDENTS][2][NORMALS + 1];
    float luminance[INCIDENTS][SIDE][SIDE];
    float spectra[INCIDENTS * RGL_CHANNELS][SIDE][SIDE]; /* packed, `channels` for each incident direction */
    double place[SIDE];                                  /* u where the warp sends the numbers of a row */
} rgl_arrays;

static double ndf_at(const vndf_surface *surface, double theta)
{
    return (double)vndf_ndf(surface, (vndf_vec3){(float)sin(theta), 0.0f, (float)fmax(cos(theta), 0)});
}

static double area_at(const vndf_surface *surface, double cosine)
{
    return (double)vndf_projected_area(surface,
                                       (vndf_vec3){(float)sqrt(1 - cosine * cosine), 0.0f, (float)cosine});
}

/* u where the warp of this density sends x. */
static double warped(const float *density, double x)
{
    double mass = 0, a, b;
    for (int i = 0; i < NORMALS; i++)
        mass += x * (double)(density[i] + density[i + 1]) / 2;
    for (int i = 0;; i++, mass -= (a + b) / 2) {
        a = (double)density[i], b = (double)density[i + 1];
        const double root = sqrt(fmax(a * a + 2 * mass * (b - a), 0));
        if (mass <= (a + b) / 2 || i == NORMALS - 1)
            return fmin((i + 2 * mass / fmax(a + root, 1e-300)) / NORMALS, 1);
    }
}

/* D, its areas, and the warp. At 90 degrees D may have no bound: the last number gives its cell, which is linear in u,
 * the integral of D. */
static void fill_normals(rgl_arrays *a)
{
    enum { PARTS = 64 };
    double last = 0;
    for (int i = 0; i < NORMALS; i++)
        a->ndf[0][i] = (float)ndf_at(&a->surface, angle_at(i, NORMALS));
    for (int i = 0; i < PARTS; i++)
        last += 2 * ndf_at(&a->surface, angle_at(NORMALS - 1 + (i + 0.5) / PARTS, NORMALS)) / PARTS;
    a->ndf[0][NORMALS] = (float)fmax(last - (double)a->ndf[0][NORMALS - 1], 0);
    for (int i = 0; i < AREAS; i++)
        a->sigma[0][i] = (float)area_at(&a->surface, cos(angle_at(i, AREAS - 1)));
    for (int i = 0; i <= NORMALS; i++)
        a->vndf[0][0][i] = (float)(sqrt((double)a->ndf[0][i]) * i * sin(angle_at(i, NORMALS)));
    memcpy(a->ndf[1], a->ndf[0], sizeof a->ndf[0]);
    memcpy(a->sigma[1], a->sigma[0], sizeof a->sigma[0]);
    for (int i = 1; i < 2 * INCIDENTS; i++)
        memcpy(a->vndf[i / 2][i % 2], a->vndf[0][0], sizeof a->vndf[0][0]);
    for (int i = 0; i < SIDE; i++)
        a->place[i] = warped(a->vndf[0][0], (double)i / (SIDE - 1));
}

/* R F of one incident direction, R = G2/G1(wi), 0 where wo is below the horizon; and the luminance, by which it is
 * drawn: light over the warp's density. */
static void fill_incident(rgl_arrays *a, int incident, const rgl_form *form)
{
    static const double of_channel[3] = {0.2126, 0.7152, 0.0722};
    const double theta_i = (double)a->theta_i[incident];
    const vec3 wi = vec(sin(theta_i), 0, fmax(cos(theta_i), 0));
    const double area_i = area_at(&a->surface, wi.z);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double u = a->place[i % SIDE], theta = angle_at(u, 1);
        const double phi = (2 * (double)(i / SIDE) / (SIDE - 1) - 1) * PI;
        const vec3 m = vec(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
        const double facing = fmax(dot(wi, m), 0), rise = pow(1 - facing, 5);
        const double cos_o = fmin(2 * facing * m.z - wi.z, 1),
                     area_o = cos_o > 0 ? area_at(&a->surface, cos_o) : 1;
        const double passed = area_i * fmax(cos_o, 0), left = passed / (passed + area_o * wi.z - cos_o * wi.z);
        double light = 0;
        for (int k = 0; k < form->channels; k++) {
            const double value = cos_o > 0 ? left * (form->f0[k] * (1 - rise) + rise) : 0;
            a->spectra[incident * form->channels + k][i / SIDE][i % SIDE] = (float)value;
            light += value * (form->is_spectral ? 1 : of_channel[k]);
        }
        a->luminance[incident][i / SIDE][i % SIDE] =
            (float)(light * facing * sqrt((double)a->ndf[0][(int)(u * NORMALS)]));
    }
}

int rgl_write(FILE *file, const vndf_distribution *distribution, const rgl_form *form)
{
    static const unsigned char one = 1;
    const size_t channels = (size_t)form->channels;
    rgl_arrays *a = calloc(1, sizeof *a);
    if (!a)
        return 0;
    a->surface = vndf_rough(distribution, form->alpha, form->alpha);
    fill_normals(a);
    for (int i = 0; i < INCIDENTS; i++) { /* closest to grazing incidence, where most changes */
        const double left = 1 - (double)i / (INCIDENTS - 1);
        a->theta_i[i] = (float)(PI / 2 * (1 - left * left));
        fill_incident(a, i, form);
    }
    const tensor fields[] = {
        {"description", TENSOR_U8, 1, {strlen(form->description)}, form->description},
        {"theta_i", TENSOR_F32, 1, {INCIDENTS}, a->theta_i},
        {"phi_i", TENSOR_F32, 1, {1}, a->phi_i},
        {"ndf", TENSOR_F32, 2, {2, NORMALS + 1}, a->ndf},
        {"sigma", TENSOR_F32, 2, {2, AREAS}, a->sigma},
        {"vndf", TENSOR_F32, 4, {1, INCIDENTS, 2, NORMALS + 1}, a->vndf},
        {"luminance", TENSOR_F32, 4, {1, INCIDENTS, SIDE, SIDE}, a->luminance},
        {form->is_spectral ? "spectra" : "rgb", TENSOR_F32, 5, {1, INCIDENTS, channels, SIDE, SIDE}, a->spectra},
        {"jacobian", TENSOR_U8, 1, {1}, &one},
        {"wavelengths", TENSOR_F32, 1, {channels}, form->wavelength},
    };
    const int good = tensor_write(file, fields, sizeof fields / sizeof fields[0] - !form->is_spectral);
    free(a);
    return good;
}
