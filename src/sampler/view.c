/* The calls for one element: views, samples, densities and what goes with them, by the text of the kernel. */
#include <float.h>

#include "sampler/sampler.h"
#include "sampler/state.h"

/* A surface in units of its distribution, which is NULL if the surface is not valid. */
typedef struct vndf_mapped {
    const vndf_distribution *distribution;
    affine_map m;
} vndf_mapped;

/* Whether all but xx and yy are 0, of either sign. */
VNDF_INLINE int surface_is_diagonal(const vndf_surface *s)
{
    return (uint32_t)(bits(s->xy) | bits(s->yx) | bits(s->mean_x) | bits(s->mean_y)) << 1 == 0;
}

VNDF_INLINE vndf_mapped mapped_as(const vndf_surface *surface, const int is_diagonal)
{
    float unit = surface->distribution->unit;
    affine_map m = {surface->xx * unit, 0.0f, 0.0f, surface->yy * unit, 0.0f, 0.0f, is_diagonal, 0.0f};
    if (!is_diagonal) {
        m.xy = surface->xy * unit;
        m.yx = surface->yx * unit;
        m.mean_x = surface->mean_x;
        m.mean_y = surface->mean_y;
    }
    m = affine_measured(m);
    const vndf_mapped s = {any(affine_is_valid(m)) ? surface->distribution : NULL, m};
    return s;
}

VNDF_INLINE vndf_mapped mapped(const vndf_surface *surface)
{
    const vndf_mapped none = {0};
    if (!surface || !surface->distribution)
        return none;
    return surface_is_diagonal(surface) ? mapped_as(surface, 1) : mapped_as(surface, 0);
}

VNDF_INLINE int is_direction(vndf_vec3 w)
{
    return any(direction_is_valid(w.x, w.y, w.z)) != 0;
}

/* ---- views ---- */

/* A view by the text of one kind. */
VNDF_INLINE void view_into(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi, const int kind)
{
    view->distribution = NULL;
    view->wi = wi;
    vndf_mapped map = mapped(surface);
    if (!map.distribution || !is_direction(wi))
        return;
    vndf_state *s = (vndf_state *)(void *)view->numbers;
    frame f = frame_of(map.m, wi.x, wi.y, wi.z);
    view->distribution = map.distribution;
    s->f = f;
    if (kind == VNDF_KIND_GGX)
        s->of.ggx = ggx_see(f.ux, f.uy, f.uz);
    else if (kind == VNDF_KIND_BECKMANN)
        s->of.beckmann = beckmann_see(f.ux, f.uy, f.uz);
    else if (f.uz < 0.0f)
        s->of.table = table_view_of(table_of(map.distribution), f, 1);
    else
        s->of.table = table_view_of(table_of(map.distribution), f, 0);
}

/* Each kind has a function of its own, since a common one would keep the numbers of all kinds in registers. A view is
 * built where the caller wants it: a copy of what was just stored waits for the stores (14 of 41 ns of GGX). */
VNDF_RARE vndf_view view_of_ggx(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view;
    view_into(&view, surface, wi, VNDF_KIND_GGX);
    return view;
}

VNDF_RARE vndf_view view_of_beckmann(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view;
    view_into(&view, surface, wi, VNDF_KIND_BECKMANN);
    return view;
}

VNDF_RARE vndf_view view_of_table(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view;
    view_into(&view, surface, wi, VNDF_KIND_TABLE);
    return view;
}

VNDF_INLINE vndf_kind kind_of(const vndf_surface *surface)
{
    return surface && surface->distribution ? surface->distribution->kind : VNDF_KIND_TABLE;
}

vndf_view vndf_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    switch (kind_of(surface)) {
    case VNDF_KIND_GGX: return view_of_ggx(surface, wi);
    case VNDF_KIND_BECKMANN: return view_of_beckmann(surface, wi);
    default: return view_of_table(surface, wi);
    }
}

void vndf_view_make(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    switch (kind_of(surface)) {
    case VNDF_KIND_GGX: view_into(view, surface, wi, VNDF_KIND_GGX); break;
    case VNDF_KIND_BECKMANN: view_into(view, surface, wi, VNDF_KIND_BECKMANN); break;
    default: view_into(view, surface, wi, VNDF_KIND_TABLE);
    }
}

/* ---- samples ---- */

/* A normal to be returned. x and y are returned in one register, which gcc would read back from two stores: the
 * processor would wait until both are in the cache. */
VNDF_INLINE vndf_vec3 vec3_of(float x, float y, float z)
{
    vndf_vec3 v = {x, y, z};
#if defined(VNDF_KERNEL_SSE2)
    _mm_storel_pi((__m64 *)(void *)&v, _mm_unpacklo_ps(lane(x), lane(y)));
#endif
    return v;
}

