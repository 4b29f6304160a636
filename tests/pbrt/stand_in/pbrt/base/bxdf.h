/* What a BxDF of pbrt-v4 is made of, in its names and shapes, as far as tools/pbrt needs it: written for this test,
 * so that the adapter is compiled and run without pbrt. Not to be used with pbrt, which has its own. */
#ifndef STAND_IN_PBRT_BASE_BXDF_H
#define STAND_IN_PBRT_BASE_BXDF_H

#include <array>
#include <optional>

namespace pstd
{
using std::optional;
}

namespace pbrt
{

using Float = float;
constexpr int NSpectrumSamples = 4;

struct Point2f {
    Float x = 0, y = 0;
};

struct Vector3f {
    Float x, y, z;
};

struct SampledSpectrum : std::array<Float, NSpectrumSamples> {
    explicit SampledSpectrum(Float c = 0) : std::array<Float, NSpectrumSamples>{c, c, c, c}
    {
    }
    explicit operator bool() const
    {
        return *this != SampledSpectrum();
    }
};

enum class TransportMode { Radiance, Importance };
enum class BxDFReflTransFlags { Unset = 0, Reflection = 1, Transmission = 2, All = 3 };

/* clang-format off */
enum BxDFFlags { Unset = 0, Reflection = 1, Transmission = 2, Glossy = 8, Specular = 16,
                 SpecularTransmission = 18, GlossyReflection = 9, GlossyTransmission = 10 };
/* clang-format on */
inline BxDFFlags operator|(BxDFFlags a, BxDFFlags b)
{
    return BxDFFlags(int(a) | int(b));
}

struct BSDFSample {
    SampledSpectrum f;
    Vector3f wi;
    Float pdf;
    BxDFFlags flags;
    Float eta = 1;
};

} // namespace pbrt

#endif
