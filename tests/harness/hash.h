/* Hashes of the bits that the run time computes, for tests that compare builds, machines or threads. */
#ifndef TESTS_HARNESS_HASH_H
#define TESTS_HARNESS_HASH_H

#include <string.h>

#include "vndf.h"

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

#endif
