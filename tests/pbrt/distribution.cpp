/* From above and below: the integral of PDF is 1; the mean over samples of what D(w, wm)/PDF weighs is its integral; and
 * D(w, wm) is pbrt's G1(w) D(wm) |w.wm|/|cos|, G its function of Lambda. */
#include "vndf_distribution.hpp"

#include "harness/test.h"

using namespace pbrt;

static void look(const VndfDistribution &normals, Vector3f w)
{
    enum { ROWS = 600, COLUMNS = 300, SAMPLES = 400000 };
    const double cell = 1.0 / ROWS * 2 * PI / COLUMNS;
    unsigned long long state = 5;
    double mass = 0, lean = 0, mean = 0;
    for (int i = 0; i < ROWS * COLUMNS; ++i) {
        const double z = (i / COLUMNS + 0.5) / ROWS, phi = 2 * PI * (i % COLUMNS + 0.5) / COLUMNS;
        const double sine = std::sqrt(1 - z * z);
        const Vector3f wm = {float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(z)};
        const double facing = double(w.x * wm.x + w.y * wm.y + w.z * wm.z), seen = double(normals.D(w, wm));
        mass += double(normals.PDF(w, wm)) * cell;
        lean += seen * double(wm.x) * cell;
        if (facing * double(w.z) > 0.01)
            TEST_RELATIVE(seen, double(normals.G1(w) * normals.D(wm)) * std::abs(facing / double(w.z)), 1e-4);
    }
    for (int i = 0; i < SAMPLES; ++i) {
        const float u = test_uniform(&state), v = test_uniform(&state);
        const Vector3f wm = normals.Sample_wm(w, {u, v});
        TEST(wm.z >= 0);
        mean += double(wm.x) * double(normals.D(w, wm)) / double(normals.PDF(w, wm)) / SAMPLES;
    }
    printf("cos %5.2f: density %.4f, mean %.4f of %.4f\n", double(w.z), mass, mean, lean);
    TEST_NEAR(mass, 1, 2e-3);
    TEST_NEAR(mean, lean, 2e-3);
}

int main()
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", nullptr);
    VndfDistribution normals(table, 0.3f, 0.15f);
    const Vector3f above = {0.48f, 0.64f, 0.6f}, below = {0.8f, 0, -0.6f}, across = {-0.6f, 0, 0.8f};
    for (const Vector3f w : {above, below, across})
        look(normals, w);
    look(VndfDistribution(0.2f, 0.4f), above);
    TEST_RELATIVE(double(normals.G(above, below)), double(1 / (1 + normals.Lambda(above) + normals.Lambda(below))),
                  1e-6);
    TEST_RELATIVE(double(normals.G1(above)), double(1 / (1 + normals.Lambda(above))), 1e-6);
    TEST(normals.Lambda(below) > 0 && !normals.EffectivelySmooth());
    const vndf_surface same = {table, 0.3f, 0.15f};
    TEST(normals.D(above) == vndf_ndf(&same, {above.x, above.y, above.z}));
    const double sharp = double(normals.D({0, 0, 1}));
    normals.Regularize(); /* 0.3 stays, 0.15 becomes 0.3 */
    TEST_RELATIVE(double(normals.D({0, 0, 1})), sharp / 2, 1e-5);
    TEST(VndfDistribution(table, 0, 0).EffectivelySmooth());
    vndf_free(table);
    return test_done();
}
