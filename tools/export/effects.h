/* The effects of an exported BSDF: what `--bsdf 'lobes=both fresnel=dielectric'` chooses. */
#ifndef TOOLS_EXPORT_EFFECTS_H
#define TOOLS_EXPORT_EFFECTS_H

#include "vndf_bsdf.h"

enum { EFFECTS_ERROR_MAX = 600 };

typedef struct export_effects {
    int wanted; /* there is a BSDF */
    vndf_effects is;
    char words[120]; /* "lobes=both fresnel=dielectric ...", with all keys */
} export_effects;

/* Reads key=choice, separated by blanks or commas; 0 and a reason for words that are none, for what files do not
 * have, and for what the library refuses. */
int effects_read(export_effects *effects, const char *text, char error[EFFECTS_ERROR_MAX]);

#endif
