/* What is reflected and transmitted from one direction: by samples, and by a quadrature that draws nothing. */
#include <math.h>

#include "bake/bake.h"

float bake_alpha(bake_mapping mapping, double roughness)
{
    double alpha = mapping == BAKE_SQUARE ? roughness * roughness
                   : mapping == BAKE_ROOT ? sqrt(roughness)
                                          : roughness;
    return (float)fmax(alpha, 1e-3); /* below that reflection is a mirror's for all that a table shows */
}

vndf_bsdf_batch bake_batch(const vndf_material *material, const float wi[3], size_t count)
{
    return (vndf_bsdf_batch){.material = material,
                             .count = count,
                             .shared = VNDF_SHARED_SURFACE | VNDF_SHARED_WI,
                             .wi_x = &wi[0],
                             .wi_y = &wi[1],
                             .wi_z = &wi[2]};
}

void bake_sample(const vndf_material *material, const double wi[3], size_t count, bake_points *p)
{
    const float *const u[3] = {p->u[0], p->u[1], p->u[2]};
    const vndf_scattered_n to = {.wo = {p->wo[0], p->wo[1], p->wo[2]},
                                 .weight = {p->weight[0], p->weight[1]},
                                 .density = p->density,
                                 .lobe = p->lobe};
    for (int k = 0; k < 3; k++)
        p->wi[k] = (float)wi[k];
    const vndf_bsdf_batch batch = bake_batch(material, p->wi, count);
    vndf_bsdf_sample_n(&batch, u, to);
}

vndf_description bake_mirror(const bake_settings *s, float alpha)
{
    return (vndf_description){.surface = vndf_rough(s->distribution, alpha, alpha),
                              .effects = {.fresnel = VNDF_FRESNEL_SCHLICK, .masking = s->masking},
                              .wavelengths = 2,
                              .f0 = {1, 0}};
}

/* Samples are a continuous function of their numbers: midpoints t of [0, 1] in each, u = t^2 (3 - 2 t), are dense at
 * both ends, where samples change fast, and count by t (1 - t). */
bake_sum bake_mean(const vndf_description *of, const double wi[3], int side, int masks_alike)
{
    static bake_points p;
    const vndf_vec3 in = {(float)wi[0], (float)wi[1], (float)wi[2]};
    const double lambda = masks_alike ? 1 + (double)vndf_lambda(&of->surface, in) : 0;
    vndf_description drawn = *of;
    vndf_material material;
    vndf_error error;
    bake_sum sum = {0, 0};
    double whole = 0;
    if (masks_alike)
        drawn.effects.masking = VNDF_MASKING_NONE;
    if (vndf_material_resolve(&drawn, &material, &error) != VNDF_OK)
        return sum;
    for (int i = 0; i < side * side; i++) {
        double s = (i % side + 0.5) / side, t = (i / side + 0.5) / side;
        p.u[0][i] = (float)(s * s * (3 - 2 * s));
        p.u[1][i] = (float)(t * t * (3 - 2 * t));
        p.u[2][i] = 0.5f;
    }
    bake_sample(&material, wi, (size_t)(side * side), &p);
    for (int i = 0; i < side * side; i++) {
        const double s = (i % side + 0.5) / side, t = (i / side + 0.5) / side;
        double part = s * (1 - s) * t * (1 - t);
        const vndf_vec3 out = {p.wo[0][i], p.wo[1][i], fabsf(p.wo[2][i])};
        whole += part;
        if (masks_alike && p.weight[0][i] > 0)
            part /= lambda + (double)vndf_lambda(&of->surface, out);
        sum.all += part * (double)p.weight[0][i];
        sum.grazing += part * (double)p.weight[1][i];
    }
    return (bake_sum){sum.all / whole, sum.grazing / whole};
}

bake_sum bake_direction(const bake_settings *s, float alpha, double cosine, double eta)
{
    const double wi[3] = {sqrt(fmax(1 - cosine * cosine, 0)), 0, cosine};
    vndf_description of = bake_mirror(s, alpha);
    if (!(eta > 0))
        return bake_mean(&of, wi, BAKE_SIDE, 0);
    of.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    of.eta = (float)eta;
    const double reflected = bake_mean(&of, wi, BAKE_SIDE_GLASS, 0).all;
    of.effects.lobes = VNDF_LOBES_TRANSMISSION;
    of.effects.transport = VNDF_TRANSPORT_IMPORTANCE; /* the part of the light, without 1/eta^2 of radiance */
    return (bake_sum){reflected + bake_mean(&of, wi, BAKE_SIDE_GLASS, s->masks_alike).all, 0};
}

