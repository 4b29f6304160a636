/* What the panels of a profile may have missed. They saw ten points each; between points a source that can be
 * bounded (vndf_reach) is followed over pieces, halved where its bound is wide, until all of it together strays by
 * no more than PROOF_STRAY from what a few values of each piece tell; and these values are compared with the
 * polynomials through the panels' own points. */
#ifndef VNDF_FIT_PROFILE_PROOF_H
#define VNDF_FIT_PROFILE_PROOF_H

#include "fit/profile/profile.h"

typedef struct vndf_proof {
    double hidden;       /* bound on what panels missed, of the mass or of the area at grazing incidence */
    double worst, where; /* largest bound of one place, as a part of them, and its slope in the source's unit */
    int proven;          /* the bound is small enough, and so is what was found */
    double *edge;        /* slopes in the source's unit about what was found and not seen, ascending; owned */
    size_t edge_count;
} vndf_proof;

/* 0 if there is no memory or the build has to end; to be freed either way. Needs the profile's points. */
int vndf_proof_from(vndf_proof *proof, const vndf_profile *profile);
/* The same for a source that has no bound, by values no farther apart than half of `width` of their slope: what is as
 * wide is met. Nothing is proven of what is not; proven says that no more was found. */
int vndf_proof_by_samples(vndf_proof *proof, const vndf_profile *profile, double width);

void vndf_proof_free(vndf_proof *proof);

#endif
