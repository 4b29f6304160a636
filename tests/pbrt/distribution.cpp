/* From above and below samples, PDF and D(w, wm) are the library's from above, to the bit; and D(w, wm) is pbrt's
 * G1(w) D(wm) |w.wm|/|cos|, G its function of Lambda. */
#include "vndf_distribution.hpp"

#include "harness/test.h"

using namespace pbrt;

static void look(const VndfDistribution &normals, const vndf_surface &surface, Vector3f w)
{
    const float side = w.z < 0 ? -1 : 1;
    const vndf_view view = vndf_view_from(&surface, {side * w.x, side * w.y, side * w.z});
    unsigned long long state = 5;
    for (int i = 0; i < 20000; ++i) {
        const float u = test_uniform(&state), v = test_uniform(&state);
        const Vector3f wm = normals.Sample_wm(w, {u, v});
        const vndf_vec3 own = vndf_sample(&view, u, v, nullptr);
        const double facing = double(w.x * wm.x + w.y * wm.y + w.z * wm.z), seen = double(normals.D(w, wm));
        TEST(wm.x == own.x && wm.y == own.y && wm.z == own.z && normals.PDF(w, wm) == vndf_pdf(&view, own));
        TEST(normals.D(w, wm) == vndf_visible(&view, own));
        if (facing * double(w.z) > 0.01)
            TEST_RELATIVE(seen, double(normals.G1(w) * normals.D(wm)) * std::abs(facing / double(w.z)), 1e-4);
    }
}

int main()
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", nullptr);
    VndfDistribution normals(table, 0.3f, 0.15f);
    const Vector3f above = {0.48f, 0.64f, 0.6f}, below = {0.8f, 0, -0.6f}, across = {-0.6f, 0, 0.8f};
    const vndf_surface same = vndf_rough(table, 0.3f, 0.15f), ggx = vndf_rough(vndf_ggx(), 0.2f, 0.4f);
    for (const Vector3f w : {above, below, across})
        look(normals, same, w);
    look(VndfDistribution(0.2f, 0.4f), ggx, above);
    TEST_RELATIVE(double(normals.G(above, below)), double(1 / (1 + normals.Lambda(above) + normals.Lambda(below))),
                  1e-6);
    TEST_RELATIVE(double(normals.G1(above)), double(1 / (1 + normals.Lambda(above))), 1e-6);
    TEST(normals.Lambda(below) > 0 && !normals.EffectivelySmooth());
    TEST(normals.D(above) == vndf_ndf(&same, {above.x, above.y, above.z}));
    const double sharp = double(normals.D({0, 0, 1}));
    normals.Regularize(); /* 0.3 stays, 0.15 becomes 0.3 */
    TEST_RELATIVE(double(normals.D({0, 0, 1})), sharp / 2, 1e-5);
    TEST(VndfDistribution(table, 0, 0).EffectivelySmooth());
    vndf_free(table);
    return test_done();
}
