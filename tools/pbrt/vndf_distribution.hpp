// vndf_distribution.hpp - any distribution of normals in the place of pbrt-v4's TrowbridgeReitzDistribution, with its
// methods, for builds of pbrt without GPU: ConductorBxDF, DielectricBxDF and the layered BxDFs keep their optics.
//
// What to copy, and what to change in pbrt's src/pbrt:
//
//   this file        next to util/scattering.h
//   bxdfs.h          VndfDistribution for TrowbridgeReitzDistribution, in the BxDFs that are to have it
//   materials.h      a material loads a table (vndf_load) when it is made, and gives the BxDF
//                    VndfDistribution(table, alpha_x, alpha_y); without a table it is GGX, as before
//   CMakeLists.txt   find_package(vndf), and vndf::vndf among the libraries of pbrt_lib
//
// Normals wm have z > 0. Directions w may be on either side: one below is turned up through the origin, as pbrt does.
// Values take the true D, PDF is what the table draws with, so estimates are exact for a table of any size.
#ifndef VNDF_DISTRIBUTION_HPP
#define VNDF_DISTRIBUTION_HPP

#include <algorithm>
#include <cmath>
#include <string>

#include <pbrt/util/vecmath.h>

#include "vndf.h"

namespace pbrt
{

class VndfDistribution
{
  public:
    VndfDistribution() : VndfDistribution(vndf_ggx(), 1, 1)
    {
    }
    VndfDistribution(Float alpha_x, Float alpha_y) : VndfDistribution(vndf_ggx(), alpha_x, alpha_y)
    {
    }
    // The table has to outlive this. Roughness below 1e-4 is a mirror to EffectivelySmooth.
    VndfDistribution(const vndf_distribution *table, Float alpha_x, Float alpha_y)
        : surface(vndf_rough(table, std::max(float(alpha_x), 1e-4f), std::max(float(alpha_y), 1e-4f)))
    {
    }

    Float D(Vector3f wm) const
    {
        return vndf_ndf(&surface, Up(wm));
    }
    bool EffectivelySmooth() const
    {
        return std::max(surface.xx, surface.yy) < 1e-3f;
    }
    Float G1(Vector3f w) const
    {
        return vndf_g1(&surface, Up(w));
    }
    Float Lambda(Vector3f w) const
    {
        return vndf_lambda(&surface, Up(w));
    }
    Float G(Vector3f wo, Vector3f wi) const
    {
        return 1 / (1 + Lambda(wo) + Lambda(wi));
    }

    // The density of visible normals, and that of Sample_wm: the same but for what the table is off.
    Float D(Vector3f w, Vector3f wm) const
    {
        const vndf_view view = vndf_view_from(&surface, Up(w));
        return vndf_visible(&view, Up(wm));
    }
    Float PDF(Vector3f w, Vector3f wm) const
    {
        const vndf_view view = vndf_view_from(&surface, Up(w));
        return vndf_pdf(&view, Up(wm));
    }
    Vector3f Sample_wm(Vector3f w, Point2f u) const
    {
        const vndf_view view = vndf_view_from(&surface, Up(w));
        const vndf_vec3 wm = vndf_sample(&view, float(u.x), float(u.y), nullptr);
        return {wm.x, wm.y, wm.z};
    }

    static Float RoughnessToAlpha(Float x)
    {
        return std::sqrt(x);
    }
    void Regularize()
    {
        for (float *alpha : {&surface.xx, &surface.yy})
            *alpha = *alpha < 0.3f ? std::clamp(2 * *alpha, 0.1f, 0.3f) : *alpha;
    }
    std::string ToString() const
    {
        return "[ VndfDistribution alpha_x: " + std::to_string(surface.xx) +
               " alpha_y: " + std::to_string(surface.yy) + " ]";
    }

  private:
    static vndf_vec3 Up(Vector3f w)
    {
        const Float sign = w.z < 0 ? -1 : 1;
        return {float(sign * w.x), float(sign * w.y), float(sign * w.z)};
    }

    vndf_surface surface;
};

} // namespace pbrt

#endif
