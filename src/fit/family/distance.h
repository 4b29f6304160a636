/* How far the mixture of two neighbours is from the family between them, by quadrature of the sources. */
#ifndef VNDF_FIT_FAMILY_DISTANCE_H
#define VNDF_FIT_FAMILY_DISTANCE_H

#include "vndf_build.h"

/* A source and what its integrals need; zeroed it is empty, and may be freed. */
typedef struct vndf_member {
    double p;
    vndf_source *source;
    struct vndf_profile *profile;
} vndf_member;

vndf_status vndf_member_open(vndf_member *member, const char *pattern, double p, vndf_error *error);
void vndf_member_close(vndf_member *member);

/* Total variation distances: of slopes, 1/2 integral |P22_mix - P22| dA, and of the normals that are visible at
 * grazing incidence, whose density is P22 times the slope along wi. */
typedef struct vndf_distances {
    double slopes, grazing;
} vndf_distances;

/* Between the member at p and (1 - t) low + t high. 0 if there is no memory. */
int vndf_distance_at(const vndf_member *low, const vndf_member *high, const vndf_member *member, double t,
                     vndf_distances *found);

#endif
