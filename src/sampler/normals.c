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

/* ---- by law ---- */

/* All normals are what is seen straight from above; those of V-cavities are made of them. */
vndf_drawn_normal vndf_sample_by(const vndf_view *view, vndf_normals_drawn law, float u1, float u2)
{
    const vndf_distribution *d = view->distribution;
    const frame *f = &vndf_state_of(view)->f;
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (law == VNDF_NORMALS_BOUNDED && f->uz > 0.0f)
        return vndf_bounded_sample(view, u1, u2);
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
        return vndf_bounded_pdf(view, wm);
    const float all = vndf_view_ndf(view, wm) * wm.z;
    if (law == VNDF_NORMALS_V_CAVITY)
        return all * v_cavity_share(view->wi.x * wm.x + view->wi.y * wm.y, view->wi.z * wm.z);
    return all;
}
