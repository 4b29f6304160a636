/* The sets of effects of vndf_bsdf.h that are measured, each a method that scatters light, and bare reflection
 * written by hand beside them. */
#ifndef TOOLS_EVIDENCE_EFFECTS_H
#define TOOLS_EVIDENCE_EFFECTS_H

#include "evidence/method.h"

typedef enum effect_kind {
    EFFECT_LIBRARY, /* vndf_bsdf_at */
    EFFECT_ROUGH,   /* vndf_bsdf_rough, a roughness for each hit */
    EFFECT_BATCH,   /* vndf_bsdf_sample_n and the like */
    EFFECT_BY_HAND, /* bare reflection written over vndf.h */
    EFFECT_BY_CAPS  /* bare reflection of GGX written without the library */
} effect_kind;

typedef struct effect_set {
    const char *name;
    effect_kind kind;
    vndf_effects effects;
    int stretched;       /* alpha_y is a quarter of alpha_x */
    int inside;          /* wi comes from below */
    const char *visible; /* the set with visible normals that efficiency is compared with; NULL: none */
} effect_set;

enum { EFFECT_BARE = 2 }; /* bare reflection, which the others are compared with */

extern const effect_set effect_sets[];
extern const size_t effect_set_count;

/* The set of that name, or NULL. */
const effect_set *effect_find(const char *name);

/* A set made ready for one distribution and roughness, the state of its method. It stays where it was made: hits
 * point to its material. */
typedef struct effect_case {
    const effect_set *set;
    vndf_surface surface;
    vndf_mixture mixture; /* its first lobe is the affine surface of sets that have one */
    vndf_albedo *albedo;  /* owned; NULL unless energy is compensated */
    vndf_material material;
} effect_case;

/* A method without `each` and an error if the set cannot be made. */
method method_effect(const effect_set *set, const vndf_surface *surface, vndf_error *error);

/* The loops of bare reflection by hand. */
void method_by_hand(method *m);

/* How blocks of a set are filled, from an incident angle or (NaN) from everywhere. */
block_law effect_law(const effect_set *set, double theta);

/* The cosine of w that goes with values: to the normal of the mean plane. */
double effect_cosine(const effect_case *of, vndf_vec3 w);

#endif
