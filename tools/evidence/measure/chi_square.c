/* Samples of one view, binned by bins.h and judged by statistics.h. */
#include "evidence/measure/chi_square.h"

#include <math.h>
#include <stdlib.h>

#include "evidence/measure/bins.h"
#include "cli/random.h"
#include "evidence/measure/statistics.h"

static const double least_expected = 5;

int chi_square_test(const vndf_surface *surface, vndf_vec3 wi, size_t samples, uint64_t seed, chi_square *result)
{
    double *expected = calloc(2 * BINS_COUNT, sizeof *expected), *observed = expected + BINS_COUNT;
    if (!expected)
        return 0;
    vndf_view view = vndf_view_from(surface, wi);
    bin_map map = bins_for(surface, wi, seed ^ 0x5851F42D4C957F2Du); /* apart from the stream that is tested */
    random_stream stream = random_from(seed);
    *result = (chi_square){0};
    for (size_t i = 0; i < samples; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
        observed[bins_place(&map, wm)] += 1;
        result->unclaimed += !(pdf > 0 && isfinite(pdf));
    }
    bins_integrate(&map, surface, wi, expected);
    for (size_t i = 0; i < BINS_COUNT; i++) {
        result->mass += expected[i];
        expected[i] *= (double)samples;
    }
    pearson found = pearson_of(expected, observed, NULL, BINS_COUNT, least_expected);
    result->blind = result->mass == 0 && result->unclaimed == samples;
    result->bins = found.classes;
    result->pooled = found.pooled;
    result->statistic = found.statistic;
    result->p = result->blind ? 1 : found.p;
    free(expected);
    return 1;
}
