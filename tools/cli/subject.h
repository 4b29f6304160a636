/* What the user points at: a distribution (FILE|ggx|beckmann), the source of one that is to be tabulated (a formula, a
 * CSV, a named family), a roughness, an incident direction. */
#pragma once

#include "cli/arguments.h"
#include "vndf_build.h"

typedef struct chosen_distribution {
    const vndf_distribution *distribution; /* NULL for a family */
    vndf_distribution *owned;              /* the table, to be freed */
    vndf_family *family;                   /* to be freed */
} chosen_distribution;

/* "ggx", "beckmann" (a file of that name: "./ggx"), a table file, or "-" for one on stdin; FILE.vndfs where families
 * are taken. Returns 1, or 0 after a complaint. */
int distribution_open(chosen_distribution *chosen, const char *command, const char *name, int families);
void distribution_close(chosen_distribution *chosen);

/* A file with the tables of a family is known by its name, FILE.vndfs. */
int is_family_file(const char *name);

/* --ndf, --slope, --csv, --family; NULL ends them. */
extern const char *const source_kinds[];

/* The source of the one that was given, or of the family `otherwise` where none was (NULL: one is needed). NULL after a
 * complaint, also where --set stands with another one than a formula. */
vndf_source *source_from_words(const arguments *given, const char *otherwise);

/* Of rows of D or P22 in a CSV, or on stdin for "-"; NULL after a complaint. */
vndf_source *source_from_csv(const char *command, const char *path);

/* For people: its description; of a family its name. */
const char *source_name(const vndf_source *source);

/* The unit direction at theta and phi in degrees; exact where either is a multiple of 90. */
vndf_vec3 direction_from(double theta, double phi);

/* "AX" or "AX,AY" into *surface; text NULL: 1, 1. Returns 1, or 0 after a complaint. */
int roughness_from(const char *command, const char *text, vndf_surface *surface);
