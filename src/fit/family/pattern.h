/* A family of sources along one number: a specification (vndf_source_family) with {p} in the place of the number. A
 * name alone, "student-t", is "student-t:{p}". */
#ifndef VNDF_FIT_FAMILY_PATTERN_H
#define VNDF_FIT_FAMILY_PATTERN_H

#include "vndf_build.h"

/* With seven digits: what knots and probes are rounded to, so that a specification shows all of them. */
double vndf_pattern_number(double p);

/* The source at p; NULL and an error. */
vndf_source *vndf_pattern_source(const char *pattern, double p, vndf_error *error);

/* Arguments of `vndf build`, to be freed; NULL and an error. */
char *vndf_pattern_describe(const char *pattern, double low, double high, vndf_error *error);

/* VNDF_OK if the pattern says where the number stands. */
vndf_status vndf_pattern_check(const char *pattern, vndf_error *error);

#endif
