/* The calls of mixtures for one element: what is asked of invalid ones, and the text of kernel/mixture.h. */
#include "sampler/lobes.h"
#include "sampler/sampler.h"

/* ---- what kernel/mixture.h asks for ---- */

typedef const vndf_view *view;

/* With room for what is made of it. */
typedef struct mixture_view {
    const vndf_mixture_view *of;
    float *weights, *areas;
} mixture_view;

typedef struct sampled {
    vec3 wm;
    float pdf;
} sampled;

#define its_count(m) ((m).of->count)
#define its_view(m, i) (&(m).of->part[i].view)
#define its_share(m, i) ((m).of->part[i].share)
#define pdf(v, wm) vndf_pdf(v, vndf_packed(wm))
#define visible(v, wm) vndf_visible(v, vndf_packed(wm))

KERNEL lobe_numbers its_weights(mixture_view m)
{
    for (int i = 0; i < m.of->count; i++)
        m.weights[i] = m.of->part[i].weight;
    return (lobe_numbers){m.weights};
}

KERNEL lobe_numbers its_areas(mixture_view m)
{
    for (int i = 0; i < m.of->count; i++)
        m.areas[i] = vndf_view_own_area(its_view(m, i));
    return (lobe_numbers){m.areas};
}

KERNEL sampled sample(view v, float u1, float u2)
{
    sampled n;
    n.wm = vndf_sample(v, u1, u2, &n.pdf);
    return n;
}

#include "kernel/mixture.h"

/* ---- views ---- */

/* The weights of a mixture over their sum; 0 if they are invalid. */
static int weights_of(const vndf_mixture *m, float weight[VNDF_MIXTURE_LOBES])
{
    if (!m || m->count < 1 || m->count > VNDF_MIXTURE_LOBES)
        return 0;
    for (int i = 0; i < m->count; i++)
        weight[i] = m->lobe[i].weight;
    return vndf_weigh(weight, m->count);
}

vndf_mixture_view vndf_mixture_view_from(const vndf_mixture *m, vndf_vec3 wi)
{
    vndf_mixture_view v;
    float weight[VNDF_MIXTURE_LOBES], share[VNDF_MIXTURE_LOBES];
    v.count = 0;
    if (!weights_of(m, weight))
        return v;
    for (int i = 0; i < m->count; i++) {
        vndf_mixture_part *part = &v.part[v.count];
        if (weight[i] == 0.0f)
            continue;
        vndf_view_make(&part->view, &m->lobe[i].surface, wi);
        if (!part->view.distribution) {
            v.count = 0;
            return v;
        }
        part->lobe = i;
        part->weight = weight[v.count++] = weight[i];
    }
    for (int i = 0; i < v.count; i++)
        share[i] = vndf_view_drawn_area(&v.part[i].view);
    lobe_shares((lobe_numbers){weight}, (lobe_numbers){share}, v.count);
    for (int i = 0; i < v.count; i++)
        v.part[i].share = share[i];
    return v;
}

/* ---- samples and densities ---- */

vndf_vec3 vndf_mixture_sample(const vndf_mixture_view *v, float u1, float u2, float *pdf_of_all, int *lobe)
{
    mixed n = {{0.0f, 0.0f, 1.0f}, 0.0f, -1};
    if (v->count) {
        n = mixture_sample((mixture_view){v, NULL, NULL}, u1, u2);
        n.lobe = v->part[n.lobe].lobe;
    }
    if (pdf_of_all)
        *pdf_of_all = n.pdf;
    if (lobe)
        *lobe = n.lobe;
    return vndf_packed(n.wm);
}

float vndf_mixture_pdf(const vndf_mixture_view *v, vndf_vec3 wm)
{
    return mixture_pdf((mixture_view){v, NULL, NULL}, wm);
}

float vndf_mixture_visible(const vndf_mixture_view *v, vndf_vec3 wm)
{
    float by_weight[VNDF_MIXTURE_LOBES], by_area[VNDF_MIXTURE_LOBES];
    return mixture_visible((mixture_view){v, by_weight, by_area}, wm);
}

int vndf_mixture_invert(const vndf_mixture_view *v, vndf_vec3 wm, int lobe, float *u1, float *u2)
{
    float begin = 0.0f, best = -1.0f, best_begin = 0.0f;
    int found_lobe = -1;
    for (int i = 0; i < v->count; i++) {
        float drawn_here = lobe >= 0 ? 0.0f : v->part[i].share * vndf_pdf(&v->part[i].view, wm);
        if ((lobe >= 0 && v->part[i].lobe == lobe) || (lobe < 0 && drawn_here > best)) {
            best = drawn_here;
            best_begin = begin;
            found_lobe = i;
        }
        begin += v->part[i].share;
    }
    *u1 = *u2 = 0.0f;
    if (found_lobe < 0)
        return -1;
    vndf_invert(&v->part[found_lobe].view, wm, u1, u2);
    *u1 = unit_number(best_begin + *u1 * v->part[found_lobe].share);
    return v->part[found_lobe].lobe;
}

/* ---- the whole ---- */

/* A function of the views, weighed. */
typedef float of_view(const vndf_view *one, vndf_vec3 w);

static float sum_of_views(const vndf_mixture_view *v, of_view *function, vndf_vec3 w)
{
    float sum = 0.0f;
    for (int i = 0; i < v->count; i++)
        sum += v->part[i].weight * function(&v->part[i].view, w);
    return sum;
}

float vndf_mixture_view_ndf(const vndf_mixture_view *v, vndf_vec3 wm)
{
    return min(sum_of_views(v, vndf_view_ndf, wm), FLT_MAX);
}

float vndf_mixture_view_area(const vndf_mixture_view *v, vndf_vec3 w)
{
    return sum_of_views(v, vndf_view_area, w);
}

float vndf_mixture_view_cosine(const vndf_mixture_view *v, vndf_vec3 w)
{
    return sum_of_views(v, vndf_view_cosine, w);
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
