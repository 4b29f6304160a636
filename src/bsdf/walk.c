/* Multiple scattering: Smith's random walk on any distribution of normals (Heitz, Hanika, d'Eon & Dachsbacher,
 * "Multiple-Scattering Microfacet BSDFs with the Smith Model", SIGGRAPH 2016).
 *
 * The microsurface is taken for a volume of independent facets. A ray in direction w at a height where the part
 * C1 of the surface lies below passes the facets above it with probability C1^Lambda(w) (eq. 24 there). So with
 *
 *     depth = -log C1,      0 at the top, infinite at the bottom,
 *
 * the way of a ray is exponential in depth: it goes on for E w.z/A(-w) of it towards the top, E of density
 * exp(-E) and A the projected area, since Lambda(w) = A(-w)/w.z for both signs of w.z (a ray that goes down has
 * Lambda(w) < -1 and A(-w) = |w.z| (1 + Lambda(-w))). It has left where depth is no longer positive. Heights
 * and their distribution do not occur: the result does not depend on them.
 *
 * Where it meets the surface it sees the normals that are visible along -w, above the horizon or below: drawn
 * from vndf_sample_weight, mirrored or refracted there, and on. A table draws with a density that is not quite the
 * visible one; the ratio goes into the weight, so the walk is exact for the distribution's own D.
 *
 * Sides. A refracted ray goes on beneath the surface. Seen from there, all of space turned about the origin (w
 * to -w, normals too), the same distribution stands there with its heights upside down, C1 to 1 - C1; the index
 * ratio is inverted. So a walk has one frame, that of the side it is on, in which normals have wm.z >= 0, and it
 * leaves upwards. Surfaces have no mean slope. */
#include <string.h>

#include "bsdf/bsdf.h"

static int transmits(const vndf_bsdf *b)
{
    return b->material->is.effects.lobes != VNDF_LOBES_REFLECTION;
}

/* With an index ratio of 1 light meets no surface and goes straight on. */
static int is_unbent(const vndf_bsdf *b)
{
    return transmits(b) && b->own.eta == 1.0;
}

/* ---- random numbers ----
 *
 * Uniform numbers of a walk by counter: number i is a hash of the seed and i, so that a walk keeps no more than
 * one word and the same seed gives the same walk everywhere. The hash is the finaliser of SplitMix64 (Steele,
 * Lea & Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014). */

static const uint64_t STEP = 0x9E3779B97F4A7C15u;

