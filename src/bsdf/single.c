/* One scattering event: what a material picks of Fresnel's terms, masking and normals, and the lobes that call them
 * (kernel/lobes.h). With q = A(wi) (visible density)/(density), what a normal's draw leaves of D (wi.wm)/(density), the
 * weight of a reflection is F G wo' q and that of a transmission (1 - F) G |wo'| q, over r^2 for radiance. */
#include "bsdf/bsdf.h"

/* ---- Fresnel ---- */

static void set_all(double f[VNDF_WAVELENGTHS], double value)
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) /* all, so that the count is a constant */
        f[i] = value;
}

/* Where light may pass Schlick's term takes the cosine in the thinner medium, so that reflection is total where that
 * has none, and the bare shape reflects what total reflection does. A conductor is seen from outside alone. */
void vndf_reflectances(const vndf_material *m, seen_cosine c, double eta, double f[VNDF_WAVELENGTHS])
{
    const vndf_description *is = &m->is;
    int transmits = is->effects.lobes != VNDF_LOBES_REFLECTION;
    switch (is->effects.fresnel) {
    case VNDF_FRESNEL_DIELECTRIC: set_all(f, dielectric(c.facing, eta)); return;
    case VNDF_FRESNEL_CONDUCTOR:
        for (int i = 0; i < is->wavelengths; i++)
            f[i] = conductor(c.facing, is->conductor_eta[i], is->conductor_k[i]);
        return;
    case VNDF_FRESNEL_SCHLICK:
        c.rest = transmits && eta < 1.0 ? refracted_rest(c.rest, eta) : c.rest;
        for (int i = 0; i < is->wavelengths; i++)
            f[i] = schlick(c.rest, is->f0[i]);
        return;
    case VNDF_FRESNEL_NONE: set_all(f, transmits && refracted_square(c.facing, eta) > 0.0 ? 0.0 : 1.0);
    }
}

static double cosine_of(float cosine)
{
    double c = fabs((double)cosine);
    return c < 1.0 ? c : 1.0;
}

float vndf_fresnel_dielectric(float cosine, float eta)
{
    return eta > 0.0f ? (float)dielectric(cosine_of(cosine), eta) : 1.0f;
}

float vndf_fresnel_conductor(float cosine, float eta, float k)
{
    return (float)conductor(cosine_of(cosine), eta, k);
}

float vndf_fresnel_schlick(float cosine, float f0)
{
    return (float)schlick(1.0 - cosine_of(cosine), f0);
}

/* A shape alone, which reflects all light: F is not asked for. */
static int is_white(const vndf_material *m)
{
    return m->is.effects.lobes == VNDF_LOBES_REFLECTION && m->is.effects.fresnel == VNDF_FRESNEL_NONE;
}

/* The part of the samples that a lobe takes. */
VNDF_INLINE double share_of(const vndf_material *m, const double *f, int reflects)
{
    if (m->is.effects.lobes != VNDF_LOBES_BOTH)
        return 1.0;
    double mean = vndf_mean_of(m, f);
    return reflects ? mean : 1.0 - mean;
}

/* What a lobe has of `whole` in each wavelength, over its share; all are as the first where F is one number. */
VNDF_INLINE void colour(const vndf_material *m, const double *f, int reflects, double whole, double share,
                        float *to)
{
    const vndf_fresnel fresnel = m->is.effects.fresnel;
    const int alike = fresnel == VNDF_FRESNEL_NONE || fresnel == VNDF_FRESNEL_DIELECTRIC;
    for (int i = 0; i < m->is.wavelengths; i++)
        to[i] = i && alike ? to[0] : vndf_density_from(whole * ((reflects ? f[i] : 1.0 - f[i]) / share));
}

/* ---- masking and normals ---- */

/* G of an event; of transmission for radiance over r^2. */
VNDF_INLINE double masked(const vndf_bsdf *b, const event *e, int reflects)
{
    vndf_masking masking = b->material->is.effects.masking;
    double rise = (double)b->own.rise, area = (double)b->own.area, carried = reflects ? 1.0 : b->own.carried;
    if (masking == VNDF_MASKING_V_CAVITIES)
        return reflects ? masked_in_cavities(rise, e->rise, e->facing, e->wm.z)
                        : passed_in_cavities(rise, e->rise, e->facing, e->beyond, e->wm.z) * carried;
    if (masking == VNDF_MASKING_NONE)
        return 1.0 / (rise * e->rise) * carried;
    double area_o = (double)vndf_hit_area(&b->own.view, vndf_rounded(e->up));
    if (masking == VNDF_MASKING_SEPARABLE)
        return masked_apart(area, area_o) * carried;
    return reflects ? masked_by_height(rise, e->rise, area, area_o)
                    : passed_by_height(rise, e->rise, area, area_o) * carried;
}

VNDF_INLINE vndf_drawn_normal draw(const vndf_bsdf *b, float u1, float u2)
{
    const struct vndf_hit_view *view = &b->own.view;
    const vndf_normals_drawn law = b->material->is.effects.normals;
    vndf_drawn_normal n;
    if (view->kind != VNDF_HIT_MIXTURE)
        return law == VNDF_NORMALS_VISIBLE ? vndf_sample_visible(&view->of.one, u1, u2)
                                           : vndf_sample_by(&view->of.one, law, u1, u2);
    n.wm = vndf_mixture_sample(&view->of.mixture, u1, u2, &n.density, NULL);
    n.weight = n.density > 0.0f ? vndf_mixture_visible(&view->of.mixture, n.wm) / n.density : 0.0f;
    return n;
}

