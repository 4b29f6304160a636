/* The public calls on affine surfaces (principal.h): those of the plain surface along the principal axes, and what the
 * mean slope and the turn do to normals and densities. */
#include "math/vector.h"
#include "sampler/affine/areas.h"
#include "sampler/affine/densities.h"
#include "sampler/area.h"

/* ---- the plain surface ---- */

/* Without a turn and a mean slope it is a surface as any other. */
static int is_straight(const vndf_affine *a)
{
    return a->xy == 0.0f && a->yx == 0.0f && a->mean_x == 0.0f && a->mean_y == 0.0f;
}

VNDF_INLINE vndf_principal principal_of(const vndf_affine *a)
{
    vndf_slope_map map = {a->xx, a->xy, a->yx, a->yy, a->mean_x, a->mean_y};
    return vndf_principal_of(&map);
}

/* The plain surface and direction of an affine surface, which may be invalid, and a direction. */
typedef struct plain {
    vndf_principal axes;
    vndf_surface surface;
    vndf_toward to;
    vndf_vec3 wi; /* `to`, rounded */
} plain;

VNDF_INLINE plain plain_of(const vndf_affine *a, vndf_vec3 wi)
{
    plain of = {.surface = {NULL, 0.0f, 0.0f}};
    if (!a)
        return of;
    of.axes = principal_of(a);
    of.to = vndf_principal_toward(&of.axes, wi.x, wi.y, wi.z);
    of.surface.distribution = a->distribution;
    of.surface.alpha_x = of.axes.ax;
    of.surface.alpha_y = of.axes.ay;
    of.wi.x = (float)of.to.x;
    of.wi.y = (float)of.to.y;
    of.wi.z = (float)of.to.z;
    return of;
}

/* ---- views ---- */

/* Members are written one by one, and of a straight view no more than are read: a copy would be waited for. */
VNDF_INLINE void set_from_plain(vndf_affine_view *view, const plain *from, vndf_vec3 wi)
{
    vndf_view_set(&view->principal, &from->surface, from->wi);
    view->straight = from->axes.straight || !view->principal.distribution;
    view->wi = wi;
    view->cosine = from->axes.cosine;
    view->sine = from->axes.sine;
    view->mean_x = from->axes.mean_x;
    view->mean_y = from->axes.mean_y;
    view->factor = from->to.factor;
}

vndf_affine_view vndf_affine_view_from(const vndf_affine *surface, vndf_vec3 wi)
{
    vndf_affine_view view;
    view.straight = 1;
    view.principal.distribution = NULL;
    if (!surface || !surface->distribution)
        return view;
    if (is_straight(surface)) {
        vndf_surface same = {surface->distribution, fabsf(surface->xx), fabsf(surface->yy)};
        vndf_view_set(&view.principal, &same, wi);
        return view;
    }
    plain of = plain_of(surface, wi);
    set_from_plain(&view, &of, wi);
    return view;
}

static vndf_principal axes_of(const vndf_affine_view *view)
{
    const vndf_view *of = &view->principal;
    vndf_principal p = {of->ax, of->ay, view->cosine, view->sine, view->mean_x, view->mean_y, 0};
    return p;
}

static int is_facing(const vndf_affine_view *view, vndf_vec3 wm)
{
    return wm.z >= 0.0f && vndf_exact_dot(view->wi, wm) > 0.0;
}

/* ---- normals ---- */

static vndf_vec3 normal_of(const vndf_affine_drawn *at)
{
    return vndf_vec3_of(at->x, at->y, at->z);
}

VNDF_INLINE vndf_affine_drawn drawn_of(const vndf_affine_view *view, const vndf_principal *p, vndf_normal n,
                                       float density)
{
    const vndf_view *of = &view->principal;
    vndf_direction w = {of->alpha_x, of->alpha_y, of->wi.x, of->wi.y, of->wi.z};
    return vndf_principal_drawn(of->distribution, p, &w, vndf_normal_of(view->wi), n, density);
}

/* One that rounding has turned away from wi, moved towards wi' by as little as turns it back. Where that fails, wi is
 * within rounding of straight down, or looks along the surface: the horizontal normal towards it is taken. */
