/* One scattering event on a mixture: all lobes, Fresnel terms and Smith's maskings by one text, which evaluates every
 * sample at the direction as it was rounded.
 *
 * The frame of the hit is turned about the origin, w to -w, where wi is below the mean plane: facets are then seen from
 * their other side, and their slopes stay what they are. With primes for projections of the mean plane, w' = w.z -
 * w.mean, and A(w) for the projected area, which is w' (1 + Lambda(w)), G = G2/(wi' wo') is that of terms/masking.h,
 *
 *     reflection      f n.z = F G D/4
 *     transmission    f n.z = (1 - F) G D (wi.wm) dwm/dwo, over r^2 for radiance
 *
 * Below the plane wo' is negative, and the area along wo that of the surface from its other side, A(-wo). */
#include "bsdf/lobes/mixture.h"

#include "bsdf/lobes/scatter.h"
#include "bsdf/terms/beta.h"
#include "sampler/affine/densities.h"

VNDF_INLINE vndf_vec3 seen_from(float side, vndf_vec3 w)
{
    return vndf_vec3_of(side * w.x, side * w.y, side * w.z);
}

double vndf_mixture_rise(const vndf_bsdf *b, vndf_vec3 w)
{
    return w.z - (w.x * b->lobes.mean_x + w.y * b->lobes.mean_y);
}

/* 1/n.z. */
static double tilt_of(const vndf_bsdf *b)
{
    const vndf_mixture_view *of = &b->lobes;
    return sqrt(1.0 + (of->mean_x * of->mean_x + of->mean_y * of->mean_y));
}

double vndf_mixture_cosine(const vndf_bsdf *b, vndf_vec3 w)
{
    return vndf_mixture_rise(b, w) / tilt_of(b);
}

/* ---- preparing a direction ---- */

int vndf_mixture_see(vndf_bsdf *b, const vndf_mixture *mixture, vndf_vec3 wi)
{
    vndf_mixture_view_set(&b->lobes, mixture, wi);
    b->view.wi = wi;
    return b->lobes.count > 0;
}

/* A roughness is no mixture. */
static int prepare_roughness(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    (void)b;
    (void)r;
    (void)wi;
    return 0;
}

/* ---- one event ---- */

/* What wi and wo have between them, in the frame of the hit. */
typedef struct event {
    vndf_half half;
    vndf_densities normal;
    double rise_i, rise_o; /* sizes of wi' and wo' */
    double masked;         /* G */
} event;

static double masked_by(vndf_masking masking, double area_i, double rise_i, double area_o, double rise_o,
                        int reflects)
{
    double below = area_o - rise_o, product = rise_i * rise_o;
    switch (masking) {
    case VNDF_MASKING_HEIGHT_CORRELATED: break;
    case VNDF_MASKING_SEPARABLE: return 1.0 / (area_i * area_o);
    case VNDF_MASKING_V_CAVITIES: break; /* refused */
    case VNDF_MASKING_NONE: return 1.0 / product;
    }
    if (reflects)
        return 1.0 / (rise_o * area_i + rise_i * (below > 0.0 ? below : 0.0));
    double i = area_i / rise_i, o = area_o / rise_o;
    return vndf_beta(i > 1.0 ? i : 1.0, o > 1.0 ? o : 1.0) / product;
}

/* Completes an event whose facet is known. */
static void complete(const vndf_bsdf *b, vndf_vec3 wo, int reflects, event *e)
{
    vndf_areas areas;
    vndf_mixture_view_areas(&b->lobes, wo, &areas);
    e->normal = vndf_mixture_densities(&b->lobes, e->half.wm, e->half.event.facing_i);
    e->rise_i = vndf_mixture_rise(b, b->view.wi);
    e->rise_o = fabs(areas.up);
    e->masked = masked_by(b->material->is.effects.masking, b->lobes.area, e->rise_i,
                          reflects ? areas.toward : areas.away, e->rise_o, reflects);
}

/* 0 where no facet takes wi to wo. */
static int event_between(const vndf_bsdf *b, vndf_vec3 wo, int reflects, event *e)
{
    vndf_vec3 wi = b->view.wi;
    vndf_normal o = vndf_normal_of(wo);
    e->half = reflects ? vndf_half_reflected(wi, o) : vndf_half_refracted(wi, o, b->eta);
    if (!vndf_is_refraction(&e->half) || !(e->half.wm.z >= 0.0))
        return 0;
    complete(b, wo, reflects, e);
    return e->normal.pdf > 0.0;
}

/* Whether a material has this lobe. */
static int scatters(const vndf_bsdf *b, int reflects)
{
    return b->material->is.effects.lobes != (reflects ? VNDF_LOBES_TRANSMISSION : VNDF_LOBES_REFLECTION);
}

/* The part of the samples that take the lobe. */
static double part_of(const vndf_bsdf *b, const double f[VNDF_WAVELENGTHS], int reflects)
{
    if (b->material->is.effects.lobes != VNDF_LOBES_BOTH)
        return 1.0;
    double mean = vndf_mean_of(b, f);
    return reflects ? mean : 1.0 - mean;
}

