/* One scattering event: a normal is drawn, wi is mirrored or refracted there, and the density of wo is that of the
 * normal times the Jacobian (Walter et al. 2007, equations 14 and 17), r the index beyond over that on the side of wi,
 *
 *     reflection     dwm/dwo = 1/(4 wi.wm),        transmission    dwm/dwo = r^2 |wo.wm|/|wi + r wo|^2.
 *
 * With q = A(wi) (visible density)/(density), what a normal's draw leaves of D (wi.wm)/(density), the weight of a
 * reflection is F G wo' q and that of a transmission (1 - F) G |wo'| q, over r^2 for radiance: the Jacobians cancel.
 * Along a refraction |wi + r wo| = (r^2 - 1)/(wi.wm + r |wo.wm|), which keeps its digits where r is near 1.
 *
 * bare       mirror_at, facet of two directions in float: reflection and nothing else
 * the rest   reflect_at and refract_at, from a drawn normal; reflecting and refracting, from two directions */
#include "bsdf/lobes/lobes.h"

#include "bsdf/hit.h"
#include "bsdf/terms/fresnel.h"
#include "bsdf/terms/masking.h"

/* Where a dot product of floats is small it keeps its digits in double. */
VNDF_INLINE double exact_dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * b.x + (double)a.y * b.y + (double)a.z * b.z;
}

/* ---- reflection ---- */

VNDF_INLINE vndf_vec3 mirror_at(const vndf_bsdf *b, vndf_vec3 wm, float facing)
{
    float twice = 2.0f * facing;
    return vndf_vec3_of(twice * wm.x - b->wi.x, twice * wm.y - b->wi.y, twice * wm.z - b->wi.z);
}

/* Bounded normals reflect to above the horizon but for rounding, and are not lost to that. */
VNDF_INLINE int goes_up(const vndf_bsdf *b, vndf_vec3 *wo, float *rise)
{
    *rise = vndf_hit_cosine(&b->view, *wo);
    if (*rise > 0.0f)
        return 1;
    if (b->material->is.effects.normals != VNDF_NORMALS_BOUNDED || *rise < -2e-6f)
        return 0;
    wo->z = *rise = FLT_MIN;
    return 1;
}

/* The normal between wi and wo, and wi.wm; 0 if there is none. Where both graze the sum is short, and lengths matter:
 * wo is given that of wi. Densities of normals hold wi.wm of wm as it is rounded: the same here keeps quotients. */
VNDF_INLINE double half_of(const vndf_bsdf *b, vndf_vec3 wo, vndf_vec3 *wm)
{
    double longer = 0.5 * (exact_dot(b->wi, b->wi) - exact_dot(wo, wo));
    double x = ((double)b->wi.x + wo.x) + longer * wo.x, y = ((double)b->wi.y + wo.y) + longer * wo.y,
           z = ((double)b->wi.z + wo.z) + longer * wo.z;
    double square = x * x + y * y + z * z, per = 1.0 / sqrt(square);
    if (!(square > 0.0) || !(z >= 0.0))
        return 0.0;
    *wm = vndf_vec3_of((float)(x * per), (float)(y * per), (float)(z * per));
    return exact_dot(b->wi, *wm);
}

/* ---- bare ---- */

static void scatter_bare(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    float facing = (float)exact_dot(b->wi, n->wm), rise;
    vndf_vec3 wo = mirror_at(b, n->wm, facing);
    (void)u3;
    if (!(facing > 0.0f) || !goes_up(b, &wo, &rise)) {
        vndf_scatter_nothing(s);
        return;
    }
    float below = vndf_hit_area(&b->view, wo) - rise, toward = rise * b->area;
    float weight = toward * n->weight / (toward + b->rise * (below > 0.0f ? below : 0.0f));
    s->wo = wo;
    s->wm = n->wm;
    s->density = vndf_positive(0.25f * n->density / facing);
    s->lobe = VNDF_LOBE_REFLECTION;
    for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
        s->weight[i] = vndf_finite(weight);
}

static void eval_bare(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    vndf_vec3 wm;
    float rise = vndf_hit_cosine(&b->view, wo), facing = vndf_is_near_unit(wo) ? (float)half_of(b, wo, &wm) : 0.0f;
    (void)seed;
    vndf_see_nothing(b, value, pdf);
    if (!(rise > 0.0f) || !(facing > 0.0f))
        return;
    if (value) {
        double masked = vndf_height_correlated((double)b->rise, (double)rise, (double)b->area,
                                               (double)vndf_hit_area(&b->view, wo));
        float f = vndf_density_from(0.25 * (double)b->tilt * (double)vndf_hit_ndf(&b->view, wm) * masked);
        for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
            value[i] = f;
    }
    if (pdf)
        *pdf = vndf_finite(0.25f * b->material->normals->pdf(&b->view, wm) / facing);
}

/* ---- events at a drawn normal ---- */

