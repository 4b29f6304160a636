/* Points for oracle_float.h. Directions and normals are chosen in the stretched frame, where a table has its
 * knots, and taken back: wi ~ (s cos/ax, s sin/ay, c), wm ~ (ax X cos, ay X sin, Z), with the table's scale in
 * ax, ay. */
#include <float.h>

#include "oracle/oracle_float.h"
#include "harness/constants.h"
#include "harness/test.h"

static double uniform(unsigned long long *state, double from, double to)
{
    return from + (to - from) * test_uniform_double(state);
}

/* 10 to a power that is uniform. */
static double decade(unsigned long long *state, double from, double to)
{
    return pow(10, uniform(state, from, to));
}

static int one_of(unsigned long long *state, int n)
{
    return (int)(test_uniform_double(state) * n);
}

/* Unit, however small the parts. */
static vndf_vec3 unit(double x, double y, double z)
{
    double length = hypot(hypot(x, y), z);
    vndf_vec3 v = {(float)(x / length), (float)(y / length), (float)(z / length)};
    return v;
}

static vndf_vec3 direction_to(const float_subject *subject, const float_point *at, double s, double phi, double c)
{
    double scale = subject->reference.scale;
    return unit(s * cos(phi) / ((double)at->alpha_x * scale), s * sin(phi) / ((double)at->alpha_y * scale), c);
}

static vndf_vec3 normal_at(const float_subject *subject, const float_point *at, double x, double phi, double z)
{
    double scale = subject->reference.scale;
    return unit(x * cos(phi) * (double)at->alpha_x * scale, x * sin(phi) * (double)at->alpha_y * scale, z);
}

/* The azimuth of the stretched direction. */
static double azimuth_of(const float_point *at)
{
    return atan2((double)at->alpha_y * (double)at->wi.y, (double)at->alpha_x * (double)at->wi.x);
}

static void choose_roughness(float_point *at, unsigned long long *state)
{
    int wide = one_of(state, 3) == 0;
    at->alpha_x = (float)(wide ? decade(state, -6, 4) : decade(state, -3, 0.5));
    at->alpha_y =
        one_of(state, 3) == 0 ? at->alpha_x : (float)(wide ? decade(state, -6, 4) : decade(state, -3, 0.5));
}

/* The sphere; the horizon; and the sphere of the stretched frame, where the area below falls to nothing. */
static void choose_direction(const float_subject *subject, float_point *at, unsigned long long *state)
{
    double phi = uniform(state, -PI, PI), c = uniform(state, -1, 1), side = one_of(state, 2) ? 1 : -1;
    int kind = one_of(state, 4);
    if (kind == 0)
        at->wi = unit(sqrt(1 - c * c) * cos(phi), sqrt(1 - c * c) * sin(phi), c);
    else if (kind == 1)
        at->wi = unit(cos(phi), sin(phi), side * decade(state, -12, 0));
    else if (kind == 2)
        at->wi = direction_to(subject, at, 1, phi, side * decade(state, -3, 3));
    else
        at->wi = direction_to(subject, at, 1, phi, -decade(state, -1, 1.5));
}

static vndf_vec3 sample_of(const float_subject *subject, const float_point *at, float u1, float u2)
{
    vndf_surface surface = {subject->table, at->alpha_x, at->alpha_y};
    vndf_view view = vndf_view_from(&surface, at->wi);
    return vndf_sample(&view, u1, u2, NULL);
}

float_point float_point_random(const float_subject *subject, unsigned long long *state)
{
    float_point at;
    choose_roughness(&at, state);
    choose_direction(subject, &at, state);
    if (one_of(state, 2))
        at.wm = sample_of(subject, &at, test_uniform(state), test_uniform(state));
    else
        at.wm = normal_at(subject, &at, decade(state, -4, 4), uniform(state, -PI, PI), 1);
    return at;
}

/* ---- hard ---- */

static float corner(unsigned long long *state)
{
    static const float edges[] = {0,    FLT_TRUE_MIN,    0x1p-24f,     0.5f - 0x1p-25f,
                                  0.5f, 0.5f + 0x1p-24f, 1 - 0x1p-24f, 1};
    int i = one_of(state, 16);
    return i < 8 ? edges[i] : i < 12 ? (float)decade(state, -12, 0) : 1 - (float)decade(state, -7.5, 0);
}

/* From tools/measure/stress.c: the pole, angles beside it, the horizon from both sides down to denormals, straight
 * down. */
static void choose_hard_direction(float_point *at, unsigned long long *state)
{
    static const double angles[] = {0, 1e-7, 1e-4, 0.01, 30, 60, 85, 89, 89.9, 89.9999, 91, 130, 179.9, 180};
    static const float cosines[] = {1e-7f, 1e-20f, 1e-42f, 0.0f, -0.0f, -1e-42f, -1e-20f, -1e-7f};
    static const double azimuths[] = {0, 90, 45, 200}, lengths[] = {1, 1 + 1e-6, 1 - 1e-6};
    double phi = azimuths[one_of(state, 4)] * PI / 180, length = lengths[one_of(state, 3)];
    int i = one_of(state, 22);
    double theta = i < 14 ? angles[i] * PI / 180 : PI / 2;
    vndf_vec3 w = {(float)(length * sin(theta) * cos(phi)), (float)(length * sin(theta) * sin(phi)),
                   i < 14 ? (float)(length * cos(theta)) : cosines[i - 14]};
    at->wi = w;
}

