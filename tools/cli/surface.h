/* The surface that sample and eval look at: FILE|ggx|beckmann|FILE.vndfs@P with --alpha, or one or more --lobe. */
#ifndef TOOLS_CLI_SURFACE_H
#define TOOLS_CLI_SURFACE_H

#include "cli/subject.h"

/* The options that sample and eval share. */
typedef struct aim_words {
    words theta, phi, alpha, lobes;
} aim_words;

/* A lobe of the mixture belongs to the --lobe `option`, counted from 0: a family makes two lobes of one. */
typedef struct chosen_surface {
    vndf_mixture mixture;
    int option[VNDF_MIXTURE_LOBES];
    chosen_distribution table[VNDF_MIXTURE_LOBES];
    vndf_family *family[VNDF_MIXTURE_LOBES];
    int tables, families; /* that are open */
    vndf_vec3 wi;
} chosen_surface;

/* The surface and the direction, from --theta (needed), --phi and either a positional word and --alpha or lobes.
 * Returns 1, or 0 after a complaint. */
int surface_open(chosen_surface *chosen, const char *command, const aim_words *aim, const words *positional);
void surface_close(chosen_surface *chosen);

/* D, Lambda and G1 of the surface. One lobe gives the bits of its distribution alone. */
float surface_ndf(const chosen_surface *chosen, vndf_vec3 wm);
float surface_lambda(const chosen_surface *chosen);
float surface_g1(const chosen_surface *chosen);

/* The positional word, and help for --lobe. */
#define SURFACE_POSITIONAL "FILE|ggx|beckmann|FILE.vndfs@P"
#define SURFACE_HELP                                                                                                \
  "FILE is a table (vndf build); FILE.vndfs@P is a family of tables (vndf build --parameter) at the parameter P,\n" \
  "as in tails.vndfs@2.7. A surface of several lobes takes, in their place and that of --alpha, up to 8 times\n"    \
  "\n"                                                                                                              \
  "  --lobe 'KEY=VALUE ...'  with the keys, between blanks and each once:\n"                                        \
  "      table=" SURFACE_POSITIONAL "\n"                                                                            \
  "                               the distribution of the lobe (needed); FILE has no blanks in its name\n"          \
  "      parameter=P              of table=FILE.vndfs, in the place of @P; a family takes two of the 8 lobes\n"     \
  "      weight=W                 its part of the surface, over the sum of all weights (default 1)\n"               \
  "      alpha=AX[,AY]            its roughness (default 1), or\n"                                                  \
  "      matrix=XX,XY,YX,YY       the linear map of its slopes, s = M u + mean, not singular\n"                     \
  "      mean=X,Y                 its mean slope (default 0,0)\n"

#endif
