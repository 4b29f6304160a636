#include "sampler/frame.h"

/* Turns by about one unit in the last place of the unit problem, where the lobe is wide: in the real problem such a
 * step would leave a narrow lobe. Where even that fails, for wi within rounding of straight down, the result is the
 * horizontal normal towards wi. */
vndf_vec3 vndf_turn_to_face(const vndf_frame *f, vndf_vec3 wm)
{
    vndf_vec3 n = vndf_normalize(vndf_to_unit(f, wm));
    for (float step = 1.2e-7f; step < 1e-5f && !(vndf_exact_dot(f->wi, wm) > 0.0); step *= 4.0f) {
        vndf_vec3 moved = {n.x + step * f->s, n.y, n.z + step * f->c};
        moved.z = moved.z > 0.0f ? moved.z : 0.0f;
        wm = vndf_normalize(vndf_from_unit(f, moved));
    }
    if (vndf_exact_dot(f->wi, wm) > 0.0 || (f->wi.x == 0.0f && f->wi.y == 0.0f))
        return wm;
    vndf_vec3 level = {f->wi.x, f->wi.y, 0.0f};
    return vndf_normalize(level);
}
