/* No bytes crash the reader of scenes: they are refused with the place, or make a scene whose parts point at each
 * other. Left out are texts that could ask for what only takes long: large images, meshes made of them, and
 * tables that are built. */
#include <ctype.h>

#include "fuzz/fuzz.h"
#include "render/scene/scene.h"

/* Images of more than three digits a side, meshes of heights, or forms of distribution that are built. */
static int takes_long(const char *text)
{
    int digits = 0;
    for (; *text; text++) {
        digits = isdigit((unsigned char)*text) || *text == 'e' || *text == 'E' ? digits + 1 : 0;
        if (digits > 3 || strncmp(text, "family", 6) == 0 || strncmp(text, "slope", 5) == 0 ||
            strncmp(text, "ndf", 3) == 0 || strncmp(text, "heights", 7) == 0)
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
    fuzz_require(s->width > 0 && s->height > 0 && s->integrator.samples > 0, "a scene has pixels and samples");
    fuzz_require(is_of(s, s->environment.map), "the environment is one of the images");
    for (size_t i = 0; i < s->material_count; i++) {
        const material *m = &s->materials[i];
        vndf_material resolved;
        fuzz_require(m->name && is_of(s, m->colour_map), "maps of a colour are images of the scene");
        fuzz_require(is_of(s, m->alpha_x.map) && is_of(s, m->alpha_y.map), "maps of roughness are, too");
        for (int k = 0; k < m->lobe_count; k++)
            fuzz_require(is_of(s, m->lobes[k].alpha_x.map) && is_of(s, m->lobes[k].weight.map) &&
                             m->lobes[k].distribution,
                         "lobes have a distribution, and maps of the scene");
        vndf_description is = m->is;
        if (is.effects.scattering > VNDF_SCATTERING_MULTIPLE) /* which needs albedos that are not made yet */
            is.effects.scattering = VNDF_SCATTERING_SINGLE;
        if (m->kind == MATERIAL_MICROFACET)
            fuzz_require(vndf_material_resolve(&is, &resolved, NULL) == VNDF_OK, "the library takes it");
    }
    for (size_t i = 0; i < s->geometry.shape_count; i++) {
        int of = s->geometry.shapes[i].material;
        fuzz_require(of >= 0 && (size_t)of < s->material_count, "shapes have materials of the scene");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    scene made;
    char message[512] = "", *text = fuzz_text(data, size);
    if (!takes_long(text)) {
        if (scene_read_text(&made, "fuzz.scene", text, size, message, sizeof message)) {
            check_scene(&made);
            scene_free(&made);
        } else
            fuzz_require(strncmp(message, "fuzz.scene:", 11) == 0, "a refusal begins with the place");
    }
    free(text);
    return 0;
}
