/* A description becomes a material, which knows what its hits call, or is refused: numbers out of range and
 * combinations of effects that make no sense, each by name. */
#include <float.h>
#include <stdio.h>

#include "bsdf/bsdf.h"
#include "core/error.h"

/* ---- numbers ---- */

/* A number, and the range that it must be in where it is read; NaN is in none. */
typedef struct number {
    const char *name;
    double value, least, most;
    int is_read;
} number;

static vndf_status check_numbers(const number *numbers, size_t count, vndf_error *error)
{
    for (const number *n = numbers; n < numbers + count; n++)
        if (n->is_read && !(n->value >= n->least && n->value <= n->most))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s is %g, it must be in [%g, %g]", n->name, n->value,
                             n->least, n->most);
    return VNDF_OK;
}

static vndf_status check_plain_numbers(const vndf_description *is, vndf_error *error)
{
    const vndf_effects *e = &is->effects;
    int bends = e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
    const number numbers[] = {
        {"effects.lobes", (int)e->lobes, 0, VNDF_LOBES_BOTH, 1},
        {"effects.fresnel", (int)e->fresnel, 0, VNDF_FRESNEL_CONDUCTOR, 1},
        {"effects.masking", (int)e->masking, 0, VNDF_MASKING_NONE, 1},
        {"effects.normals", (int)e->normals, 0, VNDF_NORMALS_V_CAVITY, 1},
        {"effects.scattering", (int)e->scattering, 0, VNDF_SCATTERING_KULLA_CONTY, 1},
        {"effects.transport", (int)e->transport, 0, VNDF_TRANSPORT_IMPORTANCE, 1},
        {"effects.shape", (int)e->shape, 0, VNDF_SHAPE_MIXTURE, 1},
        {"effects.reflection", (int)e->reflection, 0, VNDF_REFLECTION_RETRO, 1},
        {"wavelengths", is->wavelengths, 0, VNDF_WAVELENGTHS, 1},
        {"eta", (double)is->eta, (double)0.01f, 100, bends},
    };
    return check_numbers(numbers, sizeof numbers / sizeof *numbers, error);
}

static vndf_status check_colours(const vndf_description *is, int wavelengths, vndf_error *error)
{
    int schlick = is->effects.fresnel == VNDF_FRESNEL_SCHLICK,
        metal = is->effects.fresnel == VNDF_FRESNEL_CONDUCTOR;
    for (int i = 0; i < wavelengths; i++) {
        char f0[32], eta[32], k[32];
        snprintf(f0, sizeof f0, "f0[%d]", i);
        snprintf(eta, sizeof eta, "conductor_eta[%d]", i);
        snprintf(k, sizeof k, "conductor_k[%d]", i);
        const number own[] = {{f0, (double)is->f0[i], 0, 1, schlick},
                              {eta, (double)is->conductor_eta[i], 0, 1000, metal},
                              {k, (double)is->conductor_k[i], 0, 1000, metal}};
        if (check_numbers(own, 3, error) != VNDF_OK)
            return VNDF_ERROR_ARGUMENT;
        if (metal && !(is->conductor_eta[i] + is->conductor_k[i] > 0.0f))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s and %s are both 0", eta, k);
    }
    return VNDF_OK;
}

/* ---- combinations ---- */

static vndf_status check_combination(const vndf_description *is, vndf_error *error)
{
    const vndf_effects *e = &is->effects;
    int transmits = e->lobes != VNDF_LOBES_REFLECTION, both = e->lobes == VNDF_LOBES_BOTH;
    int walks = e->scattering == VNDF_SCATTERING_MULTIPLE, compensates = vndf_compensates(e);
    int is_retro = e->reflection == VNDF_REFLECTION_RETRO, tilts = e->shape != VNDF_SHAPE_LEVEL;
    int by_height = e->masking == VNDF_MASKING_HEIGHT_CORRELATED, sees = e->normals == VNDF_NORMALS_VISIBLE;
    const struct {
        int is_wrong;
        const char *why;
    } rules[] = {
        {transmits && e->fresnel == VNDF_FRESNEL_CONDUCTOR,
         "fresnel is VNDF_FRESNEL_CONDUCTOR, and a conductor transmits nothing: lobes must be VNDF_LOBES_REFLECTION"},
        {both && e->fresnel == VNDF_FRESNEL_NONE,
         "lobes is VNDF_LOBES_BOTH and fresnel is VNDF_FRESNEL_NONE: nothing says which lobe light takes"},
        {transmits && e->normals == VNDF_NORMALS_BOUNDED,
         "normals is VNDF_NORMALS_BOUNDED, normals that reflect to above the horizon: lobes must be "
         "VNDF_LOBES_REFLECTION"},
        {e->normals == VNDF_NORMALS_V_CAVITY && e->masking != VNDF_MASKING_V_CAVITIES,
         "normals is VNDF_NORMALS_V_CAVITY, so masking must be VNDF_MASKING_V_CAVITIES"},
        {compensates && (!by_height || tilts || (transmits && !(both && e->fresnel == VNDF_FRESNEL_DIELECTRIC))),
         "scattering is VNDF_SCATTERING_TURQUIN or VNDF_SCATTERING_KULLA_CONTY, by albedos of one distribution: "
         "masking must be VNDF_MASKING_HEIGHT_CORRELATED, shape not VNDF_SHAPE_TILTED or VNDF_SHAPE_MIXTURE, and lobes "
         "VNDF_LOBES_REFLECTION, or for Turquin VNDF_LOBES_BOTH with VNDF_FRESNEL_DIELECTRIC"},
        {transmits && e->scattering == VNDF_SCATTERING_KULLA_CONTY,
         "scattering is VNDF_SCATTERING_KULLA_CONTY: lobes must be VNDF_LOBES_REFLECTION"},
        {is_retro && e->lobes == VNDF_LOBES_TRANSMISSION,
         "reflection is VNDF_REFLECTION_RETRO and lobes is VNDF_LOBES_TRANSMISSION: nothing is reflected"},
        {tilts && (!sees || e->masking == VNDF_MASKING_V_CAVITIES || is_retro || walks),
         "shape is VNDF_SHAPE_TILTED or VNDF_SHAPE_MIXTURE, a surface with a mean slope: normals must be "
         "VNDF_NORMALS_VISIBLE, masking not VNDF_MASKING_V_CAVITIES, scattering VNDF_SCATTERING_SINGLE and reflection "
         "VNDF_REFLECTION_SPECULAR"},
        {walks && (!by_height || !sees || e->lobes == VNDF_LOBES_TRANSMISSION),
         "scattering is VNDF_SCATTERING_MULTIPLE, a walk: masking must be VNDF_MASKING_HEIGHT_CORRELATED, normals "
         "VNDF_NORMALS_VISIBLE and lobes VNDF_LOBES_REFLECTION or VNDF_LOBES_BOTH"},
        {walks && both && e->fresnel == VNDF_FRESNEL_SCHLICK && is->eta == 1.0f,
         "scattering is VNDF_SCATTERING_MULTIPLE, fresnel is VNDF_FRESNEL_SCHLICK and eta is 1: a walk needs another "
         "eta, since light that goes straight on has no density"},
    };
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].is_wrong)
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "effects: %s", rules[i].why);
    return VNDF_OK;
}