static uint64_t hash(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

static uint64_t next_bits(uint64_t *random)
{
    return hash(*random += STEP);
}

/* In (0, 1), 52 bits. */
static double next_uniform(uint64_t *random)
{
    return ((double)(next_bits(random) >> 12) + 0.5) * 0x1p-52;
}

/* ---- a ray on its way ---- */

typedef struct ray {
    vndf_vec3 from; /* at an event: where the ray came from, */
    vndf_view view; /* and what it sees */
    double depth;   /* -log C1, in the frame of the side it is on */
    double weight[VNDF_WAVELENGTHS];
    double eta; /* index beyond over this one */
    int turned; /* on the other side than where it began */
    uint64_t random;
} ray;

/* -log(1 - exp(-depth)): the same height, seen from the other side. At the top it would be infinite; 1e-300
 * keeps it a number, so that a walk may come back. */
static double other_depth(double depth)
{
    double below = depth > 1e-5 ? 1.0 - vndf_exp(-depth) : depth - 0.5 * depth * depth;
    return below < 1.0 ? -vndf_log(below > 1e-300 ? below : 1e-300) : 0.0;
}

/* From one event to the next, away from `back`: 0 if the ray leaves. Depth changes by E |w.z|/A(back), down or up; if
 * the area underflows a ray that goes up leaves. */
VNDF_INLINE int travel(const vndf_bsdf *b, ray *r, vndf_vec3 back)
{
    double distance = -vndf_log(next_uniform(&r->random)), area = (double)vndf_view_area(&r->view, back);
    r->depth += distance * (double)back.z / area;
    if (back.z < 0.0f && !(r->depth > 0.0))
        return 0;
    r->from = back;
    vndf_view_make(&r->view, &b->own.surface, back);
    return 1;
}

/* A ray that enters from far above. The seed is hashed, so that successive seeds give unrelated numbers. */
VNDF_INLINE ray entering(const vndf_view *view, vndf_vec3 from, double eta, uint64_t seed)
{
    ray r = {from, *view, 0.0, {1.0, 1.0, 1.0, 1.0}, eta, 0, hash(seed + STEP)};
    r.depth = -vndf_log(next_uniform(&r.random)) * (double)from.z / (double)vndf_view_area(view, from);
    return r;
}

/* Reflectances and their mean, with which reflection is chosen. */
VNDF_INLINE double reflectances(const vndf_bsdf *b, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    double facing = cosine < 1.0 ? cosine : 1.0;
    vndf_reflectances(b->material, (seen_cosine){facing, 1.0 - facing}, eta, f);
    return vndf_mean_of(b->material, f);
}

/* Scatters at the normal that u1 and u2 draw, into the lobe that u3 says; *back is the way back along the new ray, in
 * the frame of the side it is on, whose length does not drift over many events. 0 where nothing is carried on. */
VNDF_INLINE int bounce(const vndf_bsdf *b, ray *r, float u1, float u2, double u3, vndf_vec3 *back)
{
    float weight;
    direction v = vndf_direction(r->from);
    direction wm = vndf_direction(vndf_sample_weight(&r->view, u1, u2, NULL, &weight));
    double f[VNDF_WAVELENGTHS], cosine = dot_of(v, wm), mean = reflectances(b, cosine, r->eta, f), chosen = 1.0;
    const seen_cosine c = {cosine, 1.0 - cosine};
    event e = reflected_at(v, wm, c);
    int reflected = 1;
    if (transmits(b)) {
        event through = refracted_at(v, wm, c, r->eta);
        reflected = !through.met || u3 < mean || !(mean < 1.0);
        chosen = reflected ? mean : 1.0 - mean;
        e = reflected ? e : through;
    }
    for (int i = 0; i < b->material->is.wavelengths; i++)
        r->weight[i] *= (double)weight * (reflected ? f[i] : 1.0 - f[i]) / chosen;
    if (!reflected) {
        r->eta = 1.0 / r->eta;
        r->turned = !r->turned;
        r->depth = other_depth(r->depth);
    }
    double per = -1.0 / sqrt(dot_of(e.up, e.up));
    *back = vndf_vec3_of((float)(e.up.x * per), (float)(e.up.y * per), (float)(e.up.z * per));
    return vndf_mean_of(b->material, r->weight) > 0.0;
}

/* Two uniform numbers for the normal of an event, 24 bits each, as a renderer gives them; returns a third for its
 * lobe. */
static double next_numbers(const vndf_bsdf *b, ray *r, float u[2])
{
    uint64_t bits = next_bits(&r->random);
    u[0] = (float)(bits >> 40) * 0x1p-24f;
    u[1] = (float)((bits >> 16) & 0xFFFFFFu) * 0x1p-24f;
    return transmits(b) ? next_uniform(&r->random) : 0.0;
}

/* ---- to a given direction ---- */

/* For one event and one direction, per steradian. */
typedef struct scattered {
    double value[VNDF_WAVELENGTHS];
    double drawn; /* the density with which it is drawn, before the weight of a table */
} scattered;

/* From v and its view to o, turned up, on its side or `across`; 0 where no light goes there. */
VNDF_INLINE int scatter(const vndf_bsdf *b, const vndf_view *view, vndf_vec3 v, double eta, vndf_vec3 o,
                        int across, scattered *s)
{
    event e = across ? refracting(vndf_direction(v), vndf_direction(o), eta)
                     : reflecting(vndf_direction(v), vndf_direction(o));
    if (!e.met)
        return 0;
    double density = (double)vndf_visible(view, vndf_rounded(e.wm)) * e.jacobian;
    if (!(density > 0.0))
        return 0;
    double f[VNDF_WAVELENGTHS], mean = reflectances(b, e.facing, eta, f);
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->value[i] = density * (across ? 1.0 - f[i] : f[i]);
    s->drawn = density * (!transmits(b) ? 1.0 : across ? 1.0 - mean : mean);
    return s->drawn > 0.0;
}

/* ---- a density near that of samples ----
 *
 * That of the first event, and cosine lobes for all later events. The first event sends directions everywhere. Those
 * that reflection sends below the horizon are mirrored at it, as if the surface met there were flat; so no mass is lost
 * and the integral stays 1. With transmission the sphere is whole, and directions that are on the wrong side of the
 * surface are left where they are: most facets they meet next let them pass. With s = A(horizontal), the mean slope,
 * and Lambda of wi, the share of cosine lobes is
 *
 *     reflection               9 s^2/(1 + 9 s^2) cos_i/(cos_i + 0.17)
 *     transmission, eta > 1    30 s^2/(1 + 30 s^2) Lambda/(1 + Lambda)
 *     transmission, eta < 1    9 s^2/(1 + 9 s^2)
 *
 * fitted by eye to the part of walks of more than one event (GGX, Beckmann and Student-T, alpha 0.05 to 1), and
 * a thousandth more, so that the density is positive where the first event's is not. Light that enters
 * the denser medium mostly stays there; light that comes from it is reflected totally, the more the
 * flatter it comes. */

/* Of the cosine lobes. s^2 is the product of the areas along both axes of an aligned surface. */
static double share_of(const vndf_bsdf *b)
{
    const vndf_surface *m = &b->own.surface;
    double across = (double)vndf_view_area(&b->own.view.of.one, vndf_vec3_of(1.0f, 0.0f, 0.0f));
    double determinant = fabs((double)m->xx * m->yy - (double)m->xy * m->yx), cosine = (double)b->own.wi.z;
    double slope2 = across * across * determinant / ((double)m->xx * m->xx + (double)m->xy * m->xy);
    int enters = transmits(b) && b->own.eta > 1.0;
    double times = enters ? 30.0 * slope2 : 9.0 * slope2, share = times / (1.0 + times);
    if (enters)
        share *= 1.0 - cosine / (double)vndf_view_area(&b->own.view.of.one, b->own.wi);
    else if (!transmits(b))
        share *= cosine / (cosine + 0.17);
    return 0.001 + 0.998 * (share > 0.0 ? share : 0.0);
}

static float density_towards(const vndf_bsdf *b, vndf_vec3 wo)
{
    scattered s;
    const vndf_view *view = &b->own.view.of.one;
    int through = transmits(b);
    vndf_vec3 other = through ? vndf_turned(wo, -1.0f) : vndf_vec3_of(wo.x, wo.y, -wo.z);
    double first = scatter(b, view, b->own.wi, b->own.eta, wo, 0, &s) ? s.drawn : 0.0;
    first += scatter(b, view, b->own.wi, b->own.eta, other, through, &s) ? s.drawn : 0.0;
    double near = !through ? 1.0 : b->own.eta > 1.0 ? 0.05 : 1.0 - 0.6 * (double)b->own.wi.z;
    double side = wo.z > 0.0f ? near : 1.0 - near, share = share_of(b);
    double cosine = fabs((double)wo.z) * 0.31830988618379067 * side;
    return vndf_density_from((1.0 - share) * first + share * cosine);
}

/* ---- samples ---- */

/* A walk that leaves towards -back. On the other side all of space is turned about. */
static int leave(const vndf_bsdf *b, const ray *r, vndf_vec3 back, vndf_scattered *s)
{
    vndf_vec3 wo = vndf_turned(back, r->turned ? 1.0f : -1.0f);
    *s = (vndf_scattered){.wo = vndf_turned(wo, b->own.side),
                          .density = vndf_positive(density_towards(b, wo)),
                          .lobe = r->turned ? VNDF_LOBE_TRANSMISSION : VNDF_LOBE_REFLECTION};
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_density_from(r->weight[i] * (r->turned ? b->own.carried : 1.0));
    return 1;
}

/* The first normal is drawn with u[0] and u[1], its lobe with u[2]; all other numbers are a hash of their bits. */
static int sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    uint64_t seed = 0;
    float pair[2] = {u[0], u[1]};
    double lobe = (double)vndf_clamp_unit(u[2]);
    if (is_unbent(b)) {
        *s = (vndf_scattered){.wo = vndf_turned(b->own.wi, -b->own.side),
                              .weight = {1.0f, 1.0f, 1.0f, 1.0f},
                              .density = 1.0f,
                              .lobe = VNDF_LOBE_STRAIGHT};
        return 1;
    }
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &u[i], sizeof bits);
        seed = hash(seed + bits + STEP);
    }
    ray r = entering(&b->own.view.of.one, b->own.wi, b->own.eta, seed);
    for (unsigned order = 1; order <= b->material->is.order_limit; order++) {
        vndf_vec3 back;
        if (!bounce(b, &r, pair[0], pair[1], lobe, &back))
            return 0;
        if (!travel(b, &r, back))
            return leave(b, &r, back, s);
        lobe = next_numbers(b, &r, pair);
    }
    return 0;
}

