/* A description becomes a material: which routines its hits call, and with which surface where they bring none. */
#include "bsdf/bsdf.h"
#include "core/error.h"
#include "math/turn.h"

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
    int known = is && is->wavelengths > 0 && is->wavelengths <= VNDF_WAVELENGTHS;
    *m = (vndf_material){.is = {.wavelengths = known ? is->wavelengths : 3}}; /* without routines: nothing */
    if (!is)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the description is NULL");
    vndf_status status = vndf_description_check(is, error);
    if (status != VNDF_OK)
        return status;
    const vndf_effects *e = &is->effects;
    m->is = *is;
    m->is.order_limit = is->order_limit ? is->order_limit : 64;
    m->is.wavelengths = known ? is->wavelengths : 3;
    m->own.per_wavelength = 1.0 / m->is.wavelengths;
    m->own.routines = vndf_compensates(e)                         ? &vndf_routines_compensated
                      : e->scattering == VNDF_SCATTERING_MULTIPLE ? &vndf_routines_walk
                                                                  : &vndf_routines_single;
    m->own.two_sided = e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
    set_surface(m);
    if (vndf_compensates(e))
        vndf_compensation_resolve(m);
    return VNDF_OK;
}
