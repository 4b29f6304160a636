#include "sampler/analytic/view.h"

#include "sampler/surface.h"

VNDF_INLINE void put(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    double ax = 0.0, ay = 0.0;
    int valid = vndf_surface_scaled(surface, &ax, &ay) && vndf_is_usable_direction(wi);
    view->distribution = valid ? surface->distribution : NULL;
    view->wi = wi;
    view->alpha_x = ax;
    view->alpha_y = ay;
    view->ax = surface->alpha_x;
    view->ay = surface->alpha_y;
    view->trusted = 0;
}

vndf_view vndf_analytic_view_exactly(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view;
    put(&view, surface, wi);
    return view;
}

void vndf_analytic_view_set_exactly(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    put(view, surface, wi);
}

/* Below the horizon: wm.z is above `highest`, where wi sees nothing, by a few roundings of its own. It is lowered,
 * or where that would show in the length, what is across raised: a step that is small only beside 1 would leave
 * the lobe of a Beckmann. */
static vndf_vec3 turn_below(vndf_vec3 wi, vndf_vec3 wm, double highest)
{
    double factor = wm.z / highest * (1.0 + 0x1.8p-23);
    vndf_vec3 wide = {(float)(wm.x * factor), (float)(wm.y * factor), wm.z};
    if (wm.z > 0.75f && factor > 1.0 + 0x1.8p-22 && vndf_exact_dot(wi, wide) > 0.0)
        return wide;
    wm.z = fminf(wm.z, (float)(highest * (1.0 - 0x1p-23)));
    return wm;
}

vndf_vec3 vndf_analytic_turned_back(const vndf_frame *f, vndf_vec3 wm)
{
    double level = (double)f->wi.x * wm.x + (double)f->wi.y * wm.y, highest = level / -(double)f->wi.z;
    if (f->wi.z < 0.0f && highest > wm.z * (1.0 - 0x1p-21))
        wm = turn_below(f->wi, wm, highest);
    return vndf_exact_dot(f->wi, wm) > 0.0 ? wm : vndf_turn_to_face(f, wm);
}
