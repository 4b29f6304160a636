#include "oracle/oracle_float.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/test.h"
#include "sampler/law.h"
#include "vndf_build.h"

static const double least_true = 1e-30;

const char *float_quantity_name(float_quantity quantity)
{
    static const char *const names[FLOAT_COUNT] = {"density", "drawn", "weight", "area", "lambda", "g1", "ndf"};
    return names[quantity];
}

/* ---- subjects ---- */

/* Builds "BYTES SLOPE" into a file. */
static int build_into(const char *recipe, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    char *slope;
    vndf_build_options options = {.max_bytes = strtoul(recipe, &slope, 10)};
    int family = strncmp(slope, " family ", 8) == 0;
    vndf_source *source =
        family ? vndf_source_family(slope + 8, &error) : vndf_source_slope_expression(slope, NULL, 0, &error);
    vndf_distribution *table = source ? vndf_build(source, &options, NULL, &error) : NULL;
    int good = table && vndf_save(table, path, &error) == VNDF_OK;
    if (!good)
        fprintf(stderr, "%s: %s\n", recipe, error.message);
    vndf_free(table);
    vndf_source_free(source);
    return good;
}

static int open_path(float_subject *subject, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    subject->table = vndf_load(path, &error);
    if (!subject->table)
        fprintf(stderr, "%s\n", error.message);
    return subject->table && oracle_table_read(&subject->reference, path);
}

int float_subject_open(float_subject *subject, const char *name, const char *scratch)
{
    static const char *const folders[] = {"/tables/", "/tests/corpus/table/"};
    memset(subject, 0, sizeof *subject);
    snprintf(subject->name, sizeof subject->name, "%s", name);
    if (strchr(name, ' ')) {
        int good = build_into(name, scratch) && open_path(subject, scratch);
        remove(scratch);
        return good;
    }
    for (int i = 0; i < 2; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s%s%s", VNDF_SOURCE_DIR, folders[i], name);
        FILE *file = fopen(path, "rb");
        if (file) {
            fclose(file);
            return open_path(subject, path);
        }
    }
    fprintf(stderr, "%s: no such table\n", name);
    return 0;
}

void float_subject_close(float_subject *subject)
{
    vndf_free(subject->table);
    oracle_table_free(&subject->reference);
}

/* ---- errors ---- */

static oracle_query query_of(const float_point *at, vndf_vec3 wm)
{
    oracle_query q = {{(double)at->wi.x, (double)at->wi.y, (double)at->wi.z},
                      {(double)at->alpha_x, (double)at->alpha_y},
                      {(double)wm.x, (double)wm.y, (double)wm.z}};
    return q;
}

/* A true value beyond the largest float is that float. */
static double error_of(double got, double want)
{
    double limited = fmin(fabs(want), (double)FLT_MAX), error = fabs(got - copysign(limited, want)) / limited;
    return isnan(error) ? INFINITY : error;
}

/* The error, or where it is above the limit the least one of the values on all sides. */
static double nearest(double got, const double *value, size_t n, int *aside)
{
    double error = error_of(got, value[0]);
    for (size_t i = 1; i < n && error > FLOAT_LIMIT; i++)
        if (error_of(got, value[i]) < error) {
            error = error_of(got, value[i]);
            *aside = 1;
        }
    return error;
}

/* ... and nothing where the density is too steep for double. */
static double unless_blurred(const float_subject *subject, const oracle_query *q, double got, double error,
                             int ndf, int *aside)
{
    double range[2];
    if (error <= FLOAT_LIMIT)
        return error;
    oracle_table_blur(&subject->reference, q, ndf, range);
    if (!(range[0] <= got && got <= range[1]))
        return error;
    *aside = 1;
    return 0;
}

static double density_error(const float_subject *subject, float_quantity quantity, const float_point *at,
                            int *aside)
{
    vndf_surface surface = {subject->table, at->alpha_x, at->alpha_y};
    vndf_view view = vndf_view_from(&surface, at->wi);
    vndf_vec3 wm = at->wm;
    double value[ORACLE_SIDES];
    float density;
    if (quantity == FLOAT_DRAWN)
        wm = vndf_sample(&view, at->wm.x, at->wm.y, &density);
    else
        density = quantity == FLOAT_NDF ? vndf_ndf(&surface, wm) : vndf_pdf(&view, wm);
    oracle_query q = query_of(at, wm);
    size_t n = quantity == FLOAT_NDF ? oracle_table_ndfs(&subject->reference, &q, value)
                                     : oracle_table_densities(&subject->reference, &q, value);
    if (!(value[0] > least_true))
        return -1;
    double error = nearest((double)density, value, n, aside);
    return unless_blurred(subject, &q, (double)density, error, quantity == FLOAT_NDF, aside);
}

