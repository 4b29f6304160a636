/* `vndf build` from files of measurements. */
#ifndef TOOLS_COMMANDS_PARTS_BUILD_MEASURED_H
#define TOOLS_COMMANDS_PARTS_BUILD_MEASURED_H

#include "cli/arguments.h"
#include "vndf_build.h"

/* How many files were given. */
size_t measured_count(const arguments *given);

/* Whether every option stands with its file; 0 after a complaint. */
int measured_check(const arguments *given);

/* The source of the one file, to be freed, which says what it was made of; what was found on the way, as lines, in
 * found[]. NULL after a complaint. */
enum { MEASURED_NOTES = 4096 };
vndf_source *measured_source(const arguments *given, char found[MEASURED_NOTES]);

/* What --help says of them. */
#define MEASURED_HELP                                                                                               \
  "From measurements (tools/measured/README.md says what is assumed of each). What was found is printed with the\n" \
  "table: errors, residuals that say how well D explains the data, and for stretched surfaces the matrix of the\n"  \
  "surface that they are: vndf sample FILE --matrix XX,XY,YX,YY.\n"                                                 \
  "\n"                                                                                                              \
  "  --rgl FILE      a .bsdf of EPFL's realistic graphics lab: its ndf; anisotropic ones are refused\n"             \
  "  --merl FILE     a .binary of MERL: by power iteration of the light that goes back, less a diffuse constant\n"  \
  "    --channel red|green|blue|luminance    (default luminance)\n"                                                 \
  "  --height FILE   heights of a surface: PFM, PGM, or numbers between blanks\n"                                   \
  "    --step X[,Y]  how far samples are apart, in the unit of the heights (default 1)\n"                           \
  "    --cutoff N    takes waves shorter than N samples away first, 2 to 256 (Gaussian, ISO 16610-21)\n"            \
  "  --normal-map FILE    normals of a surface: PPM of 8 or 16 bits, or PFM\n"                                      \
  "  --profile OUT   the curve that was found, as a CSV for --csv\n"                                                \
  "\n"                                                                                                              \
  "example: vndf build --rgl leather.bsdf -o leather.vndf\n"                                                        \
  "         vndf build --merl gold-paint.binary --channel red -o gold-paint.vndf\n"                                 \
  "         vndf build --height surface.pfm --step 0.5 --cutoff 8 -o surface.vndf\n"

#endif
