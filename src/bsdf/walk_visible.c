#include "bsdf/walk_visible.h"

#include "sampler/engine.h"

/* D(wm) facing per_length/area: P22/Z^4 at X + Z = 1, times per^4/(ax ay). */
static double visible_of_table(const vndf_view *view, const vndf_stretched *w, vndf_normal wm, double facing)
{
    if (!(view->area > 0.0f))
        return 0.0; /* it has underflowed, far below the horizon */
    double ax = view->alpha_x, ay = view->alpha_y, mx = wm.x / ax, my = wm.y / ay;
    double x = sqrt(mx * mx + my * my), per = 1.0 / (x + wm.z);
    double p22 = vndf_engine_p22_over_z4(view->distribution, x * per, wm.z * per);
    return p22 * (per / ax) * (per / ay) * per * per * (facing * w->per_length) / view->area;
}

double vndf_walk_visible(const vndf_view *view, vndf_normal wm, double facing)
{
    if (!(wm.z >= 0.0) || !(facing > 0.0))
        return 0.0;
    vndf_stretched w = vndf_stretched_of(view);
    if (view->distribution->kind == VNDF_KIND_GGX)
        return vndf_ggx_visible(view, &w, wm, facing);
    if (view->distribution->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_visible(view, &w, wm, facing);
    return visible_of_table(view, &w, wm, facing);
}
