#include "cli/sort.h"
#include "harness/constants.h"
#include "oracle/oracle.h"
#include "oracle/oracle_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the distributions ---- */

static double ggx(double r)
{
    return pow(1 + r * r, -2);
}

static double beckmann(double r)
{
    return exp(-r * r);
}

static double student(double r) /* gamma 1.8 */
{
    return pow(1 + r * r / 0.8, -1.8);
}

static double laplace(double r)
{
    return exp(-r);
}

/* Shifted gamma (Bagher et al. 2012), the published fit of nickel, red: alpha 0.00556292, p 0.171288. */
static double measured(double r)
{
    double alpha = 0.00556292, x = alpha + r * r / alpha;
    return exp(-x) * pow(x / alpha, -0.171288);
}

/* Seven tenths Beckmann and three of a GGX a hundred times narrower, each of mass 1. */
static double haze(double r)
{
    return 0.7 * exp(-r * r) + 0.3e4 * pow(1 + 1e4 * r * r, -2);
}

static double ring(double r)
{
    return exp(-pow((r - 1) / 0.2, 2));
}

static double disc(double r)
{
    return r <= 1 ? 1 : 0;
}

static const oracle oracles[ORACLE_COUNT] = {
    {"ggx", ggx, {0, 0}, 1e-6, 1e12, 0, 0},
    {"beckmann", beckmann, {0, 0}, 1e-6, 6, 0, 0},
    {"student-t:1.8", student, {0, 0}, 1e-6, 1e20, 0, 0},
    {"exp(-r)", laplace, {0, 0}, 1e-6, 40, 0, 0},
    {"sgd:nickel/r", measured, {0, 0}, 5e-9, 0.5, 0, 0},
    {"mix:(0.7,1,beckmann)+(0.3,0.01,ggx)", haze, {0, 0}, 1e-8, 1e10, 0, 0},
    {"exp(-((r-1)/0.2)^2)", ring, {0, 0}, 1e-6, 2.4, 1, 0},
    {"step(1-r)", disc, {1, 0}, 1e-6, 1, 1, 0},
};

/* ---- quadrature ---- */

typedef double function(double x, const void *user);

/* sum over the abscissae k h, k = first, first + step, ... of both signs; x = middle + half tanh(pi/2 sinh t). The
 * distance to the nearer end is formed without a difference, for integrands that begin like a root there. */
static double tanh_sinh_sum(function *f, const void *user, double a, double b, double h, int first, int step)
{
    double half = (b - a) / 2, sum = first == 0 ? PI / 2 * f((a + b) / 2, user) : 0;
    for (int k = first == 0 ? step : first; k * h < 4.0; k += step) {
        double t = k * h, q = exp(-PI * sinh(t)), from_end = 2 * half * q / (1 + q);
        double weight = PI / 2 * cosh(t) * 4 * q / ((1 + q) * (1 + q));
        sum += weight * (f(a + from_end, user) + f(b - from_end, user));
    }
    return sum * half;
}

/* Over [a, b], smooth inside but for the ends; relative error about 1e-12. */
static double integrate(function *f, const void *user, double a, double b)
{
    double h = 0.5, sum = tanh_sinh_sum(f, user, a, b, h, 0, 1), last = sum * h;
    for (int level = 0; level < 6; level++) {
        h /= 2;
        sum += tanh_sinh_sum(f, user, a, b, h, 1, 2);
        if (level > 1 && fabs(sum * h - last) <= 1e-12 * fabs(sum * h))
            break;
        last = sum * h;
    }
    return sum * h;
}

/* ---- normalisation and area ---- */

typedef struct direction {
    const oracle *o;
    double s, c;
} direction;

/* In u = log r. */
static double seen_at(double u, const void *user)
{
    const direction *d = user;
    double r = exp(u);
    return d->o->shape(r) * r * r * oracle_circle(d->c, d->s * r);
}

/* From r0 to r1 in panels of at most half an octave of slope, narrower where the shape falls steeply. */
static double seen_between(const direction *d, double r0, double r1)
{
    double sum = 0, u = log(r0), end = log(r1);
    while (u < end) {
        double r = exp(u), here = d->o->shape(r), there = d->o->shape(r * 1.001);
        double steep = here > 0 && there > 0 ? fabs(log(there / here)) / 0.001 : 0,
               next = u + 0.35 / (1 + 0.1 * steep);
        next = next < end ? next : end;
        sum += integrate(seen_at, d, u, next);
        u = next;
    }
    return sum;
}

double oracle_area(const oracle *o, double s, double c)
{
    direction d = {o, s, c};
    double edge[4] = {o->peak}, sum = 0;
    double cut = s > 0 ? fabs(c) / s : HUGE_VAL;
    int n = 1;
    if (o->breaks[0] > o->peak && o->breaks[0] < o->reach)
        edge[n++] = o->breaks[0];
    if (cut > o->peak && cut < o->reach)
        edge[n++] = cut;
    sort_numbers(edge + 1, (size_t)n - 1);
    edge[n] = o->reach;
    if (c < 0 && cut > o->reach) /* a tail that is nothing beside the mass may be all that is seen */
        edge[0] = cut, edge[n = 1] = 1e3 * cut;
    for (int i = 0; i < n; i++)
        sum += edge[i] < edge[i + 1] ? seen_between(&d, edge[i], edge[i + 1]) : 0;
    return o->norm * sum;
}

double oracle_p22(const oracle *o, double r)
{
    return o->norm * o->shape(r);
}

/* ---- making ---- */

oracle oracle_get(size_t index)
{
    oracle o = oracles[index];
    o.norm = 1;
    o.norm = 1 / oracle_area(&o, 0, 1); /* seen from above, every slope counts its own area */
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

vndf_vec3 oracle_direction(double theta, double phi)
{
    double t = theta * PI / 180, p = phi * PI / 180, s = sin(t);
    vndf_vec3 w = {(float)(s * cos(p)), (float)(s * sin(p)), theta == 90 ? 0.0f : (float)cos(t)};
    return w;
}
