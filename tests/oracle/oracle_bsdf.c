/* The formulas. Where wi is below the mean plane all of space is turned about, w to -w: the microsurface is the same
 * from both sides. */
#include "oracle/oracle_bsdf.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- distributions ---- */

int oracle_ndf_open(oracle_ndf *ndf, const char *name)
{
    const int is_ggx = strcmp(name, "ggx") == 0;
    memset(ndf, 0, sizeof *ndf);
    ndf->name = name;
    ndf->distribution = is_ggx ? vndf_ggx() : vndf_beckmann();
    ndf->slopes = oracle_get(is_ggx ? ORACLE_GGX : ORACLE_BECKMANN);
    if (is_ggx || strcmp(name, "beckmann") == 0)
        return 1;
    ndf->distribution = ndf->owned = strchr(name, ':') ? oracle_build(name, 0, NULL, NULL) : oracle_shipped(name);
    ndf->slopes = (oracle){.shape = ORACLE_COUNT, .table = &ndf->table};
    if (ndf->owned && oracle_table_of(&ndf->table, ndf->owned))
        return 1;
    vndf_free(ndf->owned);
    return 0;
}

void oracle_ndf_close(oracle_ndf *ndf)
{
    oracle_table_free(&ndf->table);
    vndf_free(ndf->owned);
}

/* ---- vectors ---- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void scale_to(double w[3], double length)
{
    double by = length / sqrt(dot(w, w));
    for (int i = 0; i < 3; i++)
        w[i] *= by;
}

void oracle_from_vec3(vndf_vec3 w, double out[3])
{
    out[0] = (double)w.x;
    out[1] = (double)w.y;
    out[2] = (double)w.z;
}

vndf_vec3 oracle_toward(double z, double phi)
{
    double across = sqrt((1 - z) * (1 + z));
    vndf_vec3 w = {(float)(across * cos(phi)), (float)(across * sin(phi)), (float)z};
    return w;
}

/* ---- surfaces ---- */

oracle_bsdf oracle_bsdf_from(const vndf_description *is, const oracle_ndf *const ndf[])
{
    const vndf_shape shape = is->effects.shape;
    const vndf_mixture *mixture = shape == VNDF_SHAPE_MIXTURE ? is->mixture : NULL;
    double sum = 0;
    vndf_surface a = is->surface;
    if (shape == VNDF_SHAPE_LEVEL)
        a.mean_x = a.mean_y = 0;
    oracle_bsdf o = {.is = *is, .count = mixture ? mixture->count : 1};
    for (int i = 0; i < o.count; i++) {
        o.lobe[i] = oracle_surface_from(&ndf[i]->slopes, mixture ? &mixture->lobe[i].surface : &a);
        o.weight[i] = mixture ? (double)mixture->lobe[i].weight : 1;
        sum += o.weight[i];
    }
    for (int i = 0; i < o.count; i++) {
        o.weight[i] /= sum;
        o.mean[0] += o.weight[i] * o.lobe[i].mean_x;
        o.mean[1] += o.weight[i] * o.lobe[i].mean_y;
    }
    return o;
}

double oracle_bsdf_rise(const oracle_bsdf *o, const double w[3])
{
    return w[2] - w[0] * o->mean[0] - w[1] * o->mean[1];
}

double oracle_bsdf_cosine(const oracle_bsdf *o, const double w[3])
{
    return oracle_bsdf_rise(o, w) / sqrt(1 + o->mean[0] * o->mean[0] + o->mean[1] * o->mean[1]);
}

typedef double of_surface(const oracle_surface *surface, const double w[3]);

static double sum_of(const oracle_bsdf *o, of_surface *what, const double w[3])
{
    double sum = 0;
    for (int i = 0; i < o->count; i++)
        sum += o->weight[i] * what(&o->lobe[i], w);
    return sum;
}

/* 1 + Lambda from the side that w is on. */
static double one_lambda(const oracle_bsdf *o, const double w[3])
{
    double rise = oracle_bsdf_rise(o, w), side = rise < 0 ? -1 : 1,
           up[3] = {side * w[0], side * w[1], side * w[2]};
    return sum_of(o, oracle_surface_area, up) / (fabs(rise) / sqrt(dot(w, w)));
}

/* ---- masking ---- */

static double g1_of_cavity(const double w[3], const double wm[3], double facing)
{
    return fmin(1, 2 * fabs(wm[2] * w[2] / facing));
}

