/* Tables of albedos (vndf_albedo.h) for materials whose scattering is turquin or kulla-conty: one for each distribution
 * and, where light passes, each index. They are made once for a scene, when all of it is known: materials that no shape
 * has cost nothing. */
#include "render/scene/scene.h"

#include <stdio.h>
#include <stdlib.h>

#include "cli/clock.h"

static int is_compensated(const material *m)
{
    return m->kind == MATERIAL_MICROFACET && (m->is.effects.scattering == VNDF_SCATTERING_TURQUIN ||
                                              m->is.effects.scattering == VNDF_SCATTERING_KULLA_CONTY);
}

static float index_of(const material *m)
{
    return m->is.effects.lobes == VNDF_LOBES_BOTH ? m->is.eta : 0.0f;
}

static scene_albedo *find(const scene *s, const material *m)
{
    for (size_t i = 0; i < s->albedo_count; i++)
        if (s->albedos[i].of == m->is.distribution && s->albedos[i].eta == index_of(m))
            return &s->albedos[i];
    return NULL;
}

/* Adds a place for the table; 0 if there is no memory. */
static int want(scene *s, const material *m)
{
    scene_albedo *more = realloc(s->albedos, (s->albedo_count + 1) * sizeof *more);
    if (!more)
        return 0;
    s->albedos = more;
    more[s->albedo_count++] = (scene_albedo){m->is.distribution, index_of(m), NULL};
    return 1;
}

static int want_all(scene *s)
{
    for (size_t i = 0; i < s->geometry.shape_count; i++) {
        const material *m = &s->materials[s->geometry.shapes[i].material];
        if (is_compensated(m) && !find(s, m) && !want(s, m))
            return 0;
    }
    return 1;
}

/* One table of several, for the progress of all. */
typedef struct watch {
    vndf_albedo_progress *show;
    void *user;
    size_t at, count;
} watch;

static int show_all(double done, const char *what, void *user)
{
    const watch *w = user;
    return w->show ? w->show(((double)w->at + done) / (double)w->count, what, w->user) : 0;
}

static int make_all(scene *s, watch *w, vndf_error *error)
{
    w->count = s->albedo_count;
    for (w->at = 0; w->at < w->count; w->at++) {
        scene_albedo *a = &s->albedos[w->at];
        const vndf_albedo_options options = {.eta = a->eta, .progress = show_all, .progress_user = w};
        if (!a->is)
            a->is = vndf_albedo_build(a->of, &options, error);
        if (!a->is)
            return 0;
    }
    return 1;
}

int scene_make_albedos(scene *s, vndf_albedo_progress *show, void *user, char *message, size_t size)
{
    const double start = clock_seconds();
    vndf_error error = {VNDF_ERROR_MEMORY, "no memory for tables of albedos"};
    watch w = {show, user, 0, 0};
    if (!want_all(s) || !make_all(s, &w, &error)) {
        snprintf(message, size, "energy compensation: %s", error.message);
        return 0;
    }
    for (size_t i = 0; i < s->material_count; i++) {
        const scene_albedo *found = is_compensated(&s->materials[i]) ? find(s, &s->materials[i]) : NULL;
        s->materials[i].is.albedo = found ? found->is : NULL;
    }
    s->albedo_seconds += clock_seconds() - start;
    return 1;
}

size_t scene_albedo_bytes(const scene *s)
{
    size_t bytes = 0;
    for (size_t i = 0; i < s->albedo_count; i++)
        bytes += vndf_albedo_info(s->albedos[i].is).bytes;
    return bytes;
}

void scene_free_albedos(scene *s)
{
    for (size_t i = 0; i < s->albedo_count; i++)
        vndf_albedo_free(s->albedos[i].is);
    free(s->albedos);
}
