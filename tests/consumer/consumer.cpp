// A program of somebody else in C++: the same checks as consumer.c, with owners that free.
#include <cmath>
#include <cstdio>
#include <memory>

#include <vndf.h>
#include <vndf_build.h>

int main()
{
    const vndf_surface surface = {vndf_ggx(), 1.0f, 1.0f};
    const vndf_view view = vndf_view_from(&surface, vndf_vec3{0.0f, 0.0f, 1.0f});
    float pdf = 0.0f;
    const vndf_vec3 wm = vndf_sample(&view, 0.25f, 0.5f, &pdf);
    const double difference = static_cast<double>(pdf) - static_cast<double>(wm.z) / 3.14159265358979;
    const std::unique_ptr<vndf_source, decltype(&vndf_source_free)> source(
        vndf_source_slope_expression("exp(-r)", nullptr, 0, nullptr), vndf_source_free);
    const double p22 = source ? vndf_source_p22(source.get(), 0.0) : 0.0;

    std::printf("vndf %s: %.6f %.6f %.6f pdf %.6f\n", VNDF_VERSION, static_cast<double>(wm.x),
                static_cast<double>(wm.y), static_cast<double>(wm.z), static_cast<double>(pdf));
    return !(std::fabs(difference) < 1e-6 && std::fabs(p22 - 1.0) < 1e-6);
}
