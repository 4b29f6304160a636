// vndf_bxdf.hpp - any distribution of normals as a BxDF of pbrt-v4, for builds of it without GPU.
//
// What to copy, and what to change in pbrt's src/pbrt:
//
//   this file        next to bxdfs.h, where bxdfs.h includes it
//   base/bxdf.h      `class VndfBxDF;`, and VndfBxDF in the list of types that BxDF holds
//   materials.h      a material after the pattern of DielectricMaterial or ConductorMaterial: it loads a table
//                    (vndf_load), resolves one VndfMaterials when it is made, and its GetBxDF returns
//                    VndfBxDF(&materials, alpha_x, alpha_y), for a metal with eta and k at the lambda of the path
//   CMakeLists.txt   find_package(vndf), and vndf::vndf among the libraries of pbrt_lib
//
// pbrt's wo is the direction that is known, vndf's wi; both have z as the normal. f is without the cosine, densities are
// per solid angle. Of a dielectric f and weights have the factor of refraction of radiance (1/eta^2) unless `mode` is
// Importance. Bits of sampleFlags that are missing leave that lobe out: the other one is then drawn alone.
#ifndef VNDF_BXDF_HPP
#define VNDF_BXDF_HPP

#include <cmath>
#include <functional>
#include <string>

#include <pbrt/base/bxdf.h>

#include "vndf_bsdf.h"

namespace pbrt
{

// A material for either transport and for each choice of lobes, resolved once. It must not move while it is used.
struct VndfMaterials {
    // `is` carries one wavelength: a dielectric (both lobes, VNDF_FRESNEL_DIELECTRIC, eta), or a reflecting shape
    // (VNDF_FRESNEL_NONE), which a VndfBxDF colours. False, and the reason in *error, if it makes no sense.
    bool Resolve(vndf_description is, vndf_error *error)
    {
        all = is.effects.lobes;
        eta = is.eta;
        is.wavelengths = 1;
        for (int i = 0; i < 6; ++i) { // one that is refused scatters nothing
            is.effects.transport = i < 3 ? VNDF_TRANSPORT_RADIANCE : VNDF_TRANSPORT_IMPORTANCE;
            is.effects.lobes = vndf_lobes(i % 3);
            vndf_error *told = i % 3 == all ? error : nullptr;
            if (vndf_material_resolve(&is, &of[i / 3][i % 3], told) != VNDF_OK && i % 3 == all)
                return false;
        }
        return true;
    }

    vndf_material of[2][3];
    vndf_lobes all;
    float eta;
};

class VndfBxDF
{
  public:
    VndfBxDF() = default;

    // Of a metal eta and k are those at the wavelengths of the path.
    VndfBxDF(const VndfMaterials *materials, Float alpha_x, Float alpha_y,
             SampledSpectrum eta = SampledSpectrum(0), SampledSpectrum k = SampledSpectrum(0))
        : materials(materials), rough{float(alpha_x), float(alpha_y), 1, 0}, eta(eta), k(k)
    {
    }

    BxDFFlags Flags() const
    {
        const BxDFFlags both = BxDFFlags::Glossy | BxDFFlags::Reflection | BxDFFlags::Transmission;
        const BxDFFlags of[3] = {BxDFFlags::GlossyReflection, BxDFFlags::GlossyTransmission, both};
        return of[materials->all];
    }

    SampledSpectrum f(Vector3f wo, Vector3f wi, TransportMode mode) const
    {
        vndf_bsdf hit;
        float value = 0;
        const uint64_t seed = std::hash<float>()(wi.x) * 31 + std::hash<float>()(wi.y); // of random walks
        if (At(&hit, wo, mode, BxDFReflTransFlags::All))
            vndf_bsdf_eval(&hit, Vec(wi), seed, &value);
        return Colour(wo, wi, value);
    }

    pstd::optional<BSDFSample> Sample_f(Vector3f wo, Float uc, Point2f u,
                                        TransportMode mode = TransportMode::Radiance,
                                        BxDFReflTransFlags sampleFlags = BxDFReflTransFlags::All) const
    {
        const float numbers[3] = {float(u.x), float(u.y), float(uc)};
        vndf_bsdf hit;
        vndf_scattered s;
        if (!At(&hit, wo, mode, sampleFlags))
            return {};
        vndf_bsdf_sample(&hit, numbers, &s);
        if (s.lobe == VNDF_LOBE_NONE || s.wo.z == 0)
            return {};
        const Vector3f wi{s.wo.x, s.wo.y, s.wo.z};
        const SampledSpectrum value = Colour(wo, wi, s.weight[0] * s.density / std::abs(s.wo.z));
        if (s.lobe == VNDF_LOBE_TRANSMISSION)
            return BSDFSample{value, wi, s.density, BxDFFlags::GlossyTransmission,
                              wo.z > 0 ? materials->eta : 1 / materials->eta};
        return BSDFSample{value, wi, s.density,
                          s.lobe == VNDF_LOBE_STRAIGHT ? BxDFFlags::SpecularTransmission
                                                       : BxDFFlags::GlossyReflection};
    }

    Float PDF(Vector3f wo, Vector3f wi, TransportMode mode,
              BxDFReflTransFlags sampleFlags = BxDFReflTransFlags::All) const
    {
        vndf_bsdf hit;
        return At(&hit, wo, mode, sampleFlags) ? vndf_bsdf_pdf(&hit, Vec(wi)) : 0;
    }

    void Regularize()
    {
        for (float *alpha : {&rough.alpha_x, &rough.alpha_y})
            *alpha = *alpha < 0.3f ? std::fmin(std::fmax(2 * *alpha, 0.1f), 0.3f) : *alpha;
    }

    static constexpr const char *Name()
    {
        return "VndfBxDF";
    }
    std::string ToString() const
    {
        return "[ VndfBxDF alpha_x: " + std::to_string(rough.alpha_x) +
               " alpha_y: " + std::to_string(rough.alpha_y) + " ]";
    }

  private:
    static vndf_vec3 Vec(Vector3f w)
    {
        return {float(w.x), float(w.y), float(w.z)};
    }

    bool At(vndf_bsdf *hit, Vector3f wo, TransportMode mode, BxDFReflTransFlags flags) const
    {
        const int asked = int(flags); // 1: reflection, 2: transmission
        if (asked == 0)
            return false;
        const vndf_lobes lobes = asked == 3 ? materials->all : vndf_lobes(asked - 1);
        return (materials->all == VNDF_LOBES_BOTH || materials->all == lobes) &&
               vndf_bsdf_rough(hit, &materials->of[mode == TransportMode::Importance][lobes], &rough, Vec(wo));
    }

    // `value` for each wavelength: of a metal times Fresnel's term at the normal between the directions.
    SampledSpectrum Colour(Vector3f wo, Vector3f wi, float value) const
    {
        SampledSpectrum colour{Float(value)};
        const float x = float(wo.x + wi.x), y = float(wo.y + wi.y), z = float(wo.z + wi.z);
        const float cosine = 0.5f * std::sqrt(x * x + y * y + z * z); // |wo + wi| = 2 wo.wm
        for (int i = 0; i < NSpectrumSamples && k && value > 0; ++i)
            colour[i] *= vndf_fresnel_conductor(std::fmin(cosine, 1.0f), float(eta[i]), float(k[i]));
        return colour;
    }

    const VndfMaterials *materials = nullptr;
    vndf_roughness rough = {1, 1, 1, 0};
    SampledSpectrum eta, k;
};

} // namespace pbrt

#endif
