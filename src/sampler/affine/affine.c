/* The public calls on affine surfaces (principal.h): those of the surface along its principal axes, and what the mean
 * slope and the turn do to normals and densities. */
#include "math/vector.h"
#include "sampler/affine/areas.h"
#include "sampler/affine/densities.h"
#include "sampler/affine/principal.h"
#include "sampler/area.h"
#include "sampler/query.h"

/* ---- views ---- */

/* Without a turn and a mean slope it is a surface as any other. */
static int is_straight(const vndf_affine *a)
{
    return vndf_affine_is_diagonal(a) && a->mean_x == 0.0f && a->mean_y == 0.0f;
}

/* Members are written one by one, and of a straight view no more than are read: a copy would be waited for. */
vndf_affine_view vndf_affine_view_from(const vndf_affine *surface, vndf_vec3 wi)
{
    vndf_affine_view view;
    vndf_principal p;
    view.straight = 1;
    view.principal.distribution = NULL;
    if (!surface || !surface->distribution)
        return view;
    if (is_straight(surface)) {
        vndf_surface same = {surface->distribution, fabsf(surface->xx), fabsf(surface->yy)};
        vndf_view_set(&view.principal, &same, wi);
        return view;
    }
    if (!vndf_principal_of(surface, &p) || !vndf_is_usable_direction(wi))
        return view;
    vndf_normal to = vndf_principal_direction(&p, wi);
    view.straight = 0;
    view.wi = wi;
    view.cosine = p.cosine;
    view.sine = p.sine;
    view.mean_x = p.mean_x;
    view.mean_y = p.mean_y;
    view.length = vndf_normal_length(to);
    to = vndf_normal_times(to, 1.0 / view.length);
    vndf_vec3 w = {(float)to.x, (float)to.y, (float)to.z};
    view.principal = vndf_view_scaled(surface->distribution, p.ax, p.ay, w);
    return view;
}

static vndf_principal principal_of(const vndf_affine_view *view)
{
    const vndf_view *of = &view->principal;
    vndf_principal p = {of->alpha_x, of->alpha_y, view->cosine, view->sine, view->mean_x, view->mean_y};
    return p;
}

static int is_facing(const vndf_affine_view *view, vndf_vec3 wm)
{
    return wm.z >= 0.0f && vndf_exact_dot(view->wi, wm) > 0.0;
}

/* ---- normals ---- */

/* The normal of one that was drawn. */
static vndf_vec3 normal_from(const vndf_affine_view *view, vndf_normal n)
{
    vndf_principal p = principal_of(view);
    vndf_normal to = vndf_principal_back(&p, n);
    double per = 1.0 / vndf_normal_length(to);
    return vndf_vec3_of((float)(to.x * per), (float)(to.y * per), (float)(to.z * per));
}

/* One that rounding has turned away from wi, moved towards wi' by as little as turns it back. Where that fails, wi is
 * within rounding of straight down, or looks along the surface: the horizontal normal towards it is taken. */
static vndf_vec3 turned_back(const vndf_affine_view *view, vndf_vec3 drawn, vndf_vec3 wm)
{
    vndf_vec3 to = view->principal.wi, level = {view->wi.x, view->wi.y, 0.0f};
    for (double step = 0x1p-24; step < 1e-4 && !is_facing(view, wm); step *= 2.0) {
        double z = drawn.z + step * to.z;
        vndf_normal moved = {drawn.x + step * to.x, drawn.y + step * to.y, z > 0.0 ? z : 0.0};
        wm = normal_from(view, moved);
    }
    return is_facing(view, wm) || (level.x == 0.0f && level.y == 0.0f) ? wm : vndf_normalize(level);
}

vndf_vec3 vndf_affine_sample(const vndf_affine_view *view, float u1, float u2, float *pdf)
{
    if (view->straight)
        return vndf_sample(&view->principal, u1, u2, pdf);
    vndf_vec3 drawn = vndf_law_sample(&view->principal, vndf_clamp_unit(u1), vndf_clamp_unit(u2), NULL);
    vndf_vec3 wm = normal_from(view, vndf_normal_of(drawn));
    if (!is_facing(view, wm))
        wm = turned_back(view, drawn, wm);
    if (pdf)
        *pdf = vndf_affine_pdf(view, wm);
    return wm;
}

/* ---- densities ---- */

/* n/|n|, and |n|. */
typedef struct seen {
    vndf_normal n;
    double length;
} seen;

static seen seen_from(const vndf_affine_view *view, vndf_normal wm)
{
    vndf_principal p = principal_of(view);
    vndf_normal n = vndf_principal_normal(&p, wm);
    double length = vndf_normal_length(n);
    seen s = {vndf_normal_times(n, 1.0 / length), length};
    return s;
}

static double cube(double x)
{
    return x * x * x;
}

/* wi'.n is wi.wm, which loses no digits, over both lengths. */
static float visible_of(const vndf_affine_view *view, vndf_vec3 wm)
{
    seen s = seen_from(view, vndf_normal_of(wm));
    double facing = vndf_exact_dot(view->wi, wm) / (view->length * s.length);
    return vndf_density_from(vndf_normal_visible(&view->principal, s.n, facing) / cube(s.length));
}

