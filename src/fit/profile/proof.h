/* How much the panels of a profile may have missed. A panel looked at ten points. Between points the proof follows
 * a source that can be bounded (vndf_reach) over pieces. It halves pieces with a wide bound, until all pieces
 * together stray by at most STRAY from a few values in each; then it compares these values with the polynomials
 * through the points of the panels. */
#ifndef VNDF_FIT_PROFILE_PROOF_H
#define VNDF_FIT_PROFILE_PROOF_H

#include "fit/profile/profile.h"

typedef struct vndf_proof {
    double hidden;       /* bound on what panels missed, of the mass or of the area at grazing incidence */
    double worst, where; /* largest bound of one place, as such a part, and its slope in the source's unit */
    int proven;          /* the bound and the miss that was found are small enough */
    double *edge;        /* slopes in the source's unit about features that panels missed, ascending; owned */
    size_t edge_count;
} vndf_proof;

/* 0 if there is no memory or the build must end; free it either way. Needs the points of the profile. */
int vndf_proof_from(vndf_proof *proof, const vndf_profile *profile);
/* The same for a source that has no bound, by values at most half of `width` times their slope apart, which meet a
 * feature of that width. Narrower features are not excluded; `proven` then means that no more was found. */
int vndf_proof_by_samples(vndf_proof *proof, const vndf_profile *profile, double width);

void vndf_proof_free(vndf_proof *proof);

#endif
