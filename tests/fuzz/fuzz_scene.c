/* No bytes crash the readers of scenes and of OBJ: they are refused, and nothing is added; or what rays say of the
 * shapes is finite. Left out are scenes that could ask for what only takes long: images of more than three digits a
 * side, and tables that are built. */
#include "fuzz/fuzz.h"
#include "render/scene.h"

static void fuzz_one(const uint8_t *data, size_t size, char *text)
{
    static const vec3 origin = {1, 2, 3};
    size_t digits = 0;
    geometry g = {0};
    hit h;
    (void)data;
    for (size_t i = 0; i < size && digits < 4; i++)
        digits = text[i] && strchr("0123456789eE", text[i]) ? digits + 1 : 0;
    if (digits < 4 && !strstr(text, "family") && !strstr(text, "slope") && !strstr(text, "ndf="))
        scene_free(scene_read("fuzz.scene", memcpy(calloc(1, size + 1), text, size), size, 0));
    fuzz_require(obj_read_text(&g, "fuzz.obj", text, size, 0) == (g.count > 0), "all or nothing is added");
    geometry_place(&g, 0, 1.5, 0.5, vec(0.5, 0, -0.5));
    fuzz_require(geometry_build(&g), "there is memory for a hierarchy");
    for (size_t i = 0; i < g.count && i < 20; i++) {
        const shape *t = &g.shapes[i];
        const vec3 middle = along(along(t->corner, 1.0 / 3, t->edge_u), 1.0 / 3, t->edge_v);
        if (geometry_hit(&g, &(ray){origin, unit(subtract(middle, origin)), HUGE_VAL}, &h))
            fuzz_require(isfinite(length(h.place) + length(h.shading.x) + h.u + h.v) && h.distance >= 0 &&
                             fabs(length(h.shading.z) - 1) < 1e-6,
                         "place, frame, u and v are finite");
    }
    geometry_free(&g);
}
