/* Retroreflection: reflected light goes to where the half turn about z takes it. */
#ifndef VNDF_BSDF_LOBES_RETRO_H
#define VNDF_BSDF_LOBES_RETRO_H

#include "bsdf/routines.h"

extern const vndf_routines vndf_routines_retro;

#endif
