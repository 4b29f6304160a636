/* Makes the panels of a profile, and looks between their points; inside of panels.c, proof.c and profile.c. Until a
 * profile is complete its scale is 1: slopes are those of the source. */
#ifndef VNDF_FIT_PROFILE_PANELS_H
#define VNDF_FIT_PROFILE_PANELS_H

#include "fit/profile/profile.h"

/* Panels lie between 2^-VNDF_OCTAVES and 2^VNDF_OCTAVES of the source's own unit. */
enum { VNDF_OCTAVES = 100 };

/* An exponent this close to the limit of integrable ones counts as the limit. */
static const double VNDF_POWER_MARGIN = 1e-6;

/* Where panels are cut: a jump in the middle would add half to either rule, and look smooth. */
static const double VNDF_UNEVEN = 0.43;

/* The cost of a bound (vndf_reach), over the cost of a value. */
static const double VNDF_REACH_OPERATIONS = 12;

/* Whether the guard or the limit of panels stops the work. */
int vndf_profile_stopped(const vndf_profile *profile);

/* The largest P r^2 and P r^3 at a few thousand slopes, to see what is negligible. */
typedef struct vndf_peak {
    double mass, along;
} vndf_peak;
vndf_peak vndf_panels_peak(const vndf_profile *profile);

/* Makes the panels with their points, unless something stops it. */
void vndf_panels_fill(vndf_profile *profile, vndf_peak peak);

/* Fills what lies before and beyond each panel, and the totals. */
void vndf_panels_sum(vndf_profile *profile);

/* What panels missed. */
typedef struct vndf_proof {
    double hidden;       /* bound on what panels missed, of the mass or of the area at grazing incidence */
    double worst, where; /* largest bound of one place, as such a part, and its slope */
    int proven;          /* the bound and the miss that was found are small enough */
    double *edge;        /* slopes about features that panels missed, ascending; owned */
    size_t edge_count;
} vndf_proof;

/* By bounds, for a source that has them (proof.c). 0 if there is no memory or the build must end; free it either
 * way. */
int vndf_proof_from(vndf_proof *proof, const vndf_profile *profile);
/* By values at most half of `width` times their slope apart, which meet a feature of that width. Narrower features are
 * not excluded; `proven` then means that no more was found. */
int vndf_proof_by_samples(vndf_proof *proof, const vndf_profile *profile, double width);

#endif
