/* The clauses of materials and lobes, which the files that read them share. */
#ifndef TOOLS_RENDER_SCENE_MATERIAL_CLAUSES_H
#define TOOLS_RENDER_SCENE_MATERIAL_CLAUSES_H

#include "render/scene/reader.h"

/* Kinds of materials; LOBE is the statement of that name. */
enum { CONDUCTOR, DIELECTRIC, REFLECTOR, SHAPE, MATTE, MIRROR, GLASS, LIGHT, KINDS, LOBE = KINDS };

/* clang-format off */
enum {
    OF, ETA, K, F0, INDEX, LOBES, DISTRIBUTION, PARAMETER, PARAMETER_MAP, BYTES, ALPHA, ALPHA_MAP, ALPHA_X_MAP,
    ALPHA_Y_MAP, ROTATION,
    MATRIX, MEAN, HEIGHT_MAP, NORMAL_MAP, SCALE, FILTERED, WEIGHT, WEIGHT_MAP, MIX,
    MASKING, NORMALS, SCATTERING, ORDER, RETRO, ABSORB, COLOUR, COLOUR_MAP, RADIANCE, CLAUSES
};
/* clang-format on */

/* Finds the clauses of a statement from word `from` on, and refuses those that do not go with the kind. */
int material_clauses(scene_reader *r, const statement *s, size_t from, unsigned kind, clause c[CLAUSES]);

/* The distribution, the slopes and the weight of a lobe, or of a material without `mix`. */
int read_slopes(scene_reader *r, const clause c[CLAUSES], scene_lobe *made);

/* Whether a distribution is a family of tables, "family FILE.vndfs"; and that family with its parameter. */
int is_family(const clause *distribution);
int read_family(scene_reader *r, const clause c[CLAUSES], scene_lobe *made);

/* The lobes that `mix` names. */
int read_mix(scene_reader *r, const clause c[CLAUSES], material *m);

/* Gives the material its lobes, and its description their shape. */
int set_lobes(scene_reader *r, const word *at, material *m, const scene_lobe *lobes, int count);

#endif
