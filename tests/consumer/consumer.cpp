// A program of somebody else in C++17, by vndf.hpp, which includes the headers of C: the checks of consumer.c, and a
// shipped table of the folder in the argument.
#include <cmath>
#include <cstdio>
#include <string>

#include <vndf.hpp>

int main(int argc, char **argv)
{
    const vndf_surface surface = {vndf_ggx(), 1.0f, 1.0f};
    const auto [wm, pdf] = vndf::sample(vndf_view_from(&surface, {0.0f, 0.0f, 1.0f}), 0.25f, 0.5f);
    const double difference = static_cast<double>(pdf) - static_cast<double>(wm.z) / 3.14159265358979;
    const auto source = vndf::slope_expression("exp(-r)");
    const auto table = vndf::load(std::string(argc > 1 ? argv[1] : "") + "/student-t-2.5.vndf");
    if (!table)
        std::puts(table.message());
    std::printf("vndf %s: %.6f %.6f %.6f pdf %.6f\n", vndf_version(), static_cast<double>(wm.x),
                static_cast<double>(wm.y), static_cast<double>(wm.z), static_cast<double>(pdf));
    return !(table && std::fabs(difference) < 1e-6 && std::fabs(vndf_source_p22(*source, 0.0) - 1.0) < 1e-6);
}
