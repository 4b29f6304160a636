#include "bsdf/walk.h"

#include "bsdf/walk_connect.h"

/* Radiance is not constant along a ray that changes its medium, power is: over the square of the index ratio, of
 * which only the whole way from side to side is left. */
static double transport_factor(const vndf_walk *walk, int turned)
{
    double eta = walk->eta;
    return turned && walk->transport == VNDF_TRANSPORT_RADIANCE ? 1.0 / (eta * eta) : 1.0;
}

/* ---- sample ---- */

static void leave(const vndf_walk *walk, const vndf_walk_path *path, vndf_vec3 back, unsigned order,
                  vndf_walked *walked)
{
    double factor = transport_factor(walk, path->turned);
    float side = path->turned ? 1.0f : -1.0f; /* there all of space is turned about */
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        walked->weight[i] = vndf_density_from(path->weight[i] * factor);
    walked->wo = vndf_vec3_of(side * back.x, side * back.y, side * back.z);
    walked->order = order;
    walked->lobe = path->turned ? VNDF_LOBE_TRANSMISSION : VNDF_LOBE_REFLECTION;
}

/* The event's own numbers: the given three, later those of the walk. */
static void draw_numbers(vndf_walk_path *path, int transmits, float u[2], double *lobe)
{
    vndf_walk_pair(&path->random, u);
    *lobe = transmits ? vndf_walk_uniform(&path->random) : 0.0;
}

void vndf_walk_sample(const vndf_walk *walk, const vndf_view *view, const float u[3], vndf_walked *walked)
{
    const vndf_walked lost = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}, 0, VNDF_LOBE_NONE};
    vndf_walk_path path = vndf_walk_enter(walk, view, vndf_walk_seed_of(u));
    float pair[2] = {u[0], u[1]};
    double lobe = vndf_clamp_unit(u[2]);

    *walked = lost;
    for (unsigned order = 1; order <= walk->order_limit; order++) {
        vndf_walk_facet m = vndf_walk_meet(&path, pair[0], pair[1]);
        vndf_vec3 back = vndf_walk_bounce(walk, &path, m, lobe);
        if (vndf_walk_is_dark(&path))
            return;
        if (!vndf_walk_travel(&path, back)) {
            leave(walk, &path, back, order, walked);
            return;
        }
        draw_numbers(&path, walk->transmits, pair, &lobe);
    }
}

/* ---- eval ---- */

/* Where a walk is to go: wo turned up, on the side of wi or on the other, and Lambda there. */
static vndf_walk_target target_of(const vndf_view *view, vndf_vec3 wo)
{
    float side = wo.z > 0.0f ? 1.0f : -1.0f;
    vndf_vec3 up = vndf_vec3_of(side * wo.x, side * wo.y, side * wo.z);
    vndf_vec3 down = vndf_vec3_of(-up.x, -up.y, -up.z);
    vndf_walk_target target = {up, wo.z < 0.0f, vndf_walk_slant(view, down)};
    return target;
}

static void add(double value[VNDF_WAVELENGTHS], const double weight[VNDF_WAVELENGTHS],
                const double scattered[VNDF_WAVELENGTHS], double leaving)
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        value[i] += weight[i] * scattered[i] * leaving;
}

/* The orders from the second on. */
static void add_walk(const vndf_walk *walk, const vndf_view *view, const vndf_walk_target *target, uint64_t seed,
                     double value[VNDF_WAVELENGTHS])
{
    vndf_walk_path path = vndf_walk_enter(walk, view, seed);
    for (unsigned order = 2; order <= walk->order_limit; order++) {
        float u[2];
        double lobe, scattered[VNDF_WAVELENGTHS];
        draw_numbers(&path, walk->transmits, u, &lobe);
        vndf_vec3 back = vndf_walk_bounce(walk, &path, vndf_walk_meet(&path, u[0], u[1]), lobe);
        if (vndf_walk_is_dark(&path) || !vndf_walk_travel(&path, back))
            return;
        if (vndf_walk_scattered(walk, &path, target, scattered))
            add(value, path.weight, scattered, vndf_walk_leaving(&path, target));
    }
}

void vndf_walk_eval(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo, uint64_t seed,
                    double value[VNDF_WAVELENGTHS])
{
    const double one[VNDF_WAVELENGTHS] = {1.0, 1.0, 1.0};
    double scattered[VNDF_WAVELENGTHS];
    value[0] = value[1] = value[2] = 0.0;
    if (wo.z == 0.0f || (wo.z < 0.0f && !walk->transmits))
        return;
    vndf_walk_target target = target_of(view, wo);
    vndf_walk_path first = vndf_walk_enter(walk, view, 0);
    if (vndf_walk_scattered(walk, &first, &target, scattered))
        add(value, one, scattered, vndf_walk_leaving_once(view, &target));
    add_walk(walk, view, &target, seed, value);
    double factor = transport_factor(walk, target.beyond);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        value[i] = value[i] * factor < DBL_MAX ? value[i] * factor : DBL_MAX;
}
