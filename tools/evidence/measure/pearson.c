/* Bins that expect little go together with their neighbours, so that a deviation in a tail is not drowned by the
 * rest of it. The newest class is kept open, since what is left at the end joins it. */
#include "evidence/measure/pearson.h"

#include "evidence/measure/statistics.h"

typedef struct class_sum {
    double expected, observed, variance;
} class_sum;

typedef struct pooling {
    class_sum open; /* bins that expect little, being added up */
    class_sum last; /* the newest whole class */
    pearson found;  /* the statistic is that of the classes before it */
} pooling;

static void add_up(class_sum *sum, class_sum more)
{
    sum->expected += more.expected;
    sum->observed += more.observed;
    sum->variance += more.variance;
}

static double deviation(class_sum sum)
{
    double difference = sum.observed - sum.expected;
    return difference * difference / sum.variance;
}

static void close_class(pooling *state, class_sum sum)
{
    if (state->found.classes)
        state->found.statistic += deviation(state->last);
    state->last = sum;
    state->found.classes++;
}

static void add_bin(pooling *state, class_sum bin, double least)
{
    if (bin.expected >= least) {
        close_class(state, bin);
        return;
    }
    state->found.pooled++;
    add_up(&state->open, bin);
    if (state->open.expected >= least) {
        close_class(state, state->open);
        state->open = (class_sum){0, 0, 0};
    }
}

pearson pearson_of(const double *expected, const double *observed, const double *variance, size_t bins,
                   double least)
{
    pooling state = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0, 0}};
    for (size_t i = 0; i < bins; i++)
        add_bin(&state, (class_sum){expected[i], observed[i], variance ? variance[i] : expected[i]}, least);
    if (!state.found.classes)
        return state.found;
    add_up(&state.last, state.open);
    state.found.statistic += deviation(state.last);
    state.found.p = statistics_chi_square_p(state.found.statistic, state.found.classes - 1);
    return state.found;
}