/* ---- f, estimated from both ends ----
 *
 * The first order is exact, the model of single scattering with height-correlated masking. A walk from wi, with a
 * connection from each of its events to wo, estimates the orders from the second on; so does one from wo with
 * connections to wi, since f is reciprocal (over the square of the index ratio across the boundary). A path of k events
 * is drawn by the first with all of its factors but that of the last event towards wo, by the second with all but that
 * of the first towards wi. With E_o and E_i for those two factors - density of scattering to the end, chance to leave,
 * 1/cosine - their densities are as 1/E_o to 1/E_i, and the balance heuristic (Veach & Guibas, "Optimally Combining
 * Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995)
 *
 *     weight of the walk from wi   E_i/(E_i + E_o),     of that from wo   E_o/(E_i + E_o)
 *
 * turns the two contributions of a path into half their harmonic mean: a narrow lobe at one end makes no spike, unless
 * both walks meet it. */

/* One end of the paths, turned up. */
typedef struct end {
    double eta; /* index on the other side over that on the side of this end */
    vndf_view view;
    vndf_vec3 up;
    double lambda;
    int beyond; /* not on the side where walks from here begin to the other end */
} end;

/* The chance to leave towards an end, C1^Lambda, on either side. */
static double leaving_from(double depth, int across, const end *to)
{
    return vndf_exp(-(across ? other_depth(depth) : depth) * to->lambda);
}