VNDF_RARE vndf_vec3 turned_back(const vndf_affine_view *view, const vndf_principal *p, vndf_vec3 drawn,
                                vndf_vec3 wm)
{
    vndf_vec3 to = vndf_normalize(view->principal.wi), level = {view->wi.x, view->wi.y, 0.0f};
    for (double step = 0x1p-24; step < 1e-4 && !is_facing(view, wm); step *= 2.0) {
        double z = drawn.z + step * to.z;
        vndf_normal moved = {drawn.x + step * to.x, drawn.y + step * to.y, z > 0.0 ? z : 0.0};
        vndf_affine_drawn at = drawn_of(view, p, moved, 0.0f);
        wm = normal_of(&at);
    }
    return is_facing(view, wm) || (level.x == 0.0f && level.y == 0.0f) ? wm : vndf_normalize(level);
}

vndf_vec3 vndf_affine_sample(const vndf_affine_view *view, float u1, float u2, float *pdf)
{
    float density = 0.0f;
    int fast;
    if (view->straight)
        return vndf_sample(&view->principal, u1, u2, pdf);
    vndf_principal p = axes_of(view);
    vndf_vec3 drawn =
        vndf_law_sample_telling(&view->principal, vndf_clamp_unit(u1), vndf_clamp_unit(u2), &density, &fast);
    vndf_affine_drawn at = drawn_of(view, &p, vndf_normal_of(drawn), density);
    vndf_vec3 wm = normal_of(&at);
    if (!(at.facing > 0.0))
        wm = turned_back(view, &p, drawn, wm);
    if (pdf)
        *pdf = fast & at.trusted ? vndf_positive(vndf_density_from(at.density)) : vndf_affine_pdf(view, wm);
    return wm;
}

/* ---- densities ---- */

static vndf_query query_of(const vndf_affine_view *view, vndf_normal wm)
{
    const vndf_view *of = &view->principal;
    vndf_principal p = axes_of(view);
    vndf_normal n = vndf_principal_normal(&p, wm);
    vndf_query g = {{of->alpha_x, of->alpha_y, of->wi.x, of->wi.y, of->wi.z}, n.x, n.y, n.z};
    return g;
}

/* wi'.n is wi.wm, which loses no digits. */
static double visible_of(const vndf_affine_view *view, vndf_vec3 wm)
{
    vndf_query g = query_of(view, vndf_normal_of(wm));
    double facing = vndf_exact_dot(view->wi, wm) * view->factor;
    return vndf_law_visible(view->principal.distribution, &g, facing);
}

vndf_densities vndf_affine_densities(const vndf_affine_view *view, vndf_normal wm, double facing)
{
    const vndf_view *of = &view->principal;
    vndf_query g = {{of->alpha_x, of->alpha_y, of->wi.x, of->wi.y, of->wi.z}, wm.x, wm.y, wm.z};
    if (!view->straight)
        g = query_of(view, wm);
    double visible = vndf_law_visible(of->distribution, &g, view->straight ? facing : facing * view->factor);
    vndf_densities d = {vndf_law_is_exact(of->distribution) ? visible : vndf_law_density(of, &g), visible};
    return d;
}

/* Closed forms draw with Dv itself, which has no use for wi' as it was rounded. */
float vndf_affine_pdf(const vndf_affine_view *view, vndf_vec3 wm)
{
    if (view->straight)
        return vndf_pdf(&view->principal, wm);
    if (!is_facing(view, wm))
        return 0.0f;
    if (vndf_law_is_exact(view->principal.distribution))
        return vndf_positive(vndf_density_from(visible_of(view, wm)));
    vndf_query g = query_of(view, vndf_normal_of(wm));
    return vndf_positive(vndf_density_from(vndf_law_density(&view->principal, &g)));
}

float vndf_affine_visible(const vndf_affine_view *view, vndf_vec3 wm)
{
    if (view->straight)
        return vndf_visible(&view->principal, wm);
    if (!is_facing(view, wm))
        return 0.0f;
    float visible = vndf_density_from(visible_of(view, wm));
    return vndf_law_is_exact(view->principal.distribution) ? vndf_positive(visible) : visible;
}

void vndf_affine_invert(const vndf_affine_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    *u1 = *u2 = 0.0f;
    if (view->straight) {
        vndf_invert(&view->principal, wm, u1, u2);
        return;
    }
    if (!(wm.z >= 0.0f) || !vndf_is_usable_direction(wm))
        return;
    vndf_query g = query_of(view, vndf_normal_of(wm));
    double per = 1.0 / sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
    vndf_vec3 n = {(float)(g.x * per), (float)(g.y * per), (float)(g.z * per)};
    vndf_law_invert(&view->principal, n, u1, u2);
}

