/* No bytes crash the reader of OBJ: they are refused with a message that names a line, and nothing is added; or a
 * hierarchy over their triangles is built, and what rays say of them is finite. Nor do they crash the reader of scenes;
 * left out are texts that could ask it for what only takes long: images of more than three digits a side, and tables
 * that are built. */
#include "fuzz/fuzz.h"
#include "render/scene.h"

/* At the corners' middle, from near and far. */
static void shoot(const geometry *g, const shape *t)
{
    const vec3 middle = along(along(t->corner, 1.0 / 3, t->edge_u), 1.0 / 3, t->edge_v);
    const vec3 from[2] = {vec(1, 2, 3), add(middle, vec(0, 1e-3, 0))};
    for (int i = 0; i < 2; i++) {
        hit h;
        if (!geometry_hit(g, &(ray){from[i], unit(subtract(middle, from[i])), HUGE_VAL}, &h))
            continue;
        fuzz_require(isfinite(length(h.place)) && isfinite(length(h.shading.x)), "place and frame are finite");
        fuzz_require(isfinite(h.u) && isfinite(h.v) && h.distance >= 0, "u, v and the distance are finite");
        fuzz_require(fabs(length(h.shading.z) - 1) < 1e-6, "normals have length 1");
    }
}

static void read_scene(const char *text, size_t size)
{
    size_t digits = 0;
    for (size_t i = 0; i < size && digits < 4; i++)
        digits = text[i] && strchr("0123456789eE", text[i]) ? digits + 1 : 0;
    char *copy = malloc(size + 1);
    if (copy && digits < 4 && !strstr(text, "family") && !strstr(text, "slope") && !strstr(text, "ndf="))
        scene_free(scene_read_text("fuzz.scene", memcpy(copy, text, size + 1), size));
    else
        free(copy);
}

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    geometry g = {0};
    vndf_error error = {VNDF_OK, ""};
    (void)data;
    read_scene(text, size);
    const int is_read = obj_read_text(&g, "fuzz.obj", text, size, 0, &error);
    fuzz_require(is_read == (error.message[0] == '\0'), "0 and a message come together");
    fuzz_require(is_read || strncmp(error.message, "fuzz.obj:", 9) == 0, "a message names the file and the line");
    fuzz_require(is_read == (g.count > 0), "all or nothing is added");
    geometry_place(&g, 0, 1.5, 0.5, vec(0.5, 0, -0.5));
    fuzz_require(geometry_build(&g), "there is memory for a hierarchy");
    for (size_t i = 0; i < g.count && i < 20; i++)
        shoot(&g, &g.shapes[i]);
    geometry_free(&g);
}
