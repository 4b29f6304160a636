/* What the user points at: a distribution (FILE|ggx|beckmann), a roughness, an incident direction; and the surface that
 * sample and eval look at, of one distribution with --alpha, or of one or more --lobe. */
#ifndef TOOLS_CLI_SUBJECT_H
#define TOOLS_CLI_SUBJECT_H

#include "cli/arguments.h"
#include "vndf.h"

/* ---- distributions ---- */

/* A closed form, or a table that was loaded and is to be freed. */
typedef struct chosen_distribution {
    const vndf_distribution *distribution;
    vndf_distribution *owned; /* NULL for a closed form */
} chosen_distribution;

/* "ggx", "beckmann" (a file of that name: "./ggx"), a table file, or "-" for one on stdin. Returns 1, or 0 after a
 * complaint. */
int distribution_open(chosen_distribution *chosen, const char *command, const char *name);
void distribution_close(chosen_distribution *chosen);

/* A file with the tables of a family is known by its name, FILE.vndfs, and one of the family by FILE.vndfs@P. */
int is_family_file(const char *name);

/* Returns the family in a file, or NULL after a complaint. */
vndf_family *family_open(const char *command, const char *path);

/* ---- directions and roughness ---- */

/* The unit direction at theta and phi in degrees; exact where either is a multiple of 90. */
vndf_vec3 direction_from(double theta, double phi);

/* Whether so little of the surface faces w (from below the horizon, along a narrow lobe) that densities may
 * underflow: views where nothing but density 0 is no fault. */
int sees_nothing(const vndf_surface *surface, vndf_vec3 w);

/* "AX" or "AX,AY" into *surface; text NULL: 1, 1. Returns 1, or 0 after a complaint. */
int roughness_from(const char *command, const char *text, vndf_surface *surface);

/* ---- surfaces ---- */

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
int surface_open(chosen_surface *chosen, const arguments *given);
void surface_close(chosen_surface *chosen);

/* The positional word, and help for it, for the direction and for --lobe. */
#define SURFACE_POSITIONAL "FILE|ggx|beckmann|FILE.vndfs@P"
#define AIM_HELP                                                                                                  \
  "  --theta DEG      angle of the incident direction from the normal, 0 to 180; above 90 is below the surface\n" \
  "  --phi DEG        its azimuth from the x axis, -360 to 360 (default 0)\n"                                     \
  "  --alpha AX[,AY]  roughness along x and y (default 1: the distribution as the builder received it)\n"
#define SURFACE_HELP                                                                                                \
  "FILE is a table (vndf build), - for stdin; FILE.vndfs@P is a family of tables (vndf build --parameter) at the\n" \
  "parameter P, as in tails.vndfs@2.7. A surface of several lobes takes, in their place and that of --alpha, up\n"  \
  "to 8 times\n"                                                                                                    \
  "\n"                                                                                                              \
  "  --lobe 'KEY=VALUE ...' ...  with the keys, between blanks and each once:\n"                                    \
  "      table=" SURFACE_POSITIONAL "\n"                                                                            \
  "                               the distribution of the lobe (needed); FILE has no blanks in its name,\n"         \
  "                               and a family takes two of the 8 lobes\n"                                          \
  "      weight=W                 its part of the surface, over the sum of all weights (default 1)\n"               \
  "      alpha=AX[,AY]            its roughness (default 1), or\n"                                                  \
  "      matrix=XX,XY,YX,YY       the linear map of its slopes, s = M u + mean, not singular\n"                     \
  "      mean=X,Y                 its mean slope (default 0,0)\n"

#endif
