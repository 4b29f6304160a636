/* The answers to a question of ask.h about a BSDF, by its text in float (event_text.c). */
#pragma once

#include "vndf_bsdf.h"

void event_text(const vndf_effects *effects, const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 u, vndf_vec3 wo,
                float said[16]);
