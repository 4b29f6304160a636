/* Mixtures of surfaces: D = sum of w_i D_i gives A = sum of w_i A_i and Dv = sum of (w_i A_i/A) Dv_i (Heitz &
 * d'Eon 2014 are linear in D; d'Eon et al. 2023). Lobe i is drawn with the share w_i A_i/A, in which A_i is the area
 * that is drawn of it, and the density is the whole sum. Shares are kept themselves, never as differences of running
 * sums: that of a faint lobe has all its digits. */
#include "sampler/lobes.h"
#include "sampler/sampler.h"

/* ---- views ---- */

/* The weights of a mixture over their sum; 0 if they are invalid. */
static int weights_of(const vndf_mixture *mixture, float weight[VNDF_MIXTURE_LOBES])
{
    if (!mixture || mixture->count < 1 || mixture->count > VNDF_MIXTURE_LOBES)
        return 0;
    for (int i = 0; i < mixture->count; i++)
        weight[i] = mixture->lobe[i].weight;
    return vndf_weigh_lobes(mixture->count, 1, weight);
}

static void shares_of(const vndf_mixture_view *view, float (*area)(const vndf_view *view), float share[])
{
    float weight[VNDF_MIXTURE_LOBES];
    for (int i = 0; i < view->count; i++) {
        weight[i] = view->part[i].weight;
        share[i] = area(&view->part[i].view);
    }
    vndf_share_lobes(view->count, 1, 1, weight, share);
}

vndf_mixture_view vndf_mixture_view_from(const vndf_mixture *mixture, vndf_vec3 wi)
{
    vndf_mixture_view view;
    float weight[VNDF_MIXTURE_LOBES], share[VNDF_MIXTURE_LOBES];
    view.count = 0;
    if (!weights_of(mixture, weight))
        return view;
    for (int i = 0; i < mixture->count; i++) {
        vndf_mixture_part *part = &view.part[view.count];
        if (weight[i] == 0.0f)
            continue;
        vndf_view_make(&part->view, &mixture->lobe[i].surface, wi);
        if (!part->view.distribution) {
            view.count = 0;
            return view;
        }
        part->lobe = i;
        part->weight = weight[i];
        view.count++;
    }
    shares_of(&view, vndf_view_drawn_area, share);
    for (int i = 0; i < view.count; i++)
        view.part[i].share = share[i];
    return view;
}

/* ---- samples and densities ---- */

/* The density of the whole, of which lobe `drawn` has the density `known`; none is known if that is -1. It is 0 where
 * no lobe sees wm. */
static float density_with(const vndf_mixture_view *view, vndf_vec3 wm, int drawn_lobe, float known)
{
    float sum = 0.0f, largest = 0.0f;
    for (int i = 0; i < view->count; i++) {
        const float density = i == drawn_lobe ? known : vndf_pdf(&view->part[i].view, wm);
        sum += view->part[i].share * density;
        largest = max(largest, density);
    }
    return largest > 0.0f ? min(max(sum, FLT_MIN), FLT_MAX) : 0.0f;
}

vndf_vec3 vndf_mixture_sample(const vndf_mixture_view *view, float u1, float u2, float *pdf, int *lobe)
{
    vndf_vec3 wm = {0.0f, 0.0f, 1.0f};
    float begin = 0.0f, end = 0.0f, density = 0.0f, u = vndf_clamp_unit(u1);
    int i = 0;
    for (int l = 0; l < view->count; l++)
        if (view->part[l].share > 0.0f && u >= end) { /* the last one takes what rounding leaves */
            i = l;
            begin = end;
            end += view->part[l].share;
        }
    if (view->count) {
        wm = vndf_sample(&view->part[i].view, (u - begin) / view->part[i].share, u2, &density);
        density = density > 0.0f ? density_with(view, wm, i, density) : 0.0f;
    }
    if (pdf)
        *pdf = density;
    if (lobe)
        *lobe = view->count ? view->part[i].lobe : -1;
    return wm;
}

float vndf_mixture_pdf(const vndf_mixture_view *view, vndf_vec3 wm)
{
    return density_with(view, wm, -1, 0.0f);
}

