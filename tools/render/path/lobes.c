/* Rough materials that alpha along two axes does not describe: matrices, mean slopes, maps of slopes, several lobes.
 *
 * Mean slopes tilt the plane that the library calls the surface, and the shape stays where it is. The library takes
 * sides by the mean plane, rays by the shape: a direction that is above one and below the other is lost, drawn or
 * evaluated, and a ray that comes from such a direction sees black. So no light leaks through closed shapes, and
 * surfaces lose some light at grazing angles. */
#include "render/path/parts.h"

/* ---- a hit ---- */

/* Adds the slopes of the map: their mean, and M M^T + 2 covariance in the place of M M^T. Beckmann's slopes of alpha 1
 * have the variance 1/2 along each axis, so its second moments are those of both together. The new M is the triangle
 * of Cholesky. */
static void add_relief(const relief *r, const hit *h, vndf_affine *a)
{
    relief_slopes s;
    relief_at(r, h->u, h->v, &s);
    a->mean_x += s.mean_x;
    a->mean_y += s.mean_y;
    if (!r->second.rgb)
        return;
    const double m[4] = {(double)a->xx, (double)a->xy, (double)a->yx, (double)a->yy};
    const double xx = m[0] * m[0] + m[1] * m[1] + 2 * (double)s.xx;
    const double xy = m[0] * m[2] + m[1] * m[3] + 2 * (double)s.xy;
    const double yy = m[2] * m[2] + m[3] * m[3] + 2 * (double)s.yy;
    const double first = sqrt(xx), beside = xy / first;
    const double left = fmax(yy - beside * beside, 1e-12 * yy); /* the covariance is rounded */
    a->xx = (float)first;
    a->xy = 0.0f;
    a->yx = (float)beside;
    a->yy = (float)sqrt(left);
}

static vndf_affine affine_at(const scene_lobe *l, const hit *h)
{
    const float x = path_textured(&l->alpha_x, h), y = path_textured(&l->alpha_y, h);
    vndf_affine a = {l->distribution, x * l->axes[0], y * l->axes[1], x * l->axes[2],
                     y * l->axes[3],  l->mean_x,      l->mean_y};
    if (l->relief)
        add_relief(l->relief, h, &a);
    return a;
}

static float parameter_at(const scene_parameter *p, const hit *h)
{
    const textured way = {p->to - p->from, p->map};
    return p->map ? p->from + path_textured(&way, h) : p->from;
}

static void add_family(const scene_lobe *l, const hit *h, float weight, vndf_mixture *made)
{
    const vndf_affine surface = affine_at(l, h);
    scene_add_lobe(l, &surface, parameter_at(&l->parameter, h), weight, made);
}

static void add_lobe(const scene_lobe *l, const hit *h, vndf_mixture *made)
{
    const float weight = path_textured(&l->weight, h);
    if (l->family)
        add_family(l, h, weight, made);
    else
        made->lobe[made->count++] = (vndf_mixture_lobe){affine_at(l, h), weight};
}

static void mixture_at(const path_material *m, const hit *h, vndf_mixture *made)
{
    made->count = 0;
    for (int i = 0; i < m->lobe_count; i++)
        add_lobe(&m->lobes[i], h, made);
}

/* Whether the mean plane and the shape agree about the side of w. */
static int agrees(const path_point *p, vndf_vec3 w)
{
    return vndf_bsdf_cosine(&p->bsdf, w) * w.z > 0.0f;
}

static int fixed_begin(path_point *p)
{
    return vndf_bsdf_at(&p->bsdf, &p->material->bsdf, p->wi) && agrees(p, p->wi);
}

static int affine_begin(path_point *p)
{
    const vndf_affine a = affine_at(&p->material->lobes[0], p->hit);
    return vndf_bsdf_affine(&p->bsdf, &p->material->bsdf, &a, p->wi) && agrees(p, p->wi);
}

static int mixture_begin(path_point *p)
{
    vndf_mixture mixture;
    mixture_at(p->material, p->hit, &mixture);
    return vndf_bsdf_mixture(&p->bsdf, &p->material->bsdf, &mixture, p->wi) && agrees(p, p->wi);
}

static int lobes_sample(const path_point *p, const float u[3], bounce *b)
{
    return path_rough_sample(p, u, b) && agrees(p, b->wo);
}

