#include "measure/turns.h"

#include <math.h>
#include <stdlib.h>

#include "cli/clock.h"
#include "cli/sort.h"

static const double shortest = 20e-6; /* seconds: a shorter run is repeated, for the clock's sake */

double turns_seconds(void (*run)(void *user), void *user)
{
    double start = clock_seconds();
    run(user);
    double once = clock_seconds() - start;
    int repeats = (int)fmin(fmax(shortest / fmax(once, 1e-7), 1), 100);
    start = clock_seconds();
    for (int i = 0; i < repeats; i++)
        run(user);
    return (clock_seconds() - start) / repeats;
}

/* Into column `turn` of the series, `most` numbers each. */
static int take(const turns_plan *plan, size_t turn, double *number, double *all)
{
    for (size_t i = 0; i < plan->series; i++)
        number[i] = NAN;
    if (!plan->take(plan->user, turn, number))
        return 0;
    for (size_t i = 0; i < plan->series; i++)
        all[i * plan->most + turn] = number[i];
    return 1;
}

/* The count of turns; 0: stopped. */
static size_t take_all(const turns_plan *plan, double *number, double *all)
{
    double start = clock_seconds();
    size_t turns = 0;
    if (!take(plan, 0, number, all))
        return 0;
    for (; turns < plan->most && (turns < plan->least || clock_seconds() - start < plan->seconds); turns++)
        if (!take(plan, turns, number, all))
            return 0;
    return turns;
}

vndf_status turns_run(const turns_plan *plan, turns_quartiles *found)
{
    double *number = malloc(plan->series * (1 + plan->most) * sizeof *number);
    if (!number)
        return VNDF_ERROR_MEMORY;
    double *all = number + plan->series;
    size_t turns = take_all(plan, number, all);
    for (size_t i = 0; i < plan->series && turns; i++) {
        double *of = all + i * plan->most;
        sort_numbers(of, turns);
        found[i] = (turns_quartiles){of[turns / 4], of[turns / 2], of[3 * turns / 4]};
    }
    free(number);
    return turns ? VNDF_OK : VNDF_ERROR_ARGUMENT;
}