/* The cosines of both to wm are given. */
static double g2_of(const oracle_bsdf *o, const double wi[3], const double wo[3], const double wm[3],
                    double facing, double beyond)
{
    int reflects = oracle_bsdf_rise(o, wo) > 0;
    double gi = g1_of_cavity(wi, wm, facing), go = g1_of_cavity(wo, wm, beyond);
    double one_li = one_lambda(o, wi), one_lo = one_lambda(o, wo);
    switch (o->is.effects.masking) {
    case VNDF_MASKING_SEPARABLE: return 1 / (one_li * one_lo);
    case VNDF_MASKING_V_CAVITIES: return reflects ? fmin(gi, go) : fmax(0, gi + go - 1);
    case VNDF_MASKING_NONE: return 1;
    default: break;
    }
    if (reflects)
        return 1 / (one_li + one_lo - 1);
    const long double a = (long double)one_li, b = (long double)one_lo; /* Euler's Beta function of both */
    return (double)expl(lgammal(a) + lgammal(b) - lgammal(a + b));
}

/* ---- Fresnel ---- */

static long double ratio_square(long double complex x, long double complex y)
{
    long double ratio = cabsl((x - y) / (x + y));
    return ratio * ratio;
}

/* As it stands in the books, for m = n + ik: t = sqrt(1 - sin^2/m^2), r_s = (c - m t)/(c + m t),
 * r_p = (m c - t)/(m c + t), F = (|r_s|^2 + |r_p|^2)/2, in long double, where their differences of nearly equal
 * numbers cost what float does not show. */
long double oracle_fresnel(long double c, long double n, long double k)
{
    const long double sin2 = (1 - c) * (1 + c);
    const long double complex m = n + k * I, t = csqrtl(1 - sin2 / (m * m));
    if (c <= 0)
        return 1;
    if (n == 1 && k <= 0)
        return 0;
    if (k <= 0 && n * n <= sin2)
        return 1; /* in total reflection, exactly */
    return (ratio_square(c, m * t) + ratio_square(m * c, t)) / 2;
}

static void fresnel_of(const oracle_bsdf *o, double cosine, double ratio, double f[VNDF_WAVELENGTHS])
{
    double beyond2 = 1 - (1 - cosine * cosine) / (ratio * ratio);
    int through = o->is.effects.lobes != VNDF_LOBES_REFLECTION, total = through && beyond2 <= 0;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) {
        double thin = through && ratio < 1 ? sqrt(fmax(beyond2, 0)) : cosine, f0 = (double)o->is.f0[i];
        if (o->is.effects.fresnel == VNDF_FRESNEL_DIELECTRIC)
            f[i] = (double)oracle_fresnel((long double)cosine, (long double)ratio, 0);
        else if (o->is.effects.fresnel == VNDF_FRESNEL_CONDUCTOR)
            f[i] = (double)oracle_fresnel((long double)cosine, (long double)o->is.conductor_eta[i],
                                          (long double)o->is.conductor_k[i]);
        else if (o->is.effects.fresnel == VNDF_FRESNEL_SCHLICK)
            f[i] = total ? 1 : f0 + (1 - f0) * pow(1 - thin, 5);
        else
            f[i] = through ? total : 1;
    }
}

/* ---- f and its density ---- */

/* With which a normal is drawn: lobes by their areas. */
static double normal_density(const oracle_bsdf *o, const double wi[3], const double wm[3], double facing)
{
    double all = sum_of(o, oracle_surface_ndf, wm) * wm[2], area = sum_of(o, oracle_surface_drawn_area, wi),
           sum = 0;
    switch (o->is.effects.normals) {
    case VNDF_NORMALS_ALL: return all;
    case VNDF_NORMALS_V_CAVITY: /* of a normal and its twin (-x, -y, z) the one that is seen */
        return all * g1_of_cavity(wi, wm, facing) * facing / (wi[2] * wm[2]);
    case VNDF_NORMALS_BOUNDED: return -1;
    default: break;
    }
    for (int i = 0; i < o->count; i++) {
        double share = o->weight[i] * oracle_surface_drawn_area(&o->lobe[i], wi) / area;
        sum += share > 0 ? share * oracle_surface_drawn(&o->lobe[i], wi, wm) : 0;
    }
    return sum * facing / dot(wi, wm);
}

/* The half vector of wi and wo, above the plane; its cosines to both. wi.wm where both graze hangs on lengths: there
 * they are made unit in any case. */
static void half_of(double wi[3], double wo[3], double ratio, double wm[3])
{
    for (int i = 0; i < 3; i++)
        wm[i] = wi[i] + ratio * wo[i];
    if (ratio == 1 && dot(wm, wm) < 0.0064) {
        scale_to(wi, 1);
        scale_to(wo, 1);
        for (int i = 0; i < 3; i++)
            wm[i] = wi[i] + wo[i];
    }
    scale_to(wm, ratio != 1 && wm[2] < 0 ? -1 : 1);
}

