/* Finds out once which effects a scene calls for. */
#include "render/path/parts.h"

#include <stdio.h>
#include <stdlib.h>

const char *const path_sampler_names[SAMPLERS] = {"material", "all", "visible", "bounded", "perfect"};

/* ---- effects ---- */

static unsigned environment_effects(const environment *e)
{
    int map = e->map && e->scale > 0.0f;
    int light = map || e->constant[0] > 0.0f || e->constant[1] > 0.0f || e->constant[2] > 0.0f;
    return (light ? EFFECT_ENVIRONMENT : 0u) | (map ? EFFECT_ENVIRONMENT_MAP : 0u);
}

/* The effects of materials that a shape has; other materials cost nothing. */
static unsigned scene_effects(const scene *s)
{
    unsigned effects = environment_effects(&s->environment);
    for (size_t i = 0; i < s->geometry.shape_count; i++)
        effects |= path_material_effects(&s->materials[s->geometry.shapes[i].material]);
    return effects | (s->geometry.triangle_count ? EFFECT_MESHES : 0u);
}

unsigned path_effects(const path_plan *plan)
{
    return plan->effects;
}

path_precomputed path_perfect_cost(const path_plan *plan)
{
    path_precomputed cost = {plan->perfects.count, 0, plan->perfects.seconds};
    for (size_t i = 0; i < cost.count; i++)
        cost.bytes += path_perfect_bytes(plan->perfects.list[i]);
    return cost;
}

/* ---- the film ---- */

static void place_film(path_plan *plan)
{
    const camera *c = &plan->scene->camera;
    float height = (float)plan->scene->height, width = (float)plan->scene->width;
    vndf_vec3 forward = unit(subtract(c->to, c->from)), right = unit(cross(forward, c->up));
    vndf_vec3 down = cross(forward, right);
    float step = 2.0f * tanf(c->field * 0.00872664626f) / height; /* half the field, in radians */
    plan->right = scale(right, step);
    plan->down = scale(down, step);
    plan->corner = subtract(forward, add(scale(plan->right, 0.5f * width), scale(plan->down, 0.5f * height)));
}

/* ---- parts ---- */

/* Materials that no shape has stay empty: they cost nothing, and cannot refuse. */
static int prepare_materials(path_plan *plan, path_sampler sampler, unsigned without, char *message, size_t size)
{
    const scene *s = plan->scene;
    const path_choice choice = {sampler, without, &plan->perfects};
    plan->materials = calloc(s->material_count ? s->material_count : 1, sizeof *plan->materials);
    if (!plan->materials) {
        snprintf(message, size, "no memory for %zu materials", s->material_count);
        return 0;
    }
    for (size_t i = 0; i < s->geometry.shape_count; i++) {
        const int at = s->geometry.shapes[i].material;
        path_material *made = &plan->materials[at];
        if (!made->is && !path_material_prepare(made, &s->materials[at], &choice, message, size))
            return 0;
    }
    return 1;
}

/* Lights are drawn if a surface can use them: one that is not smooth. */
static int uses_lights(const path_plan *plan)
{
    const geometry *g = &plan->scene->geometry;
    for (size_t i = 0; i < g->shape_count; i++)
        if (plan->materials[g->shapes[i].material].run.eval)
            return 1;
    return 0;
}

static int prepare_lights(path_plan *plan, unsigned without, char *message, size_t size)
{
    int use = uses_lights(plan);
    int far = (plan->effects & ~without & EFFECT_ENVIRONMENT_MAP) != 0;
    if ((use && !(without & EFFECT_LIGHTS) && !path_lights_make(&plan->lights, plan->scene)) ||
        !path_environment_make(&plan->environment, &plan->scene->environment, use && far)) {
        snprintf(message, size, "no memory for lights");
        return 0;
    }
    if (plan->lights.count)
        plan->effects |= EFFECT_LIGHTS;
    if (!plan->environment.cells)
        plan->effects &= ~(unsigned)EFFECT_ENVIRONMENT_MAP;
    return 1;
}

path_plan *path_prepare(const scene *s, path_sampler sampler, unsigned without, char *message, size_t size)
{
    path_plan *plan = calloc(1, sizeof *plan);
    if (!plan) {
        snprintf(message, size, "no memory");
        return NULL;
    }
    plan->scene = s;
    plan->effects = scene_effects(s);
    place_film(plan);
    if (!prepare_materials(plan, sampler, without, message, size) ||
        !prepare_lights(plan, without, message, size)) {
        path_free(plan);
        return NULL;
    }
    plan->effects &= ~without;
    plan->trace =
        path_loop(plan->lights.count || plan->environment.cells, (plan->effects & EFFECT_ABSORPTION) != 0);
    return plan;
}

void path_free(path_plan *plan)
{
    if (!plan)
        return;
    path_lights_free(&plan->lights);
    path_environment_free(&plan->environment);
    path_perfects_free(&plan->perfects);
    free(plan->materials);
    free(plan);
}
