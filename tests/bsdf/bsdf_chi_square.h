/* Sampled directions against vndf_bsdf_pdf over bins of the sphere, 65 of the cosine by 130 of the azimuth, lost
 * samples (and those that go straight on) in one more. A direction is binned by its cosine and its azimuth from
 * that of the mirrored wi, and the borders are quantiles of a pilot run mixed with even ones, as in tools/measure/bins.h:
 * half of the bins are where the samples go, however narrow the lobe. Probabilities are integrals of the pdf by
 * Gauss-Legendre rules, finer where they disagree; what they leave of 1 is the bin of what is lost. */
#ifndef TESTS_BSDF_BSDF_CHI_SQUARE_H
#define TESTS_BSDF_BSDF_CHI_SQUARE_H

#include <stdlib.h>

#include "bsdf/bsdf_case.h"
#include "measure/statistics.h"

enum { SPHERE_ROWS = 65, SPHERE_TURNS = 130, SPHERE_BINS = SPHERE_ROWS * SPHERE_TURNS, SPHERE_PILOTS = 20001 };

typedef struct sphere_map {
    const vndf_bsdf *bsdf;
    double centre;
    double z[SPHERE_ROWS + 1], phi[SPHERE_TURNS + 1];
} sphere_map;

typedef struct sphere_result {
    double p, mass, lost; /* mass: the integral of the pdf; lost: part of the samples */
    size_t classes;
} sphere_result;

static const double SPHERE_PI = 3.14159265358979323846;

static inline int sphere_ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline double sphere_turn(double phi)
{
    return remainder(phi, 2 * SPHERE_PI);
}

/* Every second border is even, the others are quantiles, from the least to the largest: beyond them a quadrature
 * that looks at few places may find nothing. The surface itself is a border of z. */
static inline void sphere_place(double *border, size_t parts, double low, double high, const double *sorted,
                                size_t count)
{
    size_t steps = (parts - 1) / 2 - 1;
    for (size_t i = 0; i < parts; i++)
        border[i] = i % 2 || !count || i < 2 ? low + (high - low) * (double)i / (double)parts
                                             : sorted[(count - 1) * (i / 2 - 1) / steps];
    border[0] = low;
    border[parts] = high;
    qsort(border, parts + 1, sizeof *border, sphere_ascending);
}

static inline void sphere_insert_zero(double *border, size_t parts)
{
    size_t nearest = 1;
    for (size_t i = 1; i < parts; i++)
        if (fabs(border[i]) < fabs(border[nearest]))
            nearest = i;
    border[nearest] = 0;
}

static inline sphere_map sphere_for(const vndf_bsdf *bsdf, vndf_vec3 wi, unsigned long long *state)
{
    sphere_map map = {.bsdf = bsdf, .centre = atan2(-(double)wi.y, -(double)wi.x)};
    static double z[SPHERE_PILOTS], phi[SPHERE_PILOTS];
    size_t count = 0;
    for (int i = 0; i < SPHERE_PILOTS; i++) {
        vndf_scattered s;
        float u[3];
        bsdf_numbers(state, u);
        vndf_bsdf_sample(bsdf, u, &s);
        if (s.lobe != VNDF_LOBE_REFLECTION && s.lobe != VNDF_LOBE_TRANSMISSION)
            continue;
        z[count] = (double)s.wo.z;
        phi[count++] = sphere_turn(atan2((double)s.wo.y, (double)s.wo.x) - map.centre);
    }
    qsort(z, count, sizeof *z, sphere_ascending);
    qsort(phi, count, sizeof *phi, sphere_ascending);
    sphere_place(map.z, SPHERE_ROWS, -1, 1, z, count);
    sphere_insert_zero(map.z, SPHERE_ROWS);
    sphere_place(map.phi, SPHERE_TURNS, -SPHERE_PI, SPHERE_PI, phi, count);
    return map;
}

static inline size_t sphere_interval(const double *border, size_t parts, double x)
{
    size_t low = 0;
    while (parts > 1) {
        size_t half = parts / 2;
        low += x >= border[low + half] ? half : 0;
        parts -= half;
    }
    return low;
}

/* ---- probabilities ---- */

static inline double sphere_pdf(const sphere_map *map, double z, double phi)
{
    vndf_vec3 w = oracle_toward(z, map->centre + phi);
    return (double)vndf_bsdf_pdf(map->bsdf, w);
}