VNDF_INLINE float pdf_of(const vndf_bsdf *b, vndf_vec3 wm)
{
    const struct vndf_hit_view *view = &b->own.view;
    const vndf_normals_drawn law = b->material->is.effects.normals;
    if (view->kind == VNDF_HIT_MIXTURE)
        return vndf_mixture_pdf(&view->of.mixture, wm);
    return law == VNDF_NORMALS_VISIBLE ? vndf_pdf(&view->of.one, wm) : vndf_pdf_by(&view->of.one, law, wm);
}

/* ---- samples ---- */

/* By one lobe at a normal. */
VNDF_INLINE int leave(const vndf_bsdf *b, const vndf_drawn_normal *n, seen_cosine c, const double *f,
                      const int reflects, vndf_scattered *s)
{
    direction wi = vndf_direction(b->own.wi), wm = vndf_direction(n->wm);
    event e = reflects ? reflected_at(wi, wm, c) : refracted_at(wi, wm, c, b->own.eta);
    vndf_vec3 up = vndf_rounded(e.up);
    e.rise = (double)vndf_hit_cosine(&b->own.view, up);
    if (!e.met || !(e.rise > 0.0))
        return 0;
    double whole = masked(b, &e, reflects) * e.rise * ((double)b->own.area * (double)n->weight);
    double share = share_of(b->material, f, reflects);
    int straight = !reflects && b->own.eta == 1.0;
    colour(b->material, f, reflects, whole, share, s->weight);
    s->wo = vndf_turned(up, reflects ? b->own.side : -b->own.side);
    s->wm = vndf_turned(n->wm, b->own.side);
    s->density = straight ? 1.0f : vndf_positive(vndf_density_from((double)n->density * e.jacobian * share));
    s->lobe = reflects ? VNDF_LOBE_REFLECTION : straight ? VNDF_LOBE_STRAIGHT : VNDF_LOBE_TRANSMISSION;
    return 1;
}

/* Numbers outside [0, 1] do not choose what never happens. */
int vndf_scatter(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    const vndf_material *m = b->material;
    const direction wi = vndf_direction(b->own.wi), wm = vndf_direction(n->wm);
    seen_cosine c = {dot_of(wi, wm), 0.0};
    double f[VNDF_WAVELENGTHS] = {1.0};
    if (!is_white(m)) {
        c = seen_cosine_of(wi, wm);
        vndf_reflectances(m, c, b->own.eta, f);
    }
    double mean = share_of(m, f, 1);
    int reflects = m->is.effects.lobes != VNDF_LOBES_TRANSMISSION && ((mean > 0.0 && u3 < mean) || !(mean < 1.0));
    return reflects ? leave(b, n, c, f, 1, s) : leave(b, n, c, f, 0, s);
}

static int sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_drawn_normal n = draw(b, u[0], u[1]);
    return vndf_scatter(b, &n, u[2], s);
}

/* ---- values and densities ---- */

VNDF_INLINE int load_row(const vndf_bsdf *b, vndf_vec3 wo, double rise, const int reflects, float *value,
                         float *pdf)
{
    const vndf_material *m = b->material;
    direction from = vndf_direction(b->own.wi), to = vndf_direction(reflects ? wo : vndf_turned(wo, -1.0f));
    event e = reflects ? reflecting(from, to) : refracting(from, to, b->own.eta);
    if (!e.met)
        return 0;
    double f[VNDF_WAVELENGTHS] = {1.0};
    vndf_vec3 wm = vndf_rounded(e.wm);
    e.rise = rise;
    if (reflects && m->is.effects.fresnel == VNDF_FRESNEL_SCHLICK)
        e.rest = reflecting_rest(e, from, to);
    if (!is_white(m) && (value || m->is.effects.lobes == VNDF_LOBES_BOTH))
        vndf_reflectances(m, (seen_cosine){e.facing, e.rest}, b->own.eta, f);
    if (value) {
        double g = masked(b, &e, reflects), ndf = (double)vndf_hit_ndf(&b->own.view, wm);
        colour(m, f, reflects, (double)b->own.tilt * ndf * e.facing * e.jacobian * g, 1.0, value);
    }
    if (pdf)
        *pdf = vndf_density_from(share_of(m, f, reflects) * ((double)pdf_of(b, wm) * e.jacobian));
    return 1;
}

static int eval(const vndf_bsdf *b, vndf_vec3 given, uint64_t seed, float *value, float *pdf)
{
    const vndf_lobes lobes = b->material->is.effects.lobes;
    vndf_vec3 wo = vndf_turned(given, b->own.side);
    double rise = (double)vndf_hit_cosine(&b->own.view, wo);
    (void)seed;
    if (rise > 0.0)
        return lobes != VNDF_LOBES_TRANSMISSION && load_row(b, wo, rise, 1, value, pdf);
    return rise < 0.0 && lobes != VNDF_LOBES_REFLECTION && load_row(b, wo, -rise, 0, value, pdf);
}

const vndf_routines vndf_routines_single = {sample, eval};
