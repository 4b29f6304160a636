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
    char path[1024]; /* of the built table's file, for other processes; or "" */
} effects_opened;

/* Puts the distributions into the plan. If `for_others`, a built table gets a file that other processes can open.
 * Returns 0 after a complaint; the caller closes in any case. */
int effects_open(effects_opened *o, effects_plan *plan, const char *command, const words *names, int for_others);
int effects_open_one(effects_opened *o, effects_plan *plan, const char *command, const char *name);
void effects_close(effects_opened *o);

#endif
