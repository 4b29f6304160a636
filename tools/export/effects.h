/* The effects of an exported BSDF: what `--bsdf 'lobes=both fresnel=dielectric'` chooses, and which parts of the
 * text go with it. */
#ifndef TOOLS_EXPORT_EFFECTS_H
#define TOOLS_EXPORT_EFFECTS_H

#include <stddef.h>

#include "vndf_bsdf.h"

enum { EFFECTS_ERROR_MAX = 600, EFFECT_KEYS = 5 };

/* The number of each choice in its list: lobes, fresnel, masking, transport, reflection. All 0 is bare reflection. */
typedef struct export_effects {
    int wanted; /* there is a BSDF */
    int choice[EFFECT_KEYS];
} export_effects;

/* Reads key=choice, separated by blanks or commas; 0 and a reason for words that are none, for what files do not
 * have, and for what the library refuses. */
int effects_read(export_effects *effects, const char *text, char error[EFFECTS_ERROR_MAX]);

/* Whether the effects have what a mark of the text names: a choice, "lobes=both", or
 *
 *     reflects, transmits    a lobe is on this side, on the other
 *     indexed                there is an index ratio, and both sides are seen
 *     coloured               there are reflectances
 *     smith                  masking takes the area that wo sees */
int effects_have(const export_effects *effects, const char *word, size_t length);

vndf_effects effects_of(const export_effects *effects);

/* "lobes=both, fresnel=dielectric, ..." */
void effects_name(const export_effects *effects, char *text, size_t size);

#endif
