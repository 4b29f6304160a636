#include "harness/test.h"
#include "oracle/oracle.h"

/* ---- the distributions ---- */

static double shape_at(int shape, double r)
{
    const double nickel = 0.00556292, x = nickel + r * r / nickel;
    switch (shape) {
    case ORACLE_GGX: return pow(1 + r * r, -2);
    case ORACLE_BECKMANN: return exp(-r * r);
    case ORACLE_STUDENT: return pow(1 + r * r / 0.8, -1.8); /* gamma 1.8 */
    case ORACLE_LAPLACE: return exp(-r);
    case ORACLE_MEASURED: return exp(-x) * pow(x / nickel, -0.171288); /* shifted gamma, Bagher et al. 2012, red */
    case ORACLE_HAZE: /* seven tenths Beckmann and three of a GGX a hundred times narrower, each of mass 1 */
        return 0.7 * exp(-r * r) + 0.3e4 * pow(1 + 1e4 * r * r, -2);
    case ORACLE_RING: return exp(-pow((r - 1) / 0.2, 2));
    default: return r <= 1 ? 1 : 0;
    }
}

/* The norms are masses over pi here, integrals of the shape times 2 r dr. That of the measured one is, with x as above,
 * nickel^(1 + p) Gamma(1 - p, nickel), p = 0.171288; that of the ring is 0.4 sqrt(pi) but for 2e-14. */
static const oracle oracles[ORACLE_COUNT] = {
    {.name = "ggx", .shape = ORACLE_GGX, .norm = 1},
    {.name = "beckmann", .shape = ORACLE_BECKMANN, .norm = 1},
    {.name = "student-t:1.8", .shape = ORACLE_STUDENT, .norm = 1},
    {.name = "exp(-r)", .shape = ORACLE_LAPLACE, .norm = 2},
    {.name = "sgd:nickel/r", .shape = ORACLE_MEASURED, .norm = 0.00255400573357566408},
    {.name = "mix:(0.7,1,beckmann)+(0.3,0.01,ggx)", .shape = ORACLE_HAZE, .norm = 1},
    {.name = "exp(-((r-1)/0.2)^2)", .shape = ORACLE_RING, .rough = 1, .norm = 0.708981540362221692},
    {.name = "step(1-r)", .shape = ORACLE_DISC, .rough = 1, .norm = 1},
};

/* ---- area ---- */

double oracle_area(const oracle *o, double s, double c)
{
    if (o->table)
        return oracle_law_from(o->table, s, c).area;
    if (o->shape == ORACLE_GGX)
        return c < 0 ? s * s / (hypot(s, c) - c) / 2 : (c + hypot(s, c)) / 2;
    return s > 0 ? c * erfc(-c / s) / 2 + s * exp(-c * c / (s * s)) / (2 * sqrt(PI)) : fmax(c, 0);
}

double oracle_p22(const oracle *o, double r)
{
    if (o->table)
        return oracle_table_p22(o->table, r);
    return o->norm * shape_at(o->shape, r);
}

/* ---- surfaces ---- */

/* The matrix times the scale is rounded to float: that is the surface, which matters where M is nearly singular. */
oracle_surface oracle_surface_from(const oracle *of, const vndf_surface *shape)
{
    float scale = of->table ? (float)of->table->scale : 1;
    const float m[4] = {scale * shape->xx, scale * shape->xy, scale * shape->yx, scale * shape->yy};
    oracle_surface o = {*of,          (double)m[0],          (double)m[1],         (double)m[2],
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
    return oracle_p22(&o->of, hypot(u[0], u[1])) / (determinant(o) * pow(cosine3(wm), 4.0 / 3));
}

double oracle_surface_area(const oracle_surface *o, const double w[3])
{
    oracle_look look = oracle_look_from(o, w);
    return oracle_area(&o->of, look.s, look.c);
}

double oracle_surface_drawn_area(const oracle_surface *o, const double w[3])
{
    oracle_look at = oracle_look_from(o, w);
    return o->of.table ? oracle_law_from(o->of.table, at.s, at.c).drawn : oracle_area(&o->of, at.s, at.c);
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
    if (!o->of.table)
        return oracle_surface_visible(o, wi, wm);
    if (!(wm[2] > 0))
        return 0;
    unstretch(o, wm, u);
    oracle_look look = oracle_look_from(o, wi);
    oracle_law law = oracle_law_from(o->of.table, look.s, look.c);
    double along = look.x * u[0] + look.y * u[1], across = look.x * u[1] - look.y * u[0];
    return oracle_law_density(&law, hypot(along, across), atan2(across, along)) / (determinant(o) * cosine3(wm));
}

/* ---- making ---- */

oracle oracle_get(size_t index)
{
    oracle o = oracles[index];
    o.norm = 1 / (PI * o.norm);
    return o;
}

vndf_source *oracle_source(const char *text, vndf_error *error)
{
    vndf_source *family = vndf_source_family(text, NULL);
    return family ? family : vndf_source_slope_expression(text, NULL, 0, error);
}

vndf_distribution *oracle_build(const char *text, size_t max_bytes, vndf_certificate *claim, vndf_error *error)
{
    const vndf_build_options options = {.max_bytes = max_bytes};
    vndf_error own = {VNDF_OK, ""};
    vndf_source *source = oracle_source(text, &own);
    vndf_distribution *table = source ? vndf_build(source, &options, claim, &own) : NULL;
    if (!table && !error)
        fprintf(stderr, "%s: %s\n", text, own.message);
    if (error)
        *error = own;
    vndf_source_free(source);
    return table;
}

vndf_distribution *oracle_shipped(const char *name)
{
    char path[4096];
    vndf_error error = {VNDF_OK, ""};
    snprintf(path, sizeof path, VNDF_SOURCE_DIR "/tables/%s.vndf", name);
    vndf_distribution *table = vndf_load(path, &error);
    if (!table)
        fprintf(stderr, "%s: %s\n", path, error.message);
    return table;
}

int oracle_wanted(int arguments, char **argument, size_t index, const char *name)
{
    char number[24];
    snprintf(number, sizeof number, "%lu", (unsigned long)index);
    return arguments < 2 || strcmp(argument[1], number) == 0 || (name && strcmp(argument[1], name) == 0);
}

vndf_surface oracle_turned(const vndf_distribution *d, double a, double b, double before, double after)
{
    const double c = cos(after), s = sin(after), e = cos(before), f = sin(before);
    const float xx = (float)(c * a * e - s * b * f), xy = (float)(-c * a * f - s * b * e);
    return (vndf_surface){d, xx, xy, (float)(s * a * e + c * b * f), (float)(-s * a * f + c * b * e), 0, 0};
}

vndf_vec3 oracle_direction(double theta, double phi)
{
    double t = theta * PI / 180, p = phi * PI / 180, s = sin(t);
    vndf_vec3 w = {(float)(s * cos(p)), (float)(s * sin(p)), theta == 90 ? 0.0f : (float)cos(t)};
    return w;
}
