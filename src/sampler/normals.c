/* Normals that are drawn otherwise than by what wi sees alone: all of them, those of V-cavities, and visible ones that
 * reflect wi to above the horizon. Surfaces without a mean slope. */
#include <float.h>

#include "sampler/sampler.h"
#include "sampler/state.h"

/* The visible density over another one. */
static float quotient(const vndf_view *view, vndf_vec3 wm, float density)
{
    return density > 0.0f ? vndf_visible(view, wm) / density : 0.0f;
}

static vndf_drawn_normal no_normal(void)
{
    const vndf_drawn_normal none = {{0.0f, 0.0f, 1.0f}, 0.0f, 0.0f};
    return none;
}

/* The drawn normal on the surface, without a look at wi. */
static vndf_drawn_normal on_surface(const vndf_view *view, const frame *f, drawn n)
{
    sampled s = frame_sampled(*f, n);
    vndf_drawn_normal d = {{s.x, s.y, s.z}, s.pdf, 0.0f};
    d.weight = quotient(view, d.wm, d.density);
    return d;
}

/* ---- all normals: what is seen straight from above ---- */

static frame straight_frame(const vndf_view *view)
{
    return frame_of(vndf_state_of(view)->f.m, 0.0f, 0.0f, 1.0f);
}

static any_slope slope_at(const vndf_view *view, const frame *straight, float u2)
{
    const vndf_distribution *d = view->distribution;
    if (d->kind == VNDF_KIND_TABLE)
        return table_slope(table_of(d), table_view_of(table_of(d), *straight, 0), u2);
    return d->kind == VNDF_KIND_GGX ? ggx_slope(u2) : beckmann_slope(u2);
}

vndf_drawn_normal vndf_sample_all(const vndf_view *view, float u1, float u2)
{
    if (!view->distribution)
        return no_normal();
    frame straight = straight_frame(view);
    any_slope r = slope_at(view, &straight, vndf_clamp_unit(u2));
    return on_surface(view, &straight, all_normals_draw(r, vndf_clamp_unit(u1)));
}

float vndf_pdf_all(const vndf_view *view, vndf_vec3 wm)
{
    return vndf_view_ndf(view, wm) * wm.z;
}

/* ---- V-cavities ---- */

vndf_drawn_normal vndf_sample_v_cavity(const vndf_view *view, float u1, float u2)
{
    if (!view->distribution)
        return no_normal();
    const frame *f = &vndf_state_of(view)->f;
    frame straight = straight_frame(view);
    any_slope r = slope_at(view, &straight, vndf_clamp_unit(u2));
    return on_surface(view, f, v_cavity_draw(r, f->ux, f->uy, f->uz, vndf_clamp_unit(u1)));
}

float vndf_pdf_v_cavity(const vndf_view *view, vndf_vec3 wm)
{
    if (!view->distribution)
        return 0.0f;
    float level = view->wi.x * wm.x + view->wi.y * wm.y, up = view->wi.z * wm.z;
    return vndf_pdf_all(view, wm) * v_cavity_share(level, up);
}

/* ---- bounded normals ---- */

/* What (1) of kernel/bounded.h takes of a surface. */
typedef struct quadric {
    float xx, xy, yy;
} quadric;

static quadric quadric_of(const frame *f)
{
    const affine_map *m = &f->m;
    quadric e = {m->xx * m->xx + m->yx * m->yx, m->xx * m->xy + m->yx * m->yy, m->xy * m->xy + m->yy * m->yy};
    return e;
}

/* Of a table: roughness, where it is the same along and across, and the tangent of the stretched direction. */
typedef struct table_bounds {
    int isotropic;
    float alpha, slant, part;
} table_bounds;

