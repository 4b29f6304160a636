/* The law of normals behind a distribution: every question, answered by each kind. The kinds are told apart here and
 * nowhere else: other sources ask the law, and do not look at its kind.
 *
 * A kind answers in files of its own: tabulated/law.h, analytic/ggx_law.h, analytic/beckmann_law.h, and beside them its
 * bounded normals (bounded/) and its blocks of a batch (batch/). A new kind adds such files, its view and bounds to
 * vndf.h, its name to vndf_kind (table/table.h) and its distribution to law.c; the compiler then names each switch
 * below that does not know it, as no switch has a default.
 *
 * Switches are inline: a call would be a tenth of what GGX costs, and lanes are compiled once for each instruction
 * set. */
#ifndef VNDF_SAMPLER_LAW_H
#define VNDF_SAMPLER_LAW_H

#include "sampler/analytic/beckmann_law.h"
#include "sampler/analytic/ggx_law.h"
#include "sampler/bounded/beckmann.h"
#include "sampler/bounded/ggx.h"
#include "sampler/bounded/table.h"
#include "sampler/stretch.h"
#include "sampler/surface.h"
#include "sampler/tabulated/law.h"
#if VNDF_LANES > 1
#  include "sampler/batch/analytic.h"
#  include "sampler/batch/inverse.h"
#  include "sampler/batch/tabulated.h"
#endif
#if !defined(__GNUC__)
#  include <stdlib.h>
#endif

/* After a switch that returns for each kind. */
#if defined(__GNUC__)
#  define VNDF_NO_OTHER_KIND() __builtin_unreachable()
#else
#  define VNDF_NO_OTHER_KIND() abort()
#endif

/* ---- for one or for lanes ---- */

/* Whether vndf_sample draws with Dv itself: D need not be asked again for a weight. */
VNDF_INLINE int vndf_law_is_exact(const vndf_distribution *d)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return 0;
    case VNDF_KIND_GGX: return 1;
    case VNDF_KIND_BECKMANN: return 1;
    }
    VNDF_NO_OTHER_KIND();
}

/* A(-|w|), times the length of w. */
VNDF_INLINE doubles vndf_law_area_below(const vndf_distribution *d, const vndf_direction *w, doubles_m valid)
{
    doubles across = vndf_direction_across(w), up = doubles_abs(w->z);
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_area_below_table(d, across, up, valid);
    case VNDF_KIND_GGX: return vndf_ggx_area_below(across, up);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_area_below(across, up);
    }
    VNDF_NO_OTHER_KIND();
}

/* Roughness in range, and a normal above the surface whose square is a float that is not 0. */
VNDF_INLINE doubles_m vndf_normal_is_valid(const vndf_query *g)
{
    const doubles least = doubles_set(1e-18), most = doubles_set(1e18);
    doubles square = g->x * g->x + g->y * g->y + g->z * g->z;
    doubles_m low = doubles_both(doubles_at_most(least, g->wi.ax), doubles_at_most(least, g->wi.ay));
    doubles_m high = doubles_both(doubles_at_most(g->wi.ax, most), doubles_at_most(g->wi.ay, most));
    doubles_m usable = doubles_both(doubles_at_most(doubles_set(FLT_TRUE_MIN), square),
                                    doubles_less(square, doubles_set(FLT_MAX)));
    return doubles_both(doubles_both(low, high), doubles_both(usable, doubles_at_most(doubles_set(0.0), g->z)));
}

/* D of a valid normal. */
VNDF_INLINE doubles vndf_law_ndf(const vndf_distribution *d, const vndf_query *g)
{
    vndf_normal wm = {g->x, g->y, g->z};
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_ndf(d, g);
    case VNDF_KIND_GGX: return vndf_ggx_ndf(g->wi.ax, g->wi.ay, wm);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_ndf(g->wi.ax, g->wi.ay, wm);
    }
    VNDF_NO_OTHER_KIND();
}

