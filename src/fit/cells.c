#include "fit/draft.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* ---- one cell ---- */

vndf_cell vndf_cell_between(double r, double end, unsigned squarings)
{
    double z = 1 / (1 + r), power = end < HUGE_VAL ? 0 : (double)(1u << squarings);
    double h = power > 0 ? power * z : (end - r) * z / (1 + end);
    return (vndf_cell){.r = r, .x = r * z, .z = z, .h = h, .power = power};
}

double vndf_cell_place(const vndf_cell *cell, double r)
{
    double z = 1 / (1 + r), left = z / cell->z;
    if (cell->power == 0)
        return (r - cell->r) * z * cell->z / cell->h;
    for (double power = cell->power; power > 1; power /= 2)
        left = sqrt(left);
    return 1 - left;
}

/* 2 pi P22 h/z^4 at the end with this z, h = z^2 dR/dxi, within bounds about the mean: for poles, zeros and light
 * tails. */
static double end_of(double p22, double h, double z, double mean)
{
    const double least = 0.02, most = 300;
    return fmin(fmax(2 * PI * p22 * h / (z * z * z * z), least * mean), most * mean);
}

vndf_cell vndf_cell_measure(const vndf_profile *profile, const vndf_strips *strips, size_t first, size_t end,
                            unsigned squarings)
{
    const double mass_least = 1e-30, least = 1e-36, cube_most = 1e30;
    const double near_end = 4e-2; /* 1 - xi where the limit of a tail is read */
    double to = strips->at[end].edge;
    vndf_cell c = vndf_cell_between(strips->at[first].edge, to, squarings);
    for (size_t i = first; i < end; i++) {
        const vndf_strip *s = &strips->at[i];
        double d = strips->at[i].edge - c.r;
        c.m0 += s->m0;
        c.m1 += s->m1 + d * s->m0;
        c.m2 += s->m2 + d * (2 * s->m1 + d * s->m0);
        c.cube += s->m4;
    }
    c.cube = c.m0 > 0 ? c.cube / c.m0 : 0;
    if (c.m0 < mass_least) { /* an even density that floats can hold */
        double width = to < HUGE_VAL ? to - c.r : c.r;
        c.m0 = mass_least;
        c.m1 = c.m0 * width / 2;
        c.m2 = c.m0 * width * width / 3;
        c.cube = 1 / (c.r * c.r * c.r);
    }
    c.m1 = fmax(c.m1, least);
    c.m2 = fmax(c.m2, least);
    c.cube = c.cube > least ? fmin(fmin(c.cube, 1 / (c.r * c.r * c.r)), cube_most) : 0;
    if (c.r == 0) { /* no law reads these two; the first may be infinite */
        c.m0 = 2 * c.m1 / to;
        c.cube = 0;
    }
    c.g0 = end_of(strips->at[first].p0, c.h, c.z, c.m0 / (c.z * c.z));
    if (c.power > 0) {
        double z = c.z * pow(near_end, c.power), far = 1 / z - 1;
        c.g1 = end_of(vndf_profile_p22(profile, far), c.power * z / near_end, z,
                      c.m2 + (2 * c.m1 + c.m0 * c.r) * c.r);
    } else
        c.g1 = end_of(strips->at[end - 1].p1, c.h, c.z - c.h, c.m0 / ((c.z - c.h) * (c.z - c.h)));
    return c;
}

vndf_drawn vndf_drawn_by(const vndf_cell *c, double w1, double w0)
{
    double r = c->r, x1 = c->power > 0 ? 1 : c->x + c->h, z1 = c->power > 0 ? 0 : c->z - c->h;
    return (vndf_drawn){w1 * c->m2 + (2 * w1 * r + w0) * c->m1 + (w1 * r + w0) * r * c->m0,
                        c->g0 * (w1 * c->x * c->x + w0 * c->x * c->z), c->g1 * (w1 * x1 * x1 + w0 * x1 * z1)};
}

/* z^2 W at the right end. */
static double below_flat(const vndf_cell *c, double rho, double b0, double b1)
{
    double x = c->power > 0 ? 1 : c->x + c->h, way = 1;
    if (c->power == 0) /* the difference of slopes keeps its digits */
        way = (c->r - rho) * (c->z - c->h) + c->h / c->z;
    return way * (b0 * x + b1 * way);
}

vndf_drawn vndf_drawn_below(const vndf_cell *c, double rho, double b0, double b1)
{
    double d = c->r - rho, e = b0 * c->r + b1 * d;
    return (vndf_drawn){(b0 + b1) * c->m2 + ((b0 + b1) * d + e) * c->m1 + d * e * c->m0,
                        c->g0 * (d * c->z) * (e * c->z), c->g1 * below_flat(c, rho, b0, b1)};
}
