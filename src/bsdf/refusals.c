/* Combinations of effects that make no sense, and numbers out of range: each is refused by name. */
#include <math.h>
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

static vndf_status check_choices(const vndf_effects *e, vndf_error *error)
{
    const number choices[] = {
        {"effects.lobes", (int)e->lobes, 0, VNDF_LOBES_BOTH, 1},
        {"effects.fresnel", (int)e->fresnel, 0, VNDF_FRESNEL_CONDUCTOR, 1},
        {"effects.masking", (int)e->masking, 0, VNDF_MASKING_NONE, 1},
        {"effects.normals", (int)e->normals, 0, VNDF_NORMALS_V_CAVITY, 1},
        {"effects.scattering", (int)e->scattering, 0, VNDF_SCATTERING_KULLA_CONTY, 1},
        {"effects.transport", (int)e->transport, 0, VNDF_TRANSPORT_IMPORTANCE, 1},
        {"effects.shape", (int)e->shape, 0, VNDF_SHAPE_MIXTURE, 1},
        {"effects.reflection", (int)e->reflection, 0, VNDF_REFLECTION_RETRO, 1},
    };
    return check_numbers(choices, sizeof choices / sizeof *choices, error);
}

static vndf_status check_optics(const vndf_description *is, vndf_error *error)
{
    const vndf_effects *e = &is->effects;
    int bends = e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
    int schlick = e->fresnel == VNDF_FRESNEL_SCHLICK, metal = e->fresnel == VNDF_FRESNEL_CONDUCTOR;
    const number whole[] = {{"wavelengths", is->wavelengths, 0, VNDF_WAVELENGTHS, 1},
                            {"eta", (double)is->eta, (double)0.01f, 100, bends},
                            {"rotation", (double)is->rotation, -1e4, 1e4, e->shape == VNDF_SHAPE_ROTATED}};
    vndf_status status = check_numbers(whole, 3, error);
    for (int i = 0; status == VNDF_OK && i < (is->wavelengths ? is->wavelengths : 3); i++) {
        char f0[24], eta[24], k[24];
        snprintf(f0, sizeof f0, "f0[%d]", i);
        snprintf(eta, sizeof eta, "conductor_eta[%d]", i);
        snprintf(k, sizeof k, "conductor_k[%d]", i);
        const number own[] = {{f0, (double)is->f0[i], 0, 1, schlick},
                              {eta, (double)is->conductor_eta[i], 0, 1000, metal},
                              {k, (double)is->conductor_k[i], 0, 1000, metal}};
        status = check_numbers(own, 3, error);
        if (status == VNDF_OK && metal && !(is->conductor_eta[i] + is->conductor_k[i] > 0.0f))
            status = vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s and %s are both 0", eta, k);
    }
    return status;
}

/* ---- combinations ---- */

