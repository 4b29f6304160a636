/* Samples of one view, binned by bins.h and judged by statistics.h. */
#include "evidence/measure/chi_square.h"

#include <math.h>
#include <stdlib.h>

#include "evidence/measure/bins.h"
#include "cli/random.h"
#include "evidence/measure/statistics.h"

static const double least_expected = 5;

/* Writes what is expected over the probabilities. */
static void judge(double *probability, const double *observed, size_t samples, chi_square *result)
{
    for (size_t i = 0; i < BINS_COUNT; i++) {
        result->mass += probability[i];
        probability[i] *= (double)samples;
    }
    pearson found = pearson_of(probability, observed, NULL, BINS_COUNT, least_expected);
    result->blind = result->mass == 0 && result->unclaimed == samples;
    result->bins = found.classes;
    result->pooled = found.pooled;
    result->statistic = found.statistic;
    result->p = result->blind ? 1 : found.p;
}

static void draw_histogram(const bin_map *map, const vndf_view *view, size_t samples, uint64_t seed,
                           double *observed, size_t *unclaimed)
{
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < samples; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_sample(view, u1, u2, &pdf);
        observed[bins_place(map, wm)] += 1;
        *unclaimed += !(pdf > 0 && isfinite(pdf));
    }
}

int chi_square_test(const vndf_surface *surface, vndf_vec3 wi, size_t samples, uint64_t seed, chi_square *result)
{
    double *probability = calloc(2 * BINS_COUNT, sizeof *probability);
    if (!probability)
        return 0;
    double *observed = probability + BINS_COUNT;
    vndf_view view = vndf_view_from(surface, wi);
    bin_map map = bins_for(surface, wi, seed ^ 0x5851F42D4C957F2Du); /* apart from the stream that is tested */
    *result = (chi_square){0};
    result->mass_rounding = bins_integrate(&map, surface, wi, probability);
    draw_histogram(&map, &view, samples, seed, observed, &result->unclaimed);
    judge(probability, observed, samples, result);
    free(probability);
    return 1;
}