/* wi.wm. Where it is near 1 it is formed of 1 - wi.wm, which Schlick's term is a power of. */
VNDF_INLINE double facing_of(vndf_vec3 wi, vndf_vec3 wm)
{
    double dot = exact_dot(wi, wm);
    if (dot < 0.9)
        return dot;
    double x = (double)wi.x - wm.x, y = (double)wi.y - wm.y, z = (double)wi.z - wm.z;
    return 1.0 - 0.5 * (x * x + y * y + z * z);
}

VNDF_INLINE int reflect_at(const vndf_bsdf *b, vndf_vec3 wm, double facing, vndf_event *e)
{
    float rise;
    vndf_vec3 wo = mirror_at(b, wm, (float)facing);
    if (!(facing > 0.0) || !goes_up(b, &wo, &rise))
        return 0;
    *e = (vndf_event){wm, wo, (double)b->rise, (double)rise, facing, facing, 0.25 / facing};
    return 1;
}

/* `beyond` is the cosine to wm on the other side, eta beyond = root((eta^2 - 1) + facing^2). An index ratio of 1 leaves
 * wi as it is. */
VNDF_INLINE int refract_at(const vndf_bsdf *b, vndf_vec3 wm, double facing, double beyond, vndf_event *e)
{
    double change = (b->eta - 1.0) * (b->eta + 1.0), sum = facing + b->eta * beyond, per = 1.0 / b->eta;
    double along = change / sum; /* of wm, what -eta wo has more than wi */
    vndf_vec3 up = {(float)((b->wi.x + along * wm.x) * per), (float)((b->wi.y + along * wm.y) * per),
                    (float)((b->wi.z + along * wm.z) * per)};
    float rise = vndf_hit_cosine(&b->view, up);
    if (!(facing > 0.0) || !(rise > 0.0f))
        return 0;
    *e = (vndf_event){
        wm, up, (double)b->rise, (double)rise, facing, beyond, b->eta * b->eta * beyond / (along * along)};
    return 1;
}

/* Completes a sample whose event is known; `part` of the samples take its lobe. */
VNDF_INLINE void set_scattered(const vndf_bsdf *b, const vndf_drawn_normal *n, const vndf_event *e, int reflects,
                               const double f[VNDF_WAVELENGTHS], double part, vndf_scattered *s)
{
    const vndf_masking_routine *masking = b->material->masking;
    int straight = !reflects && b->eta == 1.0;
    double masked = reflects ? masking->reflection(b, e) : b->carried * masking->transmission(b, e);
    double whole = masked * e->cos_o * ((double)b->area * (double)n->weight);
    s->wo = vndf_turned(e->up, reflects ? b->side : -b->side);
    s->wm = vndf_turned(n->wm, b->side);
    s->density = straight ? 1.0f : vndf_positive(vndf_density_from((double)n->density * e->jacobian * part));
    s->lobe = reflects ? VNDF_LOBE_REFLECTION : straight ? VNDF_LOBE_STRAIGHT : VNDF_LOBE_TRANSMISSION;
    for (int i = 0, count = b->material->is.wavelengths; i < count; i++)
        s->weight[i] = vndf_density_from(whole * ((reflects ? f[i] : 1.0 - f[i]) / part));
}

static void scatter_reflected(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    double f[VNDF_WAVELENGTHS], facing = facing_of(b->wi, n->wm);
    vndf_event e;
    (void)u3;
    if (!reflect_at(b, n->wm, facing, &e)) {
        vndf_scatter_nothing(s);
        return;
    }
    vndf_reflectance(b, facing, f);
    set_scattered(b, n, &e, 1, f, 1.0, s);
}

static void scatter_through(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    double f[VNDF_WAVELENGTHS], facing = facing_of(b->wi, n->wm), square = vndf_refracted_square(facing, b->eta);
    vndf_event e;
    (void)u3;
    if (!(square > 0.0) || !refract_at(b, n->wm, facing, sqrt(square), &e)) {
        vndf_scatter_nothing(s);
        return;
    }
    vndf_reflectance(b, facing, f);
    set_scattered(b, n, &e, 0, f, 1.0, s);
}

/* Numbers outside [0, 1] do not choose what never happens. */
static void scatter_both(const vndf_bsdf *b, const vndf_drawn_normal *n, float u3, vndf_scattered *s)
{
    double f[VNDF_WAVELENGTHS], facing = facing_of(b->wi, n->wm), square = vndf_refracted_square(facing, b->eta);
    vndf_event e;
    vndf_reflectance(b, facing, f);
    double part = vndf_mean_of(b->material, f);
    int reflects = (part > 0.0 && u3 < part) || !(part < 1.0 && square > 0.0);
    double own = reflects ? part : 1.0 - part;
    if (own > 0.0 &&
        (reflects ? reflect_at(b, n->wm, facing, &e) : refract_at(b, n->wm, facing, sqrt(square), &e)))
        set_scattered(b, n, &e, reflects, f, own, s);
    else
        vndf_scatter_nothing(s);
}