VNDF_INLINE weighted_sample draw(const vndf_view *view, float u1, float u2, const int weigh)
{
    const vndf_state *s = vndf_state_of(view);
    weighted_sample w = {{0.0f, 0.0f, 1.0f, 0.0f}, 1.0f};
    if (view->distribution->kind == VNDF_KIND_TABLE) {
        table t = table_of(view->distribution);
        return vndf_is_below(s) ? table_draw_weighed(t, s->of.table, u1, u2, 1, weigh)
                                : table_draw_weighed(t, s->of.table, u1, u2, 0, weigh);
    }
    if (view->distribution->kind == VNDF_KIND_GGX)
        w.n = ggx_draw(s->of.ggx, u1, u2);
    else
        w.n = beckmann_draw(s->of.beckmann, u1, u2);
    return w;
}

VNDF_INLINE vndf_vec3 sample(const vndf_view *view, float u1, float u2, float *pdf, float *weight)
{
    surface_sample n = {0.0f, 0.0f, 1.0f, 0.0f};
    float factor = 0.0f;
    if (view->distribution) {
        weighted_sample w = draw(view, vndf_clamp_unit(u1), vndf_clamp_unit(u2), weight != NULL);
        n = frame_sampled(vndf_state_of(view)->f, w.n);
        factor = w.weight;
    }
    if (pdf)
        *pdf = n.pdf;
    if (weight)
        *weight = factor;
    return vec3_of(n.x, n.y, n.z);
}

vndf_vec3 vndf_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    return sample(view, u1, u2, pdf, NULL);
}

vndf_vec3 vndf_sample_weight(const vndf_view *view, float u1, float u2, float *pdf, float *weight)
{
    float ignored;
    return sample(view, u1, u2, pdf, weight ? weight : &ignored);
}

vndf_drawn_normal vndf_sample_visible(const vndf_view *view, float u1, float u2)
{
    vndf_drawn_normal n;
    n.wm = sample(view, u1, u2, &n.density, &n.weight);
    return n;
}

/* ---- given normals ---- */

/* The normal in the unit problem; 0 if it is not seen. */
VNDF_INLINE int seen_normal(const vndf_view *view, vndf_vec3 wm, unit_normal *n)
{
    if (!view->distribution || !(wm.z >= 0.0f))
        return 0;
    *n = frame_normal(vndf_state_of(view)->f, wm.x, wm.y, wm.z);
    return n->facing > 0.0f;
}

VNDF_INLINE float unit_ndf(const vndf_distribution *d, unit_normal n)
{
    if (d->kind == VNDF_KIND_TABLE)
        return table_p22(table_of(d), table_given(table_of(d), n.x, n.y, n.z));
    return d->kind == VNDF_KIND_GGX ? ggx_p22(n.x, n.y, n.z) : beckmann_p22(n.x, n.y, n.z);
}

/* The area of the unit problem along (ux, uy, uz). */
VNDF_INLINE float unit_area(const vndf_distribution *d, const vndf_state *s)
{
    if (d->kind == VNDF_KIND_TABLE)
        return law_area(table_of(d), s->of.table.v, vndf_is_below(s)) * frame_reach(s->f);
    return d->kind == VNDF_KIND_GGX ? s->of.ggx.area : beckmann_area(s->f.ux, s->f.uy, s->f.uz);
}

VNDF_INLINE float density(const vndf_view *view, unit_normal n)
{
    const vndf_state *s = vndf_state_of(view);
    const vndf_distribution *d = view->distribution;
    if (d->kind == VNDF_KIND_GGX)
        return ggx_density(s->of.ggx, n.x, n.y, n.z, n.facing);
    if (d->kind == VNDF_KIND_BECKMANN)
        return beckmann_density(s->of.beckmann, n.x, n.y, n.z, n.facing);
    float reach = frame_reach(s->f);
    if (!vndf_is_below(s))
        return table_pdf(table_of(d), s->of.table, n, reach, 0);
    return table_pdf(table_of(d), s->of.table, table_unturned(s->of.table.ex, s->of.table.ey, n), reach, 1);
}

float vndf_pdf(const vndf_view *view, vndf_vec3 wm)
{
    unit_normal n;
    if (!seen_normal(view, wm, &n))
        return 0.0f;
    const frame *f = &vndf_state_of(view)->f;
    return frame_density(*f, density(view, n) / f->determinant);
}

float vndf_visible(const vndf_view *view, vndf_vec3 wm)
{
    unit_normal n;
    if (!seen_normal(view, wm, &n))
        return 0.0f;
    const vndf_state *s = vndf_state_of(view);
    if (!vndf_is_table(view->distribution))
        return frame_density(s->f, density(view, n) / s->f.determinant);
    float area = max(unit_area(view->distribution, s), 1e-37f);
    return frame_density(s->f, unit_ndf(view->distribution, n) / s->f.determinant * (n.facing / area));
}

void vndf_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    pair u = {0.0f, 0.0f};
    if (view->distribution) {
        const vndf_state *s = vndf_state_of(view);
        unit_normal n = frame_normal(s->f, wm.x, wm.y, max(wm.z, 0.0f));
        if (view->distribution->kind == VNDF_KIND_TABLE)
            u = vndf_is_below(s) ? table_numbers(table_of(view->distribution), s->of.table, n, 1)
                                 : table_numbers(table_of(view->distribution), s->of.table, n, 0);
        else
            u = view->distribution->kind == VNDF_KIND_GGX ? ggx_invert(s->of.ggx, n.x, n.y, n.z)
                                                          : beckmann_invert(s->of.beckmann, n.x, n.y, n.z);
    }
    *u1 = vndf_clamp_unit(u.a);
    *u2 = vndf_clamp_unit(u.b);
}

