#include "bench/effects/open.h"

#include "vndf_build.h"

static int open_one(effects_opened *o, effects_plan *plan, const char *command, const char *name)
{
    if (!distribution_open(&o->of[o->count], command, name))
        return 0;
    plan->of[plan->count++] = (effects_named){name, o->of[o->count++].distribution};
    return 1;
}

static int build_default(effects_opened *o, effects_plan *plan, const char *command)
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
    plan->of[plan->count++] = (effects_named){family, o->built};
    return 1;
}

int effects_open(effects_opened *o, effects_plan *plan, const char *command, const words *names)
{
    for (size_t i = 0; i < names->count; i++)
        if (!open_one(o, plan, command, names->item[i]))
            return 0;
    if (plan->count)
        return 1;
    return open_one(o, plan, command, "ggx") && open_one(o, plan, command, "beckmann") &&
           build_default(o, plan, command);
}

void effects_close(effects_opened *o)
{
    for (size_t i = 0; i < o->count; i++)
        distribution_close(&o->of[i]);
    vndf_free(o->built);
}