/* Dv for a valid query with wi . wm = facing > 0. */
VNDF_INLINE doubles vndf_law_visible(const vndf_distribution *d, const vndf_query *g, doubles facing)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_visible(d, g, facing);
    case VNDF_KIND_GGX: return vndf_ggx_visible(g, facing);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_visible(g, facing);
    }
    VNDF_NO_OTHER_KIND();
}

/* Whether the density of a sample of an affine surface survives the rounding of its normal (trust.h). P22 changes by
 * 4 u/(1 + u^2) and by 2 u over u; that of a table by two bounds, the lesser of which counts. */
VNDF_INLINE doubles_m vndf_law_trusts_rounding(const vndf_distribution *d, const vndf_rounding *r)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_trusts_rounding(d, r);
    case VNDF_KIND_GGX: {
        doubles sum = r->up + r->across;
        return doubles_both(vndf_trusts_affine_flat(r),
                            vndf_trusts_affine_change(16.0 * r->across * r->up * r->slope, sum * sum * r->least));
    }
    case VNDF_KIND_BECKMANN: {
        doubles_m near = doubles_less(r->across, VNDF_TRUST_AFFINE_BECKMANN * r->up);
        return doubles_both(doubles_both(near, vndf_trusts_affine_flat(r)),
                            vndf_trusts_affine_change(4.0 * r->across * r->slope, r->up * r->least));
    }
    }
    VNDF_NO_OTHER_KIND();
}

/* A(w) for a unit w = (wx, wy, wz), wz > 0, where ax, ay is the roughness times the distribution's scale; relative
 * error below 2e-6. Where *trusted is 0 the caller computes it in double. */
VNDF_INLINE lanes_f vndf_law_area_above(const vndf_distribution *d, lanes_f ax, lanes_f ay, lanes_f wx, lanes_f wy,
                                        lanes_f wz, lanes_m *trusted)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_area_above(d, ax, ay, wx, wy, wz, trusted);
    case VNDF_KIND_GGX: return vndf_ggx_area_above(ax, ay, wx, wy, wz, trusted);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_area_above(ax, ay, wx, wy, wz, trusted);
    }
    VNDF_NO_OTHER_KIND();
}

/* The area of the view of w (vndf_law_view_area). Clears *trusted where float does not make that view; elsewhere the
 * view is valid, and trusted. */
VNDF_INLINE lanes_f vndf_law_seen_area(const vndf_distribution *d, lanes_f ax, lanes_f ay, lanes_f wx, lanes_f wy,
                                       lanes_f wz, lanes_m *trusted)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_seen_area(d, ax, ay, wx, wy, wz, trusted);
    case VNDF_KIND_GGX: return vndf_ggx_seen_area(ax, ay, wx, wy, wz, trusted);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_seen_area(ax, ay, wx, wy, wz, trusted);
    }
    VNDF_NO_OTHER_KIND();
}

/* Whether a unit normal is where hardly any samples are, and the bound of vndf_law_steepness does not hold. */
VNDF_INLINE lanes_m vndf_law_is_steeper(const vndf_distribution *d, lanes_f ax, lanes_f ay, lanes_f x, lanes_f y)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return lanes_none();
    case VNDF_KIND_GGX: return lanes_none();
    case VNDF_KIND_BECKMANN: {
        lanes_f p = ay * x, q = ax * y, product = ax * ay;
        return lanes_less(2.25f * (product * product) * (1.0f - (x * x + y * y)), p * p + q * q);
    }
    }
    VNDF_NO_OTHER_KIND();
}

/* Whether the density of a reflection, D of a half vector of any length, keeps its digits in float where the view is
 * trusted: vndf_ggx_density_of (bsdf/terms/event.h). */
VNDF_INLINE int vndf_law_is_ggx(const vndf_distribution *d)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return 0;
    case VNDF_KIND_GGX: return 1;
    case VNDF_KIND_BECKMANN: return 0;
    }
    VNDF_NO_OTHER_KIND();
}