float vndf_mixture_visible(const vndf_mixture_view *view, vndf_vec3 wm)
{
    float sum = 0.0f, share[VNDF_MIXTURE_LOBES];
    shares_of(view, vndf_view_own_area, share);
    for (int i = 0; i < view->count; i++)
        sum += share[i] * vndf_visible(&view->part[i].view, wm);
    return min(sum, FLT_MAX);
}

int vndf_mixture_invert(const vndf_mixture_view *view, vndf_vec3 wm, int lobe, float *u1, float *u2)
{
    float begin = 0.0f, best = -1.0f, best_begin = 0.0f;
    int found_lobe = -1;
    for (int i = 0; i < view->count; i++) {
        float drawn_here = lobe >= 0 ? 0.0f : view->part[i].share * vndf_pdf(&view->part[i].view, wm);
        if ((lobe >= 0 && view->part[i].lobe == lobe) || (lobe < 0 && drawn_here > best)) {
            best = drawn_here;
            best_begin = begin;
            found_lobe = i;
        }
        begin += view->part[i].share;
    }
    *u1 = *u2 = 0.0f;
    if (found_lobe < 0)
        return -1;
    vndf_invert(&view->part[found_lobe].view, wm, u1, u2);
    *u1 = vndf_clamp_unit(best_begin + *u1 * view->part[found_lobe].share);
    return view->part[found_lobe].lobe;
}

/* ---- the whole ---- */

/* A function of the views, weighed. */
typedef float of_view(const vndf_view *view, vndf_vec3 w);

static float sum_of_views(const vndf_mixture_view *view, of_view *function, vndf_vec3 w)
{
    float sum = 0.0f;
    for (int i = 0; i < view->count; i++)
        sum += view->part[i].weight * function(&view->part[i].view, w);
    return sum;
}

float vndf_mixture_view_ndf(const vndf_mixture_view *view, vndf_vec3 wm)
{
    return min(sum_of_views(view, vndf_view_ndf, wm), FLT_MAX);
}

float vndf_mixture_view_area(const vndf_mixture_view *view, vndf_vec3 w)
{
    return sum_of_views(view, vndf_view_area, w);
}

float vndf_mixture_view_cosine(const vndf_mixture_view *view, vndf_vec3 w)
{
    return sum_of_views(view, vndf_view_cosine, w);
}

/* A function of the surfaces, weighed. */
typedef float of_surface(const vndf_surface *surface, vndf_vec3 w);

static float weighed_sum(const vndf_mixture *mixture, of_surface *function, vndf_vec3 w)
{
    float weight[VNDF_MIXTURE_LOBES], sum = 0.0f;
    if (!weights_of(mixture, weight))
        return 0.0f;
    for (int i = 0; i < mixture->count; i++)
        sum += weight[i] > 0.0f ? weight[i] * function(&mixture->lobe[i].surface, w) : 0.0f;
    return min(sum, FLT_MAX);
}

static float cosine_of(const vndf_surface *s, vndf_vec3 w)
{
    return w.z - (w.x * s->mean_x + w.y * s->mean_y);
}

float vndf_mixture_ndf(const vndf_mixture *mixture, vndf_vec3 wm)
{
    return weighed_sum(mixture, vndf_ndf, wm);
}

static float p22_at(const vndf_surface *s, vndf_vec3 slope)
{
    return vndf_p22(s, slope.x, slope.y);
}

float vndf_mixture_p22(const vndf_mixture *mixture, float x, float y)
{
    vndf_vec3 slope = {x, y, 0.0f};
    return weighed_sum(mixture, p22_at, slope);
}

float vndf_mixture_projected_area(const vndf_mixture *mixture, vndf_vec3 w)
{
    return weighed_sum(mixture, vndf_projected_area, w);
}

float vndf_mixture_lambda(const vndf_mixture *mixture, vndf_vec3 w)
{
    return lambda_of(vndf_mixture_projected_area(mixture, w), weighed_sum(mixture, cosine_of, w));
}

float vndf_mixture_g1(const vndf_mixture *mixture, vndf_vec3 w)
{
    return g1_of(vndf_mixture_projected_area(mixture, w), weighed_sum(mixture, cosine_of, w));
}

float vndf_mixture_g2(const vndf_mixture *mixture, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    return vndf_g2_of(vndf_mixture_g1(mixture, wi), vndf_mixture_g1(mixture, wo), model);
}
