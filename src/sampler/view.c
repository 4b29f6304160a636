/* The calls for one element: what is asked of invalid surfaces, and the text of the kernel (kernel/view.h). */
#include <float.h>

#include "sampler/sampler.h"
#include "sampler/state.h"

/* ---- what kernel/view.h asks for ---- */

#define CALL /* a function of the text is a public call */

enum { VNDF_GGX = VNDF_KIND_GGX, VNDF_BECKMANN = VNDF_KIND_BECKMANN };

typedef const vndf_surface *surface;

typedef struct placed {
    int kind;
    table t;
    frame f;
} placed;

/* A valid view. The compiler may know the last three, and then has text of its own for what they say. */
typedef struct view {
    const vndf_view *of;
    int kind, below, weighs;
} view;

VNDF_INLINE view vndf_seen(const vndf_view *of, const int below, const int weighs)
{
    const view s = {of, below ? VNDF_KIND_TABLE : (int)of->distribution->kind, below, weighs};
    return s;
}

#define sides_apart 1
#define frame_below(f) ((f).uz < 0.0f)
#define view_weighs(s) ((s).weighs)
#define view_wi(s) ((s).of->wi)
#define view_frame(s) (vndf_state_of((s).of)->f)
#define view_law(s) (vndf_state_of((s).of)->of.table)
#define view_ggx(s) (vndf_state_of((s).of)->of.ggx)
#define view_beckmann(s) (vndf_state_of((s).of)->of.beckmann)
#define view_table(s) table_if((s).of->distribution, (s).kind)

/* Closed forms have none. */
VNDF_INLINE table table_if(const vndf_distribution *d, int kind)
{
    const table none = {0};
    return kind == VNDF_GGX || kind == VNDF_BECKMANN ? none : table_of(d);
}

/* ---- surfaces ---- */

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

VNDF_INLINE vndf_mapped mapped_as(const vndf_surface *of, const int is_diagonal)
{
    float unit = of->distribution->unit;
    affine_map m = {of->xx * unit, 0.0f, 0.0f, of->yy * unit, 0.0f, 0.0f, is_diagonal, 0.0f};
    if (!is_diagonal) {
        m.xy = of->xy * unit;
        m.yx = of->yx * unit;
        m.mean_x = of->mean_x;
        m.mean_y = of->mean_y;
    }
    m = affine_measured(m);
    const vndf_mapped s = {any(affine_is_valid(m)) ? of->distribution : NULL, m};
    return s;
}

VNDF_INLINE vndf_mapped mapped(const vndf_surface *m)
{
    const vndf_mapped none = {0};
    if (!m || !m->distribution)
        return none;
    return surface_is_diagonal(m) ? mapped_as(m, 1) : mapped_as(m, 0);
}

VNDF_INLINE int is_direction(vndf_vec3 w)
{
    return any(direction_is_valid(w.x, w.y, w.z)) != 0;
}

/* What is not valid has a frame of size 0 whose largest density is 0. */
VNDF_INLINE placed place(surface m, vec3 w)
{
    placed p = {.kind = VNDF_KIND_GGX, .f = {.uz = 1.0f}};
    vndf_mapped s = mapped(m);
    if (!s.distribution || !is_direction(w))
        return p;
    p.kind = (int)s.distribution->kind;
    p.t = table_if(s.distribution, p.kind);
    p.f = frame_of(s.m, w.x, w.y, w.z);
    return p;
}

#include "kernel/view.h"

#include "kernel/bounded.h"

/* ---- views ---- */

