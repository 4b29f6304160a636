/* Several lobes on one surface: the public calls. All of Smith's theory is linear in D, so that sums over lobes are all
 * there is. */
#include "math/vector.h"
#include "sampler/affine/areas.h"
#include "sampler/affine/densities.h"
#include "sampler/surface.h"

/* One over the sum of the weights; 0 if a weight or the count is invalid. */
static double per_weight(const vndf_mixture *m)
{
    double sum = 0.0;
    if (!m || m->count < 1 || m->count > VNDF_MIXTURE_LOBES)
        return 0.0;
    for (int i = 0; i < m->count; i++) {
        if (!(m->lobe[i].weight >= 0.0f && m->lobe[i].weight < HUGE_VALF))
            return 0.0;
        sum += m->lobe[i].weight;
    }
    return sum > 0.0 ? 1.0 / sum : 0.0;
}

/* ---- views ---- */

/* Shares of u1: those of the areas, or of the weights where all areas vanish, far below the horizon. */
static void share(vndf_mixture_view *view, const double *area)
{
    view->begin[0] = 0.0;
    for (int i = 0; i < view->count; i++)
        view->begin[i + 1] = view->begin[i] + (view->area > 0.0 ? area[i] / view->area : view->weight[i]);
    view->begin[view->count] = 1.0;
}

void vndf_mixture_view_set(vndf_mixture_view *view, const vndf_mixture *mixture, vndf_vec3 wi)
{
    double area[VNDF_MIXTURE_LOBES], per = per_weight(mixture);
    view->count = 0;
    view->area = view->mean_x = view->mean_y = 0.0;
    for (int i = 0; per > 0.0 && i < mixture->count; i++) {
        const vndf_mixture_lobe *lobe = &mixture->lobe[i];
        vndf_areas areas;
        int valid;
        if (lobe->weight == 0.0f)
            continue;
        view->lobe[view->count] = vndf_affine_lobe(&lobe->surface, wi, &areas, &valid); /* in place, not copied */
        if (!valid) {
            view->count = 0;
            return;
        }
        area[view->count] = lobe->weight * per * areas.toward;
        view->weight[view->count] = lobe->weight * per;
        view->area += area[view->count];
        view->mean_x += lobe->weight * per * lobe->surface.mean_x;
        view->mean_y += lobe->weight * per * lobe->surface.mean_y;
        view->index[view->count++] = i;
    }
    if (view->count > 0)
        share(view, area);
}

vndf_mixture_view vndf_mixture_view_from(const vndf_mixture *mixture, vndf_vec3 wi)
{
    vndf_mixture_view view;
    vndf_mixture_view_set(&view, mixture, wi);
    return view;
}

static double share_of(const vndf_mixture_view *view, int i)
{
    return view->begin[i + 1] - view->begin[i];
}

/* ---- densities ---- */

/* Of all lobes but one. */
static double pdf_but(const vndf_mixture_view *view, int but, vndf_vec3 wm)
{
    double sum = 0.0;
    for (int i = 0; i < view->count; i++)
        if (i != but)
            sum += share_of(view, i) * vndf_affine_pdf(&view->lobe[i], wm);
    return sum;
}

float vndf_mixture_pdf(const vndf_mixture_view *view, vndf_vec3 wm)
{
    double pdf = pdf_but(view, -1, wm);
    return pdf > 0.0 ? vndf_positive(vndf_density_from(pdf)) : 0.0f;
}

float vndf_mixture_visible(const vndf_mixture_view *view, vndf_vec3 wm)
{
    double visible = 0.0;
    for (int i = 0; i < view->count; i++)
        visible += share_of(view, i) * vndf_affine_visible(&view->lobe[i], wm);
    return vndf_density_from(visible);
}

vndf_densities vndf_mixture_densities(const vndf_mixture_view *view, vndf_normal wm, double facing)
{
    vndf_densities sum = {0.0, 0.0};
    for (int i = 0; i < view->count; i++) {
        vndf_densities d = vndf_affine_densities(&view->lobe[i], wm, facing);
        sum.pdf += share_of(view, i) * d.pdf;
        sum.visible += share_of(view, i) * d.visible;
    }
    return sum;
}

/* ---- samples ---- */

/* The last lobe that begins at or below u and is drawn at all. */
static int lobe_at(const vndf_mixture_view *view, double u)
{
    int at = 0;
    for (int i = 1; i < view->count; i++)
        if (view->begin[i] <= u && share_of(view, i) > 0.0)
            at = i;
    return at;
}

