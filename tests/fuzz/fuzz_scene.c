/* No bytes crash the reader of scenes: they are refused with the place, or make a scene whose parts point at each
 * other. Left out are texts that could ask for what only takes long: large images and tables that are built. */
#include <ctype.h>

#include "fuzz/fuzz.h"
#include "render/scene.h"

/* Images of more than three digits a side, or forms of distribution that are built. */
static int takes_long(const char *text)
{
    int digits = 0;
    for (; *text; text++) {
        digits = isdigit((unsigned char)*text) || *text == 'e' || *text == 'E' ? digits + 1 : 0;
        if (digits > 3 || strncmp(text, "family", 6) == 0 || strncmp(text, "slope", 5) == 0 ||
            strncmp(text, "ndf", 3) == 0)
            return 1;
    }
    return 0;
}

static int is_of(const scene *s, const image *map)
{
    return !map || (map >= s->images && map < s->images + s->image_count && map->rgb);
}

static void check_scene(const scene *s)
{
    fuzz_require(s->width > 0 && s->height > 0 && s->samples > 0, "a scene has pixels and samples");
    fuzz_require(is_of(s, s->environment.map), "the environment is one of the images");
    for (size_t i = 0; i < s->material_count; i++) {
        const material *m = &s->materials[i];
        vndf_material resolved;
        fuzz_require(m->name[0] && is_of(s, m->colour_map) && is_of(s, m->alpha_map),
                     "maps are images of the scene");
        if (m->kind == MATERIAL_ROUGH)
            fuzz_require(vndf_material_resolve(&m->is, &resolved, NULL) == VNDF_OK, "the library takes it");
    }
    for (size_t i = 0; i < s->geometry.count; i++) {
        int of = s->geometry.shapes[i].material;
        fuzz_require(of >= 0 && (size_t)of < s->material_count, "shapes have materials of the scene");
    }
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    vndf_error error = {VNDF_OK, ""};
    (void)data;
    if (takes_long(text))
        return;
    scene *made = scene_read_text("fuzz.scene", text, size, &error);
    if (made)
        check_scene(made);
    else
        fuzz_require(strncmp(error.message, "fuzz.scene:", 11) == 0, "a refusal begins with the place");
    scene_free(made);
}
