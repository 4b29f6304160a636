/* Normals that are drawn otherwise than by what wi sees alone: all of them, those of V-cavities, and visible ones that
 * reflect wi to above the horizon. Surfaces without a mean slope, from above. */
#include "sampler/sampler.h"
#include "sampler/state.h"

/* wi.wm with all its digits: at grazing angles it is a small rest of its terms. */
static double facing_of(const vndf_view *view, vndf_vec3 wm)
{
    vndf_vec3 wi = view->wi;
    return ((double)wi.x * wm.x + (double)wi.y * wm.y) + (double)wi.z * wm.z;
}

/* With the visible density over the drawn one. */
static vndf_drawn_normal with_weight(const vndf_view *view, vndf_vec3 wm, float density)
{
    float facing = max((float)facing_of(view, wm), 0.0f), area = max(vndf_view_own_area(view), 1e-37f);
    const vndf_drawn_normal n = {wm, density,
                                 density > 0.0f ? vndf_view_ndf(view, wm) / density * (facing / area) : 0.0f};
    return n;
}

/* A drawn normal on the surface, as the frame places it. */
static vndf_drawn_normal on_surface(const vndf_view *view, const frame *f, normal_sample n)
{
    surface_sample s = frame_sampled(*f, n);
    return with_weight(view, (vndf_vec3){s.x, s.y, s.z}, s.pdf);
}

/* ---- bounded normals ---- */

/* Whether it is that of a table with the same roughness along and across, whose bounds follow. */
static int has_bounds(const vndf_view *view, table_bounds *b)
{
    const vndf_state *s = vndf_state_of(view);
    ellipse e = ellipse_of(s->f.m);
    if (view->distribution->kind != VNDF_KIND_TABLE ||
        !(abs(e.e12) <= 1e-5f * e.e11 && abs(e.e11 - e.e22) <= 1e-5f * e.e11))
        return 0;
    *b = table_bounds_of(table_of(view->distribution), s->of.table, sqrt(e.e11));
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

static float pdf_bounded(const vndf_view *view, vndf_vec3 wm)
{
    const vndf_state *s = vndf_state_of(view);
    if (!(wm.z >= 0.0f) || !(2.0 * facing_of(view, wm) * wm.z > view->wi.z))
        return 0.0f;
    number_box box = box_of(view);
    float kept = box.span1 * box.span2; /* of the visible normals like this one */
    table_bounds b;
    if (has_bounds(view, &b))
        kept = table_bounded_inside(table_of(view->distribution), s->of.table, b,
                                    frame_normal(s->f, wm.x, wm.y, wm.z));
    return frame_density(s->f, vndf_pdf(view, wm) / kept);
}

/* At the edges of the square rounding may take wo to below the horizon: then wm is that of a wo just above it, and has
 * the density of where it comes to. wo is twice (wi.wm) wm less wi, so wi + wo has its x and y, and z of wi. */
static vndf_drawn_normal raised(const vndf_view *view, vndf_drawn_normal n)
{
    double facing = facing_of(view, n.wm);
    if (2.0 * facing * n.wm.z > view->wi.z)
        return n;
    float x = 2.0f * (float)facing * n.wm.x, y = 2.0f * (float)facing * n.wm.y, z = view->wi.z + 1e-6f;
    float per = 1.0f / sqrt(x * x + y * y + z * z);
    n.wm = (vndf_vec3){x * per, y * per, z * per};
    return with_weight(view, n.wm, pdf_bounded(view, n.wm));
}

static vndf_drawn_normal sample_bounded(const vndf_view *view, float u1, float u2)
{
    const vndf_state *s = vndf_state_of(view);
    table_bounds bounds;
    if (has_bounds(view, &bounds)) {
        normal_sample n = table_draw_bounded(table_of(view->distribution), s->of.table, bounds, u1, u2);
        return raised(view, on_surface(view, &s->f, n));
    }
    number_box b = box_of(view);
    vndf_drawn_normal d = vndf_sample_visible(view, b.begin1 + b.span1 * u1, b.begin2 + b.span2 * u2);
    d.density /= b.span1 * b.span2;
    d.weight *= b.span1 * b.span2;
    return d;
}

/* ---- by law ---- */

/* All normals are what is seen straight from above; those of V-cavities are made of them. */
vndf_drawn_normal vndf_sample_by(const vndf_view *view, vndf_normals_drawn law, float u1, float u2)
{
    const vndf_distribution *d = view->distribution;
    const frame *f = &vndf_state_of(view)->f;
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (law == VNDF_NORMALS_BOUNDED && f->uz > 0.0f)
        return sample_bounded(view, u1, u2);
    frame straight = frame_of(f->m, 0.0f, 0.0f, 1.0f);
    any_slope r = d->kind == VNDF_KIND_GGX ? ggx_slope(u2)
                  : d->kind == VNDF_KIND_BECKMANN
                      ? beckmann_slope(u2)
                      : table_slope(table_of(d), table_view_of(table_of(d), straight, 0), u2);
    if (law == VNDF_NORMALS_V_CAVITY)
        return on_surface(view, f, v_cavity_draw(r, f->ux, f->uy, f->uz, u1));
    return on_surface(view, &straight, all_normals_draw(r, u1));
}

float vndf_pdf_by(const vndf_view *view, vndf_normals_drawn law, vndf_vec3 wm)
{
    if (law == VNDF_NORMALS_BOUNDED && vndf_state_of(view)->f.uz > 0.0f)
        return pdf_bounded(view, wm);
    const float all = vndf_view_ndf(view, wm) * wm.z;
    if (law == VNDF_NORMALS_V_CAVITY)
        return all * v_cavity_share(view->wi.x * wm.x + view->wi.y * wm.y, view->wi.z * wm.z);
    return all;
}