oracle_value oracle_bsdf_eval(const oracle_bsdf *o, const double wi_given[3], const double wo_given[3])
{
    oracle_value value = {{0}, 0};
    const vndf_effects *e = &o->is.effects;
    double side = oracle_bsdf_two_sided(e) && oracle_bsdf_rise(o, wi_given) < 0 ? -1 : 1;
    double wi[3], wo[3], wm[3], fresnel[VNDF_WAVELENGTHS], mean = 0;
    for (int i = 0; i < 3; i++) {
        wi[i] = side * wi_given[i];
        wo[i] = side * wo_given[i];
    }
    if (!o->lengths) {
        scale_to(wi, 1);
        scale_to(wo, 1);
    }
    double rise_i = oracle_bsdf_rise(o, wi), rise_o = oracle_bsdf_rise(o, wo);
    int reflects = rise_o > 0, both = e->lobes == VNDF_LOBES_BOTH,
        count = o->is.wavelengths ? o->is.wavelengths : 3;
    double eta = !oracle_bsdf_two_sided(e) ? 1 : side > 0 ? (double)o->is.eta : 1 / (double)o->is.eta;
    if (!(rise_i > 0) || rise_o == 0 || e->lobes == (reflects ? VNDF_LOBES_TRANSMISSION : VNDF_LOBES_REFLECTION) ||
        (!reflects && eta == 1))
        return value;
    if (reflects && e->reflection == VNDF_REFLECTION_RETRO)
        wo[0] = -wo[0], wo[1] = -wo[1];
    half_of(wi, wo, reflects ? 1 : eta, wm);
    double facing = dot(wi, wm), beyond = reflects ? facing : -dot(wo, wm), sum = facing - eta * beyond;
    if (!(facing > 0) || !(beyond > 0) || !(wm[2] > 0))
        return value;
    double jacobian = reflects ? 1 / (4 * facing) : eta * eta * beyond / (sum * sum);
    double carried = reflects || e->transport == VNDF_TRANSPORT_IMPORTANCE ? 1 : 1 / (eta * eta);
    double tilt = sqrt(1 + o->mean[0] * o->mean[0] + o->mean[1] * o->mean[1]);
    double shape = sum_of(o, oracle_surface_ndf, wm) * g2_of(o, wi, wo, wm, facing, beyond) * facing * jacobian *
                   carried * tilt;
    fresnel_of(o, fmin(facing, 1), eta, fresnel);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) {
        value.f[i] = (reflects ? fresnel[i] : 1 - fresnel[i]) * shape / (rise_i * fabs(rise_o));
        mean += i < count ? fresnel[i] / count : 0;
    }
    value.pdf = normal_density(o, wi, wm, facing) * jacobian * (!both ? 1 : reflects ? mean : 1 - mean);
    return value;
}

/* ---- effect sets ---- */

int oracle_bsdf_two_sided(const vndf_effects *e)
{
    return e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
}

vndf_effects oracle_effects(size_t index)
{
    vndf_effects e = {.lobes = (vndf_lobes)(index % 3)};
    e.fresnel = (vndf_fresnel)(index / 3 % 4);
    e.masking = (vndf_masking)(index / 12 % 4);
    e.normals = (vndf_normals_drawn)(index / 48 % 4);
    e.transport = (vndf_transport)(index / 192 % 2);
    e.shape = (vndf_shape)(index / 384 % 3);
    e.scattering = (vndf_scattering)(index / 1152 % 2);
    e.reflection = (vndf_reflection)(index / 2304 % 2);
    return e;
}

int oracle_effects_sensible(const vndf_effects *e)
{
    int through = e->lobes != VNDF_LOBES_REFLECTION, walk = e->scattering == VNDF_SCATTERING_MULTIPLE;
    int retro = e->reflection == VNDF_REFLECTION_RETRO, visible = e->normals == VNDF_NORMALS_VISIBLE;
    return !(through && (e->fresnel == VNDF_FRESNEL_CONDUCTOR || e->normals == VNDF_NORMALS_BOUNDED)) &&
           !(e->lobes == VNDF_LOBES_BOTH && e->fresnel == VNDF_FRESNEL_NONE) && /* F says nothing of the lobe */
           !(e->normals == VNDF_NORMALS_V_CAVITY && e->masking != VNDF_MASKING_V_CAVITIES) &&
           !((retro || walk) && e->lobes == VNDF_LOBES_TRANSMISSION) &&
           !(e->shape != VNDF_SHAPE_LEVEL &&
             (walk || retro || !visible || e->masking == VNDF_MASKING_V_CAVITIES)) &&
           !(walk && (e->masking != VNDF_MASKING_HEIGHT_CORRELATED || !visible));
}
