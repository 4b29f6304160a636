/* The properties of stress.h, one number each. What theory says of the area: A(w) = integral max(0, w.wm) D dwm
 * (Heitz, "Understanding the Masking-Shadowing Function", JCGT 2014, eq. 16) is convex and even in the part of w
 * across z, so it grows with that part's length; and dA/dw.z, the integral of wm.z D over the visible normals, is
 * >= 0. Down a great circle both parts shrink once z < 0, so A falls from 90 to 180 degrees; mirrored, A(-w)
 * grows from 0 to 90, and so does Lambda = A(-w)/cos, while G1 = 1/(1 + Lambda) falls. A itself need not be
 * monotone above the horizon: rough surfaces (A(90 degrees) > 1) rise before they fall. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "measure/stress.h"

static const stress_property properties[STRESS_COUNT] = {
    {"unit", "|length - 1| in ulps of 2^-23", 4},
    {"above", "-wm.z", 0},
    {"facing", "-wi.wm over the sum of |terms|, in 2^-24", 2},
    {"positive", "1 where the density is not finite and > 0", 0},
    {"repeated", "|pdf(sample)/density returned - 1|", 1e-5},
    {"inverted", "distance to sample(invert), beyond 4 steps of u", 1e-5},
    {"area", "A < max(0, cos), relative, or not finite", 2e-7},
    {"mirrored", "|A(w) - A(-w) - cos|/A", 1e-6},
    {"lambda", "Lambda < 0 above, |Lambda(-w) + 1 + Lambda(w)|/(1 + |Lambda|)", 0},
    {"g1", "G1 outside [0, 1], |G1 (1 + Lambda) - 1|", 1e-6},
    {"g2", "G2 outside [0, 1]; separable <= correlated <= least G1", 1e-6},
    {"monotone", "Lambda falls, or G1 or A below the horizon rise, relative", 1e-6},
};

const stress_property *stress_property_of(stress_id id)
{
    return &properties[id];
}

size_t stress_failed(const stress_result *result)
{
    size_t failed = 0;
    for (int id = 0; id < STRESS_COUNT; id++)
        failed += result->found[id].failed > 0;
    return failed;
}

int stress_note(stress_result *result, stress_id id, double value, const stress_point *at)
{
    stress_finding *found = &result->found[id];
    int good = value <= properties[id].limit; /* not for NaN */
    if (found->checked++ == 0 || !(value <= found->worst)) {
        found->worst = isnan(value) ? INFINITY : value;
        found->at = *at;
    }
    found->failed += !good;
    return good;
}

/* ---- samples ---- */

double stress_length(vndf_vec3 w)
{
    return sqrt((double)w.x * (double)w.x + (double)w.y * (double)w.y + (double)w.z * (double)w.z);
}

/* As far as wi.wm is below 0, against its terms: wi is rounded to unit length, component by component, and the
 * normal faces what comes out. */
double stress_turned_away(vndf_vec3 wi, vndf_vec3 wm)
{
    double x = (double)wi.x * (double)wm.x, y = (double)wi.y * (double)wm.y, z = (double)wi.z * (double)wm.z;
    double size = fabs(x) + fabs(y) + fabs(z);
    return size > 0 ? -(x + y + z) / size * 0x1p24 : 0;
}

static double distance_stretched(const vndf_surface *surface, vndf_vec3 a, vndf_vec3 b)
{
    double scale = vndf_distribution_info(surface->distribution).scale;
    double per_x = 1 / ((double)surface->alpha_x * scale), per_y = 1 / ((double)surface->alpha_y * scale);
    double u[3] = {(double)a.x * per_x, (double)a.y * per_y, (double)a.z};
    double v[3] = {(double)b.x * per_x, (double)b.y * per_y, (double)b.z}, sum = 0;
    double lu = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]), lv = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        sum += (u[i] / lu - v[i] / lv) * (u[i] / lu - v[i] / lv);
    return sqrt(sum);
}

/* The normal that the uniform numbers of `wm` give; NaN if they are none. */
static vndf_vec3 returned(const vndf_view *view, vndf_vec3 wm)
{
    vndf_vec3 none = {NAN, NAN, NAN};
    float u1 = -1, u2 = -1;
    vndf_invert(view, wm, &u1, &u2);
    return u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1 ? vndf_sample(view, u1, u2, NULL) : none;
}

static float moved(float u, int steps)
{
    return (float)fmin(1, fmax(0, (double)u + steps * 0x1p-24));
}

/* How far from wm four steps of u1, of u2 and of both lead. */
static double led_by_steps(const vndf_surface *surface, const vndf_view *view, const stress_point *at,
                           vndf_vec3 wm)
{
    double most = 0;
    for (int i = 0; i < 9; i++) {
        vndf_vec3 there = vndf_sample(view, moved(at->u1, 4 * (i % 3 - 1)), moved(at->u2, 4 * (i / 3 - 1)), NULL);
        most = fmax(most, distance_stretched(surface, there, wm));
    }
    return most;
}

static int is_inside(float u)
{
    return u >= 0x1p-22f && u <= 1 - 0x1p-22f;
}

/* From where less than 1e-10 of what grazing directions see is visible: there the numbers of a table run out. */
static int is_deep(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_vec3 level = {wi.x, wi.y, 0};
    return wi.z < 0 && !(vndf_projected_area(surface, wi) > 1e-10f * vndf_projected_area(surface, level));
}

