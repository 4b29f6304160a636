/* What drawing wants of a direction of incidence, in float: the stretched direction (s, 0, c), s + |c| = 1 for
 * tables, its azimuth, and the masses of half a turn. Densities of given normals start from wi itself (exact.c).
 *
 * Here for directions above the horizon of plain size, in a dozen roundings: s, c, cos_phi and sin_phi within
 * 4e-7, masses within 1e-6. view.c makes the others from doubles. */
#ifndef VNDF_SAMPLER_TABULATED_AIM_H
#define VNDF_SAMPLER_TABULATED_AIM_H

#include "sampler/tabulated/front.h"
#include "sampler/tabulated/wedge.h"

typedef struct vndf_aim {
    lanes_f s, c, cos_phi, sin_phi;
    lanes_f front, wedge; /* masses; below the horizon 0 and 1 */
    lanes_f area;         /* of the unit problem */
} vndf_aim;

/* From the stretched direction (x, y, z), as far as *ready stays: elsewhere this is not good enough. Masses are to
 * come. */
VNDF_INLINE vndf_aim vndf_aim_towards(lanes_f x, lanes_f y, lanes_f z, lanes_m *ready)
{
    lanes_f across2 = x * x + y * y, across = lanes_root(across2), sum = across + z, none = lanes_set(0.0f);
    lanes_f per = 1.0f / (across * sum); /* of both at once */
    *ready = lanes_both(*ready, vndf_trusts_direction(across2, z, sum));
    lanes_f s = across2 * per, c = lanes_pick(*ready, z * (across * per), lanes_set(0.5f)); /* to be looked up */
    vndf_aim aim = {s, c, x * (sum * per), y * (sum * per), none, none, none};
    return aim;
}

VNDF_INLINE void vndf_aim_weigh(const vndf_distribution *d, vndf_aim *aim, lanes_m *ready)
{
    lanes_f per_width;
    aim->front = vndf_front_mass(vndf_front_of(d, aim->s, aim->c));
    aim->wedge = vndf_wedge_quick(&d->above, aim->c, &per_width);
    aim->area = 2.0f * (aim->front + aim->wedge);
    *ready = lanes_both(*ready, vndf_trusts_area_piece(per_width));
}

VNDF_INLINE vndf_aim vndf_aim_at(const vndf_distribution *d, lanes_f x, lanes_f y, lanes_f z, lanes_m *ready)
{
    vndf_aim aim = vndf_aim_towards(x, y, z, ready);
    vndf_aim_weigh(d, &aim, ready);
    return aim;
}

#endif