/* One event and the way to the next; 0 if it leaves or nothing is left. *along is the way it took. */
static int step(const vndf_bsdf *b, ray *r, vndf_vec3 *along)
{
    float u[2];
    double lobe = next_numbers(b, r, u);
    vndf_vec3 back;
    int carries = bounce(b, r, u[0], u[1], lobe, &back);
    *along = vndf_turned(back, -1.0f);
    return carries && travel(b, r, back);
}

/* Connects an event to the other end; `begin` is E at the beginning. */
static void connect(const vndf_bsdf *b, const end *to, const ray *r, double begin, double scale, double *value)
{
    scattered s;
    int across = r->turned != to->beyond;
    if (!scatter(b, &r->view, r->from, r->eta, to->up, across, &s))
        return;
    double leaving = leaving_from(r->depth, across, to), factor = s.drawn * leaving / (double)to->up.z;
    double weight = begin > 0.0 ? leaving * scale * (begin / (begin + factor)) : 0.0;
    for (int i = 0; i < b->material->is.wavelengths; i++)
        value[i] += r->weight[i] * s.value[i] * weight;
}

/* A walk from one end, its part of f |cosine at the other end| times `scale`. E at the beginning follows from the first
 * event's depth and the way that was taken from there; reciprocity wants the square of the index ratio in it. */
static void add_walk(const vndf_bsdf *b, const end *from, const end *to, uint64_t seed, double scale,
                     double *value)
{
    unsigned limit = b->material->is.order_limit;
    ray r = entering(&from->view, from->up, from->eta, seed);
    double depth = r.depth, begin = 0.0;
    scattered s;
    vndf_vec3 along;
    if (limit < 2 || !step(b, &r, &along))
        return;
    vndf_view view = vndf_view_from(&b->own.surface, along);
    if (scatter(b, &view, along, r.eta, from->up, r.turned, &s))
        begin = s.drawn * leaving_from(depth, 0, from) / (double)from->up.z *
                (to->beyond ? from->eta * from->eta : 1.0);
    for (unsigned order = 2;; order++) {
        connect(b, to, &r, begin, scale, value);
        if (order >= limit || !step(b, &r, &along))
            return;
    }
}

/* The first order is scattering by one event. Its chance to leave has a mean in closed form, since C1 = U^(1/a) there,
 * a = 1 + Lambda(wi): a/(a + Lambda(wo)), and on the other side a Beta(a, 1 + Lambda(wo)). */
static int eval(const vndf_bsdf *b, vndf_vec3 given, uint64_t seed, float *value, float *pdf)
{
    vndf_vec3 wo = vndf_turned(given, b->own.side), up = vndf_turned(wo, wo.z > 0.0f ? 1.0f : -1.0f);
    const int beyond = wo.z < 0.0f;
    if (is_unbent(b) || !(wo.z > 0.0f || (beyond && transmits(b))))
        return 0;
    if (pdf)
        *pdf = density_towards(b, wo);
    if (!value)
        return 1;
    end near = {b->own.eta, b->own.view.of.one, b->own.wi, 0.0, beyond};
    end far = {beyond ? 1.0 / b->own.eta : b->own.eta, vndf_view_from(&b->own.surface, up), up, 0.0, beyond};
    for (end *e = &near; e; e = e == &near ? &far : NULL)
        e->lambda = (double)vndf_view_area(&e->view, vndf_turned(e->up, -1.0f)) / (double)e->up.z;
    scattered once = {{0.0}, 0.0};
    double f[VNDF_WAVELENGTHS], a = 1.0 + near.lambda, cosine = (double)up.z;
    double leaving = beyond ? a * beta_of(a, 1.0 + far.lambda) : a / (a + far.lambda);
    if (!scatter(b, &near.view, near.up, near.eta, up, beyond, &once))
        leaving = 0.0;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        f[i] = once.value[i] * leaving;
    add_walk(b, &near, &far, seed, 1.0, f);
    add_walk(b, &far, &near, ~seed, (beyond ? b->own.eta * b->own.eta : 1.0) * cosine / (double)b->own.wi.z, f);
    for (int i = 0; i < b->material->is.wavelengths; i++)
        value[i] = vndf_density_from(f[i] * (beyond ? b->own.carried : 1.0) / cosine);
    return 1;
}

const vndf_routines vndf_routines_walk = {sample, eval};
