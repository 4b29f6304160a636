/* The guard of a build: how much the build has cost so far, and why it must end early.
 *
 * The guard counts operations of some 4 to 12 ns each (vndf_build.h): evaluations of the source, and points of the
 * sums beside them. So the limit is the same on every machine, and builds stay deterministic. Every GUARD_INTERVAL
 * operations the guard asks the caller's progress function whether to go on.
 *
 * The first reason why a build must end is kept here, whatever it is. From then on nothing evaluates the source any
 * more, and all loops run out quickly. The function that began the build asks for the reason, and throws the results
 * away. */
#ifndef VNDF_FIT_GUARD_H
#define VNDF_FIT_GUARD_H

#include "core/error.h"
#include "vndf_build.h"

typedef struct vndf_guard {
    vndf_progress *progress; /* may be NULL */
    void *progress_user;
    const char *what;   /* the stage that the build is in, */
    double done;        /* and where it stands */
    double spent, next; /* operations; when to ask again */
    vndf_error why;     /* why the build must end; VNDF_OK until then */
} vndf_guard;

/* progress may be NULL. */
vndf_guard vndf_guard_from(vndf_progress *progress, void *progress_user);

/* Notes that a stage begins, and asks whether to go on. */
void vndf_guard_stage(vndf_guard *guard, double done, const char *what);

/* Counts operations; 0 if the build must end. */
int vndf_guard_spend(vndf_guard *guard, double operations);

int vndf_guard_stopped(const vndf_guard *guard);

/* Where vndf_fail may put the reason: NULL, which it takes, if there is one already. */
vndf_error *vndf_guard_why(vndf_guard *guard);
void vndf_guard_starve(vndf_guard *guard); /* there is no memory */

/* VNDF_OK, or the error that says why the build must end. */
vndf_status vndf_guard_status(const vndf_guard *guard, vndf_error *error);

#endif
