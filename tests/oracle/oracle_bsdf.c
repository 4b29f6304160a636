/* The formulas. A hit is brought to the frame of the roughness, wi above: z changes sign on both sides of the
 * surface at once, since its microsurface is the same from both. */
#include "oracle/oracle_bsdf.h"

#include <math.h>
#include <string.h>

/* ---- frame ---- */

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

int oracle_bsdf_two_sided(const vndf_effects *e)
{
    return e->lobes != VNDF_LOBES_REFLECTION || e->fresnel == VNDF_FRESNEL_DIELECTRIC;
}

double oracle_bsdf_ratio(const oracle_bsdf *o, const double wi[3])
{
    if (!oracle_bsdf_two_sided(&o->is.effects))
        return 1;
    return wi[2] < 0 ? 1 / (double)o->is.eta : (double)o->is.eta;
}

static void to_frame(const oracle_bsdf *o, double side, const double given[3], double w[3])
{
    double angle = o->is.effects.shape == VNDF_SHAPE_ROTATED ? (double)o->is.rotation : 0;
    w[0] = cos(angle) * given[0] + sin(angle) * given[1];
    w[1] = cos(angle) * given[1] - sin(angle) * given[0];
    w[2] = side * given[2];
    if (!o->lengths)
        scale_to(w, 1);
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

/* ---- masking ---- */

/* The integral of u^(a-1) (1-u)^(b-1) over [0, 1], in s = log(u/(1-u)): the trapezoid rule, which converges
 * geometrically for what is analytic and decays on both sides, over 60 widths of the peak and its tails. */
static double beta_by_quadrature(double a, double b)
{
    double mode = log(a / b), width = sqrt((a + b) / (a * b)), step = fmin(width / 4, 0.2), sum = 0;
    double peak = -a * log1p(exp(-mode)) - b * log1p(exp(mode));
    for (int direction = -1; direction <= 1; direction += 2)
        for (int i = direction < 0 ? 1 : 0; i < 4000; i++) {
            double s = mode + direction * i * step;
            double term = exp(-a * log1p(exp(-s)) - b * log1p(exp(s)) - peak);
            sum += term;
            if (term < 1e-18)
                break;
        }
    return sum * step * exp(peak);
}

static double g1_of_cavity(const double w[3], const double wm[3], double facing)
{
    return fmin(1, 2 * fabs(wm[2] * w[2] / facing));
}

/* The cosines of both to wm are given. */
static double g2_of(const oracle_bsdf *o, const double alpha[2], const double wi[3], const double wo[3],
                    const double wm[3], double facing, double beyond)
{
    double up[3] = {wo[0], wo[1], fabs(wo[2])};
    double gi = g1_of_cavity(wi, wm, facing), go = g1_of_cavity(wo, wm, beyond);
    double one_li = oracle_ndf_area(o->ndf, alpha, wi) / (wi[2] / sqrt(dot(wi, wi)));
    double one_lo = oracle_ndf_area(o->ndf, alpha, up) / (up[2] / sqrt(dot(up, up)));
    switch (o->is.effects.masking) {
    case VNDF_MASKING_SEPARABLE: return 1 / (one_li * one_lo);
    case VNDF_MASKING_V_CAVITIES: return wo[2] > 0 ? fmin(gi, go) : fmax(0, gi + go - 1);
    case VNDF_MASKING_NONE: return 1;
    default: return wo[2] > 0 ? 1 / (one_li + one_lo - 1) : beta_by_quadrature(one_li, one_lo);
    }
}

/* ---- Fresnel ---- */

void oracle_bsdf_fresnel(const oracle_bsdf *o, double cosine, double ratio, double f[VNDF_WAVELENGTHS])
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

static double mean(const oracle_bsdf *o, const double f[VNDF_WAVELENGTHS])
{
    int count = o->is.wavelengths ? o->is.wavelengths : 3;
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += f[i];
    return sum / count;
}

/* ---- f and its density ---- */

static double normal_density(const oracle_bsdf *o, const double alpha[2], const double wi[3], const double wm[3],
                             double facing)
{
    switch (o->is.effects.normals) {
    case VNDF_NORMALS_ALL: return oracle_ndf_all(o->ndf, alpha, wm);
    case VNDF_NORMALS_V_CAVITY: /* of a normal and its twin (-x, -y, z) the one that is seen */
        return oracle_ndf_all(o->ndf, alpha, wm) * g1_of_cavity(wi, wm, facing) * facing / (wi[2] * wm[2]);
    case VNDF_NORMALS_BOUNDED: return -1;
    default: return oracle_ndf_visible(o->ndf, alpha, wi, wm) * facing / dot(wi, wm);
    }
}

/* wi.wm where both graze hangs on lengths: there they are made unit in any case. */
static void reflect(const oracle_bsdf *o, const double alpha[2], double wi[3], double wo[3], double ratio,
                    oracle_value *value)
{
    double wm[3] = {wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]};
    if (dot(wm, wm) < 0.0064) {
        scale_to(wi, 1);
        scale_to(wo, 1);
        for (int i = 0; i < 3; i++)
            wm[i] = wi[i] + wo[i];
    }
    scale_to(wm, 1);
    double facing = dot(wi, wm), shape = oracle_ndf_density(o->ndf, alpha, wm);
    shape *= g2_of(o, alpha, wi, wo, wm, facing, facing);
    oracle_bsdf_fresnel(o, fmin(facing, 1), ratio, value->fresnel);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        value->f[i] = value->fresnel[i] * shape / (4 * wi[2] * wo[2]);
    value->pdf = normal_density(o, alpha, wi, wm, facing) / (4 * facing);
    if (o->is.effects.lobes == VNDF_LOBES_BOTH)
        value->pdf *= mean(o, value->fresnel);
}