/* ---- surfaces ---- */

static int areas_of(const plain *of, vndf_areas *areas)
{
    double ax, ay;
    if (!vndf_surface_scaled(&of->surface, &ax, &ay) || !vndf_is_usable_direction(of->wi))
        return 0;
    *areas = vndf_areas_of(of->surface.distribution, ax, ay, &of->to, 1);
    return 1;
}

float vndf_affine_ndf(const vndf_affine *surface, vndf_vec3 wm)
{
    vndf_query g = {{0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0.0, 0.0};
    if (!surface)
        return 0.0f;
    vndf_principal p = principal_of(surface);
    vndf_surface same = {surface->distribution, p.ax, p.ay};
    vndf_normal n = vndf_principal_normal(&p, vndf_normal_of(wm));
    if (!vndf_surface_scaled(&same, &g.wi.ax, &g.wi.ay))
        return 0.0f;
    g.x = n.x;
    g.y = n.y;
    g.z = n.z;
    return vndf_normal_is_valid(&g) ? vndf_density_from(vndf_law_ndf(surface->distribution, &g)) : 0.0f;
}

float vndf_affine_p22(const vndf_affine *surface, float x, float y)
{
    if (!surface)
        return 0.0f;
    vndf_principal p = principal_of(surface);
    vndf_surface same = {surface->distribution, p.ax, p.ay};
    double ax, ay;
    if (!vndf_surface_scaled(&same, &ax, &ay) || !(fabsf(x) < HUGE_VALF) || !(fabsf(y) < HUGE_VALF))
        return 0.0f;
    double along = (p.cosine * x + p.sine * y - p.mean_x) / ax,
           aside = (p.cosine * y - p.sine * x - p.mean_y) / ay;
    double p22 = vndf_law_p22(surface->distribution, along * along + aside * aside);
    return vndf_density_from(p22 / ax / ay);
}

float vndf_affine_projected_area(const vndf_affine *surface, vndf_vec3 w)
{
    plain of = plain_of(surface, w);
    vndf_areas areas;
    return areas_of(&of, &areas) ? vndf_unit_area_of(areas.toward, vndf_normal_of(w), 1) : 0.0f;
}

float vndf_affine_lambda(const vndf_affine *surface, vndf_vec3 w)
{
    plain of = plain_of(surface, w);
    return vndf_lambda(&of.surface, of.wi);
}

float vndf_affine_g1(const vndf_affine *surface, vndf_vec3 w)
{
    plain of = plain_of(surface, w);
    return vndf_g1(&of.surface, of.wi);
}

float vndf_affine_g2(const vndf_affine *surface, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    return vndf_g2_of(vndf_affine_g1(surface, wi), vndf_affine_g1(surface, wo), model);
}

/* ---- parts of a mixture ---- */

void vndf_affine_view_areas(const vndf_affine_view *view, vndf_vec3 w, vndf_areas *areas)
{
    const vndf_view *of = &view->principal;
    vndf_toward to = {w.x, w.y, w.z, 1.0};
    if (!view->straight) {
        vndf_principal p = axes_of(view);
        to = vndf_principal_toward(&p, w.x, w.y, w.z);
    }
    *areas = vndf_areas_of(of->distribution, of->alpha_x, of->alpha_y, &to, 1);
}

int vndf_affine_areas(const vndf_affine *surface, vndf_vec3 w, vndf_areas *areas)
{
    plain of = plain_of(surface, w);
    return areas_of(&of, areas);
}

vndf_affine_view vndf_affine_lobe(const vndf_affine *surface, vndf_vec3 wi, vndf_areas *areas, int *valid)
{
    vndf_affine_view view;
    view.straight = 1;
    if (is_straight(surface)) { /* it is asked for its area as it is */
        vndf_surface same = {surface->distribution, fabsf(surface->xx), fabsf(surface->yy)};
        vndf_toward to = {wi.x, wi.y, wi.z, 1.0};
        double ax, ay;
        *valid = vndf_surface_scaled(&same, &ax, &ay) && vndf_is_usable_direction(wi);
        if (*valid) {
            *areas = vndf_areas_of(surface->distribution, ax, ay, &to, 1);
            vndf_view_set(&view.principal, &same, wi);
        }
        return view;
    }
    plain of = plain_of(surface, wi);
    *valid = areas_of(&of, areas);
    if (*valid)
        set_from_plain(&view, &of, wi);
    return view;
}
