/* One scattering event: what a material picks of Fresnel's terms, masking and normals, and the lobes that call
 * them (kernel/lobes.h). With q = A(wi) (visible density)/(density), what a normal's draw leaves of D
 * (wi.wm)/(density), the weight of a reflection is F G wo' q and that of a transmission (1 - F) G |wo'| q, over
 * r^2 for radiance. */
#include "bsdf/bsdf.h"

/* ---- Fresnel ---- */

static void set_all(double f[VNDF_WAVELENGTHS], double value)
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) /* all, so that the count is a constant */
        f[i] = value;
}

static void reflect_schlick(const vndf_description *is, seen_cosine c, double eta, double *f)
{
    (void)eta;
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = schlick(c.rest, is->f0[i]);
}

/* The cosine in the thinner medium: reflection is total where that has none. */
static void reflect_schlick_thin(const vndf_description *is, seen_cosine c, double eta, double *f)
{
    c.rest = eta < 1.0 ? refracted_rest(c.rest, eta) : c.rest;
    reflect_schlick(is, c, eta, f);
}

static void reflect_dielectric(const vndf_description *is, seen_cosine c, double eta, double *f)
{
    (void)is;
    set_all(f, dielectric(c.facing, eta));
}

/* From outside alone. */
static void reflect_conductor(const vndf_description *is, seen_cosine c, double eta, double *f)
{
    (void)eta;
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = conductor(c.facing, is->conductor_eta[i], is->conductor_k[i]);
}

static void reflect_all(const vndf_description *is, seen_cosine c, double eta, double *f)
{
    (void)is, (void)c, (void)eta;
    set_all(f, 1.0);
}

static void reflect_nothing(const vndf_description *is, seen_cosine c, double eta, double *f)
{
    (void)is;
    set_all(f, refracted_square(c.facing, eta) > 0.0 ? 0.0 : 1.0);
}

static const vndf_fresnel_routine total = {reflect_all};

