/* A ray on its way through the microsurface (walk.h): where it is, its two steps, travel and bounce, and what an event
 * sends to a given direction. */
#ifndef VNDF_BSDF_WALK_PATH_H
#define VNDF_BSDF_WALK_PATH_H

#include <string.h>

#include "bsdf/walk/walk.h"

/* ---- its random numbers ----
 *
 * Uniform numbers of a walk by counter: number i is a hash of the seed and i, so that a walk keeps no more than
 * two words and the same seed gives the same walk everywhere. The hash is the finaliser of SplitMix64 (Steele,
 * Lea & Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014). */

typedef struct vndf_walk_random {
    uint64_t state;
} vndf_walk_random;

VNDF_INLINE uint64_t vndf_walk_hash(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/* The seed is hashed, so that successive seeds give unrelated numbers. */
VNDF_INLINE vndf_walk_random vndf_walk_random_from(uint64_t seed)
{
    vndf_walk_random random = {vndf_walk_hash(seed + 0x9E3779B97F4A7C15u)};
    return random;
}

/* A seed from three uniform numbers, by all their bits. */
VNDF_INLINE uint64_t vndf_walk_seed_of(const float u[3])
{
    uint64_t seed = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &u[i], sizeof bits);
        seed = vndf_walk_hash(seed + bits + 0x9E3779B97F4A7C15u);
    }
    return seed;
}

VNDF_INLINE uint64_t vndf_walk_bits(vndf_walk_random *random)
{
    random->state += 0x9E3779B97F4A7C15u;
    return vndf_walk_hash(random->state);
}

/* In (0, 1), 52 bits. */
VNDF_INLINE double vndf_walk_uniform(vndf_walk_random *random)
{
    return ((double)(vndf_walk_bits(random) >> 12) + 0.5) * 0x1p-52;
}

/* Two in [0, 1), 24 bits each, as a renderer gives them. */
VNDF_INLINE void vndf_walk_pair(vndf_walk_random *random, float u[2])
{
    uint64_t bits = vndf_walk_bits(random);
    u[0] = (float)(bits >> 40) * 0x1p-24f;
    u[1] = (float)((bits >> 16) & 0xFFFFFFu) * 0x1p-24f;
}

/* With density exp(-x). */
VNDF_INLINE double vndf_walk_exponential(vndf_walk_random *random)
{
    return -vndf_log(vndf_walk_uniform(random));
}

/* ---- its steps ---- */

typedef struct vndf_walk_path {
    vndf_vec3 from; /* at an event: where the ray came from, */
    vndf_view view; /* and what it sees */
    double depth;   /* -log C1, in the frame of the side it is on */
    double weight[VNDF_WAVELENGTHS];
    double eta; /* index beyond over this one */
    int turned; /* on the other side than wi */
    vndf_walk_random random;
} vndf_walk_path;

VNDF_INLINE double vndf_walk_dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * b.x + (double)a.y * b.y + (double)a.z * b.z;
}

/* Rounded once, so that lengths do not drift over many events. */
VNDF_INLINE vndf_vec3 vndf_walk_unit(double x, double y, double z)
{
    double per = 1.0 / sqrt(x * x + y * y + z * z);
    return vndf_vec3_of((float)(x * per), (float)(y * per), (float)(z * per));
}

/* -log(1 - exp(-depth)): the same height, seen from the other side. At the top it would be infinite; 1e-300
 * keeps it a number, so that a walk may come back. */
VNDF_INLINE double vndf_walk_other_depth(double depth)
{
    double below = depth > 1e-5 ? 1.0 - vndf_exp(-depth) : depth - 0.5 * depth * depth;
    return below < 1.0 ? -vndf_log(below > 1e-300 ? below : 1e-300) : 0.0;
}

/* From one event to the next, away from `back`: 0 if the ray leaves. Depth changes by E |w.z|/A(back), down or up; if
 * the area underflows a ray that goes up leaves. */
VNDF_INLINE int vndf_walk_travel(const vndf_walk *walk, vndf_walk_path *path, vndf_vec3 back)
{
    double distance = vndf_walk_exponential(&path->random), area = (double)vndf_view_area(&path->view, back);
    path->depth += distance * (double)back.z / area;
    if (back.z < 0.0f && !(path->depth > 0.0))
        return 0;
    path->from = back;
    vndf_view_make(&path->view, walk->surface, back, 0);
    return 1;
}

/* A ray that enters from far above. */
VNDF_INLINE void vndf_walk_enter(const vndf_walk *walk, const vndf_view *view, vndf_vec3 from, uint64_t seed,
                                 vndf_walk_path *path)
{
    *path = (vndf_walk_path){from, *view, 0.0, {1.0, 1.0, 1.0, 1.0}, walk->eta, 0, vndf_walk_random_from(seed)};
    path->depth = vndf_walk_exponential(&path->random) * (double)from.z / (double)vndf_view_area(view, from);
}

/* Squared cosine beyond, times eta^2; total reflection where it is not positive. */
VNDF_INLINE double vndf_walk_beyond(double cosine, double eta)
{
    return (eta - 1.0) * (eta + 1.0) + cosine * cosine;
}

/* Reflectances and their mean, with which reflection is chosen. Total reflection is total whatever Fresnel's term
 * says. */
