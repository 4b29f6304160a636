/* The guard of a build: how much the build has cost so far, and why it must end early.
 *
 * The guard counts operations of some 4 to 12 ns each (vndf_build.h): evaluations of the source, and points of the
 * sums beside them. So the limit is the same on every machine, and builds stay deterministic. Every GUARD_INTERVAL
 * operations the guard asks the caller's progress function whether to go on.
 *
 * Once a build must end, nothing evaluates the source any more, and all loops run out quickly. The function that
 * began the build then asks vndf_guard_status for the reason, and throws the results away. */
#ifndef VNDF_FIT_GUARD_H
#define VNDF_FIT_GUARD_H

#include "vndf_build.h"

typedef struct vndf_guard {
    vndf_progress *progress; /* may be NULL */
    void *progress_user;
    const char *what;        /* the stage that the build is in, */
    double done;             /* and where it stands */
    double spent, next;      /* operations; when to ask again */
    double bad_r, bad_value; /* where the source was no density, in its own unit, and its value */
    int bad, exhausted, interrupted, starved;
} vndf_guard;

/* progress may be NULL. */
vndf_guard vndf_guard_from(vndf_progress *progress, void *progress_user);

/* Notes that a stage begins. */
void vndf_guard_stage(vndf_guard *guard, double done, const char *what);

/* Counts operations; 0 if the build must end. NULL is a guard that lets every build go on. */
int vndf_guard_spend(vndf_guard *guard, double operations);

/* Notes that P22 is negative, infinite or NaN at slope r; keeps the first such slope. */
void vndf_guard_note(vndf_guard *guard, double r, double value);

int vndf_guard_stopped(const vndf_guard *guard);

/* VNDF_OK, or the error that says why the build must end. */
vndf_status vndf_guard_status(const vndf_guard *guard, vndf_error *error);

#endif
