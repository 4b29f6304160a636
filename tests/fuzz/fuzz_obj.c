/* No bytes crash the reader of OBJ: they are refused with a message that names a line, and nothing is added; or
 * a hierarchy over their triangles is built, and what rays say of them is finite. */
#include <math.h>

#include "fuzz/fuzz.h"
#include "render/geometry/geometry.h"

static int is_finite(vndf_vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static void require_hit(const hit *h)
{
    fuzz_require(is_finite(h->place) && is_finite(h->normal), "place and normal are finite");
    fuzz_require(is_finite(h->shading.x) && is_finite(h->shading.y), "the frame is finite");
    fuzz_require(isfinite(h->u) && isfinite(h->v) && h->distance >= 0.0f, "u, v and the distance are finite");
    fuzz_require(fabsf(dot(h->shading.z, h->shading.z) - 1.0f) < 1e-4f, "normals have length 1");
}

/* At the corners' middle, from near and far. */
static void shoot(const geometry *g, const triangle *t)
{
    const vndf_vec3 middle = scale(add(t->corner[0], add(t->corner[1], t->corner[2])), 1.0f / 3.0f);
    const vndf_vec3 from[3] = {vec(1.0f, 2.0f, 3.0f), vec(-1e3f, 0.0f, 0.0f), add(middle, vec(0.0f, 1e-3f, 0.0f))};
    for (int i = 0; i < 3; i++) {
        const ray r = {from[i], unit(subtract(middle, from[i])), 0.0f, HUGE_VALF};
        hit h;
        if (!geometry_hit(g, &r, &h))
            continue;
        require_hit(&h);
        const ray next = ray_from(&h, h.shading.x);
        fuzz_use((double)geometry_blocked(g, &next));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const placement where = {1.5f, 30.0f, {0.5f, 0.0f, -0.5f}};
    geometry g = {0};
    char message[128] = "";
    FILE *file = tmpfile();
    if (file == NULL || fwrite(data, 1, size, file) != size)
        abort();
    rewind(file);
    const int is_read = geometry_read_obj(&g, file, "fuzz.obj", &where, 0, message, sizeof message);
    fclose(file);
    fuzz_require(is_read == (message[0] == '\0'), "0 and a message come together");
    fuzz_require(is_read || strncmp(message, "fuzz.obj:", 9) == 0, "a message names the file and the line");
    fuzz_require(is_read == (g.triangle_count > 0), "all or nothing is added");
    fuzz_require(g.shape_count == g.triangle_count, "every triangle is a shape");
    fuzz_require(geometry_build(&g), "there is memory for a hierarchy");
    for (size_t i = 0; i < g.triangle_count && i < 20; i++)
        shoot(&g, &g.triangles[i]);
    geometry_free(&g);
    return 0;
}
