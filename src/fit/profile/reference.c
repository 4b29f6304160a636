/* The public oracle: a profile without a table. */
#include <math.h>
#include <stdlib.h>

#include "fit/profile/profile.h"
#include "core/error.h"

struct vndf_reference {
    vndf_profile *profile;
};

vndf_reference *vndf_reference_from(const vndf_source *source, vndf_error *error)
{
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    if (!source) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "a source is needed");
        return NULL;
    }
    vndf_profile *profile = vndf_profile_from(source, NULL, &guard, error);
    vndf_reference *reference = profile ? malloc(sizeof *reference) : NULL;
    if (profile)
        profile->guard = NULL; /* threads may ask for areas at once, so none shares a counter */
    if (reference)
        reference->profile = profile;
    else if (profile) {
        vndf_profile_free(profile);
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for the reference of a distribution");
    }
    return reference;
}

double vndf_reference_p22(const vndf_reference *reference, double r)
{
    return reference ? reference->profile->normalization * vndf_source_p22(reference->profile->source, r) : 0.0;
}

double vndf_reference_area(const vndf_reference *reference, double theta)
{
    if (!reference)
        return 0.0;
    return vndf_profile_area(reference->profile, sin(theta) * reference->profile->scale, cos(theta));
}

void vndf_reference_free(vndf_reference *reference)
{
    if (!reference)
        return;
    vndf_profile_free(reference->profile);
    free(reference);
}
