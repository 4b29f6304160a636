/* See lanes_axes.h. The scalar calls (affine.c) use the same sources. Lanes past the end of a block work on numbers
 * that are in memory, and nobody reads what they make of them. */
#include "sampler/affine/lanes_axes.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include "sampler/affine/areas.h"
#  include "sampler/affine/lanes_list.h"
#  include "sampler/affine/principal.h"
#  include "sampler/batch/density_of.h"

#  if VNDF_LANES == 16
#    define NAMED(call) call##_avx512
#  else
#    define NAMED(call) call##_avx2
#  endif

VNDF_INLINE vndf_principal axes_at(const vndf_map_inputs *in, uint32_t i)
{
    vndf_slope_map map = {doubles_load(in->of[VNDF_MAP_XX] + i),     doubles_load(in->of[VNDF_MAP_XY] + i),
                          doubles_load(in->of[VNDF_MAP_YX] + i),     doubles_load(in->of[VNDF_MAP_YY] + i),
                          doubles_load(in->of[VNDF_MAP_MEAN_X] + i), doubles_load(in->of[VNDF_MAP_MEAN_Y] + i)};
    return vndf_principal_of(&map);
}

VNDF_INLINE vndf_principal stored_axes(const vndf_axes_block *at, uint32_t i)
{
    vndf_principal p;
    p.ax = doubles_narrow(doubles_load(at->ax + i));
    p.ay = doubles_narrow(doubles_load(at->ay + i));
    p.cosine = doubles_load_long(at->cosine + i);
    p.sine = doubles_load_long(at->sine + i);
    p.mean_x = doubles_load_long(at->mean_x + i);
    p.mean_y = doubles_load_long(at->mean_y + i);
    p.straight = vndf_principal_is_straight(&p);
    return p;
}

VNDF_INLINE vndf_normal wi_at(const vndf_map_inputs *in, uint32_t i)
{
    vndf_normal wi = {doubles_load(in->of[VNDF_MAP_WI_X] + i), doubles_load(in->of[VNDF_MAP_WI_Y] + i),
                      doubles_load(in->of[VNDF_MAP_WI_Z] + i)};
    return wi;
}

/* ---- to the axes ---- */

VNDF_INLINE void store_direction(const vndf_principal *p, const vndf_map_inputs *in, uint32_t i,
                                 vndf_axes_block *to)
{
    vndf_normal wi = wi_at(in, i);
    vndf_toward w = vndf_principal_toward(p, wi.x, wi.y, wi.z);
    doubles_store_f(to->x + i, doubles_narrow(w.x));
    doubles_store_f(to->y + i, doubles_narrow(w.y));
    doubles_store_f(to->z + i, doubles_narrow(w.z));
    doubles_store_long(to->factor + i, w.factor);
}

void NAMED(vndf_axes)(const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to)
{
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        vndf_principal p = axes_at(in, i);
        doubles_store_f(to->ax + i, p.ax);
        doubles_store_f(to->ay + i, p.ay);
        doubles_store_long(to->cosine + i, p.cosine);
        doubles_store_long(to->sine + i, p.sine);
        doubles_store_long(to->mean_x + i, p.mean_x);
        doubles_store_long(to->mean_y + i, p.mean_y);
        store_direction(&p, in, i, to);
    }
}

void NAMED(vndf_axes_turn)(const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to)
{
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        vndf_principal p = stored_axes(to, i);
        store_direction(&p, in, i, to);
    }
}

void NAMED(vndf_axes_areas)(const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at,
                            uint32_t count, vndf_areas_block *to)
{
    double scale = vndf_unit_scale(d);
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        vndf_principal p = stored_axes(at, i);
        vndf_normal wi = wi_at(in, i);
        vndf_toward w = vndf_principal_toward(&p, wi.x, wi.y, wi.z);
        doubles ax = doubles_widen(p.ax) * scale, ay = doubles_widen(p.ay) * scale;
        vndf_direction rounded = {ax, ay, doubles_load(at->x + i), doubles_load(at->y + i),
                                  doubles_load(at->z + i)};
        doubles_m valid = vndf_direction_is_valid(&rounded);
        vndf_areas areas = vndf_areas_of(d, ax, ay, &w, valid);
        doubles_store_long(to->toward + i, doubles_pick(valid, areas.toward, doubles_set(-1.0)));
        doubles_store_long(to->away + i, areas.away);
        doubles_store_long(to->up + i, areas.up);
    }
}

/* ---- normals ---- */

VNDF_INLINE doubles_f pick_f(doubles_m m, doubles_f yes, doubles no)
{
    return doubles_narrow(doubles_pick(m, doubles_widen(yes), no));
}

void NAMED(vndf_axes_real)(const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at,
                           uint32_t count, vndf_real_block *real)
{
    double scale = vndf_unit_scale(d);
    real->lost.count = real->slow.count = 0;
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        vndf_principal p = stored_axes(at, i);
        vndf_direction of = {doubles_widen(p.ax) * scale, doubles_widen(p.ay) * scale, doubles_load(at->x + i),
                             doubles_load(at->y + i), doubles_load(at->z + i)};
        vndf_normal n = {doubles_load(real->x + i), doubles_load(real->y + i), doubles_load(real->z + i)};
        doubles density = doubles_load(real->density + i);
        vndf_affine_drawn drawn = vndf_principal_drawn(d, &p, &of, wi_at(in, i), n, density);
        doubles_m turned = doubles_without(doubles_at_most(n.z, n.z), p.straight);
        doubles_m faces = doubles_less(doubles_set(0.0), drawn.facing);
        doubles_store_f(real->x + i, pick_f(turned, drawn.x, n.x));
        doubles_store_f(real->y + i, pick_f(turned, drawn.y, n.y));
        doubles_store_f(real->z + i, pick_f(turned, drawn.z, n.z));
        doubles_store_f(real->density + i, pick_f(turned, vndf_positive_of(drawn.density), density));
        doubles_m slow = doubles_without(doubles_both(turned, faces), drawn.trusted);
        vndf_list_add_few(&real->lost, doubles_without(turned, faces), i, count);
        vndf_list_add_few(&real->slow, slow, i, count);
    }
}

void NAMED(vndf_axes_seen)(const vndf_map_inputs *in, const vndf_axes_block *at, uint32_t count,
                           const float *const normal[3], vndf_seen_block *to)
{
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        vndf_principal p = stored_axes(at, i);
        vndf_normal wm = {doubles_load(normal[0] + i), doubles_load(normal[1] + i), doubles_load(normal[2] + i)};
        vndf_normal n = vndf_principal_normal(&p, wm), wi = wi_at(in, i);
        doubles_store_long(to->x + i, n.x);
        doubles_store_long(to->y + i, n.y);
        doubles_store_long(to->z + i, n.z);
        doubles_store_long(to->facing + i, vndf_normal_facing(wi, wm) * doubles_load_long(at->factor + i));
    }
}

#endif
