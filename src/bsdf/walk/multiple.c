#include "bsdf/walk/multiple.h"

#include "bsdf/lobes/scatter.h"
#include "bsdf/walk/walk.h"

static vndf_walk walk_of(const vndf_bsdf *b)
{
    const vndf_description *is = &b->material->is;
    vndf_walk walk = {b->material->fresnel->reflectance,
                      is,
                      is->wavelengths,
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
    s->wm = vndf_vec3_of(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        s->weight[i] = walked.weight[i];
}

static float pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    vndf_walk walk = walk_of(b);
    wo.z *= b->side;
    if (!vndf_is_near_unit(wo) || !(walk.transmits ? wo.z != 0.0f : wo.z > 0.0f))
        return 0.0f;
    return vndf_walk_pdf(&walk, &b->view, wo);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *density)
{
    vndf_walk walk = walk_of(b);
    double f[VNDF_WAVELENGTHS];
    if (density)
        *density = pdf(b, wo);
    wo.z *= b->side;
    if (!vndf_is_near_unit(wo) || wo.z == 0.0f || (wo.z < 0.0f && !walk.transmits)) {
        vndf_set_value(b, value, 0.0);
        return;
    }
    vndf_walk_eval(&walk, &b->view, wo, seed, f);
    for (int i = 0; i < b->material->is.wavelengths; i++)
        value[i] = vndf_density_from(f[i] / fabs(wo.z));
}

const vndf_routines vndf_routines_multiple = {vndf_prepare_visible, sample, eval, pdf, NULL, VNDF_BLOCK_NONE};

/* ---- eta = 1 ---- */

static void sample_unbent(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_vec3 wi = b->view.wi;
    (void)u;
    vndf_scatter_nothing(s);
    s->wo = vndf_vec3_of(-wi.x, -wi.y, -b->side * wi.z);
    s->density = 1.0f;
    s->lobe = VNDF_LOBE_STRAIGHT;
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = 1.0f;
}

static void eval_unbent(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)wo;
    (void)seed;
    vndf_see_nothing(b, value, pdf);
}

static float pdf_unbent(const vndf_bsdf *b, vndf_vec3 wo)
{
    (void)b;
    (void)wo;
    return 0.0f;
}

const vndf_routines vndf_routines_unbent = {vndf_prepare_visible, sample_unbent, eval_unbent,
                                            pdf_unbent,           NULL,          VNDF_BLOCK_NONE};