const vndf_fresnel_routine *vndf_fresnel_of(const vndf_effects *e)
{
    static const vndf_fresnel_routine by_schlick = {reflect_schlick}, by_schlick_thin = {reflect_schlick_thin},
                                      by_dielectric = {reflect_dielectric}, by_conductor = {reflect_conductor},
                                      nothing = {reflect_nothing};
    int transmits = e->lobes != VNDF_LOBES_REFLECTION;
    switch (e->fresnel) {
    case VNDF_FRESNEL_SCHLICK: return transmits ? &by_schlick_thin : &by_schlick;
    case VNDF_FRESNEL_DIELECTRIC: return &by_dielectric;
    case VNDF_FRESNEL_CONDUCTOR: return &by_conductor;
    default: return transmits ? &nothing : &total;
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

/* ---- masking ---- */

VNDF_INLINE vndf_vec3 up_of(const event *e)
{
    return vndf_vec3_of((float)e->up.x, (float)e->up.y, (float)e->up.z);
}

VNDF_INLINE double area_of(const vndf_bsdf *b, const event *e)
{
    return (double)vndf_hit_area(&b->view, up_of(e));
}

static double reflect_by_height(const vndf_bsdf *b, const event *e)
{
    return masked_by_height((double)b->rise, e->rise, (double)b->area, area_of(b, e));
}

static double transmit_by_height(const vndf_bsdf *b, const event *e)
{
    return passed_by_height((double)b->rise, e->rise, (double)b->area, area_of(b, e));
}

static double mask_apart(const vndf_bsdf *b, const event *e)
{
    return masked_apart((double)b->area, area_of(b, e));
}

static double reflect_in_cavities(const vndf_bsdf *b, const event *e)
{
    return masked_in_cavities((double)b->rise, e->rise, e->facing, e->wm.z);
}

static double transmit_in_cavities(const vndf_bsdf *b, const event *e)
{
    return passed_in_cavities((double)b->rise, e->rise, e->facing, e->beyond, e->wm.z);
}

static double unmasked(const vndf_bsdf *b, const event *e)
{
    return 1.0 / ((double)b->rise * e->rise);
}

static const vndf_masking_routine by_height = {reflect_by_height, transmit_by_height};

const vndf_masking_routine *vndf_masking_of(const vndf_effects *e)
{
    static const vndf_masking_routine apart = {mask_apart, mask_apart},
                                      cavities = {reflect_in_cavities, transmit_in_cavities},
                                      none = {unmasked, unmasked};
    switch (e->masking) {
    case VNDF_MASKING_SEPARABLE: return &apart;
    case VNDF_MASKING_V_CAVITIES: return &cavities;
    case VNDF_MASKING_NONE: return &none;
    default: return &by_height;
    }
}

/* ---- normals ---- */

const vndf_normals_routine *vndf_normals_of(const vndf_effects *e)
{
    static const vndf_normals_routine routines[VNDF_NORMALS_V_CAVITY + 1] = {
        [VNDF_NORMALS_VISIBLE] = {vndf_sample_visible, vndf_pdf},
        [VNDF_NORMALS_BOUNDED] = {vndf_sample_bounded, vndf_pdf_bounded},
        [VNDF_NORMALS_ALL] = {vndf_sample_all, vndf_pdf_all},
        [VNDF_NORMALS_V_CAVITY] = {vndf_sample_v_cavity, vndf_pdf_v_cavity}};
    return &routines[e->normals];
}

VNDF_INLINE vndf_drawn_normal draw(const vndf_bsdf *b, float u1, float u2)
{
    vndf_drawn_normal n;
    if (b->view.kind != VNDF_HIT_MIXTURE)
        return b->material->normals->draw(&b->view.of.one, u1, u2);
    n.wm = vndf_mixture_sample(&b->view.of.mixture, u1, u2, &n.density, NULL);
    n.weight = n.density > 0.0f ? vndf_mixture_visible(&b->view.of.mixture, n.wm) / n.density : 0.0f;
    return n;
}

VNDF_INLINE float pdf_of(const vndf_bsdf *b, const event *e)
{
    vndf_vec3 wm = vndf_vec3_of((float)e->wm.x, (float)e->wm.y, (float)e->wm.z);
    return b->view.kind == VNDF_HIT_MIXTURE ? vndf_mixture_pdf(&b->view.of.mixture, wm)
                                            : b->material->normals->pdf(&b->view.of.one, wm);
}

/* ---- samples ---- */

VNDF_INLINE int goes_up(const vndf_bsdf *b, event *e)
{
    e->rise = (double)vndf_hit_cosine(&b->view, up_of(e));
    return e->rise > 0.0;
}

/* Completes a sample of an event; `part` of the samples take its lobe. f NULL: 1 of all wavelengths. */
VNDF_INLINE void set_scattered(const vndf_bsdf *b, const vndf_drawn_normal *n, const event *e, double masked,
                               const double f[VNDF_WAVELENGTHS], double part, vndf_lobe lobe, vndf_scattered *s)
{
    int reflects = lobe == VNDF_LOBE_REFLECTION;
    double whole = masked * e->rise * ((double)b->area * (double)n->weight);
    s->wo = vndf_turned(up_of(e), reflects ? b->side : -b->side);
    s->wm = vndf_turned(n->wm, b->side);
    s->density = lobe == VNDF_LOBE_STRAIGHT
                     ? 1.0f
                     : vndf_positive(vndf_density_from((double)n->density * e->jacobian * part));
    s->lobe = lobe;
    float bare = f ? 0.0f : vndf_density_from(whole);
    for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
        s->weight[i] = f ? vndf_density_from(whole * ((reflects ? f[i] : 1.0 - f[i]) / part)) : bare;
}

VNDF_INLINE const double *reflectances(const vndf_bsdf *b, seen_cosine c, double f[VNDF_WAVELENGTHS])
{
    b->material->fresnel->reflectance(&b->material->is, c, b->eta, f);
    return f;
}

/* The two lobes at a drawn normal. Reflection has the reflectances f, or forms them where there is `fresnel`. */
VNDF_INLINE void reflect(const vndf_bsdf *b, const vndf_drawn_normal *n, seen_cosine c, const double *f,
                         double part, int fresnel, const vndf_masking_routine *masking, vndf_scattered *s)
{
    double own[VNDF_WAVELENGTHS];
    event e = reflected_at(vndf_direction(b->wi), vndf_direction(n->wm), c);
    if (!e.met || !goes_up(b, &e)) {
        vndf_scatter_nothing(s);
        return;
    }
    if (fresnel)
        f = reflectances(b, c, own);
    double masked = masking->reflection(b, &e);
    set_scattered(b, n, &e, masked, f, part, VNDF_LOBE_REFLECTION, s);
}

VNDF_INLINE void transmit(const vndf_bsdf *b, const vndf_drawn_normal *n, seen_cosine c, const double *f,
                          double part, vndf_scattered *s)
{
    event e = refracted_at(vndf_direction(b->wi), vndf_direction(n->wm), c, b->eta);
    e.rise = (double)vndf_hit_cosine(&b->view, up_of(&e));
    if (!e.met || !(e.rise > 0.0)) {
        vndf_scatter_nothing(s);
        return;
    }
    double masked = b->carried * b->material->masking->transmission(b, &e);
    set_scattered(b, n, &e, masked, f, part, b->eta == 1.0 ? VNDF_LOBE_STRAIGHT : VNDF_LOBE_TRANSMISSION, s);
}

VNDF_INLINE seen_cosine seen(const vndf_bsdf *b, const vndf_drawn_normal *n)
{
    return seen_cosine_of(vndf_direction(b->wi), vndf_direction(n->wm));
}

/* Reflection without a Fresnel term, height-correlated. */
static void scatter_bare(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    const seen_cosine c = {dot_of(vndf_direction(b->wi), vndf_direction(n->wm)), 0.0};
    (void)u3;
    reflect(b, n, c, NULL, 1.0, 0, &by_height, s);
}

static void scatter_reflected(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    (void)u3;
    reflect(b, n, seen(b, n), NULL, 1.0, 1, b->material->masking, s);
}

static void scatter_through(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    double f[VNDF_WAVELENGTHS];
    seen_cosine c = seen(b, n);
    (void)u3;
    reflectances(b, c, f);
    transmit(b, n, c, f, 1.0, s);
}

/* Numbers outside [0, 1] do not choose what never happens. */
static void scatter_both(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    double f[VNDF_WAVELENGTHS];
    seen_cosine c = seen(b, n);
    reflectances(b, c, f);
    double part = vndf_mean_of(b->material, f);
    if ((part > 0.0 && u3 < part) || !(part < 1.0))
        reflect(b, n, c, f, part, 0, b->material->masking, s);
    else
        transmit(b, n, c, f, 1.0 - part, s);
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_drawn_normal n = draw(b, u[0], u[1]);
    b->material->single->scatter(b, &n, u[2], s);
}

/* ---- values and densities ---- */

/* f and the density towards a direction; the density is that of the lobe times the part of the samples that take
 * it. */
VNDF_INLINE void look(const vndf_bsdf *b, vndf_vec3 given, float *value, float *pdf, vndf_lobes lobes,
                      const vndf_fresnel_routine *fresnel, const vndf_masking_routine *masking)
{
    const vndf_material *m = b->material;
    vndf_vec3 wo = vndf_turned(given, b->side);
    float rise = vndf_hit_cosine(&b->view, wo);
    int reflects = rise > 0.0f;
    vndf_see_nothing(b, value, pdf);
    if (!vndf_is_near_unit(wo) || !(rise != 0.0f) ||
        lobes == (reflects ? VNDF_LOBES_TRANSMISSION : VNDF_LOBES_REFLECTION))
        return;
    direction from = vndf_direction(b->wi), to = vndf_direction(reflects ? wo : vndf_turned(wo, -1.0f));
    event e = reflects ? reflecting(from, to) : refracting(from, to, b->eta);
    if (!e.met)
        return;
    double f[VNDF_WAVELENGTHS];
    e.rise = fabs((double)rise);
    const seen_cosine c = {e.facing, reflects ? reflecting_rest(e, from, to) : e.rest};
    if (value || lobes == VNDF_LOBES_BOTH)
        fresnel->reflectance(&m->is, c, b->eta, f);
    if (value) {
        double masked = reflects ? masking->reflection(b, &e) : b->carried * masking->transmission(b, &e);
        vndf_vec3 wm = vndf_vec3_of((float)e.wm.x, (float)e.wm.y, (float)e.wm.z);
        double shape = (double)b->tilt * (double)vndf_hit_ndf(&b->view, wm) * e.facing * e.jacobian * masked;
        for (int i = 0; i < m->is.wavelengths; i++)
            value[i] = vndf_density_from(shape * (reflects ? f[i] : 1.0 - f[i]));
    }
    if (pdf) {
        double mean = lobes == VNDF_LOBES_BOTH ? vndf_mean_of(m, f) : 1.0;
        double part = reflects || lobes != VNDF_LOBES_BOTH ? mean : 1.0 - mean;
        *pdf = vndf_density_from(part * ((double)pdf_of(b, &e) * e.jacobian));
    }
}

static void eval_bare(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, VNDF_LOBES_REFLECTION, &total, &by_height);
}

static void eval_reflected(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, VNDF_LOBES_REFLECTION, b->material->fresnel, b->material->masking);
}

