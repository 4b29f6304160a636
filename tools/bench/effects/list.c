/* Lists the sets to measure for each distribution, in two tables: the cost of each set over directions of the whole
 * hemisphere, and the worth of bounded normals beside visible ones, by roughness and angle. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/effects/effects.h"

static const float variance_alphas[] = {0.2f, 0.5f, 1.0f};
static const double variance_thetas[] = {0, 30, 60, 85};
enum {
    PAIRS = sizeof variance_alphas / sizeof *variance_alphas * (sizeof variance_thetas / sizeof *variance_thetas)
};

static const char bare_name[] = "bare reflection", bounded_name[] = "bounded normals";
static const char variance_name[] = "variance";

const effects_row effects_nothing = {0, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};

/* Adds an entry to the cost table; the material stays where it is made. */
static vndf_status add(effects_list *list, const effects_named *of, const effects_set *set, const float alpha[2],
                       vndf_error *error)
{
    const vndf_surface surface = {of->distribution, alpha[0], alpha[1]};
    effects_entry *e = &list->entry[list->count];
    e->distribution = of->name;
    e->theta = NAN;
    e->of_variance = e->shown = e->needed = 0;
    e->bare = e->visible = EFFECTS_NONE;
    e->row = effects_nothing;
    vndf_status status = effects_subject_make(&e->subject, set, &surface, error);
    list->count++; /* freed with the others, made or not */
    return status;
}

/* ---- costs -------------------------------------------------------------------------------------- */

static int find(const effects_list *list, size_t from, size_t to, const char *name)
{
    for (size_t i = from; name && i < to; i++)
        if (strcmp(list->entry[i].subject.set->name, name) == 0)
            return (int)i;
    return EFFECTS_NONE;
}

static vndf_status add_costs(effects_list *list, const effects_plan *plan, const effects_named *of,
                             vndf_error *error)
{
    const float alpha[2] = {plan->alpha_x, plan->alpha_y};
    size_t first = list->count;
    for (size_t i = 0; i < effects_set_count; i++) {
        if (effects_sets[i].kind == EFFECTS_BY_CAPS && of->distribution != vndf_ggx())
            continue;
        vndf_status status = add(list, of, &effects_sets[i], alpha, error);
        if (status != VNDF_OK)
            return status;
        list->entry[list->count - 1].worth_theta = plan->theta;
    }
    for (size_t i = first; i < list->count; i++) {
        list->entry[i].bare = find(list, first, list->count, bare_name);
        list->entry[i].visible = find(list, first, list->count, list->entry[i].subject.set->visible);
    }
    return VNDF_OK;
}

/* ---- variance ----------------------------------------------------------------------------------- */

/* Adds an entry with visible normals, then one with bounded normals. */
static vndf_status add_pair(effects_list *list, const effects_named *of, float alpha, double theta,
                            vndf_error *error)
{
    const char *names[2] = {bare_name, bounded_name};
    const float alphas[2] = {alpha, alpha};
    int first = (int)list->count;
    for (int i = 0; i < 2; i++) {
        vndf_status status = add(list, of, effects_find(names[i]), alphas, error);
        if (status != VNDF_OK)
            return status;
        effects_entry *e = &list->entry[list->count - 1];
        e->theta = e->worth_theta = theta;
        e->of_variance = 1;
        e->visible = i ? first : EFFECTS_NONE;
    }
    return VNDF_OK;
}

static vndf_status add_variance(effects_list *list, const effects_named *of, vndf_error *error)
{
    vndf_status status = VNDF_OK;
    for (size_t a = 0; a < sizeof variance_alphas / sizeof *variance_alphas; a++)
        for (size_t t = 0; t < sizeof variance_thetas / sizeof *variance_thetas && status == VNDF_OK; t++)
            status = add_pair(list, of, variance_alphas[a], variance_thetas[t], error);
    return status;
}

/* ---- selection --------------------------------------------------------------------------------- */

static int is_wanted(const effects_entry *e, const char *only)
{
    return !only || strstr(e->subject.set->name, only) || strstr(e->distribution, only) ||
           (e->of_variance && strstr(variance_name, only));
}

static void need(effects_list *list, int i)
{
    if (i != EFFECTS_NONE)
        list->entry[i].needed = 1;
}

/* Marks the entries that `only` selects. Returns how many are shown. A pair is shown if its second entry is. */
static size_t mark(effects_list *list, const char *only)
{
    size_t shown = 0;
    for (size_t i = 0; i < list->count; i++) {
        effects_entry *e = &list->entry[i];
        e->shown = is_wanted(e->of_variance && e->visible == EFFECTS_NONE ? e + 1 : e, only);
        e->needed |= e->shown;
        shown += (size_t)e->shown;
        if (e->shown) {
            need(list, e->bare);
            need(list, e->visible);
        }
    }
    return shown;
}

static vndf_status make(effects_list *list, const effects_plan *plan, vndf_error *error)
{
    for (size_t i = 0; i < plan->count; i++) {
        vndf_status status = add_costs(list, plan, &plan->of[i], error);
        if (status == VNDF_OK)
            status = add_variance(list, &plan->of[i], error);
        if (status != VNDF_OK)
            return status;
    }
    if (mark(list, plan->only))
        return VNDF_OK;
    snprintf(error->message, sizeof error->message,
             "no set of effects or distribution has '%s' in its name, and "
             "it is no part of '%s'",
             plan->only, variance_name);
    return VNDF_ERROR_ARGUMENT;
}

vndf_status effects_list_make(effects_list *list, const effects_plan *plan, vndf_error *error)
{
    list->count = 0;
    list->entry = calloc(plan->count * (effects_set_count + 2 * PAIRS), sizeof *list->entry);
    if (!list->entry) {
        snprintf(error->message, sizeof error->message, "no memory");
        return VNDF_ERROR_MEMORY;
    }
    vndf_status status = make(list, plan, error);
    if (status != VNDF_OK)
        effects_list_free(list);
    return status;
}

void effects_list_free(effects_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        vndf_albedo_free(list->entry[i].subject.albedo);
    free(list->entry);
    list->entry = NULL;
    list->count = 0;
}