/* ---- events of two directions ---- */

/* 0 if no microfacet does it. */
VNDF_INLINE int reflecting(const vndf_bsdf *b, vndf_vec3 wo, float rise, vndf_event *e)
{
    double facing = half_of(b, wo, &e->wm);
    if (facing > 0.9) {
        double x = (double)b->wi.x - wo.x, y = (double)b->wi.y - wo.y, z = (double)b->wi.z - wo.z;
        double square = 0.25 * (x * x + y * y + z * z); /* of the sine; 1 - wi.wm keeps its digits */
        facing = square < 1.0 ? 1.0 - square / (1.0 + sqrt(1.0 - square)) : facing;
    }
    e->up = wo;
    e->cos_i = (double)b->rise;
    e->cos_o = (double)rise;
    e->facing_i = e->facing_o = facing;
    e->jacobian = 0.25 / facing;
    return facing > 0.0;
}

VNDF_INLINE double per_length(vndf_vec3 w)
{
    return 1.0 / sqrt((double)w.x * w.x + (double)w.y * w.y + (double)w.z * w.z);
}

/* In double: where wi + eta wo is small an error of a length matters, so both lengths are made 1. */
VNDF_INLINE int refracting(const vndf_bsdf *b, vndf_vec3 wo, float rise, vndf_event *e)
{
    double i = per_length(b->wi), o = per_length(wo), change = b->eta - 1.0;
    double ix = b->wi.x * i, iy = b->wi.y * i, iz = b->wi.z * i, ox = wo.x * o, oy = wo.y * o, oz = wo.z * o;
    double x = change * ox + (ix + ox), y = change * oy + (iy + oy), z = change * oz + (iz + oz);
    double square = x * x + y * y + z * z, per = copysign(1.0 / sqrt(square), z);
    double facing = (ix * x + iy * y + iz * z) * per, beyond = -(ox * x + oy * y + oz * z) * per;
    *e = (vndf_event){{(float)(x * per), (float)(y * per), (float)(z * per)},
                      vndf_turned(wo, -1.0f),
                      (double)b->rise,
                      -(double)rise,
                      facing,
                      beyond,
                      b->eta * b->eta * beyond / square};
    return change != 0.0 && square > 0.0 && facing > 0.0 && beyond > 0.0;
}

/* f and the density towards a direction; the density is that of the lobe times the part of the samples that take it. */
VNDF_INLINE void look(const vndf_bsdf *b, vndf_vec3 given, float *value, float *pdf, vndf_lobes lobes)
{
    const vndf_material *m = b->material;
    vndf_vec3 wo = vndf_turned(given, b->side);
    float rise = vndf_hit_cosine(&b->view, wo);
    int reflects = rise > 0.0f;
    double f[VNDF_WAVELENGTHS];
    vndf_event e;
    vndf_see_nothing(b, value, pdf);
    if (!vndf_is_near_unit(wo) || !(rise != 0.0f) ||
        lobes == (reflects ? VNDF_LOBES_TRANSMISSION : VNDF_LOBES_REFLECTION))
        return;
    if (!(reflects ? reflecting(b, wo, rise, &e) : refracting(b, wo, rise, &e)))
        return;
    vndf_reflectance(b, e.facing_i, f);
    if (value) {
        double masked = reflects ? m->masking->reflection(b, &e) : b->carried * m->masking->transmission(b, &e);
        double shape = (double)b->tilt * (double)vndf_hit_ndf(&b->view, e.wm) * e.facing_i * e.jacobian * masked;
        for (int i = 0; i < m->is.wavelengths; i++)
            value[i] = vndf_density_from(shape * (reflects ? f[i] : 1.0 - f[i]));
    }
    if (pdf) {
        double mean = lobes == VNDF_LOBES_BOTH ? vndf_mean_of(m, f) : 1.0;
        double part = reflects || lobes != VNDF_LOBES_BOTH ? mean : 1.0 - mean;
        *pdf = vndf_density_from(part * ((double)m->normals->pdf(&b->view, e.wm) * e.jacobian));
    }
}

static void eval_reflected(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, VNDF_LOBES_REFLECTION);
}

static void eval_through(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, VNDF_LOBES_TRANSMISSION);
}

static void eval_both(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    (void)seed;
    look(b, wo, value, pdf, VNDF_LOBES_BOTH);
}

/* ---- routines ---- */

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    vndf_drawn_normal n = b->material->normals->draw(&b->view, u[0], u[1]);
    b->material->single->scatter(b, &n, u[2], s);
}

const vndf_routines vndf_routines_bare = {NULL, sample, eval_bare, scatter_bare};
const vndf_routines vndf_routines_reflection = {NULL, sample, eval_reflected, scatter_reflected};
const vndf_routines vndf_routines_transmission = {NULL, sample, eval_through, scatter_through};
const vndf_routines vndf_routines_both = {NULL, sample, eval_both, scatter_both};
