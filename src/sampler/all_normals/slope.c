#include "sampler/all_normals/slope.h"

#include "sampler/tabulated/radial_draw.h"
#include "sampler/tabulated/theory.h"

vndf_slope vndf_table_slope_exactly(const vndf_distribution *d, float u)
{
    vndf_radius at = vndf_radial_draw_whole(d, 1.0f, 0.0f, u).at;
    vndf_radial_lanes cell = vndf_radial_load(d, at.cell);
    vndf_slope r = {at.eta * cell.x0 + at.xi * cell.x1, at.eta * cell.z0 + at.xi * cell.z1, 0.0f, 0};
    return r;
}

double vndf_table_pdf_all(const vndf_distribution *d, double ax, double ay, vndf_normal wm)
{
    const double per_turn = 0.15915494309189534;
    vndf_azimuth_slice slice = {d, 1.0, 0.0, per_turn, d->f0_total, 0.0, d->radial_count};
    double mx = wm.x / ax, my = wm.y / ay, x = sqrt(mx * mx + my * my), scale = 1.0 / (x + wm.z), z = wm.z * scale;
    return vndf_azimuth_slice_density(&slice, x * scale, z, z) * (scale / ax) * (scale / ay) * scale;
}