/* All quotients of a D and a density. */
static double weight_error(const float_subject *subject, const float_point *at, int *aside)
{
    vndf_surface surface = {subject->table, at->alpha_x, at->alpha_y};
    vndf_view view = vndf_view_from(&surface, at->wi);
    double density[ORACLE_SIDES], ndf[ORACLE_SIDES], value[ORACLE_SIDES * ORACLE_SIDES], d[2], p[2];
    float pdf, weight;
    int ready;
    vndf_vec3 wm = vndf_sample_weight(&view, at->wm.x, at->wm.y, &pdf, &weight);
    oracle_query q = query_of(at, wm);
    size_t n = oracle_table_densities(&subject->reference, &q, density);
    size_t m = oracle_table_ndfs(&subject->reference, &q, ndf);
    double facing = vndf_exact_dot(at->wi, wm);
    double length = sqrt(vndf_exact_dot(at->wi, at->wi)); /* the oracle's area is that of a unit vector */
    double area = at->wi.z > 0 ? (double)vndf_law_view_area(&view, &ready)
                               : length * oracle_table_area(&subject->reference, &q);
    double got = (double)weight * area;
    for (size_t i = 0; i < m * n; i++)
        value[i] = ndf[i / n] * facing / density[i % n];
    if (!(area > least_true && density[0] > least_true && ndf[0] * facing > least_true &&
          density[0] < (double)FLT_MAX))
        return -1;
    double error = nearest(got, value, m * n, aside);
    if (error <= FLOAT_LIMIT)
        return error;
    oracle_table_blur(&subject->reference, &q, 1, d);
    oracle_table_blur(&subject->reference, &q, 0, p);
    *aside = d[0] * facing <= got * p[1] && got * p[0] <= d[1] * facing;
    return *aside ? 0 : error;
}

static double direction_error(const float_subject *subject, float_quantity quantity, const float_point *at)
{
    vndf_surface surface = {subject->table, at->alpha_x, at->alpha_y};
    oracle_query q = query_of(at, at->wm);
    double got, want;
    if (quantity == FLOAT_AREA) {
        got = (double)vndf_projected_area(&surface, at->wi);
        want = oracle_table_area(&subject->reference, &q);
    } else if (quantity == FLOAT_LAMBDA) {
        got = (double)vndf_lambda(&surface, at->wi);
        want = oracle_table_lambda(&subject->reference, &q);
    } else {
        got = (double)vndf_g1(&surface, at->wi);
        want = oracle_table_g1(&subject->reference, &q);
    }
    return fabs(want) > least_true ? error_of(got, want) : -1;
}

static int is_valid(const float_subject *subject, const float_point *at)
{
    double x = (double)at->alpha_x * subject->reference.scale, y = (double)at->alpha_y * subject->reference.scale;
    int zero = at->wi.x == 0 && at->wi.y == 0 && at->wi.z == 0;
    return x > 1.001e-18 && x < 0.999e18 && y > 1.001e-18 && y < 0.999e18 && !zero;
}

double float_error(const float_subject *subject, float_quantity quantity, const float_point *at, int *aside)
{
    *aside = 0;
    if (!is_valid(subject, at))
        return -1;
    if (quantity == FLOAT_WEIGHT)
        return weight_error(subject, at, aside);
    if (quantity == FLOAT_DENSITY || quantity == FLOAT_DRAWN || quantity == FLOAT_NDF)
        return density_error(subject, quantity, at, aside);
    return direction_error(subject, quantity, at);
}

void float_note(float_worst worst[FLOAT_COUNT], const float_subject *subject, float_quantity quantity,
                const float_point *at)
{
    float_worst *w = &worst[quantity];
    int aside;
    double error = float_error(subject, quantity, at, &aside);
    if (error < 0)
        return;
    w->checked++;
    w->aside += (size_t)aside;
    w->missed += !(error <= FLOAT_LIMIT);
    if (error > w->error || w->checked == 1) {
        w->error = error;
        w->at = *at;
    }
}

