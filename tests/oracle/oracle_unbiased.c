#include "oracle/oracle_unbiased.h"

#include <math.h>

#include "harness/test.h"

static void evaluate(const oracle_expected *e, vndf_vec3 wm, double f[ORACLE_FUNCTIONS])
{
    double slope = hypot(wm.x / e->alpha_x, wm.y / e->alpha_y) / wm.z;
    f[0] = 1;
    f[1] = wm.z;
    f[2] = wm.x;
    f[3] = (double)wm.y * wm.y;
    f[4] = (double)e->wi.x * wm.x + (double)e->wi.y * wm.y + (double)e->wi.z * wm.z;
    f[5] = 1 / (1 + pow(slope / e->middle, -8)); /* smooth, so that the quadrature needs no edge there */
}

static void add_point(const oracle_point *point, void *user)
{
    oracle_expected *e = user;
    double f[ORACLE_FUNCTIONS];
    evaluate(e, point->wm, f);
    for (int i = 0; i < ORACLE_FUNCTIONS; i++)
        e->reference[i] += f[i] * point->reference * point->weight;
}

oracle_expected oracle_expect(const oracle *o, const vndf_surface *surface, vndf_vec3 wi)
{
    oracle_expected e = {
        surface->alpha_x, surface->alpha_y, wi, vndf_distribution_info(surface->distribution).scale, {0}};
    oracle_visit(o, surface, wi, add_point, &e);
    return e;
}

void oracle_averages(const oracle *o, const vndf_distribution *table, const oracle_expected *expected,
                     unsigned long samples, unsigned long long *state, oracle_average average[ORACLE_FUNCTIONS])
{
    vndf_surface surface = {table, expected->alpha_x, expected->alpha_y};
    vndf_view view = vndf_view_from(&surface, expected->wi);
    double area = oracle_surface_area(o, &surface, expected->wi), sum[ORACLE_FUNCTIONS] = {0},
           squares[ORACLE_FUNCTIONS] = {0};
    for (unsigned long n = 0; n < samples; n++) {
        float pdf, u1 = test_uniform(state), u2 = test_uniform(state);
        vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
        double f[ORACLE_FUNCTIONS], weight = oracle_visible(o, &surface, expected->wi, wm, area) / (double)pdf;
        evaluate(expected, wm, f);
        for (int i = 0; i < ORACLE_FUNCTIONS; i++) { /* about the reference, so that squares keep their digits */
            double term = f[i] * weight - expected->reference[i];
            sum[i] += term;
            squares[i] += term * term;
        }
    }
    for (int i = 0; i < ORACLE_FUNCTIONS; i++) {
        double mean = sum[i] / (double)samples, variance = squares[i] / (double)samples - mean * mean;
        oracle_average one = {expected->reference[i] + mean, sqrt(variance / (double)samples)};
        average[i] = one;
    }
}
