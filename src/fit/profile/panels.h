/* Makes panels and sums over them; inside of panels.c, settle.c and profile.c. */
#ifndef VNDF_FIT_PROFILE_PANELS_H
#define VNDF_FIT_PROFILE_PANELS_H

#include "fit/profile/profile.h"

/* Panels lie between 2^-VNDF_OCTAVES and 2^VNDF_OCTAVES of the source's own unit. */
enum { VNDF_OCTAVES = 100 };

/* An exponent this close to the limit of integrable ones counts as the limit. */
static const double VNDF_POWER_MARGIN = 1e-6;

/* Whether the guard or the limit of panels stops the work. */
int vndf_profile_stopped(const vndf_profile *profile);

/* The largest P r^2 at a few thousand slopes, to see what is negligible. */
double vndf_panels_peak(vndf_profile *profile);

/* What passes know of those before, since all look at the same slopes: the largest P22 r^2 of the source; and whether
 * one panel was enough between two edges. Zeroed before the first pass but for the peak; free `simple` after the
 * last. */
typedef struct vndf_known {
    double peak;
    unsigned char *simple; /* edge i and the next */
    size_t count;          /* edges */
} vndf_known;

/* Makes the panels, unless something stops it. */
void vndf_panels_fill(vndf_profile *profile, vndf_known *known);

/* Fills what lies before and beyond each panel, and the totals. */
void vndf_panels_sum(vndf_profile *profile);

/* The Gauss points of all panels, for integrals with other kernels; 0 if there is no memory. */
int vndf_panels_points(vndf_profile *profile);

/* -d log P / d log r between two slopes; infinite if P vanishes there. */
double vndf_panels_exponent(vndf_profile *profile, double r0, double r1);

/* The slope with half of the mass on either side. */
double vndf_panels_median(vndf_profile *profile);

/* Integrates until two passes agree, and says what is wrong if P22 is no microsurface's (settle.c). */
vndf_status vndf_profile_settle(vndf_profile *profile, vndf_error *error);

#endif
