/* From a description back to the source: `--slope 'exp(-a*r)' --set a=0.3` names everything that made it. */
#ifndef VNDF_SOURCE_PROVENANCE_H
#define VNDF_SOURCE_PROVENANCE_H

#include "vndf_build.h"

/* The source that has this description. Understands --ndf, --slope, --set and --family; refuses the
 * description of a CSV or a callback (VNDF_ERROR_ARGUMENT: what made them is not in it), and of anything else. */
vndf_source *vndf_source_from_description(const char *description, vndf_error *error);

#endif