#if VNDF_LANES == 1

/* ---- views and their samples ---- */

/* vndf_view_from of a surface with a distribution. */
VNDF_INLINE vndf_view vndf_law_view(const vndf_surface *surface, vndf_vec3 wi)
{
    switch (surface->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_table_view_from(surface, wi);
    case VNDF_KIND_GGX: return vndf_ggx_view_from(surface, wi);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_view_from(surface, vndf_packed(wi));
    }
    VNDF_NO_OTHER_KIND();
}

/* The same in place: a copy would be waited for. */
VNDF_INLINE void vndf_law_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    switch (surface->distribution->kind) {
    case VNDF_KIND_TABLE: vndf_table_view_set(view, surface, vndf_packed(wi)); return;
    case VNDF_KIND_GGX: vndf_ggx_view_set(view, surface, wi); return;
    case VNDF_KIND_BECKMANN: vndf_beckmann_view_set(view, surface, vndf_packed(wi)); return;
    }
    VNDF_NO_OTHER_KIND();
}

/* The view of a usable direction for roughness times the distribution's scale. */
VNDF_INLINE vndf_view vndf_law_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    vndf_surface surface = {d, (float)ax, (float)ay};
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_view_scaled(d, ax, ay, vndf_packed(wi));
    case VNDF_KIND_GGX: return vndf_ggx_view_from(&surface, wi);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_view_from(&surface, vndf_packed(wi));
    }
    VNDF_NO_OTHER_KIND();
}

/* A view turned to another usable direction, in place. */
VNDF_INLINE void vndf_law_view_turn(vndf_view *view, vndf_vec3 wi)
{
    const vndf_distribution *d = view->distribution;
    vndf_surface surface = {d, view->ax, view->ay};
    switch (d->kind) {
    case VNDF_KIND_TABLE: *view = vndf_table_view_scaled(d, view->alpha_x, view->alpha_y, vndf_packed(wi)); return;
    case VNDF_KIND_GGX: vndf_ggx_view_set(view, &surface, wi); return;
    case VNDF_KIND_BECKMANN: vndf_beckmann_view_set(view, &surface, vndf_packed(wi)); return;
    }
    VNDF_NO_OTHER_KIND();
}

/* vndf_sample of a valid view; uniform numbers are in [0, 1]. */
VNDF_INLINE vndf_vec3 vndf_law_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_engine_sample(view, u1, u2, pdf);
    case VNDF_KIND_GGX: return vndf_ggx_view_sample(view, u1, u2, pdf);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_view_sample(view, u1, u2, pdf);
    }
    VNDF_NO_OTHER_KIND();
}

/* The same; *fast becomes 0, without a density, where the sample may lie in a place that is too steep for float. */
VNDF_INLINE vndf_vec3 vndf_law_sample_telling(const vndf_view *view, float u1, float u2, float *pdf, int *fast)
{
    *fast = 1;
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_engine_sample_telling(view, u1, u2, pdf, fast);
    case VNDF_KIND_GGX: return vndf_ggx_view_sample(view, u1, u2, pdf);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_view_sample(view, u1, u2, pdf);
    }
    VNDF_NO_OTHER_KIND();
}

/* The same with *weight (vndf_sample_weight); 0 if it has to be computed from wm. */
VNDF_INLINE vndf_vec3 vndf_law_sample_weight(const vndf_view *view, float u1, float u2, float *pdf, float *weight)
{
    *weight = 1.0f;
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_engine_sample_weight(view, u1, u2, pdf, weight);
    case VNDF_KIND_GGX: return vndf_ggx_view_sample(view, u1, u2, pdf);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_view_sample(view, u1, u2, pdf);
    }
    VNDF_NO_OTHER_KIND();
}

