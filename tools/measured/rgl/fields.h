/* Fields of a .bsdf that more than one reader looks at. */
#ifndef TOOLS_MEASURED_RGL_FIELDS_H
#define TOOLS_MEASURED_RGL_FIELDS_H

#include "measured/rgl/tensor.h"

/* The field `ndf`, azimuths by angles, its numbers finite and not negative; NULL and the reason. */
const tensor_field *rgl_ndf(const tensor_file *file, const char *name, refusal *why);

#endif
