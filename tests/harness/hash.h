/* Hashes of the bits that the run time computes, for tests that compare builds, machines or threads. */
#ifndef TESTS_HARNESS_HASH_H
#define TESTS_HARNESS_HASH_H

#include "harness/test.h"
#include "vndf_bsdf.h"

static const unsigned long long hash_begin = 0xCBF29CE484222325ULL;

/* FNV-1a, a word at a time. */
static inline unsigned long long hash_float(unsigned long long hash, float value)
{
    unsigned bits;
    memcpy(&bits, &value, sizeof bits);
    return (hash ^ bits) * 0x100000001B3ULL;
}

/* A sample, its density, and the normal itself. */
static inline unsigned long long hash_sample(unsigned long long hash, const vndf_view *view, float u1, float u2,
                                             vndf_vec3 *wm)
{
    float pdf = 0.0f;
    *wm = vndf_sample(view, u1, u2, &pdf);
    hash = hash_float(hash_float(hash_float(hash, wm->x), wm->y), wm->z);
    return hash_float(hash, pdf);
}

/* All other functions of vndf.h that take a view or a surface. */
static inline unsigned long long hash_others(unsigned long long hash, const vndf_view *view,
                                             const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wm, float x,
                                             float y)
{
    float v1 = 0.0f, v2 = 0.0f;
    vndf_invert(view, wm, &v1, &v2);
    hash = hash_float(hash_float(hash, v1), v2);
    hash = hash_float(hash_float(hash, vndf_pdf(view, wm)), vndf_visible(view, wm));
    hash = hash_float(hash_float(hash, vndf_ndf(surface, wm)), vndf_p22(surface, x, y));
    hash = hash_float(hash_float(hash, vndf_projected_area(surface, wi)), vndf_lambda(surface, wi));
    hash = hash_float(hash_float(hash, vndf_g1(surface, wi)), vndf_g2(surface, wi, wm, VNDF_G2_SEPARABLE));
    return hash_float(hash, vndf_g2(surface, wi, wm, VNDF_G2_HEIGHT_CORRELATED));
}

/* A material's sample, its value and its density there; a set of effects that makes no sense is refused. */
static inline unsigned long long hash_material(unsigned long long hash, const vndf_surface *surface,
                                               unsigned long i, vndf_vec3 wi, const float u[3])
{
    vndf_description is = {.distribution = surface->distribution,
                           .effects = {(vndf_lobes)(i % 3), (vndf_fresnel)(i / 3 % 4), (vndf_masking)(i / 12 % 4),
                                       (vndf_normals_drawn)(i / 48 % 4), (vndf_scattering)(i / 192 % 2),
                                       (vndf_transport)(i / 384 % 2), (vndf_shape)(i / 768 % 2),
                                       VNDF_REFLECTION_SPECULAR},
                           .eta = 1.5f,
                           .alpha_x = surface->alpha_x,
                           .alpha_y = surface->alpha_y,
                           .rotation = 1.0f,
                           .f0 = {0.1f, 0.5f, 0.9f},
                           .conductor_eta = {0.2f, 0.9f, 1.5f},
                           .conductor_k = {3.9f, 2.4f, 0.0f}};
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_scattered s;
    float f[3], per = 1.0f / sqrtf(wi.x * wi.x + wi.y * wi.y + wi.z * wi.z);
    const vndf_vec3 unit = {wi.x * per, wi.y * per, wi.z * per};
    if (vndf_material_resolve(&is, &material, NULL) != VNDF_OK)
        return hash_float(hash, 1.0f);
    vndf_bsdf_at(&bsdf, &material, unit);
    vndf_bsdf_sample(&bsdf, u, &s);
    vndf_bsdf_eval(&bsdf, s.wo, i, f);
    const float all[] = {s.wo.x,      s.wo.y, s.wo.z, s.weight[0], s.weight[1],
                         s.weight[2], f[0],   f[1],   f[2],        s.density};
    for (size_t j = 0; j < sizeof all / sizeof *all; j++)
        hash = hash_float(hash, all[j]);
    return hash_float(hash, vndf_bsdf_pdf(&bsdf, s.wo));
}

/* The i-th step from `state`: a view of its own, from any direction of the whole sphere, roughness from 1e-6 to 10, a
 * sample, at corners of the unit square too; at every eighth all other functions of vndf.h are asked, at every fourth a
 * material. */
static inline unsigned long long hash_step(unsigned long long hash, const vndf_distribution *distribution,
                                           unsigned long i, unsigned long long *state)
{
    static const float alphas[] = {1e-6f, 0.03f, 0.4f, 1.0f, 10.0f};
    const float x = test_uniform(state), y = test_uniform(state), z = test_uniform(state);
    const float r1 = test_uniform(state), r2 = test_uniform(state);
    const float u[3] = {i % 7 ? r1 : (float)(i % 2), i % 11 ? r2 : (float)(i % 2), x};
    const vndf_surface surface = {distribution, alphas[i % 5], alphas[i / 5 % 5]};
    const vndf_vec3 wi = {2.0f * x - 1.0f, 2.0f * y - 1.0f, 2.0f * z - 1.0f};
    const vndf_view view = vndf_view_from(&surface, wi);
    vndf_vec3 wm;
    hash = hash_sample(hash, &view, u[0], u[1], &wm);
    if (i % 8 == 0)
        hash = hash_others(hash, &view, &surface, wi, wm, u[0], u[1]);
    return i % 4 == 0 ? hash_material(hash, &surface, i / 4, wi, u) : hash;
}

#endif
