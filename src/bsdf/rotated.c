#include "bsdf/rotated.h"

#include "math/vector.h"

static vndf_vec3 to_axes(const vndf_bsdf *b, vndf_vec3 w)
{
    float c = b->cos_rotation, s = b->sin_rotation;
    return vndf_vec3_of(c * w.x + s * w.y, c * w.y - s * w.x, w.z);
}

static vndf_vec3 from_axes(const vndf_bsdf *b, vndf_vec3 w)
{
    float c = b->cos_rotation, s = b->sin_rotation;
    return vndf_vec3_of(c * w.x - s * w.y, c * w.y + s * w.x, w.z);
}

static int prepare(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    b->cos_rotation = r->cos_rotation;
    b->sin_rotation = r->sin_rotation;
    return b->material->unrotated->prepare(b, r, to_axes(b, wi));
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->unrotated->sample(b, u, s);
    s->wo = from_axes(b, s->wo);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS])
{
    b->material->unrotated->eval(b, to_axes(b, wo), seed, value);
}

static float pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    return b->material->unrotated->pdf(b, to_axes(b, wo));
}

const vndf_routines vndf_routines_rotated = {prepare, sample, eval, pdf, NULL};
