/* See profile.h. */
#include "fit/profile/profile.h"

static const double OPERATIONS_MOST = VNDF_LIMIT_BUILD_OPERATIONS;
static const double GUARD_INTERVAL = 1 << 18;

vndf_guard vndf_guard_from(vndf_progress *progress, void *progress_user)
{
    return (vndf_guard){progress, progress_user, "", 0, 0, GUARD_INTERVAL, {VNDF_OK, ""}};
}

int vndf_guard_stopped(const vndf_guard *guard)
{
    return guard->why.status != VNDF_OK;
}

vndf_error *vndf_guard_why(vndf_guard *guard)
{
    return guard->why.status == VNDF_OK ? &guard->why : NULL;
}

void vndf_guard_starve(vndf_guard *guard)
{
    vndf_fail(vndf_guard_why(guard), VNDF_ERROR_MEMORY, "no memory for this build");
}

void vndf_guard_stage(vndf_guard *guard, double done, const char *what)
{
    guard->done = done;
    guard->what = what;
    if (!vndf_guard_stopped(guard) && guard->progress && guard->progress(done, what, guard->progress_user))
        vndf_fail(&guard->why, VNDF_ERROR_ARGUMENT, "interrupted (%s)", what);
}

int vndf_guard_spend(vndf_guard *guard, double operations)
{
    if (vndf_guard_stopped(guard))
        return 0;
    guard->spent += operations;
    if (guard->spent >= guard->next) {
        guard->next = guard->spent + GUARD_INTERVAL;
        vndf_guard_stage(guard, guard->done, guard->what);
    }
    if (guard->spent > OPERATIONS_MOST)
        vndf_fail(vndf_guard_why(guard), VNDF_ERROR_DISTRIBUTION,
                  "the distribution is too costly: the build was given up after %.3g operations (%s); a "
                  "formula that is shorter or has fewer features, or a smaller table, takes fewer",
                  OPERATIONS_MOST, guard->what);
    return !vndf_guard_stopped(guard);
}

vndf_status vndf_guard_status(const vndf_guard *guard, vndf_error *error)
{
    return vndf_guard_stopped(guard) ? vndf_fail(error, guard->why.status, "%s", guard->why.message) : VNDF_OK;
}