/* ---- surfaces ---- */

/* Of the material or a lobe of its mixture; hits bring others, whose errors have a result. A view is valid if it has
 * an area, which straight from above is 1. */
static vndf_status check_map(const char *name, const vndf_surface *a, vndf_error *error)
{
    const vndf_vec3 up = {0.0f, 0.0f, 1.0f};
    if (!a->distribution)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s has the distribution NULL", name);
    vndf_view view = vndf_view_from(a, up);
    if (vndf_view_area(&view, up) > 0.0f)
        return VNDF_OK;
    return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                     "%s is the matrix (%g %g; %g %g) with mean slope (%g, %g); its singular values, times the "
                     "scale of the distribution, must be within [1e-15, 1e15], the mean slope within 1e6",
                     name, (double)a->xx, (double)a->xy, (double)a->yx, (double)a->yy, (double)a->mean_x,
                     (double)a->mean_y);
}

static vndf_status check_mixture(const vndf_mixture *mixture, vndf_error *error)
{
    double sum = 0.0;
    const number count = {"mixture->count", mixture->count, 1, VNDF_MIXTURE_LOBES, 1};
    vndf_status status = check_numbers(&count, 1, error);
    for (int i = 0; status == VNDF_OK && i < mixture->count; i++) {
        const vndf_mixture_lobe *lobe = &mixture->lobe[i];
        char weight[48], surface[48];
        snprintf(weight, sizeof weight, "mixture->lobe[%d].weight", i);
        snprintf(surface, sizeof surface, "mixture->lobe[%d].surface", i);
        const number own = {weight, (double)lobe->weight, 0, (double)FLT_MAX, 1};
        status = check_numbers(&own, 1, error);
        if (status == VNDF_OK && lobe->weight > 0.0f)
            status = check_map(surface, &lobe->surface, error);
        sum += (double)lobe->weight;
    }
    return status != VNDF_OK || sum > 0.0
               ? status
               : vndf_fail(error, VNDF_ERROR_ARGUMENT, "mixture: the weights of all lobes are 0");
}

/* ---- materials ---- */

vndf_status vndf_material_resolve(const vndf_description *is, vndf_material *m, vndf_error *error)
{
    int known = is && is->wavelengths > 0 && is->wavelengths <= VNDF_WAVELENGTHS;
    int wavelengths = known ? is->wavelengths : 3;
    *m = (vndf_material){.is = {.wavelengths = wavelengths}}; /* without routines: nothing */
    if (!is)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the description is NULL");
    const vndf_effects *e = &is->effects;
    const int is_mixture = e->shape == VNDF_SHAPE_MIXTURE;
    vndf_status status = check_plain_numbers(is, error);
    if (status == VNDF_OK)
        status = check_combination(is, error);
    if (status == VNDF_OK)
        status = check_colours(is, wavelengths, error);
    if (status != VNDF_OK)
        return status;
    m->is = *is;
    m->is.order_limit = is->order_limit ? is->order_limit : 64;
    m->is.wavelengths = wavelengths;
    m->own.surface = is->surface;
    if (e->shape == VNDF_SHAPE_LEVEL)
        m->own.surface.mean_x = m->own.surface.mean_y = 0.0f;
    if (!is_mixture)
        status = check_map("surface", &m->own.surface, error);
    else if (is->mixture)
        status = check_mixture(is->mixture, error);
    if (status == VNDF_OK && vndf_compensates(e))
        status = vndf_albedo_check(is, error);
    if (status != VNDF_OK)
        return status;
    m->own.per_wavelength = 1.0 / wavelengths;
    m->own.two_sided = e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
    if (vndf_compensates(e))
        vndf_compensation_resolve(m);
    m->own.routines = vndf_compensates(e)                         ? &vndf_routines_compensated
                      : e->scattering == VNDF_SCATTERING_MULTIPLE ? &vndf_routines_walk
                                                                  : &vndf_routines_single;
    return VNDF_OK;
}