/* ---- the distribution itself ---- */

float vndf_view_ndf(const vndf_view *view, vndf_vec3 wm)
{
    if (!view->distribution || !(wm.z >= 0.0f))
        return 0.0f;
    const frame *f = &vndf_state_of(view)->f;
    return min(unit_ndf(view->distribution, frame_normal(*f, wm.x, wm.y, wm.z)) / f->determinant, FLT_MAX);
}

float vndf_ndf(const vndf_surface *surface, vndf_vec3 wm)
{
    vndf_mapped s = mapped(surface);
    if (!s.distribution || !(wm.z >= 0.0f))
        return 0.0f;
    frame f = frame_of(s.m, 0.0f, 0.0f, 1.0f);
    return min(unit_ndf(s.distribution, frame_normal(f, wm.x, wm.y, wm.z)) / f.determinant, FLT_MAX);
}

/* The normal (-x, -y, 1) has the slope (x, y), and P22 over z^4 is P22. */
float vndf_p22(const vndf_surface *surface, float x, float y)
{
    vndf_vec3 normal = {-x, -y, 1.0f};
    return abs(x) <= FLT_MAX && abs(y) <= FLT_MAX ? vndf_ndf(surface, normal) : 0.0f;
}

/* ---- area and masking ---- */

/* Area along w, and the projection of w on the mean plane. */
typedef struct look_at {
    float area, cosine;
} look_at;

/* Above the horizon an area takes its place among the knots alone, not the law. */
VNDF_INLINE float area_along(const vndf_distribution *d, const frame *f)
{
    if (d->kind == VNDF_KIND_GGX)
        return ggx_area(f->ux, f->uy, f->uz);
    if (d->kind == VNDF_KIND_BECKMANN)
        return beckmann_area(f->ux, f->uy, f->uz);
    table t = table_of(d);
    table_direction w = table_direction_of(*f);
    radial_law v = {.s = w.s, .c = w.c, .rho = w.rho};
    if (f->uz < 0.0f)
        v = law_see_below(t, w.s, w.c, w.rho, find_knot(t, w.square, w.under));
    return law_area(t, v, f->uz < 0.0f) * frame_reach(*f);
}

static look_at look_along(const vndf_surface *surface, vndf_vec3 w)
{
    look_at at = {0.0f, 0.0f};
    vndf_mapped s = mapped(surface);
    if (!s.distribution || !is_direction(w))
        return at;
    frame f = frame_of(s.m, w.x, w.y, w.z);
    at.cosine = f.uz * f.size;
    at.area = area_along(s.distribution, &f) * f.size;
    return at;
}

float vndf_view_own_area(const vndf_view *view)
{
    const vndf_state *s = vndf_state_of(view);
    return view->distribution ? unit_area(view->distribution, s) * s->f.size : 0.0f;
}

float vndf_view_drawn_area(const vndf_view *view)
{
    const vndf_state *s = vndf_state_of(view);
    if (!view->distribution || !(s->f.max_pdf > 0.0f))
        return 0.0f;
    if (!vndf_is_table(view->distribution))
        return vndf_view_own_area(view);
    return law_drawn_area(s->of.table.v, vndf_is_below(s)) * frame_reach(s->f) * s->f.size;
}

float vndf_view_area(const vndf_view *view, vndf_vec3 w)
{
    if (!view->distribution)
        return 0.0f;
    frame f = frame_of(vndf_state_of(view)->f.m, w.x, w.y, w.z);
    return area_along(view->distribution, &f) * f.size;
}

float vndf_view_cosine(const vndf_view *view, vndf_vec3 w)
{
    return view->distribution ? affine_stretched(vndf_state_of(view)->f.m, w.x, w.y, w.z).z : 0.0f;
}

/* 1/(1 + Lambda_i + Lambda_o), with 1 + Lambda = 1/G1, is the smaller G1 times a factor that is 1/2 at least, since a
 * product of two small ones would underflow. */
float vndf_g2_of(float gi, float go, vndf_g2_model model)
{
    float lesser = min(gi, go), greater = max(gi, go);
    if (model == VNDF_G2_SEPARABLE || lesser == 0.0f)
        return gi * go;
    return lesser * (greater / (greater + lesser * (1.0f - greater)));
}

float vndf_projected_area(const vndf_surface *surface, vndf_vec3 w)
{
    return look_along(surface, w).area;
}

float vndf_lambda(const vndf_surface *surface, vndf_vec3 w)
{
    look_at at = look_along(surface, w);
    return lambda_of(at.area, at.cosine);
}

float vndf_g1(const vndf_surface *surface, vndf_vec3 w)
{
    look_at at = look_along(surface, w);
    return g1_of(at.area, at.cosine);
}

float vndf_g2(const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    return vndf_g2_of(vndf_g1(surface, wi), vndf_g1(surface, wo), model);
}
