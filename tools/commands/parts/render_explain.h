/* What a scene calls for, and what each effect costs in it. */
#ifndef TOOLS_COMMANDS_RENDER_EXPLAIN_H
#define TOOLS_COMMANDS_RENDER_EXPLAIN_H

#include "render/path/path.h"

/* Measures and prints; an exit status. */
int render_explain(const char *command, const scene *s, path_sampler sampler);

#endif