/* 0 where four steps of the numbers lead as far; within four steps of the border of the unit square, where the
 * side u2 = 0 is drawn together to one normal and the sides u1 = 0 and 1 come to lie at a right angle to wi, so
 * that all of u2 changes with the last bit of the azimuth; and deep below the horizon. */
static double lost_by_inversion(const vndf_surface *surface, const vndf_view *view, const stress_point *at,
                                vndf_vec3 wm)
{
    double lost = distance_stretched(surface, wm, returned(view, wm));
    if (isnan(lost) || lost <= 1e-5)
        return lost;
    if (!is_inside(at->u1) || !is_inside(at->u2) || is_deep(surface, at->wi))
        return 0;
    return lost > led_by_steps(surface, view, at, wm) ? lost : 0;
}

/* Straight from below every normal is turned away: the one view whose samples have density 0. */
int stress_wrong_density(vndf_vec3 wi, float pdf)
{
    if (wi.x == 0 && wi.y == 0 && wi.z < 0)
        return pdf != 0;
    return !(pdf > 0 && pdf <= FLT_MAX);
}

void stress_measure_sample(const vndf_surface *surface, const vndf_view *view, const stress_point *at,
                           stress_result *result)
{
    float pdf = -1;
    vndf_vec3 wm = vndf_sample(view, at->u1, at->u2, &pdf);
    result->samples++;
    stress_note(result, STRESS_UNIT, fabs(stress_length(wm) - 1) * 0x1p23, at);
    stress_note(result, STRESS_ABOVE, -(double)wm.z, at);
    stress_note(result, STRESS_FACING, stress_turned_away(at->wi, wm), at);
    stress_note(result, STRESS_POSITIVE, stress_wrong_density(at->wi, pdf), at);
    stress_note(result, STRESS_REPEATED, pdf > 0 ? fabs((double)vndf_pdf(view, wm) / (double)pdf - 1) : 0, at);
    stress_note(result, STRESS_INVERTED, lost_by_inversion(surface, view, at, wm), at);
}

/* ---- directions ---- */

static vndf_vec3 opposite(vndf_vec3 w)
{
    vndf_vec3 v = {-w.x, -w.y, -w.z};
    return v;
}

/* Exactly, but for the horizon itself, where Lambda is the largest float on either side. */
static double lambda_error(vndf_vec3 wi, float lambda, float back)
{
    if (wi.z >= 0 && !(lambda >= 0))
        return INFINITY;
    if (wi.z == 0)
        return lambda == FLT_MAX && back == FLT_MAX ? 0 : INFINITY;
    float large = wi.z > 0 ? lambda : back, small = wi.z > 0 ? back : lambda;
    return fabs((double)small - (double)(-1 - large)) / (1 + fabs((double)large));
}

/* Outside [0, 1] is infinitely wrong. */
static double g1_error(vndf_vec3 wi, float g1, float lambda)
{
    if (!(g1 >= 0 && g1 <= 1) || (wi.z <= 0 && g1 != 0))
        return INFINITY;
    return wi.z > 0 && lambda < 1e30f ? fabs((double)g1 * (1 + (double)lambda) - 1) : 0;
}

static double g2_error(const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wo)
{
    double apart = (double)vndf_g2(surface, wi, wo, VNDF_G2_SEPARABLE);
    double joint = (double)vndf_g2(surface, wi, wo, VNDF_G2_HEIGHT_CORRELATED);
    double least = fmin((double)vndf_g1(surface, wi), (double)vndf_g1(surface, wo));
    if (!(apart >= 0 && apart <= 1 && joint >= 0 && joint <= 1))
        return INFINITY;
    return least > 0 ? fmax(apart - joint, joint - least) / least : apart + joint;
}

void stress_measure_direction(const vndf_surface *surface, const stress_point *at, stress_result *result)
{
    vndf_vec3 back = opposite(at->wi);
    double cosine = (double)at->wi.z / stress_length(at->wi), up = fmax(cosine, 0);
    float a = vndf_projected_area(surface, at->wi), b = vndf_projected_area(surface, back);
    float lambda = vndf_lambda(surface, at->wi), mirrored = vndf_lambda(surface, back);
    double area = (double)a, largest = fmax(area, (double)b), miss = fabs(area - (double)b - cosine);
    stress_note(result, STRESS_AREA, a >= 0 && a <= FLT_MAX ? (up - area) / (up > 0 ? up : 1) : INFINITY, at);
    stress_note(result, STRESS_MIRRORED, largest > 0 ? miss / largest : fabs(cosine), at);
    stress_note(result, STRESS_LAMBDA, lambda_error(at->wi, lambda, mirrored), at);
    stress_note(result, STRESS_G1, g1_error(at->wi, vndf_g1(surface, at->wi), lambda), at);
    stress_note(result, STRESS_G2, g2_error(surface, at->wi, at->wo), at);
}

/* By how much more, relative; denormals have no digits. */
static double rise(float from, float to)
{
    return to > from && to >= FLT_MIN ? (double)to / (double)from - 1 : 0;
}

void stress_measure_step(const vndf_surface *surface, const stress_point *at, stress_result *result)
{
    double worst = 0;
    if (at->wi.z > 0 && at->wo.z > 0)
        worst = fmax(rise(vndf_lambda(surface, at->wo), vndf_lambda(surface, at->wi)),
                     rise(vndf_g1(surface, at->wi), vndf_g1(surface, at->wo)));
    else if (at->wi.z <= 0)
        worst = rise(vndf_projected_area(surface, at->wi), vndf_projected_area(surface, at->wo));
    stress_note(result, STRESS_MONOTONE, worst, at);
}
