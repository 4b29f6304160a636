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

/* Apart, since it wants many registers. */
VNDF_RARE void reflect_conductor(const vndf_description *is, double facing, double f[VNDF_WAVELENGTHS])
{
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = conductor(facing, is->conductor_eta[i], is->conductor_k[i]);
}

/* Where light may pass Schlick's term takes the cosine in the thinner medium, so that reflection is total where that
 * has none, and the bare shape reflects what total reflection does. A conductor is seen from outside alone. */
void vndf_reflectances(const vndf_material *m, seen_cosine c, double eta, double f[VNDF_WAVELENGTHS])
{
    const vndf_description *is = &m->is;
    int transmits = is->effects.lobes != VNDF_LOBES_REFLECTION;
    switch (is->effects.fresnel) {
    case VNDF_FRESNEL_DIELECTRIC: set_all(f, dielectric(c.facing, eta)); return;
    case VNDF_FRESNEL_CONDUCTOR: reflect_conductor(is, c.facing, f); return;
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

/* ---- masking ---- */

VNDF_INLINE vndf_vec3 up_of(const event *e)
{
    return vndf_vec3_of((float)e->up.x, (float)e->up.y, (float)e->up.z);
}

VNDF_INLINE double area_of(const vndf_bsdf *b, const event *e)
{
    return (double)vndf_hit_area(&b->own.view, up_of(e));
}

VNDF_INLINE double by_height(const vndf_bsdf *b, const event *e, int reflects)
{
    double area = area_of(b, e);
    return reflects ? masked_by_height((double)b->own.rise, e->rise, (double)b->own.area, area)
                    : passed_by_height((double)b->own.rise, e->rise, (double)b->own.area, area) * b->own.carried;
}

/* G of an event; of transmission for radiance over r^2. */
VNDF_INLINE double masked(const vndf_bsdf *b, const event *e, int reflects)
{
    double rise = (double)b->own.rise, carried = reflects ? 1.0 : b->own.carried;
    switch (b->material->is.effects.masking) {
    case VNDF_MASKING_HEIGHT_CORRELATED: break;
    case VNDF_MASKING_SEPARABLE: return masked_apart((double)b->own.area, area_of(b, e)) * carried;
    case VNDF_MASKING_V_CAVITIES:
        return reflects ? masked_in_cavities(rise, e->rise, e->facing, e->wm.z)
                        : passed_in_cavities(rise, e->rise, e->facing, e->beyond, e->wm.z) * carried;
    case VNDF_MASKING_NONE: return 1.0 / (rise * e->rise) * carried;
    }
    return by_height(b, e, reflects);
}

/* The same in few registers: `look` has many numbers to keep. */
VNDF_RARE double masked_aside(const vndf_bsdf *b, const event *e, int reflects)
{
    return masked(b, e, reflects);
}

/* ---- normals ---- */

VNDF_INLINE int sees_one_surface(const vndf_bsdf *b)
{
    return b->own.view.kind != VNDF_HIT_MIXTURE && b->material->is.effects.normals == VNDF_NORMALS_VISIBLE;
}

VNDF_RARE vndf_drawn_normal draw_otherwise(const vndf_bsdf *b, float u1, float u2)
{
    vndf_drawn_normal n;
    switch (b->material->is.effects.normals) {
    case VNDF_NORMALS_VISIBLE: break;
    case VNDF_NORMALS_BOUNDED: return vndf_sample_bounded(&b->own.view.of.one, u1, u2);
    case VNDF_NORMALS_ALL: return vndf_sample_all(&b->own.view.of.one, u1, u2);
    case VNDF_NORMALS_V_CAVITY: return vndf_sample_v_cavity(&b->own.view.of.one, u1, u2);
    }
    n.wm = vndf_mixture_sample(&b->own.view.of.mixture, u1, u2, &n.density, NULL);
    n.weight = n.density > 0.0f ? vndf_mixture_visible(&b->own.view.of.mixture, n.wm) / n.density : 0.0f;
    return n;
}

VNDF_INLINE vndf_drawn_normal draw(const vndf_bsdf *b, float u1, float u2)
{
    return sees_one_surface(b) ? vndf_sample_visible(&b->own.view.of.one, u1, u2) : draw_otherwise(b, u1, u2);
}

VNDF_RARE float pdf_otherwise(const vndf_bsdf *b, vndf_vec3 wm)
{
    switch (b->material->is.effects.normals) {
    case VNDF_NORMALS_VISIBLE: break;
    case VNDF_NORMALS_BOUNDED: return vndf_pdf_bounded(&b->own.view.of.one, wm);
    case VNDF_NORMALS_ALL: return vndf_pdf_all(&b->own.view.of.one, wm);
    case VNDF_NORMALS_V_CAVITY: return vndf_pdf_v_cavity(&b->own.view.of.one, wm);
    }
    return vndf_mixture_pdf(&b->own.view.of.mixture, wm);
}

VNDF_INLINE float pdf_of(const vndf_bsdf *b, vndf_vec3 wm)
{
    return sees_one_surface(b) ? vndf_pdf(&b->own.view.of.one, wm) : pdf_otherwise(b, wm);
}

/* ---- samples ---- */

VNDF_INLINE int goes_up(const vndf_bsdf *b, event *e)
{
    e->rise = (double)vndf_hit_cosine(&b->own.view, up_of(e));
    return e->rise > 0.0;
}

/* Completes a sample of an event; `part` of the samples take its lobe. f NULL: 1 of all wavelengths. */
VNDF_INLINE void set_scattered(const vndf_bsdf *b, const vndf_drawn_normal *n, const event *e, const double *f,
                               double part, vndf_lobe lobe, const int bare, vndf_scattered *s)
{
    int reflects = lobe == VNDF_LOBE_REFLECTION, count = b->material->is.wavelengths;
    double g = bare ? by_height(b, e, 1) : masked(b, e, reflects);
    double whole = g * e->rise * ((double)b->own.area * (double)n->weight);
    s->wo = vndf_turned(up_of(e), reflects ? b->own.side : -b->own.side);
    s->wm = vndf_turned(n->wm, b->own.side);
    s->density = lobe == VNDF_LOBE_STRAIGHT
                     ? 1.0f
                     : vndf_positive(vndf_density_from((double)n->density * e->jacobian * part));
    s->lobe = lobe;
    float alike = f ? 0.0f : vndf_density_from(whole);
    for (int i = 0; i < count; i++)
        s->weight[i] = f ? vndf_density_from(whole * ((reflects ? f[i] : 1.0 - f[i]) / part)) : alike;
}

/* The two lobes at a drawn normal. Bare reflection is height-correlated, without a Fresnel term; other reflection has
 * the reflectances f, or forms them where f is NULL. */
VNDF_INLINE void reflect(const vndf_bsdf *b, const vndf_drawn_normal *n, seen_cosine c, const double *f,
                         double part, const int bare, vndf_scattered *s)
{
    double own[VNDF_WAVELENGTHS];
    event e = reflected_at(vndf_direction(b->own.wi), vndf_direction(n->wm), c);
    if (!e.met || !goes_up(b, &e)) {
        vndf_scatter_nothing(s);
        return;
    }
    if (!bare && !f) {
        vndf_reflectances(b->material, c, b->own.eta, own);
        f = own;
    }
    set_scattered(b, n, &e, f, part, VNDF_LOBE_REFLECTION, bare, s);
}

VNDF_INLINE void transmit(const vndf_bsdf *b, const vndf_drawn_normal *n, seen_cosine c, const double *f,
                          double part, vndf_scattered *s)
{
    event e = refracted_at(vndf_direction(b->own.wi), vndf_direction(n->wm), c, b->own.eta);
    if (!goes_up(b, &e) || !e.met) {
        vndf_scatter_nothing(s);
        return;
    }
    vndf_lobe lobe = b->own.eta == 1.0 ? VNDF_LOBE_STRAIGHT : VNDF_LOBE_TRANSMISSION;
    set_scattered(b, n, &e, f, part, lobe, 0, s);
}

static void scatter_bare(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    const seen_cosine c = {dot_of(vndf_direction(b->own.wi), vndf_direction(n->wm)), 0.0};
    (void)u3;
    reflect(b, n, c, NULL, 1.0, 1, s);
}

/* Numbers outside [0, 1] do not choose what never happens. */
static void scatter(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    seen_cosine c = seen_cosine_of(vndf_direction(b->own.wi), vndf_direction(n->wm));
    vndf_lobes lobes = b->material->is.effects.lobes;
    double f[VNDF_WAVELENGTHS], part = 0.0;
    if (lobes == VNDF_LOBES_REFLECTION) {
        reflect(b, n, c, NULL, 1.0, 0, s);
        return;
    }
    vndf_reflectances(b->material, c, b->own.eta, f);
    if (lobes == VNDF_LOBES_BOTH)
        part = vndf_mean_of(b->material, f);
    if ((part > 0.0 && u3 < part) || !(part < 1.0))
        reflect(b, n, c, f, part, 0, s);
    else
        transmit(b, n, c, f, 1.0 - part, s);
}

static void sample_bare(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_drawn_normal n = draw(b, u[0], u[1]);
    scatter_bare(b, &n, u[2], s);
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_drawn_normal n = draw(b, u[0], u[1]);
    scatter(b, &n, u[2], s);
}

/* ---- values and densities ---- */

/* f and the density towards a direction; the density is that of the lobe times the part of the samples that take
 * it. */
VNDF_INLINE void look(const vndf_bsdf *b, vndf_vec3 given, float *value, float *pdf, const int bare)
{
    const vndf_material *m = b->material;
    vndf_lobes lobes = bare ? VNDF_LOBES_REFLECTION : m->is.effects.lobes;
    vndf_vec3 wo = vndf_turned(given, b->own.side);
    float rise = vndf_hit_cosine(&b->own.view, wo);
    int reflects = rise > 0.0f;
    if (!vndf_is_near_unit(wo) || !(rise != 0.0f) ||
        lobes == (reflects ? VNDF_LOBES_TRANSMISSION : VNDF_LOBES_REFLECTION)) {
        vndf_see_nothing(b, value, pdf);
        return;
    }
    direction from = vndf_direction(b->own.wi), to = vndf_direction(reflects ? wo : vndf_turned(wo, -1.0f));
    event e = reflects ? reflecting(from, to) : refracting(from, to, b->own.eta);
    if (!e.met) {
        vndf_see_nothing(b, value, pdf);
        return;
    }
    double f[VNDF_WAVELENGTHS];
    vndf_vec3 wm = vndf_vec3_of((float)e.wm.x, (float)e.wm.y, (float)e.wm.z);
    e.rise = fabs((double)rise);
    if (!bare && (value || lobes == VNDF_LOBES_BOTH)) {
        const seen_cosine c = {e.facing, reflects ? reflecting_rest(e, from, to) : e.rest};
        vndf_reflectances(m, c, b->own.eta, f);
    }
    if (value) {
        const event at = e; /* what is pointed at leaves its registers */
        double g = bare ? by_height(b, &e, 1) : masked_aside(b, &at, reflects);
        double shape = (double)b->own.tilt * (double)vndf_hit_ndf(&b->own.view, wm) * e.facing * e.jacobian * g;
        for (int i = 0; i < m->is.wavelengths; i++)
            value[i] = vndf_density_from(bare ? shape : shape * (reflects ? f[i] : 1.0 - f[i]));
    }
    if (pdf) {
        double mean = lobes == VNDF_LOBES_BOTH ? vndf_mean_of(m, f) : 1.0;
        double part = reflects || lobes != VNDF_LOBES_BOTH ? mean : 1.0 - mean;
        *pdf = vndf_density_from(part * ((double)pdf_of(b, wm) * e.jacobian));
    }
}

static void eval_bare(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, 1);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, 0);
}

