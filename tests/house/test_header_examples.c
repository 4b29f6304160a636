/* The examples of vndf.h, and of BSDFs in README, compile, which tests/CMakeLists.txt takes from there, and do what is
 * said of them: glass scatters; a brushed surface under a normal map has the map's normal in its middle, `along` along
 * the brush and `across` across it; two families in one mixture have the densities of their sum, 7 to 3. */
#include "harness/test.h"
#include "vndf_bsdf.h"

static void test_glass(void)
{
    const vndf_vec3 wi = {0.6f, 0, 0.8f};
    const float u[3] = {0.3f, 0.6f, 0.5f};
    vndf_error error;
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_scattered s;
#include "glass.h"
    TEST(s.lobe != VNDF_LOBE_NONE && s.density > 0 && s.weight[0] > 0.3f && s.weight[0] < 1);
}

/* P22 of GGX is a quarter of that in the middle as far away as the roughness, along the brush and across it. */
static void test_brushed(const vndf_distribution *metal, float phi, float along, float across, vndf_vec3 wi,
                         const float u[2])
{
    const vndf_vec3 n = {-0.33f, 0.19f, 0.95f};
#include "brushed.h"
    const float x = -n.x / n.z, y = -n.y / n.z, c = cosf(phi), s = sinf(phi);
    const double middle = 1 / (PI * (double)along * (double)across);
    TEST_RELATIVE((double)pdf, (double)vndf_pdf(&view, wm), 1e-5);
    TEST_RELATIVE((double)vndf_p22(&brushed, x, y), middle, 1e-4);
    TEST_RELATIVE((double)vndf_p22(&brushed, x + c * along, y + s * along), middle / 4, 1e-4);
    TEST_RELATIVE((double)vndf_p22(&brushed, x - s * across, y + c * across), middle / 4, 1e-4);
}

static void test_families(const vndf_family *metals, float p, const vndf_surface *narrow, const vndf_family *tails,
                          float q, const vndf_surface *wide, vndf_vec3 wi, const float u[2])
{
    vndf_mixture core, tail;
    TEST(vndf_family_at(metals, p, narrow, &core) == VNDF_FAMILY_INSIDE);
    TEST(vndf_family_at(tails, q, wide, &tail) == VNDF_FAMILY_INSIDE);
#include "families.h"
    TEST(whole.count == 3);
    TEST_RELATIVE((double)vndf_mixture_ndf(&whole, wm),
                  0.7 * (double)vndf_mixture_ndf(&core, wm) + 0.3 * (double)vndf_mixture_ndf(&tail, wm), 1e-5);
    TEST_RELATIVE((double)pdf, (double)vndf_mixture_pdf(&view, wm), 1e-5);
}

int main(void)
{
    const vndf_distribution *const two[2] = {vndf_ggx(), vndf_beckmann()};
    const float parameters[2] = {1, 2}, u[2] = {0.3f, 0.6f};
    const vndf_surface narrow = {NULL, 0.1f, 0, 0, 0.05f, 0.1f, 0}, wide = {NULL, 0.4f, 0.1f, 0, 0.4f, 0, 0};
    vndf_family *family = vndf_family_of(two, parameters, 2, NULL);
    test_glass();
    test_brushed(vndf_ggx(), 0.4f, 0.05f, 0.3f, (vndf_vec3){0.48f, 0.64f, 0.6f}, u);
    for (float p = 1.1f; p < 2; p += 0.1f)
        test_families(family, p, &narrow, family, 2, &wide, (vndf_vec3){0.6f, 0, 0.8f}, u);
    vndf_family_free(family);
    return test_done();
}
