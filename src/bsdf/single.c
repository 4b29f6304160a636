/* One scattering event: what a material picks of Fresnel's terms, masking and normals, for kernel/event.h. */
#include "bsdf/bsdf.h"

/* ---- what kernel/event.h asks for ---- */

typedef const vndf_material *material;
typedef const vndf_bsdf *bsdf;

/* Optics of one wavelength. */
typedef struct optics {
    double f0, n, k;
} optics;

typedef struct hit {
    direction wi;
    double eta, rise, area, tilt, carried;
} hit;

#define reflects_of(m) ((m)->is.effects.lobes != VNDF_LOBES_TRANSMISSION)
#define transmits_of(m) ((m)->is.effects.lobes != VNDF_LOBES_REFLECTION)
#define fresnel_of(m) ((m)->is.effects.fresnel)
#define masking_of(m) ((m)->is.effects.masking)
#define material_of(b) ((b)->material)
#define cosine_at(b, w) ((double)vndf_hit_cosine(&(b)->own.view, vndf_rounded(w)))
#define area_at(b, w) ((double)vndf_hit_area(&(b)->own.view, vndf_rounded(w)))

KERNEL hit hit_of(bsdf b)
{
    const hit h = {vndf_direction(b->own.wi), b->own.eta,          (double)b->own.rise,
                   (double)b->own.area,       (double)b->own.tilt, b->own.carried};
    return h;
}

#include "kernel/event.h"

/* ---- Fresnel ---- */

/* F is one number for all wavelengths. */
VNDF_INLINE int is_alike(material m)
{
    return m->is.effects.fresnel == VNDF_FRESNEL_NONE || m->is.effects.fresnel == VNDF_FRESNEL_DIELECTRIC;
}

static void set_all(double f[VNDF_WAVELENGTHS], double value)
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) /* all, so that the count is a constant */
        f[i] = value;
}

/* A conductor is seen from outside alone. */
void vndf_reflectances(const vndf_material *m, seen_cosine c, double eta, double f[VNDF_WAVELENGTHS])
{
    optics o = {0.0, 0.0, 0.0};
    for (int i = 0; !is_alike(m) && i < m->is.wavelengths; i++) {
        o.f0 = (double)m->is.f0[i];
        o.n = (double)m->is.conductor_eta[i];
        o.k = (double)m->is.conductor_k[i];
        f[i] = reflectance(m, o, c, eta);
    }
    if (is_alike(m))
        set_all(f, reflectance(m, o, c, eta));
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
static int is_white(material m)
{
    return !transmits_of(m) && m->is.effects.fresnel == VNDF_FRESNEL_NONE;
}

/* The mean over the wavelengths, where lobes share by it. */
VNDF_INLINE double mean_of(material m, const double *f)
{
    return m->is.effects.lobes == VNDF_LOBES_BOTH ? vndf_mean_of(m, f) : 1.0;
}

/* What a lobe has of `whole` in each wavelength, over its part of the samples. */
VNDF_INLINE void colour(material m, const double *f, int reflects, double whole, double part, float *to)
{
    for (int i = 0; i < m->is.wavelengths; i++)
        to[i] = i && is_alike(m) ? to[0] : vndf_density_from(whole * ((reflects ? f[i] : 1.0 - f[i]) / part));
}

/* ---- normals ---- */

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
VNDF_INLINE int leave(bsdf b, const vndf_drawn_normal *n, seen_cosine c, const double *f, double mean,
                      const int reflects, vndf_scattered *s)
{
    event e = event_at(b, vndf_direction(n->wm), c, reflects);
    if (!e.met)
        return 0;
    double whole = event_weight(b, e, (double)n->weight, reflects), part = part_of(b->material, mean, reflects);
    int straight = !reflects && b->own.eta == 1.0;
    colour(b->material, f, reflects, whole, part, s->weight);
    s->wo = vndf_turned(vndf_rounded(e.up), reflects ? b->own.side : -b->own.side);
    s->wm = vndf_turned(n->wm, b->own.side);
    s->density = straight ? 1.0f : vndf_positive(vndf_density_from((double)n->density * e.jacobian * part));
    s->lobe = reflects ? VNDF_LOBE_REFLECTION : straight ? VNDF_LOBE_STRAIGHT : VNDF_LOBE_TRANSMISSION;
    return 1;
}

int vndf_scatter(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    const direction wi = vndf_direction(b->own.wi), wm = vndf_direction(n->wm);
    seen_cosine c = {dot_of(wi, wm), 0.0};
    double f[VNDF_WAVELENGTHS] = {1.0};
    if (!is_white(b->material)) {
        c = seen_cosine_of(wi, wm);
        vndf_reflectances(b->material, c, b->own.eta, f);
    }
    const double mean = mean_of(b->material, f);
    return chooses_reflection(b->material, mean, (double)u3) ? leave(b, n, c, f, mean, 1, s)
                                                             : leave(b, n, c, f, mean, 0, s);
}

static int sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_drawn_normal n = draw(b, u[0], u[1]);
    return vndf_scatter(b, &n, u[2], s);
}

/* ---- values and densities ---- */

VNDF_INLINE int evaluate(bsdf b, direction wo, double rise, const int reflects, float *value, float *pdf)
{
    const vndf_material *m = b->material;
    event e = event_of(b, wo, rise, reflects);
    if (!e.met)
        return 0;
    double f[VNDF_WAVELENGTHS] = {1.0};
    vndf_vec3 wm = vndf_rounded(e.wm);
    if (!is_white(m) && (value || m->is.effects.lobes == VNDF_LOBES_BOTH))
        vndf_reflectances(m, (seen_cosine){e.facing, e.rest}, b->own.eta, f);
    if (value) {
        const double g = masked(b, e, reflects), ndf = (double)vndf_hit_ndf(&b->own.view, wm);
        colour(m, f, reflects, event_value(b, e, g, ndf), 1.0, value);
    }
    if (pdf)
        *pdf = vndf_density_from(part_of(m, mean_of(m, f), reflects) * ((double)pdf_of(b, wm) * e.jacobian));
    return 1;
}

static int eval(const vndf_bsdf *b, vndf_vec3 given, uint64_t seed, float *value, float *pdf)
{
    const vndf_vec3 turned = vndf_turned(given, b->own.side);
    const direction wo = vndf_direction(turned);
    const double rise = (double)vndf_hit_cosine(&b->own.view, turned);
    (void)seed;
    if (rise > 0.0)
        return reflects_of(b->material) && evaluate(b, wo, rise, 1, value, pdf);
    return rise < 0.0 && transmits_of(b->material) && evaluate(b, wo, rise, 0, value, pdf);
}

const vndf_routines vndf_routines_single = {sample, eval};
