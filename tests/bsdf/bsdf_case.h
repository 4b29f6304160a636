/* Hits to test by: materials of every sensible set of effects with optics and roughness drawn at random, and
 * directions from straight up to grazing, on both sides. */
#ifndef TESTS_BSDF_BSDF_CASE_H
#define TESTS_BSDF_BSDF_CASE_H

#include "harness/constants.h"
#include "oracle/oracle.h"
#include "oracle/oracle_bsdf.h"
#include "harness/test.h"

/* 1/1.5, 1.001, 1.33, 2.4 and what they are from the other side. */
static const float bsdf_etas[] = {1 / 1.5f, 1.001f, 1.33f, 2.4f, 1.5f, 1 / 1.001f, 1 / 1.33f, 1 / 2.4f};
enum { BSDF_ETA_COUNT = 8 };

static inline float bsdf_pick(const float *from, size_t count, unsigned long long *state)
{
    return from[(size_t)(test_uniform_double(state) * (double)count)];
}

static inline void bsdf_optics(vndf_description *is, unsigned long long *state)
{
    is->eta = bsdf_pick(bsdf_etas, BSDF_ETA_COUNT, state);
    is->wavelengths = VNDF_WAVELENGTHS;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) {
        is->f0[i] = test_uniform(state);
        is->conductor_eta[i] = 0.1f + 3 * test_uniform(state);
        is->conductor_k[i] = 4 * test_uniform(state);
    }
}

/* Roughness from the list, half of the time anisotropic. */
static inline vndf_description bsdf_material(const oracle_ndf *ndf, const vndf_effects *effects,
                                             const float *alphas, size_t count, unsigned long long *state)
{
    vndf_description is = {.distribution = ndf->distribution, .effects = *effects};
    is.alpha_x = is.alpha_y = bsdf_pick(alphas, count, state);
    if (test_uniform(state) < 0.5f)
        is.alpha_y = bsdf_pick(alphas, count, state);
    is.rotation = 20 * test_uniform(state) - 10;
    bsdf_optics(&is, state);
    return is;
}

/* Cosine 1, 1e-3, 1e-6 or any; on either side. */
static inline vndf_vec3 bsdf_direction(unsigned long long *state)
{
    double cosine = test_uniform_double(state), which = 10 * test_uniform_double(state);
    double z = which < 1 ? 1e-3 : which < 2 ? 1e-6 : which < 3 ? 1 : which < 4 ? cosine * cosine * cosine : cosine;
    double side = test_uniform(state) < 0.5f ? -1 : 1;
    return oracle_toward(side * z, 2 * PI * test_uniform_double(state));
}

static inline void bsdf_numbers(unsigned long long *state, float u[3])
{
    for (int i = 0; i < 3; i++)
        u[i] = test_uniform(state);
}

static inline void bsdf_describe(const vndf_description *is, const char *ndf, vndf_vec3 wi, vndf_vec3 wo)
{
    char text[ORACLE_EFFECTS_TEXT];
    oracle_effects_name(&is->effects, text);
    fprintf(stderr, "  %s, %s, alpha %.9g %.9g, eta %.9g, rotation %.9g, wi %.9g %.9g %.9g, wo %.9g %.9g %.9g\n",
            text, ndf, (double)is->alpha_x, (double)is->alpha_y, (double)is->eta, (double)is->rotation,
            (double)wi.x, (double)wi.y, (double)wi.z, (double)wo.x, (double)wo.y, (double)wo.z);
}

/* How far one rounding of wo moves the density of samples. */
static inline double bsdf_spread(const vndf_bsdf *bsdf, vndf_vec3 wo, double pdf)
{
    double sum = 0;
    for (int i = 0; i < 6; i++) {
        float by = i % 2 ? 0x1p-23f : -0x1p-23f;
        vndf_vec3 near = {wo.x + (i / 2 == 0) * by, wo.y + (i / 2 == 1) * by, wo.z + (i / 2 == 2) * by};
        sum += fabs((double)vndf_bsdf_pdf(bsdf, near) - pdf);
    }
    return sum;
}

#endif
