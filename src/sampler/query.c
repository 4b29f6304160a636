#include "sampler/query.h"

#include "sampler/law.h"

static vndf_query given_from(double ax, double ay, vndf_vec3 wi, vndf_normal wm)
{
    vndf_query g = {{ax, ay, wi.x, wi.y, wi.z}, wm.x, wm.y, wm.z};
    return g;
}

double vndf_normal_pdf(const vndf_view *view, vndf_normal wm)
{
    vndf_query g = given_from(view->alpha_x, view->alpha_y, view->wi, wm);
    return vndf_law_density(view, &g);
}

double vndf_normal_visible(const vndf_view *view, vndf_normal wm, double facing)
{
    vndf_query g = given_from(view->alpha_x, view->alpha_y, view->wi, wm);
    return vndf_law_visible(view->distribution, &g, facing);
}

double vndf_normal_ndf(const vndf_distribution *d, double ax, double ay, vndf_normal wm)
{
    vndf_vec3 none = {0.0f, 0.0f, 0.0f};
    vndf_query g = given_from(ax, ay, none, wm);
    return vndf_law_ndf(d, &g);
}
