#include "sampler/frame.h"

/* By about one unit in the last place; where even that fails (wi within rounding of straight down) the
 * horizontal normal towards wi is taken. */
vndf_vec3 vndf_turn_to_face(const vndf_view *view, vndf_vec3 wm)
{
    for (float step = 1.2e-7f; step < 1e-5f && !(vndf_exact_dot(view->wi, wm) > 0.0); step *= 4.0f) {
        vndf_vec3 moved = {wm.x + step * view->wi.x, wm.y + step * view->wi.y, wm.z + step * view->wi.z};
        moved.z = moved.z > 0.0f ? moved.z : 0.0f;
        wm = vndf_normalize(moved);
    }
    if (vndf_exact_dot(view->wi, wm) > 0.0 || (view->wi.x == 0.0f && view->wi.y == 0.0f))
        return wm;
    vndf_vec3 level = {view->wi.x, view->wi.y, 0.0f};
    return vndf_normalize(level);
}
