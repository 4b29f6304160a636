/* f of a random walk, estimated from both ends.
 *
 * A walk from wi, with a connection from each of its events to wo, estimates the orders from the second on; so
 * does one from wo with connections to wi, since f is reciprocal (over the square of the index ratio across the
 * boundary). A path of k events is drawn by the first with all of its factors but that of the last event towards
 * wo, by the second with all but that of the first towards wi. With E_o and E_i for those two factors - density
 * of scattering to the end, chance to leave, 1/cosine - their densities are as 1/E_o to 1/E_i, and the balance
 * heuristic (Veach & Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995)
 *
 *     weight of the walk from wi   E_i/(E_i + E_o),     of that from wo   E_o/(E_i + E_o)
 *
 * turns the two contributions of a path into half their harmonic mean: a narrow lobe at one end makes no spike, unless
 * both walks meet it. */
#include "bsdf/walk/path.h"

/* One end of the paths, turned up. */
typedef struct end {
    vndf_walk walk; /* as it is from there */
    vndf_view view;
    vndf_vec3 up;
    double lambda;
    int beyond; /* not on the side where walks from here begin to the other end */
} end;

/* wo on the other side sees the inverse of the index ratio. */
static end end_at(const vndf_walk *walk, const vndf_view *view, vndf_vec3 up, int beyond)
{
    end e = {*walk, *view, up, (double)vndf_view_area(view, vndf_turned(up, -1.0f)) / (double)up.z, beyond};
    return e;
}

static end far_end(const vndf_walk *walk, vndf_vec3 wo)
{
    vndf_vec3 up = vndf_turned(wo, wo.z > 0.0f ? 1.0f : -1.0f);
    vndf_view seen = vndf_affine_view_from(walk->surface, up);
    end e = end_at(walk, &seen, up, wo.z < 0.0f);
    e.walk.eta = wo.z < 0.0f ? 1.0 / walk->eta : walk->eta;
    return e;
}

/* The chance to leave towards an end, C1^Lambda, on either side. */
static double leaving_from(double depth, int across, const end *to)
{
    return vndf_exp(-(across ? vndf_walk_other_depth(depth) : depth) * to->lambda);
}

/* ---- the first order ---- */

/* The chance to leave has a mean in closed form, since C1 = U^(1/a) at the first event, a = 1 + Lambda(wi):
 * a/(a + Lambda(wo)), and on the other side a Beta(a, 1 + Lambda(wo)). */
static void add_single(const end *from, const end *to, double *value)
{
    vndf_walk_scattered s;
    if (!vndf_walk_scatter(&from->walk, &from->view, from->up, from->walk.eta, to->up, to->beyond, &s))
        return;
    double a = 1.0 + from->lambda;
    double leaving = to->beyond ? a * beta_of(a, 1.0 + to->lambda) : a / (a + to->lambda);
    for (int i = 0; i < from->walk.material->is.wavelengths; i++)
        value[i] += s.value[i] * leaving;
}

/* ---- the others ---- */

/* One event and the way to the next; 0 if it leaves or nothing is left. *along is the way it took. */
static int step(const vndf_walk *walk, vndf_walk_path *path, vndf_vec3 *along)
{
    float u[2];
    double lobe = vndf_walk_numbers(walk, path, u);
    vndf_vec3 back = vndf_walk_bounce(walk, path, u[0], u[1], lobe);
    *along = vndf_turned(back, -1.0f);
    return !vndf_walk_is_dark(walk, path) && vndf_walk_travel(walk, path, back);
}

/* E at the beginning, from the first event's depth and the way that was taken from there. */
static double begin_factor(const end *from, const vndf_walk_path *path, vndf_vec3 along, double depth)
{
    vndf_walk_scattered s;
    vndf_view view = vndf_affine_view_from(from->walk.surface, along);
    if (!vndf_walk_scatter(&from->walk, &view, along, path->eta, from->up, path->turned, &s))
        return 0.0;
    return s.drawn * leaving_from(depth, 0, from) / (double)from->up.z;
}

/* Connects an event to the other end; `begin` holds the square of the index ratio, which reciprocity needs. */
static void connect(const end *from, const end *to, const vndf_walk_path *path, double begin, double scale,
                    double *value)
{
    vndf_walk_scattered s;
    int across = path->turned != to->beyond;
    if (!vndf_walk_scatter(&from->walk, &path->view, path->from, path->eta, to->up, across, &s))
        return;
    double leaving = leaving_from(path->depth, across, to), factor = s.drawn * leaving / (double)to->up.z;
    double weight = begin > 0.0 ? leaving * scale * (begin / (begin + factor)) : 0.0;
    for (int i = 0; i < from->walk.material->is.wavelengths; i++)
        value[i] += path->weight[i] * s.value[i] * weight;
}

/* A walk from one end, its part of f |cosine at the other end| times `scale`. */
static void add_walk(const end *from, const end *to, uint64_t seed, double scale, double *value)
{
    unsigned limit = from->walk.material->is.order_limit;
    vndf_walk_path path;
    vndf_vec3 along;
    vndf_walk_enter(&from->walk, &from->view, from->up, seed, &path);
    double depth = path.depth, eta = from->walk.eta;
    if (limit < 2 || !step(&from->walk, &path, &along))
        return;
    double begin = begin_factor(from, &path, along, depth) * (to->beyond ? eta * eta : 1.0);
    for (unsigned order = 2;; order++) {
        connect(from, to, &path, begin, scale, value);
        if (order >= limit || !step(&from->walk, &path, &along))
            return;
    }
}

void vndf_walk_eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, double *value)
{
    vndf_walk walk = vndf_walk_of(b);
    int count = b->material->is.wavelengths;
    end far = far_end(&walk, wo), near = end_at(&walk, &b->view.of.one, b->wi, far.beyond);
    double index = far.beyond ? walk.eta * walk.eta : 1.0, factor = vndf_walk_transport(&walk, far.beyond);
    for (int i = 0; i < count; i++)
        value[i] = 0.0;
    add_single(&near, &far, value);
    add_walk(&near, &far, seed, 1.0, value);
    add_walk(&far, &near, ~seed, index * (double)far.up.z / (double)near.up.z, value);
    for (int i = 0; i < count; i++)
        value[i] = value[i] * factor < DBL_MAX ? value[i] * factor : DBL_MAX;
}
