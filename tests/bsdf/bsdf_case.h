/* Hits to test by: materials of every sensible set of effects with optics, roughness and shape drawn at random, and
 * directions from straight up to grazing, on both sides. */
#ifndef TESTS_BSDF_BSDF_CASE_H
#define TESTS_BSDF_BSDF_CASE_H

#include "harness/test.h"
#include "oracle/oracle_bsdf.h"

/* Steps *i on to the next of the distributions that the arguments ask for, and opens it; 0 where there is no more. */
static inline int bsdf_next(size_t *i, oracle_ndf *ndf, const char *const names[], size_t count, int arguments,
                            char **argument)
{
    while (*i < count && !oracle_wanted(arguments, argument, *i, names[*i]))
        ++*i;
    return *i < count && TEST(oracle_ndf_open(ndf, names[*i]));
}

static inline float bsdf_pick(const float *from, size_t count, unsigned long long *state)
{
    return from[(size_t)(test_uniform_double(state) * (double)count)];
}

static inline float bsdf_around(float most, unsigned long long *state)
{
    return most * (2 * test_uniform(state) - 1);
}

/* A surface: R diag R of singular values from 0.01 to 3, mirrored half of the time; with a mean slope or without. */
static inline vndf_surface bsdf_sheared(const vndf_distribution *d, float mean, unsigned long long *state)
{
    double x = exp(log(0.01) + log(300) * test_uniform_double(state)), p = 2 * PI * test_uniform_double(state);
    double y = exp(log(0.01) + log(300) * test_uniform_double(state)), q = 2 * PI * test_uniform_double(state);
    double flip = test_uniform(state) < 0.5f ? -1 : 1;
    vndf_surface a = oracle_turned(d, x, y * flip, q, p);
    a.mean_x = bsdf_around(mean, state);
    a.mean_y = bsdf_around(mean, state);
    return a;
}

/* A description and what it points to: it must not move. */
typedef struct bsdf_subject {
    vndf_description is;
    vndf_mixture mixture;
    const oracle_ndf *ndf[ORACLE_LOBES];
    float alpha[2];
    int is_rough; /* of this roughness, along x and y or turned, and level */
} bsdf_subject;

/* Of the distributions `all`, the first of them where there is one. Roughness from the list, half of the time
 * anisotropic, or a matrix; index ratios 1/1.5, 1.001, 1.33, 2.4 and what they are from the other side. */
static inline void bsdf_material(bsdf_subject *s, const oracle_ndf *all, size_t ndfs, const vndf_effects *effects,
                                 const float *alphas, size_t count, unsigned long long *state)
{
    static const float etas[] = {1 / 1.5f, 1.001f, 1.33f, 2.4f, 1.5f, 1 / 1.001f, 1 / 1.33f, 1 / 2.4f};
    vndf_description *is = &s->is;
    *is = (vndf_description){.effects = *effects, .mixture = &s->mixture};
    s->alpha[0] = s->alpha[1] = bsdf_pick(alphas, count, state);
    if (test_uniform(state) < 0.5f)
        s->alpha[1] = bsdf_pick(alphas, count, state);
    const float turn = test_uniform(state) < 0.5f ? 0 : bsdf_around(10, state);
    s->is_rough = effects->shape == VNDF_SHAPE_LEVEL && test_uniform(state) < 0.7f;
    is->surface =
        s->is_rough ? vndf_rotated(vndf_rough(all->distribution, s->alpha[0], s->alpha[1]), cosf(turn), sinf(turn))
                    : bsdf_sheared(all->distribution, test_uniform(state) < 0.8f ? 1.4f : 0, state);
    s->mixture.count = 1 + (int)(ORACLE_LOBES * test_uniform(state));
    for (int i = 0; i < s->mixture.count; i++) {
        s->ndf[i] = &all[i ? (size_t)((float)ndfs * test_uniform(state)) : 0];
        s->mixture.lobe[i].surface = bsdf_sheared(s->ndf[i]->distribution, 1.4f, state);
        s->mixture.lobe[i].weight = 0.05f + test_uniform(state);
    }
    is->eta = bsdf_pick(etas, 8, state);
    is->wavelengths = VNDF_WAVELENGTHS;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) {
        is->f0[i] = test_uniform(state) < 0.3f ? 0 : test_uniform(state); /* 0: F is (1 - wi.wm)^5 alone */
        is->conductor_eta[i] = 0.1f + 3 * test_uniform(state);
        is->conductor_k[i] = 4 * test_uniform(state);
    }
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

/* f |cos_o| over the density, and that density. */
typedef struct bsdf_look {
    double pdf, weight[VNDF_WAVELENGTHS];
} bsdf_look;

static inline bsdf_look bsdf_look_at(const vndf_bsdf *bsdf, vndf_vec3 wo)
{
    float f[VNDF_WAVELENGTHS], pdf;
    vndf_bsdf_eval_pdf(bsdf, wo, 0, f, &pdf);
    bsdf_look at = {(double)pdf, {0}};
    for (int i = 0; i < bsdf->material->is.wavelengths && pdf > 0; i++)
        at.weight[i] = (double)f[i] * fabs((double)vndf_bsdf_cosine(bsdf, wo)) / (double)pdf;
    return at;
}

/* How far one rounding of wo moves both. */
static inline bsdf_look bsdf_spread(const vndf_bsdf *bsdf, vndf_vec3 wo, const bsdf_look *at)
{
    bsdf_look sum = {0, {0}};
    for (int i = 0; i < 6; i++) {
        float by = i % 2 ? 0x1p-23f : -0x1p-23f;
        vndf_vec3 near = {wo.x + (i / 2 == 0) * by, wo.y + (i / 2 == 1) * by, wo.z + (i / 2 == 2) * by};
        bsdf_look other = bsdf_look_at(bsdf, near);
        sum.pdf += fabs(other.pdf - at->pdf);
        for (int k = 0; k < VNDF_WAVELENGTHS; k++)
            sum.weight[k] += other.pdf > 0 ? fabs(other.weight[k] - at->weight[k]) : 0;
    }
    return sum;
}

static inline void bsdf_describe(const vndf_description *is, const char *ndf, vndf_vec3 wi, vndf_vec3 wo)
{
    const vndf_effects *e = &is->effects; /* by the numbers of vndf_bsdf.h */
    fprintf(
        stderr,
        "  lobes %d, fresnel %d, masking %d, normals %d, scattering %d, transport %d, shape %d, reflection %d\n",
        e->lobes, e->fresnel, e->masking, e->normals, e->scattering, e->transport, e->shape, e->reflection);
    const vndf_surface *a = &is->surface;
    fprintf(stderr,
            "    %s, (%.9g %.9g; %.9g %.9g) mean %.9g %.9g, eta %.9g, wi %.9g %.9g %.9g, wo %.9g %.9g %.9g\n", ndf,
            (double)a->xx, (double)a->xy, (double)a->yx, (double)a->yy, (double)a->mean_x, (double)a->mean_y,
            (double)is->eta, (double)wi.x, (double)wi.y, (double)wi.z, (double)wo.x, (double)wo.y, (double)wo.z);
}

#endif
