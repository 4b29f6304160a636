/* Prints hashes of the bits that the run time computes for the closed forms and the tables that are its arguments:
 *
 *     same_bits COUNT [TABLE...]
 *
 * after COUNT steps. A line has the hash after so many steps, that number, and the distribution: one after PREFIX, so
 * that a slow machine that takes fewer is compared with a fast one, and one after COUNT. The last line is the sum of
 * the hashes after PREFIX: the number of README.md.
 * test_same_bits.cmake compares differently compiled copies. */
#include <stdlib.h>

#include "harness/test.h"
#include "vndf_bsdf.h"

/* FNV-1a, a word at a time. */
static unsigned long long hash_floats(unsigned long long hash, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        unsigned bits;
        memcpy(&bits, &values[i], sizeof bits);
        hash = (hash ^ bits) * 0x100000001B3ULL;
    }
    return hash;
}

/* Of a radian. */
static const float COSINE = 0.540302277f, SINE = 0.841470957f;

/* A material's sample, its value and its density there, half of them turned by a radian; a set of effects that makes no
 * sense is refused. */
static unsigned long long hash_material(unsigned long long hash, const vndf_surface *surface, unsigned long i,
                                        vndf_vec3 wi, const float u[3])
{
    const vndf_surface turned = vndf_rotated(*surface, COSINE, SINE);
    vndf_description is = {.surface = i / 768 % 2 ? turned : *surface,
                           .effects = {(vndf_lobes)(i % 3), (vndf_fresnel)(i / 3 % 4), (vndf_masking)(i / 12 % 4),
                                       (vndf_normals_drawn)(i / 48 % 4), (vndf_scattering)(i / 192 % 2),
                                       (vndf_transport)(i / 384 % 2), VNDF_SHAPE_LEVEL, VNDF_REFLECTION_SPECULAR},
                           .eta = 1.5f,
                           .f0 = {0.1f, 0.5f, 0.9f},
                           .conductor_eta = {0.2f, 0.9f, 1.5f},
                           .conductor_k = {3.9f, 2.4f, 0.0f}};
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_scattered s;
    float f[3], per = 1.0f / sqrtf(wi.x * wi.x + wi.y * wi.y + wi.z * wi.z);
    const vndf_vec3 unit = {wi.x * per, wi.y * per, wi.z * per};
    if (vndf_material_resolve(&is, &material, NULL) != VNDF_OK)
        return hash_floats(hash, &(float){1.0f}, 1);
    vndf_bsdf_at(&bsdf, &material, unit);
    vndf_bsdf_sample(&bsdf, u, &s);
    vndf_bsdf_eval(&bsdf, s.wo, i, f);
    const float pdf = vndf_bsdf_pdf(&bsdf, s.wo);
    const float all[] = {s.wo.x, s.wo.y, s.wo.z, s.weight[0], s.weight[1], s.weight[2],
                         f[0],   f[1],   f[2],   s.density,   pdf};
    return hash_floats(hash, all, sizeof all / sizeof *all);
}

/* The i-th step from `state`: a view of its own, from any direction of the whole sphere, roughness from 1e-6 to 10, a
 * sample, at corners of the unit square too; at every eighth all other functions of vndf.h are asked, at every fourth a
 * material. */
static unsigned long long hash_step(unsigned long long hash, const vndf_distribution *distribution,
                                    unsigned long i, unsigned long long *state)
{
    static const float alphas[] = {1e-6f, 0.03f, 0.4f, 1.0f, 10.0f};
    const float x = test_uniform(state), y = test_uniform(state), z = test_uniform(state);
    const float r1 = test_uniform(state), r2 = test_uniform(state);
    const float u[3] = {i % 7 ? r1 : (float)(i % 2), i % 11 ? r2 : (float)(i % 2), x};
    const vndf_surface surface = vndf_rough(distribution, alphas[i % 5], alphas[i / 5 % 5]);
    const vndf_vec3 wi = {2.0f * x - 1.0f, 2.0f * y - 1.0f, 2.0f * z - 1.0f};
    const vndf_view view = vndf_view_from(&surface, wi);
    float pdf, v1 = 0.0f, v2 = 0.0f;
    const vndf_vec3 wm = vndf_sample(&view, u[0], u[1], &pdf);
    const float sample[] = {wm.x, wm.y, wm.z, pdf};
    hash = hash_floats(hash, sample, 4);
    if (i % 8 == 0) {
        vndf_invert(&view, wm, &v1, &v2);
        const float all[] = {v1,
                             v2,
                             vndf_pdf(&view, wm),
                             vndf_visible(&view, wm),
                             vndf_ndf(&surface, wm),
                             vndf_p22(&surface, u[0], u[1]),
                             vndf_projected_area(&surface, wi),
                             vndf_lambda(&surface, wi),
                             vndf_g1(&surface, wi),
                             vndf_g2(&surface, wi, wm, VNDF_G2_SEPARABLE),
                             vndf_g2(&surface, wi, wm, VNDF_G2_HEIGHT_CORRELATED)};
        hash = hash_floats(hash, all, sizeof all / sizeof *all);
    }
    return i % 4 == 0 ? hash_material(hash, &surface, i / 4, wi, u) : hash;
}

enum { PREFIX = 20000 };

static unsigned long long sum_at_prefix;

static void print_hashes(const vndf_distribution *distribution, const char *name, unsigned long count)
{
    unsigned long long state = 20140716, hash = 0xCBF29CE484222325ULL;
    for (unsigned long i = 0; i < count; i++) {
        hash = hash_step(hash, distribution, i, &state);
        sum_at_prefix += i + 1 == PREFIX ? hash : 0;
        if (i + 1 == PREFIX || i + 1 == count)
            printf("%016llx %lu %s\n", hash, i + 1, name);
    }
}

int main(int arguments, char **argument)
{
    const unsigned long count = arguments > 1 ? strtoul(argument[1], NULL, 10) : 0;
    if (!TEST(count >= PREFIX))
        return test_done();
    print_hashes(vndf_ggx(), "ggx", count);
    print_hashes(vndf_beckmann(), "beckmann", count);
    for (int i = 2; i < arguments; i++) {
        vndf_distribution *table = vndf_load(argument[i], NULL);
        const char *slash = strrchr(argument[i], '/');
        if (TEST(table != NULL))
            print_hashes(table, slash ? slash + 1 : argument[i], count);
        vndf_free(table);
    }
    printf("%016llx %d all\n", sum_at_prefix, PREFIX);
    return test_done();
}
