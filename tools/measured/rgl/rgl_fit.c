/* An anisotropic D as an isotropic one under a matrix. Normals are drawn as D cos has them, through the warp of
 * the grid that D stands on: with u = sqrt(2 theta/pi), D cos dm is D cos sin u, but for a constant, over the unit
 * square. */
#include <math.h>
#include <stdlib.h>

#include "measured/rgl/fields.h"
#include "measured/rgl/rgl.h"
#include "measured/rgl/warp.h"
#include "measured/surface/slopes.h"

enum { DRAWN = 1 << 18, ROWS_MOST = 4096 };

static const double pi = 3.14159265358979323846;

static double angle_at(double u)
{
    return pi / 2 * u * u;
}

static double *density_of(const tensor_field *ndf)
{
    size_t rows = ndf->shape[0], columns = ndf->shape[1];
    double *density = malloc(rows * columns * sizeof *density);
    for (size_t j = 0; j < columns && density; j++) {
        double u = (double)j / (double)(columns - 1), theta = angle_at(u);
        for (size_t i = 0; i < rows; i++)
            density[i * columns + j] = tensor_at(ndf, i * columns + j) * fmax(cos(theta), 0) * sin(theta) * u;
    }
    return density;
}

/* Bits in the reverse order: van der Corput's numbers. */
static double reversed(unsigned i)
{
    double value = 0, digit = 0.5;
    for (; i; i >>= 1, digit /= 2)
        value += (i & 1u) * digit;
    return value;
}

/* DRAWN points of Hammersley's, finest along theta; the parts of the set are spread over all of them. */
static void draw(const warp *from, slope_set *to)
{
    for (unsigned i = 0; i < DRAWN; i++) {
        double u, v;
        warp_sample(from, (i + 0.5) / DRAWN, reversed(i) + 0.5 / DRAWN, &u, &v);
        double r = tan(fmin(angle_at(u), pi / 2 - 1e-9)), phi = (2 * v - 1) * pi;
        slopes_add(to, -r * cos(phi), -r * sin(phi), (int)(i * 2654435761u >> 16 & (SLOPE_PARTS - 1)));
    }
}

static int draw_slopes(const tensor_field *ndf, const char *name, slope_set *made, refusal *why)
{
    warp from;
    double *density = density_of(ndf);
    int good = density && slopes_make(made, DRAWN);
    if (!good)
        refuse_data(why, name, "there is no memory for %d slopes", DRAWN);
    else if (!warp_make(&from, density, (int)ndf->shape[1], (int)ndf->shape[0]))
        good = refuse_data(why, name, "D is 0 everywhere");
    else {
        draw(&from, made);
        warp_free(&from);
    }
    free(density);
    return good;
}

int rgl_fit(profile *rows, const char *name, const unsigned char *bytes, size_t size, notes *to, refusal *why)
{
    tensor_file file;
    slope_set slopes = {NULL, NULL, NULL, 0, 0, 0};
    slope_law law;
    *rows = (profile){VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, NULL, NULL, 0, NULL};
    const tensor_field *ndf = tensor_read(&file, name, bytes, size, why) ? rgl_ndf(&file, name, why) : NULL;
    if (!ndf)
        return 0;
    if (ndf->shape[0] < 2 || ndf->shape[0] > ROWS_MOST)
        return refuse_data(why, name, "field 'ndf' has %zu azimuths; from 2 to %d are needed", ndf->shape[0],
                           ROWS_MOST);
    note(to, "ndf %zu x %zu", ndf->shape[0], ndf->shape[1]);
    int good = draw_slopes(ndf, name, &slopes, why) && slopes_law(&slopes, name, &law, to, why);
    slopes_free(&slopes);
    if (good)
        *rows = law.rows;
    return good;
}
