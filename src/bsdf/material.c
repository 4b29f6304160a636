/* A description becomes a material: which routines its hits call. Those of a single event (single.c) look at the
 * effects once more, for Fresnel's term, masking and normals. */
#include "bsdf/bsdf.h"
#include "core/error.h"
#include "math/turn.h"

/* ---- nothing ---- */

static void sample_nothing(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    (void)b;
    (void)u;
    vndf_scatter_nothing(s);
}

void vndf_eval_nothing(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)wo;
    (void)seed;
    vndf_see_nothing(b, value, pdf);
}

static const vndf_routines nothing = {NULL, sample_nothing, vndf_eval_nothing, NULL};
const vndf_material vndf_materials_of_nothing[VNDF_WAVELENGTHS + 1] = {
    {.is = {.wavelengths = 3}, .own = {.routines = &nothing, .specular = &nothing}},
    {.is = {.wavelengths = 1}, .own = {.routines = &nothing, .specular = &nothing}},
    {.is = {.wavelengths = 2}, .own = {.routines = &nothing, .specular = &nothing}},
    {.is = {.wavelengths = 3}, .own = {.routines = &nothing, .specular = &nothing}},
    {.is = {.wavelengths = 4}, .own = {.routines = &nothing, .specular = &nothing}}};

/* ---- effects to routines ---- */

/* The surface of hits that bring none. */
static void set_surface(vndf_material *m)
{
    const vndf_description *is = &m->is;
    double cosine = 1.0, sine = 0.0;
    if (is->effects.shape == VNDF_SHAPE_ROTATED)
        vndf_turn_of((double)is->rotation * 0.15915494309189535, &cosine, &sine);
    m->own.cos_rotation = (float)cosine;
    m->own.sin_rotation = (float)sine;
    const vndf_roughness r = {is->alpha_x, is->alpha_y, m->own.cos_rotation, m->own.sin_rotation};
    if (is->effects.shape <= VNDF_SHAPE_ROTATED)
        vndf_surface_of(m, &r, &m->own.surface);
    else
        m->own.surface = is->affine;
    m->own.surface.distribution = is->distribution;
    if (is->effects.shape != VNDF_SHAPE_AFFINE)
        m->own.surface.mean_x = m->own.surface.mean_y = 0.0f;
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
    m->is.order_limit = is->order_limit ? is->order_limit : 64;
    m->is.wavelengths = is->wavelengths ? is->wavelengths : 3;
    m->own.per_wavelength = 1.0 / m->is.wavelengths;
    int straight = e->lobes == VNDF_LOBES_BOTH && e->fresnel == VNDF_FRESNEL_DIELECTRIC && is->eta == 1.0f;
    m->own.single = e->scattering != VNDF_SCATTERING_MULTIPLE ? vndf_single_of(e)
                    : straight                                ? &vndf_routines_unbent
                                                              : &vndf_routines_walk;
    m->own.specular = e->scattering == VNDF_SCATTERING_TURQUIN       ? &vndf_routines_turquin
                      : e->scattering == VNDF_SCATTERING_KULLA_CONTY ? &vndf_routines_kulla_conty
                                                                     : m->own.single;
    m->own.routines = e->reflection == VNDF_REFLECTION_RETRO ? &vndf_routines_retro : m->own.specular;
    m->own.two_sided = e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
    set_surface(m);
    if (vndf_compensates(e))
        vndf_compensation_resolve(m);
    return VNDF_OK;
}
