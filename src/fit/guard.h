/* The guard of a build: what it has cost so far, and why it has to end early.
 *
 * Costs are counted in operations, of some 4 to 12 ns each (vndf_build.h): what an evaluation of the source
 * takes, and what else is summed over is charged by what it takes. So a bound is the same on every machine, and
 * builds stay deterministic. Every GUARD_INTERVAL operations the caller's progress function is asked whether to
 * go on.
 *
 * Once a build has to end nothing evaluates the source any more, all loops run out quickly on whatever is left,
 * and who began the build asks vndf_guard_status for the reason: what was made meanwhile is of no use. */
#ifndef VNDF_FIT_GUARD_H
#define VNDF_FIT_GUARD_H

#include "vndf_build.h"

typedef struct vndf_guard {
    vndf_progress *progress; /* may be NULL */
    void *progress_user;
    const char *what;        /* the stage that the build is in, */
    double done;             /* and where it stands */
    double spent, next;      /* operations; when to ask again */
    double bad_r, bad_value; /* where the source was no density, in its own unit, and what it was */
    int bad, exhausted, interrupted, starved;
} vndf_guard;

/* progress may be NULL. */
vndf_guard vndf_guard_from(vndf_progress *progress, void *progress_user);

/* A stage begins. */
void vndf_guard_stage(vndf_guard *guard, double done, const char *what);

/* Counts operations; 0 if the build has to end. NULL is a guard that lets all pass. */
int vndf_guard_spend(vndf_guard *guard, double operations);

/* P22 is negative, infinite or not a number at slope r: the first such place is kept. */
void vndf_guard_note(vndf_guard *guard, double r, double value);

int vndf_guard_stopped(const vndf_guard *guard);

/* VNDF_OK, or the error that says why the build has to end. */
vndf_status vndf_guard_status(const vndf_guard *guard, vndf_error *error);

#endif
