/* Prints a hash of the bits of everything that the run time computes for the tables that are its
 * arguments, over directions of the whole sphere, roughness from 1e-6 to 10 and the corners of the unit
 * square. test_same_bits.cmake compares the hashes of differently compiled copies. */
#include "test.h"
#include "vndf.h"

enum { POINTS = 20000 };

static unsigned long long hash_float(unsigned long long hash, float value)
{
    unsigned bits;
    memcpy(&bits, &value, sizeof bits);
    return (hash ^ bits) * 0x100000001B3ULL; /* FNV-1a, a word at a time */
}

static unsigned long long hash_vector(unsigned long long hash, vndf_vec3 v)
{
    return hash_float(hash_float(hash_float(hash, v.x), v.y), v.z);
}

static unsigned long long hash_point(unsigned long long hash, const vndf_surface *surface, vndf_vec3 wi, float u1,
                                     float u2)
{
    const vndf_view view = vndf_view_from(surface, wi);
    float pdf = 0.0f, v1 = 0.0f, v2 = 0.0f;
    const vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);

    vndf_invert(&view, wm, &v1, &v2);
    hash = hash_float(hash_float(hash_float(hash_vector(hash, wm), pdf), v1), v2);
    hash = hash_float(hash_float(hash, vndf_pdf(&view, wm)), vndf_visible(&view, wm));
    hash = hash_float(hash_float(hash, vndf_ndf(surface, wm)), vndf_p22(surface, u1, u2));
    hash = hash_float(hash_float(hash, vndf_projected_area(surface, wi)), vndf_lambda(surface, wi));
    return hash_float(hash, vndf_g1(surface, wi));
}

static unsigned long long hash_table(const vndf_distribution *distribution)
{
    static const float alphas[] = {1e-6f, 0.03f, 0.4f, 1.0f, 10.0f};
    unsigned long long state = 20140716, hash = 0xCBF29CE484222325ULL;

    for (unsigned i = 0; i < POINTS; i++) {
        const float x = test_uniform(&state), y = test_uniform(&state), z = test_uniform(&state);
        const float u1 = test_uniform(&state), u2 = test_uniform(&state);
        const vndf_surface surface = {distribution, alphas[i % 5], alphas[i / 5 % 5]};
        const vndf_vec3 wi = {2.0f * x - 1.0f, 2.0f * y - 1.0f, 2.0f * z - 1.0f};
        hash = hash_point(hash, &surface, wi, i % 7 ? u1 : (float)(i % 2), i % 11 ? u2 : (float)(i % 2));
    }
    return hash;
}

int main(int count, char **paths)
{
    for (int i = 1; i < count; i++) {
        vndf_error error = {VNDF_OK, ""};
        vndf_distribution *distribution = vndf_load(paths[i], &error);
        if (!TEST(distribution != NULL)) {
            fprintf(stderr, "%s\n", error.message);
            continue;
        }
        printf("%016llx %s\n", hash_table(distribution), paths[i]);
        vndf_free(distribution);
    }
    TEST(count > 1);
    return test_done();
}