static float lobes_eval(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3])
{
    if (!agrees(p, wo))
        return 0.0f;
    path_rough_eval(p, wo, seed, value);
    return fabsf(vndf_bsdf_cosine(&p->bsdf, wo));
}

/* ---- what is left out, for measurements ---- */

static void straighten(scene_lobe *l, float stretch)
{
    l->axes[0] = l->axes[3] = stretch;
    l->axes[1] = l->axes[2] = 0.0f;
}

static float determinant(const scene_lobe *l)
{
    return l->axes[0] * l->axes[3] - l->axes[1] * l->axes[2];
}

static void simplify(scene_lobe *l, unsigned without)
{
    if (without & EFFECT_MATRICES && l->is_matrix)
        straighten(l, sqrtf(fabsf(determinant(l))));
    if (without & EFFECT_ROTATED_AXES && !l->is_matrix)
        straighten(l, 1.0f);
    if (without & EFFECT_MEAN_SLOPES)
        l->mean_x = l->mean_y = 0.0f;
    if (without & EFFECT_RELIEFS)
        l->relief = NULL;
    if (without & EFFECT_FAMILIES) {
        l->family = NULL;
        l->parameter.map = NULL;
    }
    if (without & EFFECT_TEXTURED_WEIGHTS)
        l->weight.map = NULL;
    if (without & EFFECT_TEXTURED_ALPHA)
        l->alpha_x.map = l->alpha_y.map = NULL;
}

static void keep_heaviest(path_material *m)
{
    int heaviest = 0;
    for (int i = 1; i < m->lobe_count; i++)
        if (m->lobes[i].weight.value > m->lobes[heaviest].weight.value)
            heaviest = i;
    m->lobes[0] = m->lobes[heaviest];
    m->lobe_count = 1;
}

/* ---- preparing ---- */

unsigned path_lobes_effects(const material *is)
{
    unsigned effects = is->lobe_count > 1 ? EFFECT_MIXTURES : 0u;
    for (int i = 0; i < is->lobe_count; i++) {
        const scene_lobe *l = &is->lobes[i];
        effects |= (l->family ? EFFECT_FAMILIES : 0u) | (l->is_matrix ? EFFECT_MATRICES : 0u) |
                   (l->relief ? EFFECT_RELIEFS : 0u) |
                   (l->mean_x != 0.0f || l->mean_y != 0.0f ? EFFECT_MEAN_SLOPES : 0u) |
                   (l->alpha_x.map || l->alpha_y.map ? EFFECT_TEXTURED_ALPHA : 0u) |
                   (l->rotation != 0.0f ? EFFECT_ROTATED_AXES : 0u) |
                   (is->lobe_count > 1 && l->weight.map ? EFFECT_TEXTURED_WEIGHTS : 0u);
    }
    return effects;
}

/* Whether hits bring what differs from place to place. */
static int varies(const path_material *m)
{
    for (int i = 0; i < m->lobe_count; i++) {
        const scene_lobe *l = &m->lobes[i];
        if (l->alpha_x.map || l->alpha_y.map || l->relief || l->parameter.map ||
            (m->lobe_count > 1 && l->weight.map))
            return 1;
    }
    return 0;
}

void path_lobes_describe(path_material *m, unsigned without, vndf_description *is)
{
    m->lobe_count = m->is->lobe_count;
    for (int i = 0; i < m->lobe_count; i++) {
        m->lobes[i] = m->is->lobes[i];
        simplify(&m->lobes[i], without);
    }
    if (without & EFFECT_MIXTURES)
        keep_heaviest(m);
    scene_mixture_of(m->lobes, m->lobe_count, &m->mixture);
    is->effects.shape = scene_shape_of(m->lobes, m->lobe_count);
    is->distribution = m->lobes[0].distribution;
    is->affine = scene_affine_of(m->lobes);
    is->mixture = &m->mixture;
}

void path_lobes_make(path_material *m)
{
    int (*const each)(path_point * p) =
        m->bsdf.is.effects.shape == VNDF_SHAPE_MIXTURE ? mixture_begin : affine_begin;
    m->run.begin = varies(m) ? each : fixed_begin;
    if (m->bsdf.is.effects.shape == VNDF_SHAPE_MATRIX)
        return; /* z = 0 is the mean plane */
    m->run.sample = lobes_sample;
    m->run.eval = lobes_eval;
}
