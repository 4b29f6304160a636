/* `vndf export --rgl`: single scattering of one distribution as a file of reflectances. */
#ifndef TOOLS_COMMANDS_PARTS_EXPORT_BRDF_H
#define TOOLS_COMMANDS_PARTS_EXPORT_BRDF_H

#include "cli/arguments.h"

/* An exit status. */
int export_brdf(const arguments *given);

/* What --help says of it, with an example. */
#define BRDF_HELP                                                                                                     \
  "As reflectances, for hosts that read measured ones: what a surface of this D mirrors once, F by Schlick, masked\n" \
  "by Smith with heights correlated. FILE is one table, ggx or beckmann.\n"                                           \
  "\n"                                                                                                                \
  "  --rgl            a .bsdf that Mitsuba 3 (plugin measured) renders as it is; with --wavelengths, its spectral\n"  \
  "                   variants and pbrt-v4\n"                                                                         \
  "    --alpha A      roughness (default 1, D as the table holds it)\n"                                               \
  "    --f0 R[,G,B]   reflectance at normal incidence, 0 to 1 (default 1: all light is reflected)\n"                  \
  "    --wavelengths L,...  nanometres, ascending, up to 16; --f0 then has one number, or one for each\n"             \
  "\n"                                                                                                                \
  "example: vndf export tables/student-t-2.5.vndf --rgl --alpha 0.3 --f0 1,0.78,0.34 -o gold.bsdf\n"

#endif
