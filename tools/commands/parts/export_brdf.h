/* `vndf export --rgl`: single scattering of one distribution as a file of reflectances. */
#ifndef TOOLS_COMMANDS_PARTS_EXPORT_BRDF_H
#define TOOLS_COMMANDS_PARTS_EXPORT_BRDF_H

#include "cli/arguments.h"

typedef struct brdf_words {
    words tables, rgl, alpha, f0, wavelengths, output;
} brdf_words;

/* An exit status. */
int export_brdf(const char *command, const brdf_words *given);

/* What --help says of it, with an example. */
enum { BRDF_HELP_MAX = 4096 };
extern const char brdf_help[];

#endif