VNDF_INLINE double vndf_walk_reflectances(const vndf_walk *walk, double cosine, double eta,
                                          double f[VNDF_WAVELENGTHS])
{
    const vndf_material *m = walk->material;
    if (walk->transmits && !(vndf_walk_beyond(cosine, eta) > 0.0)) {
        for (int i = 0; i < VNDF_WAVELENGTHS; i++)
            f[i] = 1.0;
        return 1.0;
    }
    vndf_reflectance(m, cosine, eta, f);
    return vndf_mean_of(m, f);
}

/* Scatters at the normal that u1 and u2 draw, into the lobe that u3 says; returns the way back along the new ray, in
 * the frame of the side it is on. With c = v.wm and t the cosine beyond times eta a refracted ray goes back along
 * -(v + (t - c) wm)/eta. */
VNDF_INLINE vndf_vec3 vndf_walk_bounce(const vndf_walk *walk, vndf_walk_path *path, float u1, float u2, double u3)
{
    float weight;
    vndf_vec3 v = path->from, wm = vndf_sample_weight(&path->view, u1, u2, NULL, &weight);
    double f[VNDF_WAVELENGTHS], cosine = vndf_walk_dot(v, wm), eta = path->eta;
    double mean = vndf_walk_reflectances(walk, cosine, eta, f);
    int reflected = !walk->transmits || u3 < mean || !(mean < 1.0);
    double chosen = !walk->transmits ? 1.0 : reflected ? mean : 1.0 - mean;
    for (int i = 0; i < walk->material->is.wavelengths; i++)
        path->weight[i] *= (double)weight * (reflected ? f[i] : 1.0 - f[i]) / chosen;
    if (reflected) {
        double twice = 2.0 * cosine / vndf_walk_dot(wm, wm);
        return vndf_walk_unit(v.x - twice * wm.x, v.y - twice * wm.y, v.z - twice * wm.z);
    }
    path->eta = 1.0 / eta;
    path->turned = !path->turned;
    path->depth = vndf_walk_other_depth(path->depth);
    double along = (eta - 1.0) * (eta + 1.0) / (sqrt(vndf_walk_beyond(cosine, eta)) + cosine); /* t - c */
    return vndf_walk_unit(-(v.x + along * wm.x), -(v.y + along * wm.y), -(v.z + along * wm.z));
}

/* Draws two uniform numbers for the normal of an event, and returns a third for its lobe. */
VNDF_INLINE double vndf_walk_numbers(const vndf_walk *walk, vndf_walk_path *path, float u[2])
{
    vndf_walk_pair(&path->random, u);
    return walk->transmits ? vndf_walk_uniform(&path->random) : 0.0;
}

/* Along a ray that changes its medium power is constant, and radiance is not: it is divided by the square of the index
 * ratio. Over a walk only the change from the first side to the last remains. */
VNDF_INLINE double vndf_walk_transport(const vndf_walk *walk, int turned)
{
    int radiance = walk->material->is.effects.transport == VNDF_TRANSPORT_RADIANCE;
    return turned && radiance ? 1.0 / (walk->eta * walk->eta) : 1.0;
}

/* Nothing is carried on. */
VNDF_INLINE int vndf_walk_is_dark(const vndf_walk *walk, const vndf_walk_path *path)
{
    double sum = path->weight[0];
    for (int i = 1; i < walk->material->is.wavelengths; i++)
        sum += path->weight[i];
    return !(sum > 0.0);
}

/* ---- to a given direction ----
 *
 * The density of scattering there, per steradian. With v the direction to where the ray came from, o the wanted one,
 * turned up, and Dv the visible normals of v,
 *
 *     reflection     F Dv(wm)/(4 v.wm),                                  wm ~ v + o
 *     transmission   (1 - F) Dv(wm) eta^2 (o.wm)/|eta o - v|^2,          wm ~ +-(eta o - v)
 *
 * (Walter et al., EGSR 2007, equations 14 and 17, with o in the frame of its own side: -o in theirs). */

/* For one event and one direction. */
typedef struct vndf_walk_scattered {
    double value[VNDF_WAVELENGTHS]; /* of the wavelengths, per steradian; */
    double drawn;                   /* and the density with which it is drawn, before the weight of a table */
} vndf_walk_scattered;

/* From v and its view to o, on its side or `across`; 0 where no light goes there. */
VNDF_INLINE int vndf_walk_scatter(const vndf_walk *walk, const vndf_view *view, vndf_vec3 v, double eta,
                                  vndf_vec3 o, int across, vndf_walk_scattered *s)
{
    event e = across ? refracting(vndf_direction(v), vndf_direction(o), eta)
                     : reflecting(vndf_direction(v), vndf_direction(o));
    if (!e.met)
        return 0;
    vndf_vec3 wm = vndf_vec3_of((float)e.wm.x, (float)e.wm.y, (float)e.wm.z);
    double density = (double)vndf_visible(view, wm) * e.jacobian;
    if (!(density > 0.0))
        return 0;
    double f[VNDF_WAVELENGTHS], mean = vndf_walk_reflectances(walk, e.facing, eta, f);
    for (int i = 0; i < walk->material->is.wavelengths; i++)
        s->value[i] = density * (across ? 1.0 - f[i] : f[i]);
    s->drawn = density * (!walk->transmits ? 1.0 : across ? 1.0 - mean : mean);
    return s->drawn > 0.0;
}

#endif
