/* GGX: Walter et al. 2007, equation 33, stretched, Lambda = (sqrt(1 + 1/a^2) - 1)/2, a = 1/(alpha tan). Beckmann:
 * equation 25, Lambda = (erf(a) - 1)/2 + exp(-a^2)/(2 a sqrt(pi)) (both from Heitz 2014), written as areas. */
#include "oracle/oracle_surface.h"

#include <math.h>

#include "harness/constants.h"

/* The matrix times the scale is rounded to float: that is the surface, which matters where M is nearly singular. */
oracle_surface oracle_surface_from(oracle_slopes of, const vndf_affine *shape)
{
    float scale = of.kind == ORACLE_KIND_TABLE ? (float)of.table->scale : 1;
    const float m[4] = {scale * shape->xx, scale * shape->xy, scale * shape->yx, scale * shape->yy};
    oracle_surface o = {of,           (double)m[0],          (double)m[1],         (double)m[2],
                        (double)m[3], (double)shape->mean_x, (double)shape->mean_y};
    return o;
}

static double determinant(const oracle_surface *o)
{
    return fabs(o->xx * o->yy - o->xy * o->yx);
}

oracle_look oracle_look_from(const oracle_surface *o, const double wi[3])
{
    double length = sqrt(wi[0] * wi[0] + wi[1] * wi[1] + wi[2] * wi[2]);
    double x = (o->xx * wi[0] + o->yx * wi[1]) / length, y = (o->xy * wi[0] + o->yy * wi[1]) / length;
    oracle_look look = {hypot(x, y), (wi[2] - wi[0] * o->mean_x - wi[1] * o->mean_y) / length, 1, 0};
    if (look.s > 0)
        look.x = x / look.s, look.y = y / look.s;
    return look;
}

/* The slope of wm over the matrix; slopes are (-wm.x/wm.z, -wm.y/wm.z), and u here is turned by a half. */
static void unstretch(const oracle_surface *o, const double wm[3], double u[2])
{
    double x = wm[0] / wm[2] + o->mean_x, y = wm[1] / wm[2] + o->mean_y, d = o->xx * o->yy - o->xy * o->yx;
    u[0] = (o->yy * x - o->xy * y) / d;
    u[1] = (o->xx * y - o->yx * x) / d;
}

static double p22(const oracle_slopes *of, double r)
{
    switch (of->kind) {
    case ORACLE_KIND_GGX: return 1 / (PI * (1 + r * r) * (1 + r * r));
    case ORACLE_KIND_BECKMANN: return exp(-r * r) / PI;
    case ORACLE_KIND_TABLE: return oracle_table_p22(of->table, r);
    default: return oracle_p22(of->formula, r);
    }
}

static double area(const oracle_slopes *of, double s, double c)
{
    switch (of->kind) {
    case ORACLE_KIND_GGX: return c < 0 ? s * s / (hypot(s, c) - c) / 2 : (c + hypot(s, c)) / 2;
    case ORACLE_KIND_BECKMANN:
        return s > 0 ? c * erfc(-c / s) / 2 + s * exp(-c * c / (s * s)) / (2 * sqrt(PI)) : fmax(c, 0);
    case ORACLE_KIND_TABLE: return oracle_law_from(of->table, s, c).area;
    default: return oracle_area(of->formula, s, c);
    }
}

/* dwm per slope area: cos^3 of the angle of wm. */
static double cosine3(const double wm[3])
{
    return pow(wm[2] / sqrt(wm[0] * wm[0] + wm[1] * wm[1] + wm[2] * wm[2]), 3);
}

double oracle_surface_ndf(const oracle_surface *o, const double wm[3])
{
    double u[2];
    if (!(wm[2] > 0))
        return 0;
    unstretch(o, wm, u);
    return p22(&o->of, hypot(u[0], u[1])) / (determinant(o) * pow(cosine3(wm), 4.0 / 3));
}

double oracle_surface_area(const oracle_surface *o, const double w[3])
{
    oracle_look look = oracle_look_from(o, w);
    return area(&o->of, look.s, look.c);
}

double oracle_surface_drawn_area(const oracle_surface *o, const double w[3])
{
    oracle_look look = oracle_look_from(o, w);
    if (o->of.kind != ORACLE_KIND_TABLE)
        return area(&o->of, look.s, look.c);
    return oracle_law_from(o->of.table, look.s, look.c).drawn;
}

double oracle_surface_visible(const oracle_surface *o, const double wi[3], const double wm[3])
{
    double wi2 = wi[0] * wi[0] + wi[1] * wi[1] + wi[2] * wi[2],
           wm2 = wm[0] * wm[0] + wm[1] * wm[1] + wm[2] * wm[2];
    double facing = (wi[0] * wm[0] + wi[1] * wm[1] + wi[2] * wm[2]) / sqrt(wi2 * wm2);
    return facing > 0 ? facing * oracle_surface_ndf(o, wm) / oracle_surface_area(o, wi) : 0;
}

double oracle_surface_drawn(const oracle_surface *o, const double wi[3], const double wm[3])
{
    double u[2];
    if (o->of.kind != ORACLE_KIND_TABLE)
        return oracle_surface_visible(o, wi, wm);
    if (!(wm[2] > 0))
        return 0;
    unstretch(o, wm, u);
    oracle_look look = oracle_look_from(o, wi);
    oracle_law law = oracle_law_from(o->of.table, look.s, look.c);
    double along = look.x * u[0] + look.y * u[1], across = look.x * u[1] - look.y * u[0];
    return oracle_law_density(&law, hypot(along, across), atan2(across, along)) / (determinant(o) * cosine3(wm));
}
