/* A description becomes a material. Nothing else looks at the effects. */
#include "bsdf/material.h"

#include "bsdf/lobes/compensated.h"
#include "bsdf/lobes/dielectric.h"
#include "bsdf/lobes/mixture.h"
#include "bsdf/lobes/retro.h"
#include "bsdf/lobes/scatter.h"
#include "bsdf/lobes/turned.h"
#include "bsdf/terms/fresnel.h"
#include "bsdf/terms/masking.h"
#include "bsdf/trust.h"
#include "bsdf/walk/multiple.h"
#include "core/error.h"
#include "math/elementary.h"
#include "math/half_turn.h"
#include "sampler/law.h"

/* ---- nothing ---- */

static int prepare_nothing(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    (void)b;
    (void)r;
    (void)wi;
    return 0;
}

static void sample_nothing(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    (void)b;
    (void)u;
    vndf_scatter_nothing(s);
}

static void eval_nothing(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)wo;
    (void)seed;
    vndf_see_nothing(b, value, pdf);
}

static float pdf_nothing(const vndf_bsdf *b, vndf_vec3 wo)
{
    (void)b;
    (void)wo;
    return 0.0f;
}

static const vndf_routines nothing = {prepare_nothing, sample_nothing, eval_nothing,
                                      pdf_nothing,     NULL,           VNDF_BLOCK_NONE};
const vndf_material vndf_materials_of_nothing[VNDF_WAVELENGTHS + 1] = {
    {.routines = &nothing, .is = {.wavelengths = 3}},
    {.routines = &nothing, .is = {.wavelengths = 1}},
    {.routines = &nothing, .is = {.wavelengths = 2}},
    {.routines = &nothing, .is = {.wavelengths = 3}},
    {.routines = &nothing, .is = {.wavelengths = 4}}};

/* ---- effects to routines ---- */

static const vndf_fresnel_routine *fresnel_of(const vndf_effects *e)
{
    switch (e->fresnel) {
    case VNDF_FRESNEL_SCHLICK:
        return e->lobes == VNDF_LOBES_REFLECTION ? &vndf_fresnel_of_schlick : &vndf_fresnel_of_schlick_thin;
    case VNDF_FRESNEL_DIELECTRIC: return &vndf_fresnel_of_dielectric;
    case VNDF_FRESNEL_CONDUCTOR: return &vndf_fresnel_of_conductor;
    default: return e->lobes == VNDF_LOBES_REFLECTION ? &vndf_fresnel_of_total : &vndf_fresnel_of_nothing;
    }
}

static const vndf_masking_routine *masking_of(const vndf_effects *e)
{
    switch (e->masking) {
    case VNDF_MASKING_SEPARABLE: return &vndf_masking_separable;
    case VNDF_MASKING_V_CAVITIES: return &vndf_masking_v_cavities;
    case VNDF_MASKING_NONE: return &vndf_masking_none;
    default: return &vndf_masking_height_correlated;
    }
}

static const vndf_routines *walk_of(const vndf_description *is, int frame)
{
    const vndf_effects *e = &is->effects;
    if (frame == VNDF_FRAME_TURNED)
        return &vndf_routines_turned_walk;
    return e->lobes == VNDF_LOBES_BOTH && e->fresnel == VNDF_FRESNEL_DIELECTRIC && is->eta == 1.0f
               ? &vndf_routines_unbent
               : &vndf_routines_multiple;
}

static const vndf_routines *routines_of(const vndf_description *is, int frame)
{
    const vndf_effects *e = &is->effects;
    if (e->scattering == VNDF_SCATTERING_MULTIPLE)
        return walk_of(is, frame);
    if (e->lobes == VNDF_LOBES_TRANSMISSION)
        return &vndf_routines_transmission[frame][e->normals];
    if (e->lobes == VNDF_LOBES_BOTH)
        return &vndf_routines_both[frame][e->normals];
    int bare = e->fresnel == VNDF_FRESNEL_NONE && e->masking == VNDF_MASKING_HEIGHT_CORRELATED;
    if (bare && e->normals == VNDF_NORMALS_VISIBLE && is->distribution == vndf_ggx())
        return &vndf_routines_bare_ggx[frame];
    if (bare && e->normals == VNDF_NORMALS_BOUNDED && is->distribution == vndf_ggx() &&
        frame == VNDF_FRAME_ALIGNED)
        return &vndf_routines_bare_bounded_ggx;
    if (bare)
        return &vndf_routines_bare[frame][e->normals];
    return &vndf_routines_reflection[frame][e->normals];
}

