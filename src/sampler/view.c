/* The public calls on a view: what they promise for any input; the law of the distribution does the rest. */
#include "math/vector.h"
#include "sampler/frame.h"
#include "sampler/law.h"
#include "sampler/surface.h"

vndf_view vndf_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    return vndf_law_view_scaled(d, ax, ay, wi);
}

void vndf_view_turn(vndf_view *view, vndf_vec3 wi)
{
    vndf_law_view_turn(view, wi);
}

void vndf_view_bare(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    view->distribution = NULL;
    view->wi.x = wi.x;
    view->wi.y = wi.y;
    view->wi.z = wi.z;
    if (vndf_surface_scaled(surface, &view->alpha_x, &view->alpha_y) && vndf_is_usable_direction(wi))
        view->distribution = surface->distribution;
}

vndf_view vndf_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    if (!surface || !surface->distribution)
        return vndf_invalid_view();
    return vndf_law_view(surface, wi);
}

void vndf_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_law_view_set(view, surface, wi);
}

vndf_vec3 vndf_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf)
{
    return vndf_law_sample_exactly(view, vndf_clamp_unit(u1), vndf_clamp_unit(u2), pdf);
}

vndf_vec3 vndf_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (!view->distribution) {
        vndf_vec3 up = {0.0f, 0.0f, 1.0f};
        if (pdf)
            *pdf = 0.0f;
        return up;
    }
    return vndf_law_sample(view, u1, u2, pdf);
}

/* Above the horizon with the area that the draw divided by, as where the draw has told the weight. Below it that is a
 * float which may underflow. */
float vndf_weight_of(const vndf_view *view, vndf_vec3 wm, float pdf)
{
    const vndf_distribution *d = view->distribution;
    double facing = vndf_exact_dot(view->wi, wm);
    vndf_query g = vndf_query_of(view, wm);
    int ready;
    if (!(pdf > 0.0f && facing > 0.0))
        return 0.0f;
    double visible = view->wi.z > 0.0f ? vndf_law_ndf(d, &g) * facing / (double)vndf_law_view_area(view, &ready)
                                       : vndf_law_visible(d, &g, facing);
    return vndf_density_from(visible / (double)pdf);
}

vndf_vec3 vndf_sample_weight(const vndf_view *view, float u1, float u2, float *pdf, float *weight)
{
    float density = 0.0f;
    vndf_vec3 wm = {0.0f, 0.0f, 1.0f};
    *weight = 0.0f;
    if (view->distribution) {
        wm = vndf_law_sample_weight(view, vndf_clamp_unit(u1), vndf_clamp_unit(u2), &density, weight);
        if (!(*weight > 0.0f) || !(density > 0.0f))
            *weight = vndf_weight_of(view, wm, density);
    }
    if (pdf)
        *pdf = density;
    return wm;
}

float vndf_pdf(const vndf_view *view, vndf_vec3 wm)
{
    return vndf_is_facing(view, wm) ? vndf_law_pdf(view, wm) : 0.0f;
}

void vndf_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    *u1 = *u2 = 0.0f;
    if (!view->distribution || !(wm.z >= 0.0f) || !vndf_is_usable_direction(wm))
        return;
    vndf_law_invert(view, wm, u1, u2);
}

float vndf_visible(const vndf_view *view, vndf_vec3 wm)
{
    if (!vndf_is_facing(view, wm))
        return 0.0f;
    const vndf_distribution *d = view->distribution;
    vndf_query g = vndf_query_of(view, wm);
    float visible = vndf_density_from(vndf_law_visible(d, &g, vndf_exact_dot(view->wi, wm)));
    return vndf_law_is_exact(d) ? vndf_positive(visible) : visible;
}