vndf_densities vndf_affine_densities(const vndf_affine_view *view, vndf_normal wm, double facing)
{
    const vndf_view *of = &view->principal;
    seen s = {wm, 1.0};
    double over = 1.0;
    if (!view->straight) {
        s = seen_from(view, wm);
        facing /= view->length * s.length;
        over = 1.0 / cube(s.length);
    }
    double visible = vndf_normal_visible(of, s.n, facing);
    vndf_densities d = {(vndf_law_is_exact(of->distribution) ? visible : vndf_normal_pdf(of, s.n)) * over,
                        visible * over};
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
        return vndf_positive(visible_of(view, wm));
    seen s = seen_from(view, vndf_normal_of(wm));
    return vndf_positive(vndf_density_from(vndf_normal_pdf(&view->principal, s.n) / cube(s.length)));
}

float vndf_affine_visible(const vndf_affine_view *view, vndf_vec3 wm)
{
    if (view->straight)
        return vndf_visible(&view->principal, wm);
    if (!is_facing(view, wm))
        return 0.0f;
    float visible = visible_of(view, wm);
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
    vndf_normal n = seen_from(view, vndf_normal_of(wm)).n;
    vndf_law_invert(&view->principal, vndf_vec3_of((float)n.x, (float)n.y, (float)n.z), u1, u2);
}

/* ---- surfaces ---- */

float vndf_affine_ndf(const vndf_affine *surface, vndf_vec3 wm)
{
    vndf_principal p;
    if (!vndf_principal_of(surface, &p) || !(wm.z >= 0.0f) || !vndf_is_usable_direction(wm))
        return 0.0f;
    vndf_normal n = vndf_principal_normal(&p, vndf_normal_of(wm));
    double length = vndf_normal_length(n), square = length * length;
    double ndf = vndf_normal_ndf(surface->distribution, p.ax, p.ay, vndf_normal_times(n, 1.0 / length));
    return vndf_density_from(ndf / (square * square));
}

float vndf_affine_p22(const vndf_affine *surface, float x, float y)
{
    vndf_principal p;
    if (!vndf_principal_of(surface, &p) || !(fabsf(x) < HUGE_VALF) || !(fabsf(y) < HUGE_VALF))
        return 0.0f;
    double along = (p.cosine * x + p.sine * y - p.mean_x) / p.ax,
           aside = (p.cosine * y - p.sine * x - p.mean_y) / p.ay;
    double p22 = vndf_law_p22(surface->distribution, along * along + aside * aside);
    return vndf_density_from(p22 / p.ax / p.ay);
}

/* w' with the roughness; of an invalid surface or direction invalid. */
static vndf_direction direction_of(const vndf_affine *surface, vndf_vec3 w)
{
    vndf_principal p;
    if (!vndf_principal_of(surface, &p) || !vndf_is_usable_direction(w))
        return (vndf_direction){0};
    vndf_normal to = vndf_principal_direction(&p, w);
    vndf_direction direction = {p.ax, p.ay, to.x, to.y, to.z};
    return direction;
}

static void set_areas(const vndf_distribution *d, const vndf_direction *to, vndf_areas *areas)
{
    double below = vndf_law_area_below(d, to, 1);
    areas->toward = below + doubles_positive(to->z);
    areas->away = below + doubles_positive(-to->z);
    areas->up = to->z;
}

int vndf_affine_areas(const vndf_affine *surface, vndf_vec3 w, vndf_areas *areas)
{
    vndf_direction to = direction_of(surface, w);
    if (!vndf_direction_is_valid(&to))
        return 0;
    set_areas(surface->distribution, &to, areas);
    return 1;
}

void vndf_affine_view_areas(const vndf_affine_view *view, vndf_vec3 w, vndf_areas *areas)
{
    const vndf_view *of = &view->principal;
    vndf_direction to = {of->alpha_x, of->alpha_y, w.x, w.y, w.z};
    if (!view->straight) {
        vndf_principal p = principal_of(view);
        vndf_normal n = vndf_principal_direction(&p, w);
        to.x = n.x;
        to.y = n.y;
        to.z = n.z;
    }
    set_areas(of->distribution, &to, areas);
}

float vndf_affine_projected_area(const vndf_affine *surface, vndf_vec3 w)
{
    vndf_areas areas;
    return vndf_affine_areas(surface, w, &areas) ? (float)(areas.toward / vndf_normal_length(vndf_normal_of(w)))
                                                 : 0.0f;
}

float vndf_affine_lambda(const vndf_affine *surface, vndf_vec3 w)
{
    vndf_direction to = direction_of(surface, w);
    return vndf_direction_is_valid(&to) ? vndf_lambda_of(surface->distribution, &to) : 0.0f;
}

float vndf_affine_g1(const vndf_affine *surface, vndf_vec3 w)
{
    vndf_direction to = direction_of(surface, w);
    return vndf_direction_is_valid(&to) ? vndf_g1_of(surface->distribution, &to) : 0.0f;
}

float vndf_affine_g2(const vndf_affine *surface, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    return vndf_g2_of(vndf_affine_g1(surface, wi), vndf_affine_g1(surface, wo), model);
}