static void choose_hard_roughness(float_point *at, unsigned long long *state)
{
    static const float roughness[] = {1e-8f, 1e-6f, 1e-4f, 1e-2f, 0.1f, 0.5f, 1, 2, 10, 1e4f};
    at->alpha_x = roughness[one_of(state, 10)];
    at->alpha_y = one_of(state, 2) ? at->alpha_x : roughness[one_of(state, 10)];
}

/* 1, or beside it by some ulps, or by a decade below one. */
static double about_one(unsigned long long *state)
{
    int i = one_of(state, 3);
    double side = one_of(state, 2) ? 1 : -1;
    return i == 0 ? 1 : 1 + side * (i == 1 ? one_of(state, 8) * 0x1p-24 : decade(state, -8, -1));
}

/* A normal whose slope is at a knot. */
static vndf_vec3 at_knot(const float_subject *subject, const float_point *at, double phi,
                         unsigned long long *state)
{
    const oracle_table *t = &subject->reference;
    size_t j = 1 + (size_t)one_of(state, (int)t->count - 1);
    return normal_at(subject, at, t->x[j] * about_one(state), phi, t->z[j]);
}

/* A direction whose cut, for the azimuth a from it, is at a knot: c Z + s cos a X = 0. */
static void cut_at_knot(const float_subject *subject, float_point *at, double phi, double a,
                        unsigned long long *state)
{
    const oracle_table *t = &subject->reference;
    size_t j = 1 + (size_t)one_of(state, (int)t->count - 1);
    at->wi = direction_to(subject, at, t->z[j], phi - a, -cos(a) * t->x[j] * about_one(state));
}

/* A direction at a row of a wedge, or at a knot of its area. */
static void at_row(const float_subject *subject, float_point *at, double phi, unsigned long long *state)
{
    int below = one_of(state, 2);
    const oracle_wedge *w = below ? &subject->reference.below : &subject->reference.above;
    double y = one_of(state, 2) ? w->row_y[one_of(state, (int)(w->rows + 1) / 2)]
                                : w->knot_y[one_of(state, (int)w->knots)];
    y = fmin(y * about_one(state), 1);
    at->wi = below ? direction_to(subject, at, y, phi, y - 1) : direction_to(subject, at, 1 - y, phi, y);
}

/* The normal turned about the axis that is level and across it until wi . wm is nearly 0. */
static void near_cut(float_point *at, unsigned long long *state)
{
    double level = (double)at->wi.x * (double)at->wm.x + (double)at->wi.y * (double)at->wm.y;
    double z = -level / (double)at->wi.z;
    double beside = 1 + copysign(decade(state, -8, -0.5), (double)at->wi.z);
    if (z > 0 && z < 1e30)
        at->wm = unit((double)at->wm.x, (double)at->wm.y, z * beside);
}

float_point float_point_hard(const float_subject *subject, unsigned long long *state)
{
    float_point at;
    double phi = uniform(state, -PI, PI), a = uniform(state, -PI, PI), side = one_of(state, 2) ? 1 : -1;
    if (one_of(state, 2))
        choose_hard_roughness(&at, state);
    else
        choose_roughness(&at, state);
    if (one_of(state, 2))
        choose_hard_direction(&at, state);
    else
        choose_direction(subject, &at, state);
    switch (one_of(state, 8)) {
    case 0:
    case 1: at.wm = sample_of(subject, &at, corner(state), corner(state)); break;
    case 2: /* the horizon */
        at.wm = unit(cos(phi), sin(phi), one_of(state, 4) ? decade(state, -44, -2) : 0);
        break;
    case 3: at.wm = at_knot(subject, &at, phi, state); break;
    case 4:
        cut_at_knot(subject, &at, phi, a, state);
        at.wm = one_of(state, 2) ? normal_at(subject, &at, decade(state, -2, 2), phi, 1)
                                 : at_knot(subject, &at, phi, state);
        break;
    case 5: /* at and beside the seam */
        a = azimuth_of(&at) + side * (PI / 2 + (one_of(state, 2) ? 1 : -1) * decade(state, -9, -1));
        at.wm = normal_at(subject, &at, decade(state, -3, 3), a, 1);
        break;
    case 6:
        at_row(subject, &at, phi, state);
        at.wm = sample_of(subject, &at, test_uniform(state), test_uniform(state));
        break;
    default: /* the pole, or a level ring about it */
        at.wm = normal_at(subject, &at, decade(state, -20, -1), phi, 1);
    }
    if (one_of(state, 4) == 0)
        near_cut(&at, state);
    return at;
}

float_point float_point_drawn(float_point at, unsigned long long *state)
{
    int hard = one_of(state, 2);
    vndf_vec3 u = {hard ? corner(state) : test_uniform(state), hard ? corner(state) : test_uniform(state), 0};
    at.wm = u;
    return at;
}
