/* The public oracle: a profile without a table. */
#include <math.h>
#include <stdlib.h>

#include "fit/profile/profile.h"
#include "core/error.h"

struct vndf_truth {
    vndf_profile *profile;
};

vndf_truth *vndf_truth_from(const vndf_source *source, vndf_error *error)
{
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, NULL, &guard, error);
    vndf_truth *truth = profile ? malloc(sizeof *truth) : NULL;
    if (profile)
        profile->guard = NULL; /* threads may ask for areas at once, so none shares a counter */
    if (truth)
        truth->profile = profile;
    else if (profile) {
        vndf_profile_free(profile);
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for the truth of a distribution");
    }
    return truth;
}

double vndf_truth_p22(const vndf_truth *truth, double r)
{
    return truth->profile->normalization * vndf_source_p22(truth->profile->source, r);
}

double vndf_truth_area(const vndf_truth *truth, double theta)
{
    return vndf_profile_area(truth->profile, sin(theta) * truth->profile->scale, cos(theta));
}

void vndf_truth_free(vndf_truth *truth)
{
    if (!truth)
        return;
    vndf_profile_free(truth->profile);
    free(truth);
}
