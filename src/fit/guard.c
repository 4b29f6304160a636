#include "fit/guard.h"

#include <math.h>

#include "core/error.h"

static const double OPERATIONS_MOST = VNDF_LIMIT_BUILD_OPERATIONS;
static const double GUARD_INTERVAL = 1 << 18;
static const double DEGREES = 57.295779513082323; /* to a radian */

vndf_guard vndf_guard_from(vndf_progress *progress, void *progress_user)
{
    vndf_guard guard = {progress, progress_user, "", 0, 0, GUARD_INTERVAL, 0, 0, 0, 0, 0, 0};
    return guard;
}

int vndf_guard_stopped(const vndf_guard *guard)
{
    return guard && (guard->bad || guard->exhausted || guard->interrupted || guard->starved);
}

static void ask(vndf_guard *guard)
{
    if (guard->progress && guard->progress(guard->done, guard->what, guard->progress_user))
        guard->interrupted = 1;
}

void vndf_guard_stage(vndf_guard *guard, double done, const char *what)
{
    guard->done = done;
    guard->what = what;
    if (!vndf_guard_stopped(guard))
        ask(guard);
}

int vndf_guard_spend(vndf_guard *guard, double operations)
{
    if (!guard)
        return 1;
    if (vndf_guard_stopped(guard))
        return 0;
    guard->spent += operations;
    guard->exhausted = guard->spent > OPERATIONS_MOST;
    if (guard->spent >= guard->next) {
        guard->next = guard->spent + GUARD_INTERVAL;
        ask(guard);
    }
    return !vndf_guard_stopped(guard);
}

void vndf_guard_note(vndf_guard *guard, double r, double value)
{
    if (!guard || guard->bad)
        return;
    guard->bad = 1;
    guard->bad_r = r;
    guard->bad_value = value;
}

static vndf_status bad_value(const vndf_guard *guard, vndf_error *error)
{
    double theta = atan(guard->bad_r) * DEGREES;
    if (guard->bad_value < 0.0)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "P22 is negative (%g) at slope %g (theta_m = %.9g degrees)", guard->bad_value,
                         guard->bad_r, theta);
    return vndf_fail(error, VNDF_ERROR_DISTRIBUTION, "P22 is %s at slope %g (theta_m = %.9g degrees)",
                     isnan(guard->bad_value) ? "not a number" : "infinite", guard->bad_r, theta);
}

vndf_status vndf_guard_status(const vndf_guard *guard, vndf_error *error)
{
    if (guard->bad)
        return bad_value(guard, error);
    if (guard->starved)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to build the table");
    if (guard->interrupted)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "interrupted (%s)", guard->what);
    if (guard->exhausted)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "the distribution is too costly: the build was given up after %.3g operations (%s); a "
                         "formula that is shorter or has fewer features, or a smaller table, takes fewer",
                         OPERATIONS_MOST, guard->what);
    return VNDF_OK;
}
