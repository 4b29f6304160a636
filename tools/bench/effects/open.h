/* The distributions that `vndf bench effects` measures: the named ones, or by default both closed forms and a table
 * built for the purpose. */
#ifndef TOOLS_BENCH_EFFECTS_OPEN_H
#define TOOLS_BENCH_EFFECTS_OPEN_H

#include "cli/subject.h"
#include "bench/effects/effects.h"

typedef struct effects_opened {
    chosen_distribution of[EFFECTS_DISTRIBUTIONS_MAX];
    size_t count;
    vndf_distribution *built;
} effects_opened;

/* Puts the distributions into the plan. Returns 0 after a complaint; the caller closes in any case. */
int effects_open(effects_opened *o, effects_plan *plan, const char *command, const words *names);
void effects_close(effects_opened *o);

#endif