/* In the frame of the hit, which a shape has beside the effects. */
static const vndf_routines *shaped(const vndf_description *is)
{
    switch (is->effects.shape) {
    case VNDF_SHAPE_ALIGNED: return routines_of(is, VNDF_FRAME_ALIGNED);
    case VNDF_SHAPE_ROTATED:
    case VNDF_SHAPE_MATRIX: return routines_of(is, VNDF_FRAME_TURNED);
    case VNDF_SHAPE_AFFINE:
    case VNDF_SHAPE_MIXTURE: break;
    }
    return &vndf_routines_mixture;
}

static const vndf_routines *compensated(const vndf_routines *single, vndf_scattering scattering)
{
    switch (scattering) {
    case VNDF_SCATTERING_SINGLE:
    case VNDF_SCATTERING_MULTIPLE: return single;
    case VNDF_SCATTERING_TURQUIN: return &vndf_routines_turquin;
    case VNDF_SCATTERING_KULLA_CONTY: break;
    }
    return &vndf_routines_kulla_conty;
}

/* By half a turn and back, within 1e-6, made unit, and turned by the rest. */
static void set_rotation(vndf_material *m, double angle)
{
    double turns = angle * 0.15915494309189535, part = turns - floor(turns);
    vndf_turn half = vndf_half_turn((float)part);
    double c = (double)half.cosine * half.cosine, s = (double)half.sine * half.sine, per = 1.0 / (c + s);
    double cosine = (c - s) * per, sine = 2.0 * half.cosine * half.sine * per;
    double off = part - vndf_atan2(sine, cosine) * 0.15915494309189535;
    double rest = (off - floor(off + 0.5)) * 6.283185307179586;
    m->roughness.cos_rotation = (float)(cosine - rest * sine);
    m->roughness.sin_rotation = (float)(sine + rest * cosine);
}

/* A conductor that is nearly a dielectric reflects totally beyond some angle. */
static int is_steep(const vndf_description *is)
{
    int steep = 0;
    for (int i = 0; i < is->wavelengths; i++)
        steep |= is->conductor_eta[i] < 1.0f && is->conductor_k[i] < VNDF_TRUST_CONDUCTOR_K;
    return steep && is->effects.fresnel == VNDF_FRESNEL_CONDUCTOR;
}

vndf_status vndf_material_resolve(const vndf_description *is, vndf_material *m, vndf_error *error)
{
    int wavelengths = is && is->wavelengths >= 0 && is->wavelengths <= VNDF_WAVELENGTHS ? is->wavelengths : 0;
    *m = vndf_materials_of_nothing[wavelengths];
    if (!is)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the description is NULL");
    vndf_status status = vndf_description_check(is, error);
    if (status != VNDF_OK)
        return status;
    const vndf_effects *e = &is->effects;
    m->is = *is;
    m->roughness.alpha_x = is->alpha_x;
    m->roughness.alpha_y = is->alpha_y;
    m->is.order_limit = is->order_limit ? is->order_limit : 64;
    m->is.wavelengths = is->wavelengths ? is->wavelengths : 3;
    m->per_wavelength = 1.0 / m->is.wavelengths;
    m->fresnel = fresnel_of(e);
    m->masking = masking_of(e);
    m->unturned = routines_of(is, VNDF_FRAME_ALIGNED);
    m->single = shaped(is);
    m->specular = compensated(m->single, e->scattering);
    m->routines = e->reflection == VNDF_REFLECTION_RETRO ? &vndf_routines_retro : m->specular;
    m->steep = is_steep(&m->is);
    m->turn = e->shape == VNDF_SHAPE_MIXTURE ? 0.0f : vndf_turn_for(vndf_law_steepness(is->distribution));
    m->two_sided = e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
    set_rotation(m, e->shape == VNDF_SHAPE_ROTATED ? is->rotation : 0.0);
    if (vndf_compensates(e))
        vndf_compensation_resolve(m);
    if (e->shape == VNDF_SHAPE_MATRIX)
        vndf_turned_roughness(is->distribution, &is->affine, &m->roughness);
    vndf_axes_of(&m->roughness, &m->axes);
    return VNDF_OK;
}
