/* Bounded visible normals of GGX: in float where that does (bounded_ggx_draw.h), else in double (bounded_ggx.c). */
#include "sampler/bounded_ggx_draw.h"

/* Of a direction that is not plain no more is read than the laws. */
void vndf_bounds_ggx(vndf_view *view, double bounds[VNDF_BOUNDS])
{
    if (view->plain) {
        vndf_outlook_set(view);
        vndf_outlook o = vndf_outlook_of(view);
        if (vndf_outlook_is_plain(view, &o)) {
            vndf_bounds_ggx_plain(&o, bounds);
            return;
        }
    }
    vndf_bounds_ggx_carefully(view, bounds);
}

vndf_bounded vndf_bounded_ggx(const vndf_view *view, const double bounds[VNDF_BOUNDS], float u1, float u2)
{
    vndf_outlook o = vndf_outlook_of(view);
    if (!vndf_outlook_is_plain(view, &o))
        return vndf_bounded_ggx_carefully(view, bounds, u1, u2);
    vndf_ggx_bounded n = vndf_ggx_draw_bounded(view, &o, bounds, u1, u2);
    if (!vndf_ggx_is_inside(&o, &n) || !vndf_ggx_is_settled(&o, &n, 1.0f))
        return vndf_bounded_ggx_carefully(view, bounds, u1, u2);
    float length = sqrtf(n.length2), per = 1.0f / length;
    float density = n.length2 * length * n.cosine / (3.14159265f * view->spread * n.kept);
    vndf_bounded b = {vndf_vec3_of(n.x * per, n.y * per, n.z * per), density, n.kept};
    return b;
}
