/* What the user points at: a distribution (FILE|ggx|beckmann), a roughness, an incident direction. */
#ifndef TOOLS_CLI_SUBJECT_H
#define TOOLS_CLI_SUBJECT_H

#include "cli/arguments.h"
#include "vndf.h"

/* A closed form, or a table that was loaded and is to be freed. */
typedef struct chosen_distribution {
    const vndf_distribution *distribution;
    vndf_distribution *owned; /* NULL for a closed form */
} chosen_distribution;

/* "ggx", "beckmann" or a table file (one of that name: "./ggx"). Returns 1, or 0 after a complaint. */
int distribution_open(chosen_distribution *chosen, const char *command, const char *name);
void distribution_close(chosen_distribution *chosen);

/* A file with the tables of a family is known by its name, FILE.vndfs, and one of the family by FILE.vndfs@P. */
int is_family_file(const char *name);

/* The parameter's text behind FILE.vndfs@, or NULL. */
const char *family_parameter(const char *name);

/* Returns the family in a file, or NULL after a complaint. */
vndf_family *family_open(const char *command, const char *path);

/* The unit direction at theta and phi in degrees; exact where either is a multiple of 90. */
vndf_vec3 direction_from(double theta, double phi);

/* Whether so little of the surface faces w (from below the horizon, along a narrow lobe) that densities may
 * underflow: views where nothing but density 0 is no fault. */
int sees_nothing(const vndf_surface *surface, vndf_vec3 w);

/* "AX" or "AX,AY" into *surface; text NULL: 1, 1. Returns 1, or 0 after a complaint. */
int roughness_from(const char *command, const char *text, vndf_surface *surface);

#endif
