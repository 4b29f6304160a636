#define _XOPEN_SOURCE 700 /* P_tmpdir */
#include "bench/effects/open.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "vndf_build.h"

int effects_open_one(effects_opened *o, effects_plan *plan, const char *command, const char *name)
{
    if (!distribution_open(&o->of[o->count], command, name))
        return 0;
    plan->of[plan->count++] = (effects_named){name, name, o->of[o->count++].distribution};
    return 1;
}

/* Saves the built table to a temporary file. Returns 0 after a complaint. */
static int save_built(effects_opened *o, const char *command)
{
    vndf_error error = {VNDF_OK, ""};
    const char *folder = getenv("TMPDIR");
    int length =
        snprintf(o->path, sizeof o->path, "%s/vndf-effects-XXXXXX", folder && *folder ? folder : P_tmpdir);
    int file = length > 0 && (size_t)length < sizeof o->path ? mkstemp(o->path) : -1;
    if (file >= 0 && close(file) == 0 && vndf_save(o->built, o->path, &error) == VNDF_OK)
        return 1;
    if (file >= 0)
        remove(o->path);
    o->path[0] = '\0';
    complain(command, "no temporary table for valgrind: %s",
             file < 0 ? "no file can be made in the folder of TMPDIR" : error.message);
    return 0;
}

static int build_default(effects_opened *o, effects_plan *plan, const char *command, int for_others)
{
    static const char family[] = "student-t:2.5";
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_family(family, &error);
    o->built = source ? vndf_build(source, NULL, NULL, &error) : NULL;
    vndf_source_free(source);
    if (!o->built) {
        complain(command, "%s", error.message);
        return 0;
    }
    if (for_others && !save_built(o, command))
        return 0;
    plan->of[plan->count++] = (effects_named){family, o->path[0] ? o->path : NULL, o->built};
    return 1;
}

int effects_open(effects_opened *o, effects_plan *plan, const char *command, const words *names, int for_others)
{
    for (size_t i = 0; i < names->count; i++)
        if (!effects_open_one(o, plan, command, names->item[i]))
            return 0;
    if (plan->count)
        return 1;
    return effects_open_one(o, plan, command, "ggx") && effects_open_one(o, plan, command, "beckmann") &&
           build_default(o, plan, command, for_others);
}

void effects_close(effects_opened *o)
{
    for (size_t i = 0; i < o->count; i++)
        distribution_close(&o->of[i]);
    vndf_free(o->built);
    if (o->path[0])
        remove(o->path);
}