/* The same for samples that float may not draw. */
VNDF_INLINE vndf_vec3 vndf_law_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_engine_sample_exactly(view, u1, u2, pdf);
    case VNDF_KIND_GGX: return vndf_ggx_view_sample_exactly(view, u1, u2, pdf);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_view_sample_exactly(view, u1, u2, pdf);
    }
    VNDF_NO_OTHER_KIND();
}

/* The density of a normal that wi sees, in double. */
VNDF_INLINE double vndf_law_density(const vndf_view *view, const vndf_query *g)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_engine_density(view, g);
    case VNDF_KIND_GGX: return vndf_ggx_visible(g, vndf_query_facing(g));
    case VNDF_KIND_BECKMANN: return vndf_beckmann_visible(g, vndf_query_facing(g));
    }
    VNDF_NO_OTHER_KIND();
}

/* vndf_pdf of a valid view, where wi sees wm. */
VNDF_INLINE float vndf_law_pdf(const vndf_view *view, vndf_vec3 wm)
{
    vndf_query g = vndf_query_of(view, wm);
    return vndf_positive(vndf_density_from(vndf_law_density(view, &g)));
}

/* vndf_invert of a valid view, wm.z >= 0. */
VNDF_INLINE void vndf_law_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: vndf_table_invert(view, vndf_packed(wm), u1, u2); return;
    case VNDF_KIND_GGX: vndf_ggx_view_invert(view, vndf_packed(wm), u1, u2); return;
    case VNDF_KIND_BECKMANN: vndf_beckmann_view_invert(view, vndf_packed(wm), u1, u2); return;
    }
    VNDF_NO_OTHER_KIND();
}

/* ---- normals without a direction ---- */

/* P22 at the squared slope length r2, roughness 1. */
VNDF_INLINE double vndf_law_p22(const vndf_distribution *d, double r2)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_p22(d, r2);
    case VNDF_KIND_GGX: return vndf_ggx_p22(r2);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_p22(r2);
    }
    VNDF_NO_OTHER_KIND();
}

/* The slope length that u stands for (all_normals/). */
VNDF_INLINE vndf_slope vndf_law_slope(const vndf_distribution *d, float u)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_slope(d, u);
    case VNDF_KIND_GGX: return vndf_ggx_slope(u);
    case VNDF_KIND_BECKMANN: return vndf_beckmann_slope_of(u);
    }
    VNDF_NO_OTHER_KIND();
}

/* D cos(theta_m), the density of all normals as they are drawn, wm.z >= 0. */
VNDF_INLINE double vndf_law_pdf_all(const vndf_distribution *d, double ax, double ay, vndf_normal wm)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_table_pdf_all(d, ax, ay, wm);
    case VNDF_KIND_GGX: return wm.z * vndf_ggx_ndf(ax, ay, wm);
    case VNDF_KIND_BECKMANN: return wm.z * vndf_beckmann_ndf(ax, ay, wm);
    }
    VNDF_NO_OTHER_KIND();
}

/* ---- areas of one direction ---- */

/* A(w) of a view's own direction; a table's view holds it. */
VNDF_INLINE float vndf_law_view_area(const vndf_view *view, int *trusted)
{
    *trusted = 1;
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_table_view_area(view);
    case VNDF_KIND_GGX: break;
    case VNDF_KIND_BECKMANN: break;
    }
    return vndf_law_area_above(view->distribution, view->ax, view->ay, view->wi.x, view->wi.y, view->wi.z,
                               trusted);
}

/* The stretched direction, with the length that the law uses. */
VNDF_INLINE vndf_stretched vndf_law_stretch(const vndf_distribution *d, vndf_vec3 w, double ax, double ay)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return vndf_stretch(w, ax, ay, VNDF_LENGTH_SUM);
    case VNDF_KIND_GGX: return vndf_stretch(w, ax, ay, VNDF_LENGTH_ROOT);
    case VNDF_KIND_BECKMANN: return vndf_stretch(w, ax, ay, VNDF_LENGTH_ROOT);
    }
    VNDF_NO_OTHER_KIND();
}