/* ---- climbing ---- */

static float nudged(float value, unsigned long long *state)
{
    double u = test_uniform_double(state), step = pow(10, -8 + 7.5 * test_uniform_double(state));
    if (u < 0.4)
        return value;
    if (u < 0.7)
        return nextafterf(value, u < 0.55 ? -2 : 2);
    return (float)((double)value * (1 + (u - 0.85) * step));
}

/* Whether a point holds uniform numbers. */
static int is_drawn(float_quantity quantity)
{
    return quantity == FLOAT_DRAWN || quantity == FLOAT_WEIGHT;
}

static float_point neighbour(float_point at, int drawn, unsigned long long *state)
{
    float *numbers[8] = {&at.wi.x, &at.wi.y, &at.wi.z, &at.alpha_x, &at.alpha_y, &at.wm.x, &at.wm.y, &at.wm.z};
    for (int i = 0; i < 8; i++)
        *numbers[i] = nudged(*numbers[i], state);
    at.wm.z = fabsf(at.wm.z);
    if (drawn) {
        at.wm.x = fminf(fmaxf(at.wm.x, 0), 1);
        at.wm.y = fminf(fmaxf(at.wm.y, 0), 1);
    }
    return at;
}

void float_climb(float_worst *worst, const float_subject *subject, float_quantity quantity, size_t steps,
                 unsigned long long *state)
{
    for (size_t i = 0; worst->checked && i < steps; i++) {
        float_point at = neighbour(worst->at, is_drawn(quantity), state);
        int aside;
        double length = hypot(hypot((double)at.wm.x, (double)at.wm.y), (double)at.wm.z);
        if (!is_drawn(quantity)) { /* unit as far as rounding lets it */
            at.wm.x = (float)((double)at.wm.x / length);
            at.wm.y = (float)((double)at.wm.y / length);
            at.wm.z = (float)((double)at.wm.z / length);
        }
        double error = float_error(subject, quantity, &at, &aside);
        worst->checked += error >= 0;
        worst->aside += (size_t)aside;
        worst->missed += !(error <= FLOAT_LIMIT);
        if (error > worst->error) {
            worst->error = error;
            worst->at = at;
        }
    }
}

/* ---- all of it ---- */

void float_run(float_worst worst[FLOAT_COUNT], const float_subject *subject, size_t random, size_t hard,
               size_t climb, unsigned long long seed)
{
    unsigned long long state = seed;
    for (size_t i = 0; i < random + hard; i++) {
        float_point at = i < random ? float_point_random(subject, &state) : float_point_hard(subject, &state);
        float_point drawn = float_point_drawn(at, &state);
        for (int id = 0; id < FLOAT_COUNT; id++)
            float_note(worst, subject, (float_quantity)id, is_drawn((float_quantity)id) ? &drawn : &at);
    }
    for (int id = 0; id < FLOAT_COUNT; id++)
        float_climb(&worst[id], subject, (float_quantity)id, climb, &state);
}

void float_print(const float_subject *subject, float_quantity quantity, const float_worst *worst)
{
    const float_point *at = &worst->at;
    printf("%s,%s,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.3g\n", subject->name, float_quantity_name(quantity),
           (double)at->wi.x, (double)at->wi.y, (double)at->wi.z, (double)at->alpha_x, (double)at->alpha_y,
           (double)at->wm.x, (double)at->wm.y, (double)at->wm.z, worst->error);
}

int float_scan(const char *line, char name[64], float_quantity *quantity, float_point *at)
{
    char word[16];
    double n[8];
    int fields = sscanf(line, "%63[^,],%15[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", name, word, &n[0], &n[1], &n[2],
                        &n[3], &n[4], &n[5], &n[6], &n[7]),
        id = 0;
    while (id < FLOAT_COUNT && strcmp(word, float_quantity_name((float_quantity)id)) != 0)
        id++;
    if (fields != 10 || id == FLOAT_COUNT)
        return 0;
    float_point read = {{(float)n[0], (float)n[1], (float)n[2]},
                        (float)n[3],
                        (float)n[4],
                        {(float)n[5], (float)n[6], (float)n[7]}};
    *at = read;
    *quantity = (float_quantity)id;
    return 1;
}
