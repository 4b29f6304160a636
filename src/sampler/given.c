#include "sampler/given.h"

#include "sampler/surface.h"

static vndf_vec3 rounded(vndf_normal n)
{
    vndf_vec3 wm = {(float)n.x, (float)n.y, (float)n.z};
    return wm;
}

double vndf_pdf_of(const vndf_view *view, vndf_normal wm, double facing)
{
    vndf_stretched w = vndf_stretched_of(view);
    if (view->distribution->kind == VNDF_KIND_GGX)
        return vndf_ggx_visible(view, &w, wm, facing);
    if (view->distribution->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_visible(view, &w, wm, facing);
    return vndf_pdf(view, rounded(wm));
}

double vndf_ndf_of(const vndf_distribution *d, double ax, double ay, vndf_normal wm)
{
    if (d->kind == VNDF_KIND_GGX)
        return vndf_ggx_ndf(ax, ay, wm);
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_ndf(ax, ay, wm);
    return vndf_ndf_scaled(d, ax, ay, rounded(wm));
}