static void eval_through(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, VNDF_LOBES_TRANSMISSION, b->material->fresnel, b->material->masking);
}

static void eval_both(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, VNDF_LOBES_BOTH, b->material->fresnel, b->material->masking);
}

const vndf_routines *vndf_single_of(const vndf_effects *e)
{
    static const vndf_routines bare = {NULL, sample, eval_bare, scatter_bare},
                               reflection = {NULL, sample, eval_reflected, scatter_reflected},
                               transmission = {NULL, sample, eval_through, scatter_through},
                               lobes = {NULL, sample, eval_both, scatter_both};
    if (e->lobes != VNDF_LOBES_REFLECTION)
        return e->lobes == VNDF_LOBES_BOTH ? &lobes : &transmission;
    return e->fresnel == VNDF_FRESNEL_NONE && e->masking == VNDF_MASKING_HEIGHT_CORRELATED ? &bare : &reflection;
}

/* ---- retroreflection ----
 *
 * Samples, values and densities are those of the same material without it, with wo turned by half a turn where it
 * is on the side of wi. That turn changes no length and no angle, so all integrals and reciprocity stay. */

static vndf_vec3 turned_about(const vndf_bsdf *b, vndf_vec3 wo)
{
    float turn = wo.z * b->side > 0.0f ? -1.0f : 1.0f;
    return vndf_vec3_of(turn * wo.x, turn * wo.y, wo.z);
}

static void sample_retro(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->specular->sample(b, u, s);
    if (s->lobe == VNDF_LOBE_REFLECTION)
        s->wo = turned_about(b, s->wo);
}

static void eval_retro(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->specular->eval(b, turned_about(b, wo), seed, value, pdf);
}

const vndf_routines vndf_routines_retro = {NULL, sample_retro, eval_retro, NULL};