/* Gauss-Legendre with three points in both. */
static inline double sphere_rule(const sphere_map *map, const double z[2], const double phi[2])
{
    static const double node[3] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[3] = {5, 8, 5};
    double sum = 0, mz = (z[0] + z[1]) / 2, hz = (z[1] - z[0]) / 2, mp = (phi[0] + phi[1]) / 2,
           hp = (phi[1] - phi[0]) / 2;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum += weight[i] * weight[j] * sphere_pdf(map, mz + hz * node[i], mp + hp * node[j]);
    return sum * hz * hp / 81;
}

/* In quarters until they agree with the whole within `allowed`; once in any case, a bin may hold a narrow peak. */
enum { SPHERE_DEPTH = 8 };

static inline double sphere_adaptive(const sphere_map *map, const double z[2], const double phi[2], double whole,
                                     double allowed, int depth)
{
    double mz = (z[0] + z[1]) / 2, mp = (phi[0] + phi[1]) / 2, part[4], sum = 0;
    const double zs[2][2] = {{z[0], mz}, {mz, z[1]}}, phis[2][2] = {{phi[0], mp}, {mp, phi[1]}};
    for (int i = 0; i < 4; i++)
        sum += part[i] = sphere_rule(map, zs[i / 2], phis[i % 2]);
    if (depth == 0 || (depth < SPHERE_DEPTH && fabs(sum - whole) <= allowed))
        return sum;
    sum = 0;
    for (int i = 0; i < 4; i++)
        sum += sphere_adaptive(map, zs[i / 2], phis[i % 2], part[i], allowed / 2, depth - 1);
    return sum;
}

static inline void sphere_integrate(const sphere_map *map, double allowed, double probability[SPHERE_BINS])
{
    for (size_t i = 0; i < SPHERE_ROWS; i++)
        for (size_t j = 0; j < SPHERE_TURNS; j++)
            probability[i * SPHERE_TURNS + j] =
                map->z[i] < map->z[i + 1] && map->phi[j] < map->phi[j + 1]
                    ? sphere_adaptive(map, &map->z[i], &map->phi[j], sphere_rule(map, &map->z[i], &map->phi[j]),
                                      allowed, SPHERE_DEPTH)
                    : 0;
}

/* ---- the test ---- */

static inline void sphere_draw(const sphere_map *map, size_t samples, unsigned long long *state,
                               double observed[SPHERE_BINS + 1])
{
    for (size_t i = 0; i < samples; i++) {
        vndf_scattered s;
        float u[3];
        bsdf_numbers(state, u);
        vndf_bsdf_sample(map->bsdf, u, &s);
        size_t bin = SPHERE_BINS;
        if (s.lobe == VNDF_LOBE_REFLECTION || s.lobe == VNDF_LOBE_TRANSMISSION)
            bin = sphere_interval(map->z, SPHERE_ROWS, (double)s.wo.z) * SPHERE_TURNS +
                  sphere_interval(map->phi, SPHERE_TURNS,
                                  sphere_turn(atan2((double)s.wo.y, (double)s.wo.x) - map->centre));
        observed[bin] += 1;
    }
}

/* Bins that expect less than 5 are pooled with their neighbours. */
static inline double sphere_statistic(const double *probability, const double *observed, double samples,
                                      size_t *classes)
{
    double statistic = 0, expected = 0, seen = 0;
    *classes = 0;
    for (size_t i = 0; i <= SPHERE_BINS; i++) {
        expected += probability[i] * samples;
        seen += observed[i];
        if (expected < 5)
            continue;
        statistic += (seen - expected) * (seen - expected) / expected;
        expected = seen = 0;
        ++*classes;
    }
    if (expected > 0) /* what is left has a class of its own, of few: no weaker for it */
        statistic += (seen - expected) * (seen - expected) / fmax(expected, 1);
    return statistic;
}

/* 0 if there is no memory. */
static inline int sphere_test(const vndf_bsdf *bsdf, vndf_vec3 wi, size_t samples, unsigned long long *state,
                              sphere_result *result)
{
    double *probability = calloc(2 * (SPHERE_BINS + 1), sizeof *probability), *observed;
    if (!probability)
        return 0;
    observed = probability + SPHERE_BINS + 1;
    sphere_map map = sphere_for(bsdf, wi, state);
    sphere_integrate(&map, 1e-7, probability);
    result->mass = 0;
    for (size_t i = 0; i < SPHERE_BINS; i++)
        result->mass += probability[i];
    probability[SPHERE_BINS] = fmax(1 - result->mass, 0);
    sphere_draw(&map, samples, state, observed);
    double statistic = sphere_statistic(probability, observed, (double)samples, &result->classes);
    result->lost = observed[SPHERE_BINS] / (double)samples;
    result->p = result->classes > 1 ? statistics_chi_square_p(statistic, result->classes - 1)
                : result->lost == 1 ? 1
                                    : 0;
    free(probability);
    return 1;
}

#endif
