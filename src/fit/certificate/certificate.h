/* The certificate says how good a table is. It compares densities (before vndf_pdf rounds them to float), areas
 * and D of the run time with the profile of the source. */
#ifndef VNDF_FIT_CERTIFICATE_CERTIFICATE_H
#define VNDF_FIT_CERTIFICATE_CERTIFICATE_H

#include "fit/profile/profile.h"
#include "table/table.h"

/* A quick certificate is measured in the directions where a coarse look found most, a full one in all directions of a
 * survey ten times as dense. 0 if there is no memory. */
int vndf_certificate_measure(vndf_certificate *certificate, const vndf_distribution *table,
                             const vndf_profile *profile, int quick);

#endif
