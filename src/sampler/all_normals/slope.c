#include "sampler/all_normals/slope.h"

#include "sampler/tabulated/exact.h"

/* The law of each azimuth at normal incidence. */
static vndf_azimuth_slice law_of(const vndf_distribution *d)
{
    const double per_turn = 0.15915494309189534;
    vndf_azimuth_slice law = {d, 1.0, 0.0, per_turn, d->f0_total, 0.0, d->radial_count};
    return law;
}

vndf_slope vndf_table_slope_exactly(const vndf_distribution *d, float u)
{
    vndf_azimuth_slice law = law_of(d);
    uint32_t cell;
    vndf_exact_slope at = vndf_exact_law_draw(&law, u, &cell);
    double per = 1.0 / (at.x + at.z);
    vndf_slope r = {(float)(at.x * per), (float)(at.z * per), 0.0f, 0};
    return r;
}

double vndf_table_pdf_all(const vndf_distribution *d, double ax, double ay, vndf_normal wm)
{
    vndf_azimuth_slice law = law_of(d);
    double mx = wm.x / ax, my = wm.y / ay, x = sqrt(mx * mx + my * my), scale = 1.0 / (x + wm.z), z = wm.z * scale;
    return vndf_azimuth_slice_density(&law, x * scale, z, z) * (scale / ax) * (scale / ay) * scale;
}
