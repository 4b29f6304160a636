/* A comparison that is under way, and its ways: one scene drawn from in several ways, or several readings of it
 * with other tables. */
#ifndef COMPARE_WAYS_H
#define COMPARE_WAYS_H

#include "cli/progress.h"
#include "compare/run.h"

typedef struct under_way {
    const compare_choice *choice;
    scene scenes[WAYS_MAX];
    size_t scene_count;
    path_plan *plans[WAYS_MAX];
    contest contest;
    film reference;
    comparison result;
    char reference_is[96];
    progress progress;
} under_way;

/* Reads the scene, as often as tables differ, and fills the contest's ways; an exit status, with a complaint if
 * it is not good. ways_free is due in any case. */
int ways_prepare(under_way *run);
void ways_free(under_way *run);

#endif
