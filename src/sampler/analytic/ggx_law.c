/* GGX: views and their samples. */
#include "sampler/analytic/ggx_law.h"

#include "sampler/analytic/inverse.h"
#include "sampler/law.h"

#include "math/vector.h"
#include "sampler/all_normals/all_normals.h"
#include "sampler/analytic/ggx.h"

vndf_vec3 vndf_ggx_view_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    if (!view->trusted)
        return vndf_ggx_view_sample_exactly(view, u1, u2, pdf);
    vndf_ggx_incidence w = vndf_ggx_incidence_of(view);
    lanes_m trusted;
    vndf_drawn n = vndf_ggx_draw(&w, u1, u2, &trusted);
    if (!trusted)
        return vndf_ggx_view_sample_exactly(view, u1, u2, pdf);
    if (pdf)
        *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}

vndf_vec3 vndf_ggx_view_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf)
{
    if (view->wi.x == 0.0f && view->wi.y == 0.0f && view->wi.z > 0.0f)
        return vndf_sample_all(view->distribution, view->alpha_x, view->alpha_y, u1, u2, pdf); /* the same there */
    vndf_frame f = vndf_analytic_frame(view);
    vndf_vec3 wm = vndf_analytic_normal(&f, vndf_ggx_sample(f.s, f.c, u1, u2));
    if (pdf)
        *pdf = vndf_is_facing(view, wm) ? vndf_law_pdf(view, wm) : 0.0f;
    return vndf_packed(wm);
}

void vndf_ggx_view_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    vndf_query g = vndf_query_of(view, wm);
    vndf_unit_query q = vndf_unit_query_of(&g);
    vndf_uniforms u = vndf_ggx_inverse(&q);
    *u1 = u.u1;
    *u2 = u.u2;
}
