/* A distribution as a .bsdf; brdf.h says what its fields are. D stands at NORMALS + 1 angles. The vndf is coarser in
 * theta by FINE, and each of its numbers is the mean over the cells beside it, so that no ring of D falls between two
 * of them: what is reflected there has to be drawn as well. rgb is fitted (grid.h) to R at POINTS^2 places of each
 * cell, so that the light of a cell where wo meets the horizon is right. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measured/grid.h"
#include "measured/model.h"
#include "measured/brdf.h"
#include "measured/tensor.h"

enum { NORMALS = 2048, FINE = 8, THETAS = NORMALS / FINE + 1, PHIS = 65, INCIDENTS = 48, SIDE = 32, AREAS = 257 };
enum { POINTS = 4, FINE_SIDE = (SIDE - 1) * POINTS };

static const double pi = 3.14159265358979323846;

typedef struct rgl_arrays {
    float theta_i[INCIDENTS], phi_i[1];
    float ndf[2][NORMALS + 1], sigma[2][AREAS];
    float vndf[INCIDENTS][PHIS][THETAS];
    float luminance[INCIDENTS][SIDE][SIDE];
    float spectra[INCIDENTS][RGL_CHANNELS][SIDE][SIDE]; /* packed, `channels` for each incident direction */
    double density[PHIS][THETAS];                       /* vndf of one incident direction */
    double along[NORMALS + 1],
        across[NORMALS + 1]; /* of visible normals at fine angles: D u sin cos and D u sin^2 */
} rgl_arrays;

static double angle_at(double u)
{
    return pi / 2 * u * u;
}

/* ---- D and A ------------------------------------------------------------------------------------- */

/* At 90 degrees D may have no bound. The last number gives its cell, which is linear in u, the integral of D. */
static double last_ndf(const vndf_surface *surface, double before)
{
    enum { PARTS = 64 };
    double sum = 0;
    for (int i = 0; i < PARTS; i++)
        sum += model_ndf(surface, angle_at((NORMALS - 1 + (i + 0.5) / PARTS) / NORMALS));
    return fmax(2 * sum / PARTS - before, 0);
}

static void fill_ndf(rgl_arrays *a, const vndf_surface *surface)
{
    for (int i = 0; i < NORMALS; i++)
        a->ndf[0][i] = (float)model_ndf(surface, angle_at((double)i / NORMALS));
    a->ndf[0][NORMALS] = (float)last_ndf(surface, (double)a->ndf[0][NORMALS - 1]);
    memcpy(a->ndf[1], a->ndf[0], sizeof a->ndf[0]);
    for (int i = 0; i < AREAS; i++)
        a->sigma[0][i] = (float)model_area(surface, angle_at((double)i / (AREAS - 1)));
    memcpy(a->sigma[1], a->sigma[0], sizeof a->sigma[0]);
}

/* ---- visible normals ----------------------------------------------------------------------------- */

/* D max(0, wi.m) over the unit square is, but for a constant, the positive part of
 * cos(theta_i) along + sin(theta_i) cos(phi) across. */
static void fill_parts(rgl_arrays *a)
{
    for (int i = 0; i <= NORMALS; i++) {
        double u = (double)i / NORMALS, theta = angle_at(u), part = (double)a->ndf[0][i] * u * sin(theta);
        a->along[i] = part * fmax(cos(theta), 0);
        a->across[i] = part * sin(theta);
    }
}

/* The mean over the cells on both sides of point `column`, weighed by a hat. */
static double mean_visible(const rgl_arrays *a, int column, double along, double across)
{
    double sum = 0, whole = 0;
    for (int k = -FINE + 1; k < FINE; k++) {
        int i = column * FINE + k;
        double weight = FINE - abs(k);
        if (i < 0 || i > NORMALS)
            continue;
        sum += weight * fmax(along * a->along[i] + across * a->across[i], 0);
        whole += weight;
    }
    return sum / whole;
}

static void fill_density(rgl_arrays *a, int incident)
{
    double theta_i = (double)a->theta_i[incident];
    for (int row = 0; row < PHIS; row++) {
        double cos_phi = cos((2.0 * row / (PHIS - 1) - 1) * pi);
        for (int column = 0; column < THETAS; column++) {
            a->density[row][column] = mean_visible(a, column, cos(theta_i), sin(theta_i) * cos_phi);
            a->vndf[incident][row][column] = (float)a->density[row][column];
        }
    }
}

/* ---- what is reflected --------------------------------------------------------------------------- */

/* R (1 - rise) and R rise in POINTS^2 places of each cell; and where wo is above the horizon. */
typedef struct reflected {
    float low[FINE_SIDE][FINE_SIDE], high[FINE_SIDE][FINE_SIDE], is_seen[FINE_SIDE][FINE_SIDE];
    double low_grid[SIDE][SIDE], high_grid[SIDE][SIDE];
} reflected;

