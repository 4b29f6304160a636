#include "bsdf/walk/multiple.h"

#include "bsdf/lobes/scatter.h"
#include "bsdf/walk/walk.h"

static vndf_walk walk_of(const vndf_bsdf *b)
{
    const vndf_description *is = &b->material->is;
    vndf_walk walk = {b->material->fresnel->reflectance,
                      is,
                      b->eta,
                      is->effects.lobes != VNDF_LOBES_REFLECTION,
                      is->effects.transport,
                      is->order_limit};
    return walk;
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_walk walk = walk_of(b);
    vndf_walked walked;
    vndf_walk_sample(&walk, &b->view, u, &walked);
    if (walked.lobe == VNDF_LOBE_NONE) {
        vndf_scatter_nothing(s);
        return;
    }
    s->wo = vndf_mirrored(walked.wo, b->side);
    s->density = vndf_positive(vndf_walk_pdf(&walk, &b->view, walked.wo));
    s->lobe = walked.lobe;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        s->weight[i] = walked.weight[i];
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS])
{
    vndf_walk walk = walk_of(b);
    double f[VNDF_WAVELENGTHS];
    wo.z *= b->side;
    if (!vndf_is_near_unit(wo) || wo.z == 0.0f || (wo.z < 0.0f && !walk.transmits)) {
        vndf_set_value(value, 0.0);
        return;
    }
    vndf_walk_eval(&walk, &b->view, wo, seed, f);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        value[i] = vndf_density_from(f[i] / fabs(wo.z));
}

static float pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    vndf_walk walk = walk_of(b);
    wo.z *= b->side;
    if (!vndf_is_near_unit(wo) || !(walk.transmits ? wo.z != 0.0f : wo.z > 0.0f))
        return 0.0f;
    return vndf_walk_pdf(&walk, &b->view, wo);
}

const vndf_routines vndf_routines_multiple = {vndf_prepare_visible, sample, eval, pdf, NULL};

/* ---- eta = 1 ---- */

static void sample_unbent(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_vec3 wi = b->view.wi;
    const vndf_scattered straight = {
        {-wi.x, -wi.y, -b->side * wi.z}, {1.0f, 1.0f, 1.0f}, 1.0f, VNDF_LOBE_STRAIGHT};
    (void)u;
    *s = straight;
}

static void eval_unbent(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS])
{
    (void)b;
    (void)wo;
    (void)seed;
    vndf_set_value(value, 0.0);
}

static float pdf_unbent(const vndf_bsdf *b, vndf_vec3 wo)
{
    (void)b;
    (void)wo;
    return 0.0f;
}

const vndf_routines vndf_routines_unbent = {vndf_prepare_visible, sample_unbent, eval_unbent, pdf_unbent, NULL};