static table_bounds table_bounds_of(const vndf_view *view)
{
    const vndf_state *s = vndf_state_of(view);
    quadric e = quadric_of(&s->f);
    table_bounds b = {size(e.xy) <= 1e-5f * e.xx && size(e.xx - e.yy) <= 1e-5f * e.xx, root(e.xx), 0.0f, 1.0f};
    if (!b.isotropic || !(s->f.uz > 0.0f))
        return b;
    b.slant = least(s->of.table.v.s / (b.alpha * s->of.table.v.c), 1e15f);
    b.part = table_bounded_part(table_of(view->distribution), s->of.table, b.alpha, b.slant);
    return b;
}

static bounded draw_bounded(const vndf_view *view, float u1, float u2)
{
    const vndf_state *s = vndf_state_of(view);
    quadric e = quadric_of(&s->f);
    if (view->distribution->kind == VNDF_KIND_GGX)
        return ggx_draw_bounded(ggx_bounds_of(s->f.ux, s->f.uy, s->f.uz, e.xx, e.xy, e.yy), u1, u2);
    if (view->distribution->kind == VNDF_KIND_BECKMANN)
        return beckmann_draw_bounded(beckmann_bounds_of(s->f.ux, s->f.uy, s->f.uz, e.xx, e.xy, e.yy), u1, u2);
    table t = table_of(view->distribution);
    table_bounds b = table_bounds_of(view);
    if (!b.isotropic) {
        bounded any_normal = {table_draw(t, s->of.table, u1, u2, 0), 1.0f};
        return any_normal;
    }
    bounded_normal n = table_draw_bounded(t, s->of.table, b.alpha, b.slant, b.part, u1, u2);
    bounded inside = {n.n, n.inside};
    return inside;
}

static int can_bound(const vndf_view *view)
{
    return view->distribution && view->wi.z > 0.0f && vndf_state_of(view)->f.uz > 0.0f;
}

vndf_drawn_normal vndf_sample_bounded(const vndf_view *view, float u1, float u2)
{
    if (!can_bound(view))
        return no_normal();
    bounded b = draw_bounded(view, vndf_clamp_unit(u1), vndf_clamp_unit(u2));
    sampled s = frame_sampled(vndf_state_of(view)->f, b.n);
    vndf_drawn_normal d = {{s.x, s.y, s.z}, s.pdf, b.inside};
    if (!vndf_is_exact(view->distribution))
        d.weight = quotient(view, d.wm, d.density);
    return d;
}

/* K of bounded normals (kernel/math.h) where wm reflects wi to above the horizon. */
static float bounded_density(const vndf_view *view, unit_normal n)
{
    const vndf_state *s = vndf_state_of(view);
    quadric e = quadric_of(&s->f);
    if (view->distribution->kind == VNDF_KIND_GGX)
        return ggx_bounded_density(ggx_bounds_of(s->f.ux, s->f.uy, s->f.uz, e.xx, e.xy, e.yy), n.x, n.y, n.z,
                                   n.facing);
    if (view->distribution->kind == VNDF_KIND_BECKMANN)
        return beckmann_bounded_density(beckmann_bounds_of(s->f.ux, s->f.uy, s->f.uz, e.xx, e.xy, e.yy), n.x, n.y,
                                        n.z, n.facing);
    table t = table_of(view->distribution);
    table_bounds b = table_bounds_of(view);
    float whole_density = table_pdf(t, s->of.table, n, frame_reach(s->f), 0);
    return b.isotropic ? whole_density / table_bounded_inside(t, s->of.table, b.alpha, b.slant, b.part, n)
                       : whole_density;
}

float vndf_pdf_bounded(const vndf_view *view, vndf_vec3 wm)
{
    if (!can_bound(view) || !(wm.z >= 0.0f))
        return 0.0f;
    const frame *f = &vndf_state_of(view)->f;
    unit_normal n = frame_normal(*f, wm.x, wm.y, wm.z);
    float facing = view->wi.x * wm.x + view->wi.y * wm.y + view->wi.z * wm.z;
    return 2.0f * facing * wm.z > view->wi.z ? frame_density(*f, bounded_density(view, n) / f->determinant) : 0.0f;
}