vndf_vec3 vndf_mixture_sample(const vndf_mixture_view *view, float u1, float u2, float *pdf, int *lobe)
{
    vndf_vec3 up = {0.0f, 0.0f, 1.0f};
    float own;
    if (lobe)
        *lobe = -1;
    if (pdf)
        *pdf = 0.0f;
    if (view->count < 1)
        return up;
    double u = vndf_clamp_unit(u1);
    int i = lobe_at(view, u);
    float part = (float)((u - view->begin[i]) / share_of(view, i));
    vndf_vec3 wm = vndf_affine_sample(&view->lobe[i], part, u2, pdf ? &own : NULL);
    if (lobe)
        *lobe = view->index[i];
    if (pdf) {
        double sum = share_of(view, i) * own + pdf_but(view, i, wm);
        *pdf = sum > 0.0 ? vndf_positive(vndf_density_from(sum)) : 0.0f;
    }
    return wm;
}

/* The lobe whose share of the density at wm is largest. */
static int likeliest(const vndf_mixture_view *view, vndf_vec3 wm)
{
    double most = -1.0;
    int at = -1;
    for (int i = 0; i < view->count; i++) {
        double pdf = share_of(view, i) * vndf_affine_pdf(&view->lobe[i], wm);
        if (pdf > most && share_of(view, i) > 0.0) {
            most = pdf;
            at = i;
        }
    }
    return at;
}

static int place_of(const vndf_mixture_view *view, int lobe)
{
    for (int i = 0; i < view->count; i++)
        if (view->index[i] == lobe && share_of(view, i) > 0.0)
            return i;
    return -1;
}

int vndf_mixture_invert(const vndf_mixture_view *view, vndf_vec3 wm, int lobe, float *u1, float *u2)
{
    *u1 = *u2 = 0.0f;
    if (!(wm.z >= 0.0f) || !vndf_is_usable_direction(wm))
        return -1;
    int i = lobe == -1 ? likeliest(view, wm) : place_of(view, lobe);
    if (i < 0)
        return -1;
    vndf_affine_invert(&view->lobe[i], wm, u1, u2);
    *u1 = vndf_clamp_unit((float)(view->begin[i] + share_of(view, i) * *u1));
    return view->index[i];
}

/* ---- the surface ---- */

float vndf_mixture_ndf(const vndf_mixture *mixture, vndf_vec3 wm)
{
    double sum = 0.0, per = per_weight(mixture);
    for (int i = 0; per > 0.0 && i < mixture->count; i++)
        if (mixture->lobe[i].weight > 0.0f)
            sum += mixture->lobe[i].weight * per * vndf_affine_ndf(&mixture->lobe[i].surface, wm);
    return vndf_density_from(sum);
}

float vndf_mixture_p22(const vndf_mixture *mixture, float x, float y)
{
    double sum = 0.0, per = per_weight(mixture);
    for (int i = 0; per > 0.0 && i < mixture->count; i++)
        if (mixture->lobe[i].weight > 0.0f)
            sum += mixture->lobe[i].weight * per * vndf_affine_p22(&mixture->lobe[i].surface, x, y);
    return vndf_density_from(sum);
}

VNDF_INLINE void add_areas(vndf_areas *whole, double weight, const vndf_areas *part)
{
    whole->toward += weight * part->toward;
    whole->away += weight * part->away;
    whole->up += weight * part->up;
}

void vndf_mixture_view_areas(const vndf_mixture_view *view, vndf_vec3 w, vndf_areas *areas)
{
    *areas = (vndf_areas){0.0, 0.0, 0.0};
    for (int i = 0; i < view->count; i++) {
        vndf_areas part;
        vndf_affine_view_areas(&view->lobe[i], w, &part);
        add_areas(areas, view->weight[i], &part);
    }
}

/* Of the whole; 0 where it or the direction is invalid. */
static int areas_of(const vndf_mixture *mixture, vndf_vec3 w, vndf_areas *whole)
{
    double per = per_weight(mixture);
    *whole = (vndf_areas){0.0, 0.0, 0.0};
    for (int i = 0; per > 0.0 && i < mixture->count; i++) {
        double weight = mixture->lobe[i].weight * per;
        vndf_areas areas;
        if (weight == 0.0)
            continue;
        if (!vndf_affine_areas(&mixture->lobe[i].surface, w, &areas))
            return 0;
        add_areas(whole, weight, &areas);
    }
    return per > 0.0;
}

float vndf_mixture_projected_area(const vndf_mixture *mixture, vndf_vec3 w)
{
    vndf_areas areas;
    return areas_of(mixture, w, &areas) ? vndf_unit_area_of(areas.toward, vndf_normal_of(w), 1) : 0.0f;
}

float vndf_mixture_lambda(const vndf_mixture *mixture, vndf_vec3 w)
{
    vndf_areas areas;
    if (!areas_of(mixture, w, &areas))
        return 0.0f;
    return vndf_areas_lambda(&areas);
}

float vndf_mixture_g1(const vndf_mixture *mixture, vndf_vec3 w)
{
    vndf_areas areas;
    return areas_of(mixture, w, &areas) ? vndf_areas_g1(&areas) : 0.0f;
}

float vndf_mixture_g2(const vndf_mixture *mixture, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    return vndf_g2_of(vndf_mixture_g1(mixture, wi), vndf_mixture_g1(mixture, wo), model);
}
