/* Prints hashes of the bits that the run time computes for the closed forms and the tables that are its arguments:
 *
 *     same_bits COUNT [TABLE...]
 *
 * Each of COUNT samples has a view of its own: directions of the whole sphere, roughness from 1e-6 to 10, corners of
 * the unit square. At every eighth all other functions of vndf.h are asked, at every fourth a material. A line has the
 * hash after so many samples, that number, and the distribution: one after PREFIX, so that a slow machine that takes
 * fewer is compared with a fast one, and one after COUNT. test_same_bits.cmake compares differently compiled copies. */
#include <stdlib.h>

#include "harness/hash.h"
#include "harness/test.h"
#include "vndf_bsdf.h"

enum { PREFIX = 20000 };

/* A material's sample, its value and its density there; a set of effects that makes no sense is refused. */
static unsigned long long hash_material(unsigned long long hash, const vndf_surface *surface, unsigned long i,
                                        vndf_vec3 wi, const float u[3])
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

static void print_hashes(const vndf_distribution *distribution, const char *name, unsigned long count)
{
    static const float alphas[] = {1e-6f, 0.03f, 0.4f, 1.0f, 10.0f};
    unsigned long long state = 20140716, hash = hash_begin;
    for (unsigned long i = 0; i < count; i++) {
        const float x = test_uniform(&state), y = test_uniform(&state), z = test_uniform(&state);
        const float r1 = test_uniform(&state), r2 = test_uniform(&state);
        const float u1 = i % 7 ? r1 : (float)(i % 2), u2 = i % 11 ? r2 : (float)(i % 2), u[3] = {u1, u2, x};
        const vndf_surface surface = {distribution, alphas[i % 5], alphas[i / 5 % 5]};
        const vndf_vec3 wi = {2.0f * x - 1.0f, 2.0f * y - 1.0f, 2.0f * z - 1.0f};
        const vndf_view view = vndf_view_from(&surface, wi);
        vndf_vec3 wm;
        hash = hash_sample(hash, &view, u1, u2, &wm);
        if (i % 8 == 0)
            hash = hash_others(hash, &view, &surface, wi, wm, u1, u2);
        if (i % 4 == 0)
            hash = hash_material(hash, &surface, i / 4, wi, u);
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
    return test_done();
}
