/* Bounded visible normals of GGX: in float where that is trusted (ggx_draw.h), else in double (ggx.c). */
#include "sampler/bounded/ggx_draw.h"

void vndf_bound_ggx(const vndf_view *view, struct vndf_ggx_bounds *bounds)
{
    if (view->trusted) {
        vndf_outlook o = vndf_outlook_set(view, bounds);
        if (vndf_outlook_is_trusted(view, &o)) {
            vndf_ggx_law_set(bounds, &o);
            return;
        }
    }
    vndf_bound_ggx_exactly(view, bounds);
}

vndf_bounded vndf_bounded_ggx(const vndf_view *view, const struct vndf_ggx_bounds *bounds, float u1, float u2)
{
    vndf_outlook o = vndf_outlook_of(view, bounds);
    if (!vndf_outlook_is_trusted(view, &o))
        return vndf_bounded_ggx_exactly(view, bounds, u1, u2);
    vndf_ggx_bounded n = vndf_ggx_draw_bounded(view, bounds, &o, u1, u2);
    if (!vndf_ggx_is_inside(&o, &n) || !vndf_ggx_is_settled(view, &o, &n, 1.0f))
        return vndf_bounded_ggx_exactly(view, bounds, u1, u2);
    float length = sqrtf(n.length2), per = 1.0f / length; /* spread: 2 pi times the area */
    float density = 2.0f * n.length2 * length * n.cosine / (view->of.ggx.spread * n.inside_mass);
    vndf_bounded b = {vndf_vec3_of(n.x * per, n.y * per, n.z * per), density, n.inside_mass, 0.0f};
    return b;
}