static void transmit(const oracle_bsdf *o, const double alpha[2], const double wi[3], const double wo[3],
                     double ratio, oracle_value *value)
{
    double wm[3], normal[3] = {0, 0, 1};
    for (int i = 0; i < 3; i++)
        wm[i] = wi[i] + ratio * wo[i];
    scale_to(wm, dot(wm, normal) < 0 ? -1 : 1);
    double facing = dot(wi, wm), beyond = -dot(wo, wm), sum = facing - ratio * beyond;
    if (!(facing > 0) || !(beyond > 0))
        return;
    double shape =
        oracle_ndf_density(o->ndf, alpha, wm) * g2_of(o, alpha, wi, wo, wm, facing, beyond) * facing * beyond;
    double per = wi[2] * -wo[2] * sum * sum, jacobian = ratio * ratio * beyond / (sum * sum);
    if (o->is.effects.transport == VNDF_TRANSPORT_IMPORTANCE)
        per /= ratio * ratio;
    oracle_bsdf_fresnel(o, fmin(facing, 1), ratio, value->fresnel);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        value->f[i] = (1 - value->fresnel[i]) * shape / per;
    value->pdf = normal_density(o, alpha, wi, wm, facing) * jacobian;
    if (o->is.effects.lobes == VNDF_LOBES_BOTH)
        value->pdf *= 1 - mean(o, value->fresnel);
}

oracle_value oracle_bsdf_eval(const oracle_bsdf *o, const double wi_given[3], const double wo_given[3])
{
    oracle_value value = {{0}, 0, {0}};
    double side = oracle_bsdf_two_sided(&o->is.effects) && wi_given[2] < 0 ? -1 : 1;
    double wi[3], wo[3], alpha[2] = {(double)o->is.alpha_x, (double)o->is.alpha_y};
    double ratio = oracle_bsdf_ratio(o, wi_given);
    to_frame(o, side, wi_given, wi);
    to_frame(o, side, wo_given, wo);
    if (wi[2] > 0 && wo[2] > 0 && o->is.effects.lobes != VNDF_LOBES_TRANSMISSION)
        reflect(o, alpha, wi, wo, ratio, &value);
    if (wi[2] > 0 && wo[2] < 0 && o->is.effects.lobes != VNDF_LOBES_REFLECTION && ratio != 1)
        transmit(o, alpha, wi, wo, ratio, &value);
    return value;
}

/* ---- effect sets ---- */

vndf_effects oracle_effects(size_t index)
{
    vndf_effects e = {.reflection = VNDF_REFLECTION_SPECULAR};
    e.lobes = (vndf_lobes)(index % 3);
    e.fresnel = (vndf_fresnel)(index / 3 % 4);
    e.masking = (vndf_masking)(index / 12 % 4);
    e.normals = (vndf_normals_drawn)(index / 48 % 4);
    e.transport = (vndf_transport)(index / 192 % 2);
    e.shape = (vndf_shape)(index / 384 % 2);
    e.scattering = (vndf_scattering)(index / 768 % 2);
    return e;
}

int oracle_effects_sensible(const vndf_effects *e)
{
    int through = e->lobes != VNDF_LOBES_REFLECTION, walk = e->scattering == VNDF_SCATTERING_MULTIPLE;
    if (through && (e->fresnel == VNDF_FRESNEL_CONDUCTOR || e->normals == VNDF_NORMALS_BOUNDED))
        return 0;
    if (e->lobes == VNDF_LOBES_BOTH && e->fresnel == VNDF_FRESNEL_NONE) /* F says nothing of the lobe */
        return 0;
    if (e->normals == VNDF_NORMALS_V_CAVITY && e->masking != VNDF_MASKING_V_CAVITIES)
        return 0;
    return !walk || (e->masking == VNDF_MASKING_HEIGHT_CORRELATED && e->normals == VNDF_NORMALS_VISIBLE &&
                     e->lobes != VNDF_LOBES_TRANSMISSION);
}

void oracle_effects_name(const vndf_effects *e, char text[ORACLE_EFFECTS_TEXT])
{
    static const char *const lobes[] = {"reflection", "transmission", "both"};
    static const char *const fresnel[] = {"no-fresnel", "schlick", "dielectric", "conductor"};
    static const char *const masking[] = {"correlated", "separable", "v-cavities", "unmasked"};
    static const char *const normals[] = {"visible", "bounded", "all", "v-cavity"};
    static const char *const transport[] = {"radiance", "importance"}, *const axes[] = {"fixed", "rotated",
                                                                                        "matrix", "affine",
                                                                                        "mixture"};
    const char *words[] = {lobes[e->lobes],
                           fresnel[e->fresnel],
                           masking[e->masking],
                           normals[e->normals],
                           transport[e->transport],
                           axes[e->shape],
                           e->scattering ? "multiple" : "single"};
    text[0] = '\0';
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        strcat(text, words[i]);
        strcat(text, i + 1 < sizeof words / sizeof *words ? " " : "");
    }
}
