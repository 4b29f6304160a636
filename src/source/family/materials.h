/* The shipped measured materials, by name. */
#ifndef VNDF_SOURCE_FAMILY_MATERIALS_H
#define VNDF_SOURCE_FAMILY_MATERIALS_H

#include <stddef.h>

typedef struct vndf_material {
    const char *name;    /* as a specification: "sgd:alum-bronze/r", "abc:two-layer-gold" */
    double parameter[2]; /* of its family: alpha, p or B, C */
} vndf_material;

enum { VNDF_MATERIAL_COUNT = 312 };
extern const vndf_material vndf_materials[VNDF_MATERIAL_COUNT];

/* The material with this name; NULL if there is none. */
const vndf_material *vndf_material_find(const char *name, size_t size);

/* Writes the names that differ from the given one by the fewest letters, "a, b, c"; returns out. */
enum { VNDF_MATERIAL_NEAREST = 192 };
const char *vndf_material_nearest(char out[VNDF_MATERIAL_NEAREST], const char *name, size_t size);

#endif
