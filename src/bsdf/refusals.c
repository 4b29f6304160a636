/* Combinations of effects that make no sense, and numbers out of range: each is refused by name. */
#include <math.h>
#include <stdio.h>

#include "bsdf/bsdf.h"
#include "core/error.h"
#include "sampler/sampler.h"

/* ---- effects ---- */

typedef struct effect_range {
    const char *name;
    unsigned value, last;
} effect_range;

static vndf_status check_range(const vndf_effects *e, vndf_error *error)
{
    const effect_range ranges[] = {
        {"lobes", (unsigned)e->lobes, VNDF_LOBES_BOTH},
        {"fresnel", (unsigned)e->fresnel, VNDF_FRESNEL_CONDUCTOR},
        {"masking", (unsigned)e->masking, VNDF_MASKING_NONE},
        {"normals", (unsigned)e->normals, VNDF_NORMALS_V_CAVITY},
        {"scattering", (unsigned)e->scattering, VNDF_SCATTERING_KULLA_CONTY},
        {"transport", (unsigned)e->transport, VNDF_TRANSPORT_IMPORTANCE},
        {"shape", (unsigned)e->shape, VNDF_SHAPE_MIXTURE},
        {"reflection", (unsigned)e->reflection, VNDF_REFLECTION_RETRO},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++)
        if (ranges[i].value > ranges[i].last)
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "effects.%s is %d, which is none of its choices",
                             ranges[i].name, (int)ranges[i].value);
    return VNDF_OK;
}

/* What is wrong with a combination; NULL if nothing. */
static const char *combination_refused(const vndf_effects *e)
{
    int transmits = e->lobes != VNDF_LOBES_REFLECTION, walks = e->scattering == VNDF_SCATTERING_MULTIPLE;
    int is_retro = e->reflection == VNDF_REFLECTION_RETRO, tilts = e->shape >= VNDF_SHAPE_AFFINE;
    if (transmits && e->fresnel == VNDF_FRESNEL_CONDUCTOR)
        return "fresnel is VNDF_FRESNEL_CONDUCTOR, and a conductor transmits nothing: lobes must be "
               "VNDF_LOBES_REFLECTION";
    if (e->lobes == VNDF_LOBES_BOTH && e->fresnel == VNDF_FRESNEL_NONE)
        return "lobes is VNDF_LOBES_BOTH and fresnel is VNDF_FRESNEL_NONE: nothing says which lobe light takes";
    if (transmits && e->normals == VNDF_NORMALS_BOUNDED)
        return "normals is VNDF_NORMALS_BOUNDED, normals that reflect to above the horizon: lobes must be "
               "VNDF_LOBES_REFLECTION";
    if (e->normals == VNDF_NORMALS_V_CAVITY && e->masking != VNDF_MASKING_V_CAVITIES)
        return "normals is VNDF_NORMALS_V_CAVITY, so masking must be VNDF_MASKING_V_CAVITIES";
    if (vndf_compensates(e) && e->masking != VNDF_MASKING_HEIGHT_CORRELATED)
        return "scattering is VNDF_SCATTERING_TURQUIN or VNDF_SCATTERING_KULLA_CONTY, whose albedos have Smith's "
               "masking by height: masking must be VNDF_MASKING_HEIGHT_CORRELATED";
    if (vndf_compensates(e) && transmits &&
        (e->lobes == VNDF_LOBES_TRANSMISSION || e->fresnel != VNDF_FRESNEL_DIELECTRIC))
        return "scattering is VNDF_SCATTERING_TURQUIN or VNDF_SCATTERING_KULLA_CONTY: lobes must be "
               "VNDF_LOBES_REFLECTION, or VNDF_LOBES_BOTH with VNDF_FRESNEL_DIELECTRIC";
    if (vndf_compensates(e) && tilts)
        return "scattering is VNDF_SCATTERING_TURQUIN or VNDF_SCATTERING_KULLA_CONTY, whose albedos are of one "
               "distribution without mean slope: shape must not be VNDF_SHAPE_AFFINE or VNDF_SHAPE_MIXTURE";
    if (is_retro && e->lobes == VNDF_LOBES_TRANSMISSION)
        return "reflection is VNDF_REFLECTION_RETRO and lobes is VNDF_LOBES_TRANSMISSION: nothing is reflected";
    if (tilts &&
        (e->normals != VNDF_NORMALS_VISIBLE || e->masking == VNDF_MASKING_V_CAVITIES || is_retro || walks))
        return "shape is VNDF_SHAPE_AFFINE or VNDF_SHAPE_MIXTURE, a surface with a mean slope: normals must be "
               "VNDF_NORMALS_VISIBLE, masking not VNDF_MASKING_V_CAVITIES, scattering VNDF_SCATTERING_SINGLE and "
               "reflection VNDF_REFLECTION_SPECULAR";
    if (walks && (e->masking != VNDF_MASKING_HEIGHT_CORRELATED || e->normals != VNDF_NORMALS_VISIBLE ||
                  e->lobes == VNDF_LOBES_TRANSMISSION))
        return "scattering is VNDF_SCATTERING_MULTIPLE, a walk: masking must be VNDF_MASKING_HEIGHT_CORRELATED, "
               "normals VNDF_NORMALS_VISIBLE and lobes VNDF_LOBES_REFLECTION or VNDF_LOBES_BOTH";
    return NULL;
}

