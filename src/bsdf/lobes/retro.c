/* Samples, values and densities are those of the same material without retroreflection, with wo turned by half a turn
 * where it is on the side of wi. That turn changes no length and no angle, so all integrals and reciprocity stay. */
#include "bsdf/lobes/lobes.h"

static vndf_vec3 turned_about(const vndf_bsdf *b, vndf_vec3 wo)
{
    float turn = wo.z * b->side > 0.0f ? -1.0f : 1.0f;
    return vndf_vec3_of(turn * wo.x, turn * wo.y, wo.z);
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->specular->sample(b, u, s);
    if (s->lobe == VNDF_LOBE_REFLECTION)
        s->wo = turned_about(b, s->wo);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->specular->eval(b, turned_about(b, wo), seed, value, pdf);
}

const vndf_routines vndf_routines_retro = {NULL, sample, eval, NULL};
