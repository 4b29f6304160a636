/* What `vndf albedo` prints of a table of albedos: text, CSV, an array in C. */
#ifndef TOOLS_COMMANDS_ALBEDO_PRINT_H
#define TOOLS_COMMANDS_ALBEDO_PRINT_H

#include <stddef.h>
#include <stdio.h>

#include "vndf_albedo.h"

enum { ALBEDO_LIST_MAX = 16 };

/* Roughness and angles of incidence, degrees, that rows and columns are printed for. */
typedef struct albedo_lists {
    double alpha[ALBEDO_LIST_MAX], theta[ALBEDO_LIST_MAX];
    size_t alphas, thetas;
} albedo_lists;

/* E over theta and alpha from each side, of a dielectric also what is transmitted; averages; the measured errors. */
void albedo_print_text(FILE *file, const char *subject, const vndf_albedo *albedo, const albedo_lists *at);

/* The last part of that text: the measured errors, the grid and the size. */
void albedo_print_facts(FILE *file, const vndf_albedo_properties *is);

void albedo_print_csv(FILE *file, const char *subject, const vndf_albedo *albedo, const albedo_lists *at);

/* float NAME[size][size] over roughness sqrt(alpha) and cosine, both even from 0 to 1, and NAME_average[size]; of a
 * dielectric the same from the other side. NAME is the last name of `path` as an identifier of C. */
void albedo_print_c(FILE *file, const char *path, const vndf_albedo *albedo, int size);

#endif
