/* BSDFs of exports before they are printed: kernel/event.h and the pages of tools/export as C, compiled in float by the
 * build, over the library's calls for normals. Effects are variables, whose ifs stay. */
#include "export/event_text.h"

#pragma GCC diagnostic ignored "-Wconversion" /* of constants, unless they are floats */
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wuninitialized"

#include "kernel/one.h"
#include "sampler/sampler.h"

/* ---- words ---- */

static vndf_effects effects_now;

#define reflects_of(m) (effects_now.lobes != VNDF_LOBES_TRANSMISSION)
#define transmits_of(m) (effects_now.lobes != VNDF_LOBES_REFLECTION)
#define fresnel_of(m) effects_now.fresnel
#define masking_of(m) effects_now.masking
#define is_alike (effects_now.fresnel == VNDF_FRESNEL_NONE || effects_now.fresnel == VNDF_FRESNEL_DIELECTRIC)
#define is_indexed (transmits_of(0) || effects_now.fresnel == VNDF_FRESNEL_DIELECTRIC)
#define carries_radiance (transmits_of(0) && effects_now.transport == VNDF_TRANSPORT_RADIANCE)
#define is_retro (effects_now.reflection == VNDF_REFLECTION_RETRO)
#define material_of(b) ((b).material)
#define hit_of(b) ((b).h)

/* Calls of values where the library's have pointers. */
#define vndf_material text_material
#define vndf_bsdf text_bsdf
#define vndf_scattered text_scattered
#define vndf_bsdf_at text_bsdf_at
#define vndf_bsdf_cosine text_bsdf_cosine
#define vndf_bsdf_sample text_bsdf_sample
#define vndf_bsdf_eval text_bsdf_eval
#define vndf_bsdf_pdf text_bsdf_pdf
#define vndf_view_from(m, w) (vndf_view_from)(&(m), w)
#define vndf_sample(v, u1, u2) sampled_from(&(v), u1, u2)
#define vndf_pdf(v, wm) (vndf_pdf)(&(v), wm)
#define seen_ndf(v, wm) vndf_view_ndf(&(v), wm)
#define area(v) vndf_view_own_area(&(v))
#define area_along(v, w) vndf_view_area(&(v), w)

typedef vndf_vec3 vec3;
#define vec3(x, y, z) vector_of(x, y, z)
#define VNDF_KERNEL_DIRECTION
#define direction vndf_vec3

static vec3 vector_of(float x, float y, float z)
{
    const vec3 v = {x, y, z};
    return v;
}

typedef struct vndf_sampled {
    vec3 wm;
    float pdf, weight;
} vndf_sampled;

static vndf_sampled sampled_from(const vndf_view *v, float u1, float u2)
{
    const vndf_drawn_normal n = vndf_sample_visible(v, u1, u2);
    const vndf_sampled s = {n.wm, n.density, n.weight};
    return s;
}

typedef struct text_material {
    vndf_surface surface;
    float eta;
    vec3 f0, conductor_eta, conductor_k;
} text_material;

#include "../tools/export/hits.h"

typedef text_material material;
typedef text_bsdf bsdf;

#include "kernel/event.h"

#include "../tools/export/scatter.h"

/* ---- what ask.h asks ---- */

static void put(float *to, vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

void event_text(const vndf_effects *effects, const vndf_surface *surface, vec3 wi, vec3 u, vec3 wo, float said[16])
{
    const text_material m = {*surface, 1.5f, {0.0f, 0.04f, 0.9f}, {0.2f, 0.9f, 1.5f}, {3.9f, 2.4f, 1.9f}};
    effects_now = *effects;
    const text_bsdf b = vndf_bsdf_at(m, wi);
    const text_scattered s = vndf_bsdf_sample(b, u);
    put(said, s.wo);
    put(said + 3, s.weight);
    said[6] = s.pdf;
    said[7] = (float)s.lobe;
    put(said + 8, vndf_bsdf_eval(b, wo));
    said[11] = vndf_bsdf_pdf(b, wo);
    put(said + 12, vndf_bsdf_eval(b, s.wo));
    said[15] = vndf_bsdf_pdf(b, s.wo);
}