/* ---- samples ---- */

static void set_scattered(const vndf_bsdf *b, vndf_vec3 wo, vndf_vec3 wm, const event *e, int reflects,
                          vndf_scattered *s)
{
    double f[VNDF_WAVELENGTHS],
        whole = e->masked * e->rise_o * b->lobes.area * (e->normal.visible / e->normal.pdf);
    int straight = !reflects && b->eta == 1.0;
    vndf_reflectance(b, e->half.event.facing_i, f);
    double part = part_of(b, f, reflects);
    if (!(part > 0.0))
        return;
    s->wo = seen_from(b->side, wo);
    s->wm = seen_from(b->side, wm);
    s->density = straight ? 1.0f : vndf_positive(vndf_density_from(e->normal.pdf * e->half.jacobian * part));
    s->lobe = reflects ? VNDF_LOBE_REFLECTION : straight ? VNDF_LOBE_STRAIGHT : VNDF_LOBE_TRANSMISSION;
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_finite((float)(whole * (reflects ? f[i] : b->carried * (1.0 - f[i])) / part));
}

/* Which lobe a facet sends the light to: 1 reflection, 0 transmission, -1 none. */
static int lobe_of(const vndf_bsdf *b, const vndf_meeting *at, double square, float u3)
{
    vndf_lobes lobes = b->material->is.effects.lobes;
    if (lobes != VNDF_LOBES_BOTH)
        return lobes == VNDF_LOBES_REFLECTION ? 1 : square > 0.0 ? 0 : -1;
    double f[VNDF_WAVELENGTHS];
    vndf_reflectance(b, at->facing, f);
    double part = vndf_mean_of(b, f);
    return (part > 0.0 && u3 < part) || !(part < 1.0 && square > 0.0);
}

/* Light that passes without a change of direction: its facet is the drawn one. */
static void set_straight(const vndf_bsdf *b, const vndf_meeting *at, vndf_vec3 wm, vndf_scattered *s)
{
    vndf_vec3 wi = b->view.wi, wo = vndf_vec3_of(-wi.x, -wi.y, -wi.z);
    event e = {.half = {.wm = at->wm, .event = {.facing_i = at->facing}}};
    complete(b, wo, 0, &e);
    if (e.normal.pdf > 0.0)
        set_scattered(b, wo, wm, &e, 0, s);
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_vec3 wi = b->view.wi, wm = vndf_mixture_sample(&b->lobes, u[0], u[1], NULL, NULL);
    vndf_meeting at = vndf_meeting_of(wi, wm);
    double square = vndf_refracted_square(at.facing, b->eta);
    int lobe = lobe_of(b, &at, square, u[2]);
    vndf_scatter_nothing(s);
    if (lobe < 0)
        return;
    if (lobe == 0 && b->eta == 1.0) {
        set_straight(b, &at, wm, s);
        return;
    }
    vndf_vec3 wo = lobe ? vndf_reflected(wi, wm, vndf_dot(wi, wm))
                        : vndf_vec3_from(vndf_bent(&at, vndf_bend_along(&at, sqrt(square), b->eta), b->eta));
    event e;
    double rise = vndf_mixture_rise(b, wo);
    if ((lobe ? rise > 0.0 : rise < 0.0) && event_between(b, wo, lobe, &e))
        set_scattered(b, wo, wm, &e, lobe, s);
}

/* ---- values and densities ---- */

static void eval(const vndf_bsdf *b, vndf_vec3 given, uint64_t seed, float *value, float *pdf)
{
    double f[VNDF_WAVELENGTHS];
    vndf_vec3 wo = seen_from(b->side, given);
    double rise = vndf_mixture_rise(b, wo);
    int reflects = rise > 0.0;
    event e;
    (void)seed;
    if (!vndf_is_near_unit(wo) || !(rise != 0.0) || !scatters(b, reflects) ||
        !event_between(b, wo, reflects, &e)) {
        vndf_see_nothing(b, value, pdf);
        return;
    }
    vndf_reflectance(b, e.half.event.facing_i, f);
    double shape = e.masked * e.normal.visible * b->lobes.area * tilt_of(b);
    if (value)
        vndf_set_values(b, value,
                        reflects ? 0.25 * shape / e.half.event.facing_i : shape * e.half.jacobian * b->carried, f,
                        !reflects);
    if (pdf)
        *pdf = vndf_density_from(e.normal.pdf * e.half.jacobian * part_of(b, f, reflects));
}

static float pdf_of(const vndf_bsdf *b, vndf_vec3 wo)
{
    float pdf;
    eval(b, wo, 0, NULL, &pdf);
    return pdf;
}

const vndf_routines vndf_routines_mixture = {prepare_roughness, sample, eval, pdf_of, NULL, VNDF_BLOCK_NONE};
