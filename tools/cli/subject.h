/* What the user points at: a distribution (FILE|ggx|beckmann), a roughness, an incident direction, a surface. */
#ifndef TOOLS_CLI_SUBJECT_H
#define TOOLS_CLI_SUBJECT_H

#include "cli/arguments.h"
#include "vndf.h"

/* ---- distributions ---- */

/* A closed form, a table that was loaded, or a family of tables. */
typedef struct chosen_distribution {
    const vndf_distribution *distribution; /* NULL for a family */
    vndf_distribution *owned;              /* the table, to be freed */
    vndf_family *family;                   /* to be freed */
} chosen_distribution;

/* "ggx", "beckmann" (a file of that name: "./ggx"), a table file, or "-" for one on stdin; FILE.vndfs where families
 * are taken. Returns 1, or 0 after a complaint. */
int distribution_open(chosen_distribution *chosen, const char *command, const char *name, int families);
void distribution_close(chosen_distribution *chosen);

/* A file with the tables of a family is known by its name, FILE.vndfs, and one of the family by FILE.vndfs@P. */
int is_family_file(const char *name);

/* ---- directions and roughness ---- */

/* The unit direction at theta and phi in degrees; exact where either is a multiple of 90. */
vndf_vec3 direction_from(double theta, double phi);

/* Whether so little of the surface faces w (from below the horizon, along a narrow lobe) that densities may
 * underflow: views where nothing but density 0 is no fault. */
int sees_nothing(const vndf_surface *surface, vndf_vec3 w);

/* "AX" or "AX,AY" into *surface; text NULL: 1, 1. Returns 1, or 0 after a complaint. */
int roughness_from(const char *command, const char *text, vndf_surface *surface);

/* ---- surfaces ---- */

/* What is sampled: one distribution, or the two neighbours of a family's parameter. */
typedef struct chosen_surface {
    vndf_mixture mixture;
    chosen_distribution of;
    vndf_vec3 wi;
} chosen_surface;

/* From the positional word and the options of SURFACE_HELP; close what it is of. Returns 1, or 0 after a
 * complaint. */
int surface_open(chosen_surface *chosen, const arguments *given);

#define SURFACE_POSITIONAL "FILE|ggx|beckmann|FILE.vndfs@P"
#define SURFACE_HELP                                                                                                \
  "FILE is a table (vndf build), - for stdin; FILE.vndfs@P is a family of tables (vndf build --parameter) at the\n" \
  "parameter P, as in tails.vndfs@2.7.\n"                                                                           \
  "\n"                                                                                                              \
  "  --theta DEG      angle of the incident direction from the normal, 0 to 180; above 90 is below the surface\n"   \
  "  --phi DEG        its azimuth from the x axis, -360 to 360 (default 0)\n"                                       \
  "  --alpha AX[,AY]  roughness along x and y (default 1: the distribution as the builder received it), or\n"       \
  "  --matrix XX,XY,YX,YY  the linear map of its slopes, s = M u + mean, not singular\n"                            \
  "  --mean X,Y       its mean slope (default 0,0)\n"

#endif
