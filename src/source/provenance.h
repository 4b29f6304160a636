/* From a description back to the source: `--slope 'exp(-a*r)' --set a=0.3` names everything that made it. */
#ifndef VNDF_SOURCE_PROVENANCE_H
#define VNDF_SOURCE_PROVENANCE_H

#include "vndf_build.h"

/* Makes the source that has this description. It understands --ndf, --slope, --set and --family, and refuses any
 * other (VNDF_ERROR_ARGUMENT): the descriptions of a CSV and of a callback do not hold the data. */
vndf_source *vndf_source_from_description(const char *description, vndf_error *error);

#endif