static vndf_status check_combination(const vndf_description *is, vndf_error *error)
{
    const vndf_effects *e = &is->effects;
    int transmits = e->lobes != VNDF_LOBES_REFLECTION, both = e->lobes == VNDF_LOBES_BOTH;
    int walks = e->scattering == VNDF_SCATTERING_MULTIPLE, compensates = vndf_compensates(e);
    int is_retro = e->reflection == VNDF_REFLECTION_RETRO, tilts = e->shape >= VNDF_SHAPE_AFFINE;
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
        {compensates && !by_height,
         "scattering is VNDF_SCATTERING_TURQUIN or VNDF_SCATTERING_KULLA_CONTY, whose albedos have Smith's masking by "
         "height: masking must be VNDF_MASKING_HEIGHT_CORRELATED"},
        {compensates && transmits && !(both && e->fresnel == VNDF_FRESNEL_DIELECTRIC),
         "scattering is VNDF_SCATTERING_TURQUIN or VNDF_SCATTERING_KULLA_CONTY: lobes must be VNDF_LOBES_REFLECTION, "
         "or VNDF_LOBES_BOTH with VNDF_FRESNEL_DIELECTRIC"},
        {compensates && tilts,
         "scattering is VNDF_SCATTERING_TURQUIN or VNDF_SCATTERING_KULLA_CONTY, whose albedos are of one distribution "
         "without mean slope: shape must not be VNDF_SHAPE_AFFINE or VNDF_SHAPE_MIXTURE"},
        {is_retro && e->lobes == VNDF_LOBES_TRANSMISSION,
         "reflection is VNDF_REFLECTION_RETRO and lobes is VNDF_LOBES_TRANSMISSION: nothing is reflected"},
        {tilts && (!sees || e->masking == VNDF_MASKING_V_CAVITIES || is_retro || walks),
         "shape is VNDF_SHAPE_AFFINE or VNDF_SHAPE_MIXTURE, a surface with a mean slope: normals must be "
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

/* ---- shapes ---- */

/* Whether a view is valid: straight from above it then has the area 1. */
static int is_visible(const vndf_affine *surface)
{
    const vndf_vec3 up = {0.0f, 0.0f, 1.0f};
    vndf_view view = vndf_affine_view_from(surface, up);
    return vndf_view_area(&view, up) > 0.0f;
}

/* Of the material or a lobe of its mixture; hits bring others, whose errors have a result. */
static vndf_status check_map(const char *name, const vndf_affine *a, vndf_error *error)
{
    if (!a->distribution)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s has the distribution NULL", name);
    if (is_visible(a))
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
    if (check_numbers(&count, 1, error) != VNDF_OK)
        return VNDF_ERROR_ARGUMENT;
    for (int i = 0; i < mixture->count; i++) {
        const vndf_mixture_lobe *lobe = &mixture->lobe[i];
        char name[48];
        snprintf(name, sizeof name, "mixture->lobe[%d].surface", i);
        if (!(lobe->weight >= 0.0f && lobe->weight < HUGE_VALF))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                             "mixture->lobe[%d].weight is %g, it must be finite and at least 0", i,
                             (double)lobe->weight);
        if (lobe->weight > 0.0f && check_map(name, &lobe->surface, error) != VNDF_OK)
            return VNDF_ERROR_ARGUMENT;
        sum += lobe->weight;
    }
    return sum > 0.0 ? VNDF_OK : vndf_fail(error, VNDF_ERROR_ARGUMENT, "mixture: the weights of all lobes are 0");
}

static vndf_status check_shape(const vndf_description *is, vndf_error *error)
{
    vndf_affine a = is->affine;
    if (is->effects.shape == VNDF_SHAPE_MIXTURE)
        return is->mixture ? check_mixture(is->mixture, error) : VNDF_OK;
    if (!is->distribution)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "distribution is NULL");
    if (is->effects.shape <= VNDF_SHAPE_ROTATED) {
        a = (vndf_affine){is->distribution, is->alpha_x, 0.0f, 0.0f, is->alpha_y, 0.0f, 0.0f};
        if (is->alpha_x > 0.0f && is->alpha_y > 0.0f && is_visible(&a))
            return VNDF_OK;
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "alpha_x is %g and alpha_y %g; both must be above 0, and times the scale of the "
                         "distribution within [1e-15, 1e15]",
                         (double)is->alpha_x, (double)is->alpha_y);
    }
    a.distribution = is->distribution;
    if (is->effects.shape == VNDF_SHAPE_MATRIX) /* which does not read it */
        a.mean_x = a.mean_y = 0.0f;
    return check_map("affine", &a, error);
}

vndf_status vndf_description_check(const vndf_description *is, vndf_error *error)
{
    vndf_status status = check_choices(&is->effects, error);
    if (status == VNDF_OK)
        status = check_combination(is, error);
    if (status == VNDF_OK)
        status = check_shape(is, error);
    if (status == VNDF_OK && vndf_compensates(&is->effects))
        status = vndf_albedo_check(is, error);
    return status == VNDF_OK ? check_optics(is, error) : status;
}
