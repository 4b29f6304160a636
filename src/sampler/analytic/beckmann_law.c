/* Beckmann: views and their samples. */
#include "sampler/analytic/beckmann_law.h"

#include "sampler/analytic/inverse.h"
#include "sampler/law.h"

#include "math/vector.h"
#include "sampler/analytic/beckmann.h"

/* A trusted one. */
VNDF_INLINE void put(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi, const vndf_beckmann_incidence *w)
{
    view->distribution = surface->distribution;
    view->wi.x = wi.x;
    view->wi.y = wi.y;
    view->wi.z = wi.z;
    view->alpha_x = w->ax;
    view->alpha_y = w->ay;
    view->ax = w->ax;
    view->ay = w->ay;
    view->trusted = 1;
    view->of.beckmann = (struct vndf_beckmann_view){w->cos_phi, w->sin_phi, w->bound, w->line, w->tail, w->spread,
                                                    w->near,    w->p0,      w->p1,    w->p2,   w->p3,   w->p4};
}

vndf_view vndf_beckmann_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_beckmann_incidence w = vndf_beckmann_incidence_from(surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z);
    vndf_view view;
    if (!w.trusted)
        return vndf_analytic_view_exactly(surface, vndf_packed(wi));
    put(&view, surface, wi, &w);
    return view;
}

void vndf_beckmann_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_beckmann_incidence w = vndf_beckmann_incidence_from(surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z);
    if (w.trusted)
        put(view, surface, wi, &w);
    else
        vndf_analytic_view_set_exactly(view, surface, vndf_packed(wi));
}

vndf_vec3 vndf_beckmann_view_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    if (!view->trusted)
        return vndf_beckmann_view_sample_exactly(view, u1, u2, pdf);
    vndf_beckmann_incidence w = vndf_beckmann_incidence_of(view);
    lanes_m trusted;
    vndf_beckmann_place at = vndf_beckmann_step(&w, vndf_beckmann_first(&w, u1), u1);
    vndf_drawn n = vndf_beckmann_normal(&w, &at, vndf_beckmann_second(u2), vndf_beckmann_middle(u1, u2), &trusted);
    if (!trusted)
        return vndf_beckmann_view_sample_exactly(view, u1, u2, pdf);
    if (pdf)
        *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}

vndf_vec3 vndf_beckmann_view_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf)
{
    vndf_frame f = vndf_analytic_frame(view);
    vndf_vec3 wm = vndf_analytic_normal(&f, vndf_beckmann_sample(f.s, f.c, u1, u2));
    if (pdf)
        *pdf = vndf_is_facing(view, wm) ? vndf_law_pdf(view, wm) : 0.0f;
    return vndf_packed(wm);
}

void vndf_beckmann_view_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    vndf_query g = vndf_query_of(view, wm);
    vndf_unit_query q = vndf_unit_query_of(&g);
    vndf_uniforms u = vndf_beckmann_inverse(&q);
    *u1 = u.u1;
    *u2 = u.u2;
}
