/* Normals that are drawn otherwise than by what wi sees alone: all of them, those of V-cavities, and visible ones that
 * reflect wi to above the horizon. Surfaces without a mean slope. */
#include <float.h>

#include "sampler/sampler.h"
#include "sampler/state.h"

/* wi.wm with all its digits: at grazing angles it is a small rest of its terms. */
static double facing_of(const vndf_view *view, vndf_vec3 wm)
{
    vndf_vec3 wi = view->wi;
    return ((double)wi.x * wm.x + (double)wi.y * wm.y) + (double)wi.z * wm.z;
}

/* The visible density over another one. */
static float quotient(const vndf_view *view, vndf_vec3 wm, float density)
{
    float facing = most((float)facing_of(view, wm), 0.0f), area = most(vndf_view_own_area(view), 1e-37f);
    return density > 0.0f ? vndf_view_ndf(view, wm) / density * (facing / area) : 0.0f;
}

static vndf_drawn_normal no_normal(void)
{
    const vndf_drawn_normal none = {{0.0f, 0.0f, 1.0f}, 0.0f, 0.0f};
    return none;
}

/* The drawn normal on the surface, without a look at wi. */
static vndf_drawn_normal on_surface(const vndf_view *view, const frame *f, drawn n)
{
    sampled_normal s = frame_sampled(*f, n);
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

/* Whether it is that of a table with the same roughness along and across, whose bounds follow; `can_bound`. */
static int has_bounds(const vndf_view *view, table_bounds *b)
{
    const vndf_state *s = vndf_state_of(view);
    ellipse e = ellipse_of(s->f.m);
    if (view->distribution->kind != VNDF_KIND_TABLE ||
        !(size(e.e12) <= 1e-5f * e.e11 && size(e.e11 - e.e22) <= 1e-5f * e.e11))
        return 0;
    *b = table_bounds_of(table_of(view->distribution), s->of.table, root(e.e11));
    return 1;
}

/* The numbers that closed forms keep; tables of unequal roughness keep all. */
static number_box box_of(const vndf_view *view)
{
    const vndf_state *s = vndf_state_of(view);
    const number_box all = {0.0f, 1.0f, 0.0f, 1.0f};
    if (view->distribution->kind == VNDF_KIND_TABLE)
        return all;
    return view->distribution->kind == VNDF_KIND_GGX ? ggx_box(s->f)
                                                     : beckmann_box(s->of.beckmann, ellipse_of(s->f.m));
}

static int can_bound(const vndf_view *view)
{
    return view->distribution && view->wi.z > 0.0f && vndf_state_of(view)->f.uz > 0.0f;
}

/* At the edges of the square rounding may take wo to below the horizon: then wm is that of a wo just above it, and has
 * the density of where it comes to. wo is twice (wi.wm) wm less wi, so wi + wo has its x and y, and z of wi. */
static vndf_drawn_normal raised(const vndf_view *view, vndf_drawn_normal n)
{
    double facing = facing_of(view, n.wm);
    if (2.0 * facing * n.wm.z > view->wi.z)
        return n;
    float x = 2.0f * (float)facing * n.wm.x, y = 2.0f * (float)facing * n.wm.y, z = view->wi.z + 1e-6f;
    float per = 1.0f / root(x * x + y * y + z * z);
    n.wm = (vndf_vec3){x * per, y * per, z * per};
    n.density = vndf_pdf_bounded(view, n.wm);
    n.weight = quotient(view, n.wm, n.density);
    return n;
}

vndf_drawn_normal vndf_sample_bounded(const vndf_view *view, float u1, float u2)
{
    if (!can_bound(view))
        return no_normal();
    const vndf_state *s = vndf_state_of(view);
    table_bounds bounds;
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (has_bounds(view, &bounds)) {
        drawn n = table_draw_bounded(table_of(view->distribution), s->of.table, bounds, u1, u2);
        return raised(view, on_surface(view, &s->f, n));
    }
    number_box b = box_of(view);
    vndf_drawn_normal d = vndf_sample_visible(view, b.begin1 + b.span1 * u1, b.begin2 + b.span2 * u2);
    d.density /= b.span1 * b.span2;
    d.weight *= b.span1 * b.span2;
    return d;
}

float vndf_pdf_bounded(const vndf_view *view, vndf_vec3 wm)
{
    if (!can_bound(view) || !(wm.z >= 0.0f) || !(2.0 * facing_of(view, wm) * wm.z > view->wi.z))
        return 0.0f;
    const vndf_state *s = vndf_state_of(view);
    number_box box = box_of(view);
    float kept = box.span1 * box.span2; /* of the visible normals like this one */
    table_bounds b;
    if (has_bounds(view, &b))
        kept = table_bounded_inside(table_of(view->distribution), s->of.table, b,
                                    frame_normal(s->f, wm.x, wm.y, wm.z));
    return frame_density(s->f, vndf_pdf(view, wm) / kept);
}
