/* A ray on its way through the microsurface (walk.h): where it is, and its two steps, travel and scatter. */
#ifndef VNDF_BSDF_WALK_PATH_H
#define VNDF_BSDF_WALK_PATH_H

#include "bsdf/walk/walk.h"
#include "bsdf/walk/random.h"
#include "math/vector.h"
#include "sampler/law.h"

typedef struct vndf_walk_path {
    vndf_view view; /* at an event: of where the ray came from */
    double depth;   /* -log C1, in the frame of the side it is on */
    double weight[VNDF_WAVELENGTHS];
    double eta, eta_back; /* index beyond over this one, and the inverse */
    int turned;           /* on the other side than wi */
    vndf_walk_random random;
} vndf_walk_path;

/* Rounded once, so that lengths do not drift over many events. */
VNDF_INLINE vndf_vec3 vndf_walk_unit(vndf_normal w)
{
    double per = 1.0 / sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
    return vndf_vec3_of((float)(w.x * per), (float)(w.y * per), (float)(w.z * per));
}

/* -log(1 - exp(-depth)): the same height, seen from the other side. At the top it would be infinite; 1e-300
 * keeps it a number, so that a walk may come back. */
VNDF_INLINE double vndf_walk_other_depth(double depth)
{
    double below = depth > 1e-5 ? 1.0 - vndf_exp(-depth) : depth - 0.5 * depth * depth;
    return below < 1.0 ? -vndf_log(below > 1e-300 ? below : 1e-300) : 0.0;
}

/* The view of another direction. */
VNDF_INLINE vndf_view vndf_walk_look(const vndf_view *view, vndf_vec3 w)
{
    return vndf_view_scaled(view->distribution, view->alpha_x, view->alpha_y, vndf_packed(w));
}

/* Whether a ray that goes up, away from `back`, leaves; else its depth shrinks. If its area underflows it leaves. */
VNDF_INLINE int vndf_walk_leaves(vndf_walk_path *path, vndf_vec3 back, double distance)
{
    path->depth -= distance / vndf_law_slant(&path->view, back);
    return !(path->depth > 0.0);
}

/* From one event to the next: 0 if it leaves. */
VNDF_INLINE int vndf_walk_travel(vndf_walk_path *path, vndf_vec3 back)
{
    double distance = vndf_walk_exponential(&path->random);
    if (back.z < 0.0f && vndf_walk_leaves(path, back, distance))
        return 0;
    vndf_view_turn(&path->view, vndf_packed(back));
    if (back.z > 0.0f)
        path->depth += distance / vndf_law_view_slant(&path->view);
    return 1;
}

/* A ray that enters from far above. */
VNDF_INLINE vndf_walk_path vndf_walk_enter(const vndf_walk *walk, const vndf_view *view, uint64_t seed)
{
    vndf_walk_path path = {*view,           0.0, {1.0, 1.0, 1.0, 1.0},       walk->eta,
                           1.0 / walk->eta, 0,   vndf_walk_random_from(seed)};
    path.depth = vndf_walk_exponential(&path.random) / vndf_law_view_slant(view);
    return path;
}

/* Squared cosine beyond, times eta^2; total reflection where it is not positive. */
VNDF_INLINE double vndf_walk_beyond(double cosine, double eta)
{
    return (eta - 1.0) * (eta + 1.0) + cosine * cosine;
}

/* Reflectances and their mean, with which reflection is chosen. */
VNDF_INLINE double vndf_walk_reflectances(const vndf_walk *walk, double cosine, double eta,
                                          double f[VNDF_WAVELENGTHS])
{
    if (walk->transmits && !(vndf_walk_beyond(cosine, eta) > 0.0)) {
        for (int i = 0; i < VNDF_WAVELENGTHS; i++)
            f[i] = 1.0;
        return 1.0;
    }
    walk->reflectance(walk->is, cosine, eta, f);
    double sum = f[0];
    for (int i = 1; i < walk->wavelengths; i++)
        sum += f[i];
    return sum / walk->wavelengths;
}

/* A drawn normal and its cosine to where the ray came from. */
typedef struct vndf_walk_facet {
    vndf_vec3 wm;
    double cosine;
} vndf_walk_facet;

/* Back along the mirrored ray. */
VNDF_INLINE vndf_vec3 vndf_walk_reflected(vndf_vec3 v, vndf_walk_facet m)
{
    double twice = 2.0 * m.cosine / vndf_exact_dot(m.wm, m.wm);
    vndf_normal back = {v.x - twice * m.wm.x, v.y - twice * m.wm.y, v.z - twice * m.wm.z};
    return vndf_walk_unit(back);
}

/* Back along the refracted ray, in the frame of its side: -(v/eta + (t - c)/eta wm), t^2 = eta^2 - 1 + c^2. */
VNDF_INLINE vndf_vec3 vndf_walk_refracted(vndf_vec3 v, vndf_walk_facet m, double eta)
{
    double beyond = sqrt(vndf_walk_beyond(m.cosine, eta));
    double along = (eta - 1.0) * (eta + 1.0) / (beyond + m.cosine); /* t - c */
    vndf_normal back = {-(v.x + along * m.wm.x), -(v.y + along * m.wm.y), -(v.z + along * m.wm.z)};
    return vndf_walk_unit(back);
}

/* To the other side. */
VNDF_INLINE void vndf_walk_turn(vndf_walk_path *path)
{
    double eta = path->eta;
    path->eta = path->eta_back;
    path->eta_back = eta;
    path->turned = !path->turned;
    path->depth = vndf_walk_other_depth(path->depth);
}

VNDF_INLINE void vndf_walk_weigh(const vndf_walk *walk, vndf_walk_path *path, const double f[VNDF_WAVELENGTHS],
                                 double mean, int reflected)
{
    for (int i = 0; i < walk->wavelengths; i++)
        path->weight[i] *= reflected ? f[i] / mean : (1.0 - f[i]) / (1.0 - mean);
}

/* The lobe of an event, by the uniform number u, and back along the new ray. */
VNDF_INLINE vndf_vec3 vndf_walk_bounce(const vndf_walk *walk, vndf_walk_path *path, vndf_walk_facet m, double u)
{
    double f[VNDF_WAVELENGTHS], mean = vndf_walk_reflectances(walk, m.cosine, path->eta, f), eta = path->eta;
    int reflected = !walk->transmits || u < mean || !(mean < 1.0);
    vndf_walk_weigh(walk, path, f, walk->transmits ? mean : 1.0, reflected);
    if (reflected)
        return vndf_walk_reflected(path->view.wi, m);
    vndf_walk_turn(path);
    return vndf_walk_refracted(path->view.wi, m, eta);
}

/* Draws a normal. The weight corrects a table's density to the true one. */
VNDF_INLINE vndf_walk_facet vndf_walk_meet(vndf_walk_path *path, float u1, float u2)
{
    float weight;
    vndf_vec3 wm = vndf_sample_weight(&path->view, u1, u2, NULL, &weight);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        path->weight[i] *= (double)weight;
    vndf_walk_facet facet = {wm, vndf_exact_dot(path->view.wi, wm)};
    return facet;
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
    double eta = walk->eta;
    return turned && walk->transport == VNDF_TRANSPORT_RADIANCE ? 1.0 / (eta * eta) : 1.0;
}

/* Nothing is carried on. */
VNDF_INLINE int vndf_walk_is_dark(const vndf_walk *walk, const vndf_walk_path *path)
{
    double sum = path->weight[0];
    for (int i = 1; i < walk->wavelengths; i++)
        sum += path->weight[i];
    return !(sum > 0.0);
}

#endif
