/* The distributions that `vndf bench effects` measures: those that are named, or by default both closed forms and a
 * table that is built. */
#ifndef TOOLS_BENCH_EFFECTS_OPEN_H
#define TOOLS_BENCH_EFFECTS_OPEN_H

#include "cli/subject.h"
#include "bench/effects/effects.h"

typedef struct effects_opened {
    chosen_distribution of[EFFECTS_DISTRIBUTIONS_MAX];
    size_t count;
    vndf_distribution *built;
    char path[1024]; /* of a file of what was built, for other processes; "" if there is none */
} effects_opened;

/* Into the plan; `for_others`: what is built gets a file that other processes can open. 0 after a complaint; to be
 * closed in any case. */
int effects_open(effects_opened *o, effects_plan *plan, const char *command, const words *names, int for_others);
int effects_open_one(effects_opened *o, effects_plan *plan, const char *command, const char *name);
void effects_close(effects_opened *o);

#endif