/* Node i of Gauss's rule on [0, 1], and its weight. */
enum { NODES = 8 };
static double gauss(int i, double *weight)
{
    static const double x[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static const double w[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    *weight = w[i / 2] / 2;
    return (i % 2 ? 1 - x[i / 2] : 1 + x[i / 2]) / 2;
}

double bake_average(const bake_settings *s, float alpha, double eta)
{
    double weight, sum = 0;
    for (int i = 0; i < NODES; i++) {
        const double cosine = gauss(i, &weight);
        sum += 2 * cosine * weight * bake_direction(s, alpha, cosine, eta).all;
    }
    return fmin(sum, 1);
}

/* wi on a surface. eta 0: a mirror. */
typedef struct hit {
    const bake_settings *s;
    vndf_surface surface;
    double wi[3], lambda, eta;
} hit;

/* G2 where the light goes on along wo, on this side or, with the Beta function (Heitz et al. 2016) or as some hosts
 * have it, the other. */
static double g2(const hit *h, const double wo[3])
{
    const vndf_vec3 out = {(float)wo[0], (float)wo[1], (float)fabs(wo[2])};
    double i = 1 + h->lambda, o = 1 + (double)vndf_lambda(&h->surface, out);
    if (h->s->masking == VNDF_MASKING_SEPARABLE)
        return 1 / (i * o);
    return wo[2] > 0 || h->s->masks_alike ? 1 / (i + o - 1) : exp(lgamma(i) + lgamma(o) - lgamma(i + o));
}

/* What goes on from the normal with this slope, times (wi.wm/wm.z)/cos_i: for `grazing` see bake_sum. */
static bake_sum scattered(const hit *h, double x, double y)
{
    bake_sum sum = {0, 0};
    const double length = sqrt(1 + x * x + y * y), wm[3] = {-x / length, -y / length, 1 / length};
    double facing = h->wi[2] - x * h->wi[0], dot = facing / length, along[3], beyond[3];
    if (!(facing > 0))
        return sum;
    double f = h->eta > 0 ? (double)vndf_fresnel_dielectric((float)dot, (float)h->eta) : 1;
    double inner = h->eta > 0 ? 1 - (1 - dot * dot) / (h->eta * h->eta) : 0;
    for (int k = 0; k < 3; k++) {
        along[k] = 2 * dot * wm[k] - h->wi[k];
        beyond[k] = inner > 0 ? (dot / h->eta - sqrt(inner)) * wm[k] - h->wi[k] / h->eta : 0;
    }
    if (along[2] > 0) {
        double part = f * g2(h, along) * facing / h->wi[2];
        sum.all += part;
        sum.grazing += part * pow(1 - dot, 5);
    }
    if (beyond[2] < 0)
        sum.all += (1 - f) * g2(h, beyond) * facing / h->wi[2];
    return sum;
}

/* Slope lengths by Gauss's rule, of tables between quantiles of all normals; azimuths by midpoints. */
bake_sum bake_reference(const bake_settings *s, float alpha, double cosine, double eta)
{
    enum { PANELS = 72, AZIMUTHS = 256 };
    hit h = {s, vndf_rough(s->distribution, alpha, alpha), {sqrt(1 - cosine * cosine), 0, cosine}, 0, eta};
    const vndf_vec3 up = {0, 0, 1}, in = {(float)h.wi[0], 0, (float)cosine};
    const vndf_view straight = vndf_view_from(&h.surface, up);
    const int is_table = vndf_distribution_info(s->distribution).bytes > 0;
    double from = 0;
    bake_sum sum = {0, 0};
    h.lambda = (double)vndf_lambda(&h.surface, in);
    for (int k = 1; k <= PANELS; k++) {
        double part = (double)k / PANELS, to = (double)alpha * 2 * part / (1.001 - part);
        if (is_table) {
            const vndf_vec3 wm = vndf_sample(&straight, 0.5f, (float)(1 - pow(1 - part, 3)), NULL);
            to = hypot((double)wm.x, (double)wm.y) / fmax((double)wm.z, 1e-30);
        }
        for (int i = 0; i < NODES; i++) {
            double weight, r = from + (to - from) * gauss(i, &weight);
            bake_sum ring = {0, 0};
            for (int a = 0; a < AZIMUTHS; a++) {
                double phi = 3.14159265358979 * (a + 0.5) / AZIMUTHS;
                bake_sum here = scattered(&h, r * cos(phi), r * sin(phi));
                ring.all += here.all;
                ring.grazing += here.grazing;
            }
            double scale = (double)vndf_p22(&h.surface, (float)r, 0) * r * (to - from) * weight * 2 *
                           3.14159265358979 / AZIMUTHS;
            sum.all += scale * ring.all;
            sum.grazing += scale * ring.grazing;
        }
        from = to;
    }
    return sum;
}