/* A(w)/|w.z|: 1 + Lambda(w) above the horizon, Lambda(-w) below; w.z is not 0. */
VNDF_INLINE double vndf_law_slant(const vndf_view *view, vndf_vec3 w)
{
    vndf_stretched s = vndf_law_stretch(view->distribution, w, view->alpha_x, view->alpha_y);
    return vndf_unit_area(view->distribution, s.s, s.c) / fabs(s.c);
}

/* The same for a view's own direction. For a table it is infinite where c is too small for a float. */
VNDF_INLINE double vndf_law_view_slant(const vndf_view *view)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return (double)view->of.table.area / fabsf(view->of.table.c);
    case VNDF_KIND_GGX: break;
    case VNDF_KIND_BECKMANN: break;
    }
    return vndf_law_slant(view, view->wi);
}

/* The largest change of log P22 over the slope length, in units of alpha, except where hardly any samples are. */
VNDF_INLINE double vndf_law_steepness(const vndf_distribution *d)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: return d->steepness;
    case VNDF_KIND_GGX: return 2.0;
    case VNDF_KIND_BECKMANN: return 3.0; /* 2 R; R exceeds 1.5 in 10% of samples */
    }
    VNDF_NO_OTHER_KIND();
}

/* ---- bounded normals (bounded/bounded.h), wi.z > 0 ---- */

VNDF_INLINE void vndf_law_bounds(const vndf_view *view, vndf_bounds *bounds)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return;
    case VNDF_KIND_GGX: vndf_bound_ggx(view, &bounds->ggx); return;
    case VNDF_KIND_BECKMANN: vndf_bound_beckmann(view, &bounds->beckmann); return;
    }
    VNDF_NO_OTHER_KIND();
}

VNDF_INLINE vndf_bounded vndf_law_sample_bounded(const vndf_view *view, const vndf_bounds *bounds, float u1,
                                                 float u2)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_bounded_table(view, u1, u2);
    case VNDF_KIND_GGX: return vndf_bounded_ggx(view, &bounds->ggx, u1, u2);
    case VNDF_KIND_BECKMANN: return vndf_bounded_beckmann(view, &bounds->beckmann, u1, u2);
    }
    VNDF_NO_OTHER_KIND();
}

VNDF_INLINE vndf_bounded_factors vndf_law_bounded_at(const vndf_view *view, const vndf_bounds *bounds,
                                                     vndf_normal wm, double facing)
{
    switch (view->distribution->kind) {
    case VNDF_KIND_TABLE: return vndf_bounded_table_at(view, wm, facing);
    case VNDF_KIND_GGX: return vndf_bounded_ggx_at(view, &bounds->ggx, wm, facing);
    case VNDF_KIND_BECKMANN: return vndf_bounded_beckmann_at(view, &bounds->beckmann, wm, facing);
    }
    VNDF_NO_OTHER_KIND();
}

#else

/* ---- blocks of a batch ---- */

VNDF_INLINE void vndf_law_draw_block(const vndf_distribution *d, vndf_sample_block *b)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: vndf_draw_table(d, b); return;
    case VNDF_KIND_GGX: vndf_draw_ggx(b); return;
    case VNDF_KIND_BECKMANN: vndf_draw_beckmann(b); return;
    }
    VNDF_NO_OTHER_KIND();
}

VNDF_INLINE void vndf_law_invert_block(const vndf_distribution *d, vndf_invert_block *b)
{
    switch (d->kind) {
    case VNDF_KIND_TABLE: vndf_invert_table(d, b); return;
    case VNDF_KIND_GGX: vndf_invert_ggx(b); return;
    case VNDF_KIND_BECKMANN: vndf_invert_beckmann(b); return;
    }
    VNDF_NO_OTHER_KIND();
}

#endif
#endif
