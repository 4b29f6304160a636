/* lobe NAME distribution ...: lobes that materials mix; and the surfaces of the library that lobes make. */
#include "render/scene/material_clauses.h"

#include <stdlib.h>
#include <string.h>

/* ---- surfaces ---- */

static int leans(const scene_lobe *l)
{
    return l->mean_x != 0.0f || l->mean_y != 0.0f || l->relief;
}

vndf_shape scene_shape_of(const scene_lobe *lobes, int count)
{
    return count > 1 || lobes->family ? VNDF_SHAPE_MIXTURE : leans(lobes) ? VNDF_SHAPE_AFFINE : VNDF_SHAPE_MATRIX;
}

vndf_affine scene_affine_of(const scene_lobe *l)
{
    const float x = l->alpha_x.value, y = l->alpha_y.value;
    const vndf_affine made = {l->distribution, x * l->axes[0], y * l->axes[1], x * l->axes[2],
                              y * l->axes[3],  l->mean_x,      l->mean_y};
    return made;
}

int scene_lobe_width(const scene_lobe *l)
{
    return l->family ? 2 : 1;
}

void scene_add_lobe(const scene_lobe *l, const vndf_affine *surface, float parameter, float weight,
                    vndf_mixture *made)
{
    vndf_mixture part;
    if (!l->family) {
        made->lobe[made->count++] = (vndf_mixture_lobe){*surface, weight};
        return;
    }
    vndf_family_at(l->family, parameter, surface, &part);
    for (int i = 0; i < part.count; i++)
        made->lobe[made->count++] = (vndf_mixture_lobe){part.lobe[i].surface, weight * part.lobe[i].weight};
}

void scene_mixture_of(const scene_lobe *lobes, int count, vndf_mixture *made)
{
    made->count = 0;
    for (int i = 0; i < count; i++) {
        const vndf_affine surface = scene_affine_of(&lobes[i]);
        scene_add_lobe(&lobes[i], &surface, lobes[i].parameter.from, lobes[i].weight.value, made);
    }
}

/* ---- of materials ---- */

int set_lobes(scene_reader *r, const word *at, material *m, const scene_lobe *lobes, int count)
{
    m->lobes = malloc((size_t)count * sizeof *m->lobes);
    if (!m->lobes)
        return reader_refuse(r, at, "there is no memory for lobes");
    memcpy(m->lobes, lobes, (size_t)count * sizeof *m->lobes);
    m->lobe_count = count;
    m->is.effects.shape = scene_shape_of(lobes, count);
    m->is.distribution = lobes[0].distribution;
    m->is.affine = scene_affine_of(lobes);
    return 1;
}

/* ---- lobes by name ---- */

typedef struct named_lobe {
    const word *name;
    scene_lobe is;
} named_lobe;

static int find_lobe(scene_reader *r, const word *name, const scene_lobe **found)
{
    const char *names[SCENE_LOBES_MAX];
    for (size_t i = 0; i < r->lobe_count; i++) {
        names[i] = r->lobes[i].name->text;
        if (strcmp(names[i], name->text) == 0) {
            *found = &r->lobes[i].is;
            return 1;
        }
    }
    if (!r->lobe_count)
        return reader_refuse(r, name, "no lobe is defined before this, so '%.64s' is none", name->text);
    return reader_unknown(r, name, "lobe that is defined before this", names, r->lobe_count);
}

/* What belongs to one lobe stands in its statement. */
static int refuse_others(scene_reader *r, const clause c[CLAUSES])
{
    for (int i = DISTRIBUTION; i < MIX; i++)
        if (c[i].at)
            return reader_refuse(r, c[i].at, "'%s' is of one lobe; beside 'mix' it stands in the lobe's statement",
                                 c[i].keyword);
    return 1;
}

/* A family is two lobes of the library. */
static int check_width(scene_reader *r, const clause *mix, const scene_lobe *lobes, int count)
{
    int width = 0;
    for (int i = 0; i < count; i++)
        width += scene_lobe_width(&lobes[i]);
    return width <= VNDF_MIXTURE_LOBES ||
           reader_refuse(r, mix->at, "these are more than %d lobes; a family counts as two", VNDF_MIXTURE_LOBES);
}

/* Weights that maps multiply count as they are without them. */
static int check_weights(scene_reader *r, const clause *mix, const scene_lobe *lobes, int count)
{
    for (int i = 0; i < count; i++)
        if (lobes[i].weight.value > 0.0f)
            return 1;
    return reader_refuse(r, mix->at, "the weights of all lobes are 0");
}

int read_mix(scene_reader *r, const clause c[CLAUSES], material *m)
{
    const clause *mix = &c[MIX];
    scene_lobe lobes[VNDF_MIXTURE_LOBES];
    const scene_lobe *found = NULL;
    if (!refuse_others(r, c))
        return 0;
    for (size_t i = 0; i < mix->count; i++) {
        if (!find_lobe(r, &mix->values[i], &found))
            return 0;
        lobes[i] = *found;
    }
    return check_width(r, mix, lobes, (int)mix->count) && check_weights(r, mix, lobes, (int)mix->count) &&
           set_lobes(r, mix->at, m, lobes, (int)mix->count);
}

/* ---- the statement ---- */

static int check_name(scene_reader *r, const word *name)
{
    for (size_t i = 0; i < r->lobe_count; i++)
        if (strcmp(r->lobes[i].name->text, name->text) == 0)
            return reader_refuse(r, name, "there is a lobe '%s' already", name->text);
    return r->lobe_count < SCENE_LOBES_MAX ||
           reader_refuse(r, name, "these are more than %d lobes", SCENE_LOBES_MAX);
}

int read_lobe(scene_reader *r, const statement *s)
{
    clause c[CLAUSES];
    named_lobe made;
    if (!reader_name(r, s, "lobe", &made.name) || !check_name(r, made.name) ||
        !material_clauses(r, s, 2, LOBE, c) || !read_slopes(r, c, &made.is))
        return 0;
    if (!r->lobes)
        r->lobes = calloc(SCENE_LOBES_MAX, sizeof *r->lobes);
    if (!r->lobes)
        return reader_refuse(r, made.name, "there is no memory for lobes");
    r->lobes[r->lobe_count++] = made;
    return 1;
}
