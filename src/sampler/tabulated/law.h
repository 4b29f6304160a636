/* The answers of a table to sampler/law.h; its area is in area.h, its samples and densities are in theory.h. */
#ifndef VNDF_SAMPLER_TABULATED_LAW_H
#define VNDF_SAMPLER_TABULATED_LAW_H

#include "sampler/tabulated/density.h"
#include "sampler/tabulated/theory.h"
#include "sampler/tabulated/view.h"

/* ---- for one or for lanes ---- */

/* D of a valid normal. */
VNDF_INLINE doubles vndf_table_ndf(const vndf_distribution *d, const vndf_query *g)
{
    vndf_bare n = vndf_bare_of(g);
    return vndf_query_ndf(d, &n);
}

/* Dv for a valid query with wi . wm = facing > 0. */
VNDF_INLINE doubles vndf_table_visible(const vndf_distribution *d, const vndf_query *g, doubles facing)
{
    const doubles nothing = doubles_set(0.0);
    doubles across = vndf_direction_across(&g->wi), up = doubles_abs(g->wi.z);
    doubles below = vndf_area_below_table(d, across, up, vndf_direction_is_valid(&g->wi));
    doubles area = below + doubles_positive(g->wi.z);
    return doubles_pick(doubles_less(nothing, area), vndf_table_ndf(d, g) / area * facing, nothing);
}

/* Whether the density survives the rounding of an affine surface's normal. */
VNDF_INLINE doubles_m vndf_table_trusts_rounding(const vndf_distribution *d, const vndf_rounding *r)
{
    double s = d->steepness > VNDF_TRUST_AFFINE_STEEP ? d->steepness : VNDF_TRUST_AFFINE_STEEP;
    double fold = d->fold_steepness > VNDF_TRUST_AFFINE_STEEP ? d->fold_steepness : VNDF_TRUST_AFFINE_STEEP;
    double most = fold < (double)VNDF_STEEP_RADIUS ? fold : (double)VNDF_STEEP_RADIUS, ratio = s / most;
    doubles_m away = doubles_less(d->steep_from * d->steep_from * r->up, r->across);
    doubles up = doubles_pick(away, r->up, doubles_set(0.0));
    doubles below = (up + ratio * ratio * r->across) * r->least;
    doubles_m turns = doubles_both(vndf_trusts_affine_side(r), vndf_trusts_affine_pole(r));
    return doubles_both(vndf_trusts_affine_change(s * s * r->slope * r->up, below), turns);
}

/* A(w) for a unit w = (wx, wy, wz), wz > 0; relative error below 2e-6. Where *trusted is 0 the caller computes it in
 * double. */
VNDF_INLINE lanes_f vndf_table_area_above(const vndf_distribution *d, lanes_f ax, lanes_f ay, lanes_f wx,
                                          lanes_f wy, lanes_f wz, lanes_m *trusted)
{
    lanes_f x = ax * wx, y = ay * wy, across2 = x * x + y * y, across = lanes_root(across2), sum = across + wz;
    *trusted = vndf_trusts_direction(across2, wz, sum);
    if (!lanes_any(*trusted))
        return lanes_set(0.0f);
    lanes_f per = 1.0f / sum, s = across * per, c = lanes_pick(*trusted, wz * per, lanes_set(0.5f)), per_width;
    lanes_f area = 2.0f * (vndf_front_mass(vndf_front_of(d, s, c)) + vndf_wedge_quick(&d->above, c, &per_width));
    *trusted = lanes_both(*trusted, vndf_trusts_area_piece(per_width));
    return area * sum;
}

/* The area of a view (vndf_table_view_area) from roughness times scale and its direction. Clears *trusted where a view
 * is not made in float. */
VNDF_INLINE lanes_f vndf_table_seen_area(const vndf_distribution *d, lanes_f ax, lanes_f ay, lanes_f wx,
                                         lanes_f wy, lanes_f wz, lanes_m *trusted)
{
    lanes_f x = ax * wx, y = ay * wy;
    vndf_stretched_view stretched = vndf_stretched_view_at(d, x, y, wz, trusted);
    *trusted = lanes_both(*trusted, vndf_trusts_scale(ax, ay, stretched.c));
    return stretched.area * (lanes_root(x * x + y * y) + wz);
}

#if VNDF_LANES == 1

/* P22 at the squared slope length r2. */
VNDF_INLINE double vndf_table_p22(const vndf_distribution *d, double r2)
{
    double r = sqrt(r2), z = 1.0 / (1.0 + r);
    return vndf_engine_p22_over_z4(d, r * z, z) * (z * z) * (z * z);
}

/* The same for a view's own direction, for any roughness, from numbers in the view. */
VNDF_INLINE float vndf_table_view_area(const vndf_view *view)
{
    float x = view->ax * view->wi.x, y = view->ay * view->wi.y;
    return view->of.table.area * (sqrtf(x * x + y * y) + view->wi.z);
}

/* vndf_invert of a valid view, wm.z >= 0; view.c. */
void vndf_table_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2);

#endif
#endif