/* A view by the text of one kind. */
VNDF_INLINE void view_into(vndf_view *v, const vndf_surface *m, vndf_vec3 wi, const int kind)
{
    v->distribution = NULL;
    v->wi = wi;
    vndf_mapped map = mapped(m);
    if (!map.distribution || !is_direction(wi))
        return;
    vndf_state *s = (vndf_state *)(void *)v->numbers;
    frame f = frame_of(map.m, wi.x, wi.y, wi.z);
    v->distribution = map.distribution;
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
VNDF_RARE vndf_view view_of_ggx(const vndf_surface *m, vndf_vec3 wi)
{
    vndf_view v;
    view_into(&v, m, wi, VNDF_KIND_GGX);
    return v;
}

VNDF_RARE vndf_view view_of_beckmann(const vndf_surface *m, vndf_vec3 wi)
{
    vndf_view v;
    view_into(&v, m, wi, VNDF_KIND_BECKMANN);
    return v;
}

VNDF_RARE vndf_view view_of_table(const vndf_surface *m, vndf_vec3 wi)
{
    vndf_view v;
    view_into(&v, m, wi, VNDF_KIND_TABLE);
    return v;
}

VNDF_INLINE vndf_kind kind_of(const vndf_surface *m)
{
    return m && m->distribution ? m->distribution->kind : VNDF_KIND_TABLE;
}

vndf_view vndf_view_from(const vndf_surface *m, vndf_vec3 wi)
{
    switch (kind_of(m)) {
    case VNDF_KIND_GGX: return view_of_ggx(m, wi);
    case VNDF_KIND_BECKMANN: return view_of_beckmann(m, wi);
    default: return view_of_table(m, wi);
    }
}

void vndf_view_make(vndf_view *v, const vndf_surface *m, vndf_vec3 wi)
{
    switch (kind_of(m)) {
    case VNDF_KIND_GGX: view_into(v, m, wi, VNDF_KIND_GGX); break;
    case VNDF_KIND_BECKMANN: view_into(v, m, wi, VNDF_KIND_BECKMANN); break;
    default: view_into(v, m, wi, VNDF_KIND_TABLE);
    }
}

/* ---- samples ---- */

VNDF_INLINE sampled draw(const vndf_view *v, float w1, float w2, const int weighs)
{
    const sampled none = {{0.0f, 0.0f, 1.0f}, 0.0f, 0.0f};
    if (!v->distribution)
        return none;
    const float u1 = unit_number(w1), u2 = unit_number(w2);
    return sample_on(vndf_state_of(v)->f, vndf_is_below(v) ? unit_draw(vndf_seen(v, 1, weighs), u1, u2)
                                                           : unit_draw(vndf_seen(v, 0, weighs), u1, u2));
}

vndf_vec3 vndf_sample(const vndf_view *v, float u1, float u2, float *pdf)
{
    sampled n = draw(v, u1, u2, 0);
    if (pdf)
        *pdf = n.pdf;
    return vndf_packed(n.wm);
}

vndf_vec3 vndf_sample_weight(const vndf_view *v, float u1, float u2, float *pdf, float *weight)
{
    sampled n = draw(v, u1, u2, 1);
    if (pdf)
        *pdf = n.pdf;
    if (weight)
        *weight = n.weight;
    return vndf_packed(n.wm);
}

static vndf_drawn_normal drawn_of(sampled n)
{
    const vndf_drawn_normal d = {vndf_packed(n.wm), n.pdf, n.weight};
    return d;
}

vndf_drawn_normal vndf_sample_visible(const vndf_view *v, float u1, float u2)
{
    return drawn_of(draw(v, u1, u2, 1));
}

/* ---- given normals ---- */

float vndf_pdf(const vndf_view *v, vndf_vec3 wm)
{
    if (!v->distribution)
        return 0.0f;
    return pdf(vndf_seen(v, vndf_is_below(v), 0), wm);
}

float vndf_visible(const vndf_view *v, vndf_vec3 wm)
{
    if (!v->distribution)
        return 0.0f;
    return visible(vndf_seen(v, vndf_is_below(v), 0), wm);
}

void vndf_invert(const vndf_view *v, vndf_vec3 wm, float *u1, float *u2)
{
    pair u = {0.0f, 0.0f};
    if (v->distribution)
        u = vndf_is_below(v) ? invert(vndf_seen(v, 1, 0), wm) : invert(vndf_seen(v, 0, 0), wm);
    *u1 = u.a;
    *u2 = u.b;
}

float vndf_view_ndf(const vndf_view *v, vndf_vec3 wm)
{
    return v->distribution ? seen_ndf(vndf_seen(v, 0, 0), wm) : 0.0f;
}

/* ---- areas ---- */

float vndf_view_own_area(const vndf_view *v)
{
    return v->distribution ? area(vndf_seen(v, vndf_is_below(v), 0)) : 0.0f;
}

float vndf_view_drawn_area(const vndf_view *v)
{
    return v->distribution ? drawn_area(vndf_seen(v, vndf_is_below(v), 0)) : 0.0f;
}

float vndf_view_area(const vndf_view *v, vndf_vec3 w)
{
    return v->distribution ? area_along(vndf_seen(v, 0, 0), w) : 0.0f;
}

float vndf_view_cosine(const vndf_view *v, vndf_vec3 w)
{
    return v->distribution ? cosine_along(vndf_seen(v, 0, 0), w) : 0.0f;
}

/* ---- surfaces ---- */

/* The normal (-x, -y, 1) has the slope (x, y), and P22 over z^4 is P22. */
float vndf_p22(const vndf_surface *m, float x, float y)
{
    vndf_vec3 normal = {-x, -y, 1.0f};
    return abs(x) <= FLT_MAX && abs(y) <= FLT_MAX ? vndf_ndf(m, normal) : 0.0f;
}

float vndf_g2_of(float gi, float go, vndf_g2_model model)
{
    return model == VNDF_G2_SEPARABLE ? gi * go : g2_of(gi, go);
}

float vndf_g2(const vndf_surface *m, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    return vndf_g2_of(vndf_g1(m, wi), vndf_g1(m, wo), model);
}

/* ---- other normals ---- */

/* V-cavities draw what they draw of all normals, by the mirror twin that wi sees. */
vndf_drawn_normal vndf_sample_by(const vndf_view *v, vndf_normals_drawn law, float w1, float w2)
{
    const view s = vndf_seen(v, vndf_is_below(v), 1);
    const frame f = view_frame(s), up = frame_of(f.m, 0.0f, 0.0f, 1.0f);
    const float u1 = unit_number(w1), u2 = unit_number(w2);
    if (law == VNDF_NORMALS_BOUNDED)
        return drawn_of(bounded_sample(s, u1, u2));
    const any_slope r = unit_slope(s.kind, view_table(s), up, u2);
    const surface_sample n = law == VNDF_NORMALS_V_CAVITY
                                 ? frame_sampled(f, v_cavity_draw(r, f.ux, f.uy, f.uz, u1))
                                 : frame_sampled(up, all_normals_draw(r, u1));
    const double facing = ((double)v->wi.x * n.x + (double)v->wi.y * n.y) + (double)v->wi.z * n.z;
    return drawn_of(weighed_normal(s, vec3(n.x, n.y, n.z), (float)facing, n.pdf));
}

float vndf_pdf_by(const vndf_view *v, vndf_normals_drawn law, vndf_vec3 wm)
{
    const view s = vndf_seen(v, vndf_is_below(v), 0);
    const float all = law == VNDF_NORMALS_BOUNDED ? bounded_pdf(s, wm) : seen_ndf(s, wm) * wm.z;
    if (law == VNDF_NORMALS_V_CAVITY)
        return all * v_cavity_share(v->wi.x * wm.x + v->wi.y * wm.y, v->wi.z * wm.z);
    return all;
}
