/* For each case: integral of PDF = 1 but for lost samples; mean of f cos/PDF over samples = integral of f cos; both
 * of a sample are those of its direction; transmitted importance has eta^2 the value of radiance; flags choose lobes.
 */
#include "vndf_bxdf.hpp"

#include "harness/test.h"

using namespace pbrt;

static const BxDFReflTransFlags flags_of[] = {BxDFReflTransFlags::All, BxDFReflTransFlags::Reflection,
                                              BxDFReflTransFlags::Transmission};

static Vector3f at(double cosine, double phi)
{
    const double sine = std::sqrt(1 - cosine * cosine);
    return {float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(cosine)};
}

static void look(const VndfBxDF &bxdf, Vector3f wo, TransportMode mode, BxDFReflTransFlags flags, double eta)
{
    enum { ROWS = 800, COLUMNS = 400, SAMPLES = 200000 };
    const double cell = 2.0 / ROWS * 2 * PI / COLUMNS;
    unsigned long long state = 5;
    double mass = 0, light = 0, mean = 0, kept = 0;
    for (int i = 0; i < ROWS * COLUMNS; ++i) {
        const double cosine = 2 * (i / COLUMNS + 0.5) / ROWS - 1;
        const Vector3f wi = at(cosine, 2 * PI * (i % COLUMNS + 0.5) / COLUMNS);
        mass += double(bxdf.PDF(wo, wi, mode, flags)) * cell;
        if (int(flags) & (wi.z * wo.z > 0 ? 1 : 2))
            light += double(bxdf.f(wo, wi, mode)[1]) * std::abs(cosine) * cell;
    }
    for (int i = 0; i < SAMPLES; ++i) {
        const float uc = test_uniform(&state), u = test_uniform(&state), v = test_uniform(&state);
        const pstd::optional<BSDFSample> s = bxdf.Sample_f(wo, uc, {u, v}, mode, flags);
        if (!s)
            continue;
        kept += 1.0 / SAMPLES;
        mean += double(s->f[1]) * std::abs(double(s->wi.z)) / double(s->pdf) / SAMPLES;
        const bool isTransmitted = s->flags & BxDFFlags::Transmission;
        TEST(isTransmitted == (s->wi.z * wo.z < 0));
        if (i % 1000 || std::abs(s->wi.z) < 0.01f)
            continue;
        const double bent = !isTransmitted ? 1 : wo.z > 0 ? eta : 1 / eta;
        TEST_RELATIVE(double(bxdf.PDF(wo, s->wi, mode, flags)), double(s->pdf), 1e-3);
        TEST_RELATIVE(double(bxdf.f(wo, s->wi, mode)[1]), double(s->f[1]), 1e-3);
        TEST_RELATIVE(double(s->eta), bent, 1e-6);
        TEST_RELATIVE(double(bxdf.f(wo, s->wi, TransportMode::Importance)[1]),
                      double(bxdf.f(wo, s->wi, TransportMode::Radiance)[1]) * bent * bent, 1e-4);
    }
    printf("cos %5.2f, mode %d, lobes %d: density %.4f of %.4f, albedo %.4f of %.4f\n", double(wo.z), int(mode),
           int(flags), mass, kept, mean, light);
    TEST_NEAR(mass, kept, 0.01);
    TEST_RELATIVE(mean, light, 0.01);
}

int main()
{
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", nullptr);
    vndf_description is = {};
    VndfMaterials metal, glass;
    vndf_error error;
    is.distribution = table;
    is.alpha_x = is.alpha_y = 1; // those of a hit come with it
    is.eta = 1.5f;
    TEST(metal.Resolve(is, &error));
    is.effects.lobes = VNDF_LOBES_BOTH;
    TEST(!glass.Resolve(is, &error) && strlen(error.message) > 0); // no Fresnel term to choose by
    is.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    TEST(glass.Resolve(is, &error));
    const VndfBxDF gold(&metal, 0.3f, 0.15f, SampledSpectrum(0.4f), SampledSpectrum(2.4f));
    TEST(!gold.Sample_f(at(0.5, 0), 0.5f, {}, TransportMode::Radiance, BxDFReflTransFlags::Transmission));
    look(gold, at(0.6, 1), TransportMode::Radiance, BxDFReflTransFlags::All, 1);
    for (const double cosine : {0.9, 0.3, -0.7})
        for (int i = 0; i < 6; ++i)
            look(VndfBxDF(&glass, 0.3f, 0.3f), at(cosine, 2), TransportMode(i % 2), flags_of[i % 3], 1.5);
    vndf_free(table);
    return test_done();
}