static void look_up(reflected *r, const vndf_surface *surface, const warp *to, double theta_i)
{
    direction wi = direction_at(theta_i, 0);
    double area_i = model_area(surface, theta_i), cos_i = fmax(wi.z, 0);
    for (int row = 0; row < FINE_SIDE; row++)
        for (int column = 0; column < FINE_SIDE; column++) {
            double u, v;
            warp_sample(to, (column + 0.5) / FINE_SIDE, (row + 0.5) / FINE_SIDE, &u, &v);
            direction m = direction_at(angle_at(u), (2 * v - 1) * pi), wo = direction_mirrored(wi, m);
            double rise = model_schlick(fmax(direction_dot(wi, m), 0));
            double left =
                wo.z > 0 ? model_masked(area_i, cos_i, model_area(surface, acos(fmin(wo.z, 1))), wo.z) : 0;
            r->low[row][column] = (float)(left * (1 - rise));
            r->high[row][column] = (float)(left * rise);
            r->is_seen[row][column] = wo.z > 0;
        }
}

/* The mean over the cells around each point, weighed by a hat: never 0 where a neighbour is not. */
static void fill_luminance(rgl_arrays *a, const reflected *r, double f0, int incident)
{
    for (int row = 0; row < SIDE; row++)
        for (int column = 0; column < SIDE; column++) {
            double sum = 0, whole = 0;
            for (int y = (row - 1) * POINTS; y < (row + 1) * POINTS; y++)
                for (int x = (column - 1) * POINTS; x < (column + 1) * POINTS; x++) {
                    if (x < 0 || y < 0 || x >= FINE_SIDE || y >= FINE_SIDE)
                        continue;
                    double weight = (1 - fabs((y + 0.5) / POINTS - row)) * (1 - fabs((x + 0.5) / POINTS - column));
                    whole += weight;
                    sum += weight * (f0 * (double)r->low[y][x] + (double)r->high[y][x]);
                }
            a->luminance[incident][row][column] = (float)(sum / whole);
        }
}

static void fill_spectra(rgl_arrays *a, const reflected *r, const rgl_form *form, int incident)
{
    float *spectra = &a->spectra[0][0][0][0] + (size_t)(incident * form->channels) * SIDE * SIDE;
    for (int i = 0; i < form->channels; i++)
        for (int row = 0; row < SIDE; row++)
            for (int column = 0; column < SIDE; column++)
                *spectra++ = (float)fmax(form->f0[i] * r->low_grid[row][column] + r->high_grid[row][column], 0);
}

/* Luminance of linear sRGB; the mean of other channels. */
static double luminance_of(const rgl_form *form)
{
    double sum = 0;
    if (!form->is_spectral)
        return 0.2126 * form->f0[0] + 0.7152 * form->f0[1] + 0.0722 * form->f0[2];
    for (int i = 0; i < form->channels; i++)
        sum += form->f0[i] / form->channels;
    return sum;
}

static int fill_reflected(rgl_arrays *a, reflected *r, const vndf_surface *surface, const rgl_form *form,
                          int incident)
{
    warp to;
    fill_density(a, incident);
    if (!warp_make(&to, &a->density[0][0], THETAS, PHIS))
        return 0;
    look_up(r, surface, &to, (double)a->theta_i[incident]);
    warp_free(&to);
    grid_fit(&r->low[0][0], &r->is_seen[0][0], SIDE, POINTS, &r->low_grid[0][0]);
    grid_fit(&r->high[0][0], &r->is_seen[0][0], SIDE, POINTS, &r->high_grid[0][0]);
    fill_luminance(a, r, luminance_of(form), incident);
    fill_spectra(a, r, form, incident);
    return 1;
}

/* Closest to grazing incidence, where most changes. */
static double incident_angle(int i)
{
    double left = 1 - (double)i / (INCIDENTS - 1);
    return pi / 2 * (1 - left * left);
}

static int fill(rgl_arrays *a, const vndf_surface *surface, const rgl_form *form)
{
    reflected *r = malloc(sizeof *r);
    int good = r != NULL;
    fill_ndf(a, surface);
    fill_parts(a);
    for (int i = 0; i < INCIDENTS && good; i++) {
        a->theta_i[i] = (float)incident_angle(i);
        good = fill_reflected(a, r, surface, form, i);
    }
    free(r);
    return good;
}

/* ---- the file ------------------------------------------------------------------------------------ */

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
    int good = a && fill(a, &surface, form) && write_arrays(file, a, form);
    free(a);
    return good;
}