/* ---- numbers ---- */

/* False for NaN. */
static int is_within(double x, double least, double most)
{
    return x >= least && x <= most;
}

static vndf_status check_numbers(const vndf_description *is, vndf_error *error)
{
    const vndf_effects *e = &is->effects;
    int bends = e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
    const struct {
        int is_read;
        const char *name;
        double value, least, most;
    } numbers[] = {{1, "wavelengths", is->wavelengths, 0, VNDF_WAVELENGTHS},
                   {bends, "eta", (double)is->eta, (double)0.01f, 100},
                   {e->shape == VNDF_SHAPE_ROTATED, "rotation", (double)is->rotation, -1e4, 1e4}};
    for (int i = 0; i < 3; i++)
        if (numbers[i].is_read && !is_within(numbers[i].value, numbers[i].least, numbers[i].most))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s is %g, it must be in [%g, %g]", numbers[i].name,
                             numbers[i].value, numbers[i].least, numbers[i].most);
    if (e->scattering == VNDF_SCATTERING_MULTIPLE && e->lobes == VNDF_LOBES_BOTH &&
        e->fresnel == VNDF_FRESNEL_SCHLICK && is->eta == 1.0f)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "eta is 1: a walk with VNDF_FRESNEL_SCHLICK needs another, "
                         "since light that goes straight on has no density");
    return VNDF_OK;
}

/* What each wavelength has. */
static vndf_status check_optics(const vndf_description *is, vndf_error *error)
{
    vndf_fresnel fresnel = is->effects.fresnel;
    for (int i = 0; i < (is->wavelengths ? is->wavelengths : 3); i++) {
        float eta = is->conductor_eta[i], k = is->conductor_k[i];
        const struct {
            vndf_fresnel of;
            const char *name;
            double value, most;
        } numbers[] = {{VNDF_FRESNEL_SCHLICK, "f0", (double)is->f0[i], 1},
                       {VNDF_FRESNEL_CONDUCTOR, "conductor_eta", (double)eta, 1000},
                       {VNDF_FRESNEL_CONDUCTOR, "conductor_k", (double)k, 1000}};
        for (int n = 0; n < 3; n++)
            if (fresnel == numbers[n].of && !is_within(numbers[n].value, 0, numbers[n].most))
                return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%s[%d] is %g, it must be in [0, %g]",
                                 numbers[n].name, i, numbers[n].value, numbers[n].most);
        if (fresnel == VNDF_FRESNEL_CONDUCTOR && !(eta + k > 0.0f))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "conductor_eta[%d] and conductor_k[%d] are both 0", i, i);
    }
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
    if (mixture->count < 1 || mixture->count > VNDF_MIXTURE_LOBES)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "mixture->count is %d, it must be in [1, %d]", mixture->count,
                         VNDF_MIXTURE_LOBES);
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
    vndf_status status = check_range(&is->effects, error);
    const char *refused = status == VNDF_OK ? combination_refused(&is->effects) : NULL;
    if (refused)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "effects: %s", refused);
    if (status == VNDF_OK)
        status = check_shape(is, error);
    if (status == VNDF_OK && vndf_compensates(&is->effects))
        status = vndf_albedo_check(is, error);
    if (status == VNDF_OK)
        status = check_numbers(is, error);
    return status == VNDF_OK ? check_optics(is, error) : status;
}