const vndf_routines *vndf_single_of(const vndf_effects *e)
{
    static const vndf_routines bare = {NULL, sample_bare, eval_bare, scatter_bare},
                               others = {NULL, sample, eval, scatter};
    int is_bare = e->lobes == VNDF_LOBES_REFLECTION && e->fresnel == VNDF_FRESNEL_NONE &&
                  e->masking == VNDF_MASKING_HEIGHT_CORRELATED;
    return is_bare ? &bare : &others;
}

/* ---- retroreflection ----
 *
 * Samples, values and densities are those of the same material without it, with wo turned by half a turn where it
 * is on the side of wi. That turn changes no length and no angle, so all integrals and reciprocity stay. */

static vndf_vec3 turned_about(const vndf_bsdf *b, vndf_vec3 wo)
{
    float turn = wo.z * b->own.side > 0.0f ? -1.0f : 1.0f;
    return vndf_vec3_of(turn * wo.x, turn * wo.y, wo.z);
}

static void sample_retro(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->own.specular->sample(b, u, s);
    if (s->lobe == VNDF_LOBE_REFLECTION)
        s->wo = turned_about(b, s->wo);
}

static void eval_retro(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->own.specular->eval(b, turned_about(b, wo), seed, value, pdf);
}

const vndf_routines vndf_routines_retro = {NULL, sample_retro, eval_retro, NULL};
