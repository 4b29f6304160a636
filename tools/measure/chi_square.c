/* Pooling: going through the bins in order, those with fewer than 5 expected are added up until they
 * hold 5, then make one class. The classes stay local, so a deviation in a tail is not drowned by the
 * rest of it. What is left at the end joins the last class. */
#include "measure/chi_square.h"

#include <math.h>
#include <stdlib.h>

#include "measure/bins.h"
#include "cli/random.h"
#include "measure/statistics.h"

static const double least_expected = 5;

typedef struct class_sum {
    double expected, observed;
} class_sum;

static double deviation(class_sum sum)
{
    double difference = sum.observed - sum.expected;
    return difference * difference / sum.expected;
}

/* The class that is kept open takes the leftovers at the end; its part is added last. */
typedef struct pooling {
    class_sum open;   /* bins below 5, being added up */
    class_sum last;   /* the newest whole class */
    double statistic; /* of the classes before it */
    size_t classes, pooled;
} pooling;

static void close_class(pooling *state, class_sum sum)
{
    if (state->classes)
        state->statistic += deviation(state->last);
    state->last = sum;
    state->classes++;
}

static void add_bin(pooling *state, class_sum bin)
{
    if (bin.expected >= least_expected) {
        close_class(state, bin);
        return;
    }
    state->pooled++;
    state->open.expected += bin.expected;
    state->open.observed += bin.observed;
    if (state->open.expected >= least_expected) {
        close_class(state, state->open);
        state->open = (class_sum){0, 0};
    }
}

static void finish_statistic(const double *probability, const double *observed, size_t samples, chi_square *result)
{
    pooling state = {{0, 0}, {0, 0}, 0, 0, 0};
    for (size_t i = 0; i < BINS_COUNT; i++) {
        result->mass += probability[i];
        add_bin(&state, (class_sum){probability[i] * (double)samples, observed[i]});
    }
    state.last.expected += state.open.expected;
    state.last.observed += state.open.observed;
    result->blind = result->mass == 0 && result->unclaimed == samples;
    result->bins = state.classes;
    result->pooled = state.pooled;
    if (state.classes)
        result->statistic = state.statistic + deviation(state.last);
    result->p = result->blind ? 1 : 0;
    if (state.classes)
        result->p = statistics_chi_square_p(result->statistic, state.classes - 1);
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
    bins_integrate(&map, &view, probability);
    draw_histogram(&map, &view, samples, seed, observed, &result->unclaimed);
    finish_statistic(probability, observed, samples, result);
    free(probability);
    return 1;
}
