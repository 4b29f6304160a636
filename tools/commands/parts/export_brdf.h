/* `vndf export --rgl`: single scattering of one distribution as a file of reflectances. */
#ifndef TOOLS_COMMANDS_PARTS_EXPORT_BRDF_H
#define TOOLS_COMMANDS_PARTS_EXPORT_BRDF_H

#include "cli/arguments.h"

/* An exit status. */
int export_brdf(const arguments *given);

#endif
