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
#include "bsdf/terms/beta.h"
#include "bsdf/walk/walk.h"
#include "bsdf/walk/connect.h"

/* One end of the paths, turned up. */
typedef struct end {
    vndf_walk walk; /* as it is from there */
    vndf_view view;
    vndf_walk_target target;
    double cosine;
} end;

static end end_at(const vndf_walk *walk, const vndf_view *view, int beyond)
{
    vndf_vec3 up = view->wi, down = vndf_vec3_of(-up.x, -up.y, -up.z);
    vndf_walk_target target = {up, vndf_law_slant(view, down), beyond};
    end e = {*walk, *view, target, up.z};
    return e;
}

/* wo on the other side sees the inverse of the index ratio. */
static end far_end(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo)
{
    float side = wo.z > 0.0f ? 1.0f : -1.0f;
    vndf_vec3 up = vndf_vec3_of(side * wo.x, side * wo.y, side * wo.z);
    vndf_view seen = vndf_walk_look(view, up);
    end e = end_at(walk, &seen, wo.z < 0.0f);
    e.walk.eta = wo.z < 0.0f ? 1.0f / walk->eta : walk->eta;
    return e;
}

/* ---- the first order ---- */

/* The chance to leave has a mean in closed form, since C1 = U^(1/a) at the first event, a = 1 + Lambda(wi):
 * a/(a + Lambda(wo)), and on the other side a Beta(a, 1 + Lambda(wo)). */
static double leaving_once(const end *from, const end *to)
{
    double a = vndf_law_slant(&from->view, from->view.wi);
    return to->target.beyond ? a * vndf_beta(a, 1.0 + to->target.lambda) : a / (a + to->target.lambda);
}

static void add_single(const end *from, const end *to, double *value)
{
    vndf_walk_scattered s;
    if (!vndf_walk_scatter(&from->walk, &from->view, from->walk.eta, to->target.wo, to->target.beyond, &s))
        return;
    double leaving = leaving_once(from, to);
    for (int i = 0; i < from->walk.wavelengths; i++)
        value[i] += s.value[i] * leaving;
}

/* ---- the others ---- */

/* One event and the way to the next; 0 if it leaves or nothing is left. *along is the way it took. */
static int step(const vndf_walk *walk, vndf_walk_path *path, vndf_vec3 *along)
{
    float u[2];
    double lobe = vndf_walk_numbers(walk, path, u);
    vndf_vec3 back = vndf_walk_bounce(walk, path, vndf_walk_meet(path, u[0], u[1]), lobe);
    *along = vndf_vec3_of(-back.x, -back.y, -back.z);
    return !vndf_walk_is_dark(walk, path) && vndf_walk_travel(path, back);
}

/* E at the beginning, from the first event's depth and the way that was taken from there. */
static double begin_factor(const end *from, const vndf_walk_path *path, vndf_vec3 along, double depth)
{
    vndf_walk_scattered s;
    vndf_view view = vndf_walk_look(&path->view, along);
    if (!vndf_walk_scatter(&from->walk, &view, path->eta, from->target.wo, path->turned, &s))
        return 0.0;
    return s.drawn * vndf_walk_leaving(depth, 0, &from->target) / from->cosine;
}

/* Connects an event to the other end; `begin` holds the square of the index ratio, which reciprocity needs. */
static void connect(const end *from, const end *to, const vndf_walk_path *path, double begin, double scale,
                    double *value)
{
    vndf_walk_scattered s;
    int across = path->turned != to->target.beyond;
    if (!vndf_walk_scatter(&from->walk, &path->view, path->eta, to->target.wo, across, &s))
        return;
    double leaving = vndf_walk_leaving(path->depth, across, &to->target), factor = s.drawn * leaving / to->cosine;
    double weight = begin > 0.0 ? leaving * scale * (begin / (begin + factor)) : 0.0;
    for (int i = 0; i < from->walk.wavelengths; i++)
        value[i] += path->weight[i] * s.value[i] * weight;
}

/* A walk from one end, its part of f |cosine at the other end| times `scale`. */
static void add_walk(const end *from, const end *to, uint64_t seed, double scale, double *value)
{
    vndf_walk_path path = vndf_walk_enter(&from->walk, &from->view, seed);
    vndf_vec3 along;
    double depth = path.depth, eta = from->walk.eta;
    if (from->walk.order_limit < 2 || !step(&from->walk, &path, &along))
        return;
    double begin = begin_factor(from, &path, along, depth) * (to->target.beyond ? eta * eta : 1.0);
    for (unsigned order = 2;; order++) {
        connect(from, to, &path, begin, scale, value);
        if (order >= from->walk.order_limit || !step(&from->walk, &path, &along))
            return;
    }
}

void vndf_walk_eval(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo, uint64_t seed, double *value)
{
    for (int i = 0; i < walk->wavelengths; i++)
        value[i] = 0.0;
    if (wo.z == 0.0f || (wo.z < 0.0f && !walk->transmits))
        return;
    end far = far_end(walk, view, wo), near = end_at(walk, view, far.target.beyond);
    double eta = walk->eta, index = far.target.beyond ? eta * eta : 1.0;
    double factor = vndf_walk_transport(walk, far.target.beyond);
    add_single(&near, &far, value);
    add_walk(&near, &far, seed, 1.0, value);
    add_walk(&far, &near, ~seed, index * far.cosine / near.cosine, value);
    for (int i = 0; i < walk->wavelengths; i++)
        value[i] = value[i] * factor < DBL_MAX ? value[i] * factor : DBL_MAX;
}
