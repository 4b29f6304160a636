#include "bsdf/walk/walk.h"

#include "bsdf/walk/path.h"

static void leave(const vndf_walk *walk, const vndf_walk_path *path, vndf_vec3 back, unsigned order,
                  vndf_walked *walked)
{
    double factor = vndf_walk_transport(walk, path->turned);
    float side = path->turned ? 1.0f : -1.0f; /* there all of space is turned about */
    for (int i = 0; i < walk->wavelengths; i++)
        walked->weight[i] = vndf_density_from(path->weight[i] * factor);
    walked->wo = vndf_vec3_of(side * back.x, side * back.y, side * back.z);
    walked->order = order;
    walked->lobe = path->turned ? VNDF_LOBE_TRANSMISSION : VNDF_LOBE_REFLECTION;
}

void vndf_walk_sample(const vndf_walk *walk, const vndf_view *view, const float u[3], vndf_walked *walked)
{
    const vndf_walked lost = {{0.0f, 0.0f, 1.0f}, {0.0f}, 0, VNDF_LOBE_NONE};
    vndf_walk_path path = vndf_walk_enter(walk, view, vndf_walk_seed_of(u));
    float pair[2] = {u[0], u[1]};
    double lobe = vndf_clamp_unit(u[2]);

    *walked = lost;
    for (unsigned order = 1; order <= walk->order_limit; order++) {
        vndf_walk_facet m = vndf_walk_meet(&path, pair[0], pair[1]);
        vndf_vec3 back = vndf_walk_bounce(walk, &path, m, lobe);
        if (vndf_walk_is_dark(walk, &path))
            return;
        if (!vndf_walk_travel(&path, back)) {
            leave(walk, &path, back, order, walked);
            return;
        }
        lobe = vndf_walk_numbers(walk, &path, pair);
    }
}
