/* Families of distributions by name: the form of each as P22(r), its parameters, and the area under it.
 *
 * family_forms.c holds the formulas, family.c reads specifications ("student-t:2.5", "mix:(...)+(...)"),
 * materials.c the parameters of measured materials, family_help.c the words for people. */
#ifndef VNDF_SOURCE_FAMILY_FAMILY_H
#define VNDF_SOURCE_FAMILY_FAMILY_H

#include <stddef.h>

enum { VNDF_FAMILY_PARAMETERS = 2 };

/* The range of a parameter. */
typedef struct vndf_family_range {
    const char *name;
    double low, high; /* `high` belongs to the range */
    int open;         /* `low` does not belong to it */
    double standard;  /* the default */
} vndf_family_range;

typedef struct vndf_family_form {
    const char *name, *usage; /* "gtr", "gtr:GAMMA[,ALPHA]" */
    size_t required, count;   /* numbers of parameters: the fewest and the most */
    vndf_family_range range[VNDF_FAMILY_PARAMETERS];
    const char *reason;                               /* of the limits, for messages */
    double (*p22)(const double *parameter, double r); /* any scale, finite for 0 <= r <= 1e75 */
    double (*mass)(const double *parameter);          /* 2 pi integral P22(r) r dr */
    const char *formula;                              /* p22 in r, with the parameters a and b: for bounds */
} vndf_family_form;

/* The form of this name, NULL if there is none; the i-th form, NULL past the last. */
const vndf_family_form *vndf_family_form_find(const char *name, size_t size);
const vndf_family_form *vndf_family_form_at(size_t index);

#endif
