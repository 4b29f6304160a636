/* Families of distributions by name: the form of each as P22(r), its parameters, and the area under it.
 *
 * forms.c holds the formulas and the words for people, family.c reads specifications ("student-t:2.5",
 * "mix:(...)+(...)") and makes sources of them, materials.c holds the parameters of measured materials. */
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
    const char *reason;  /* of the limits, for messages */
    const char *formula; /* P22 in r and the parameters a and b, at any scale */
    const char *mass;    /* 2 pi integral P22(r) r dr in a and b; NULL: by quadrature */
} vndf_family_form;

enum { VNDF_FAMILY_FORMS = 10 };
extern const vndf_family_form vndf_family_forms[VNDF_FAMILY_FORMS];

/* The shipped measured materials. */
typedef struct vndf_material_fit {
    const char *name;    /* as a specification: "sgd:alum-bronze/r", "abc:two-layer-gold" */
    double parameter[2]; /* of its family: alpha, p or B, C */
} vndf_material_fit;

enum { VNDF_MATERIAL_FITS = 312 };
extern const vndf_material_fit vndf_material_fits[VNDF_MATERIAL_FITS];

/* The material whose name differs from the given one by the fewest letters. */
const vndf_material_fit *vndf_material_near(const char *name, size_t size);

#endif
