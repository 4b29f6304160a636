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

/* ---- one direction ------------------------------------------------------------------------------- */

vndf_bsdf_batch bake_batch(const vndf_material *material, const float wi[3], size_t count)
{
    const vndf_bsdf_batch batch = {.material = material,
                                   .count = count,
                                   .shared = VNDF_SHARED_ALPHA | VNDF_SHARED_WI,
                                   .wi_x = &wi[0],
                                   .wi_y = &wi[1],
                                   .wi_z = &wi[2]};
    return batch;
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
    const vndf_description of = {.distribution = s->distribution,
                                 .alpha_x = alpha,
                                 .alpha_y = alpha,
                                 .effects = {.fresnel = VNDF_FRESNEL_SCHLICK, .masking = s->masking},
                                 .wavelengths = 2,
                                 .f0 = {1, 0}};
    return of;
}

/* Samples are a continuous function of their numbers: midpoints t of [0, 1] in each, u = t^2 (3 - 2 t), are dense at
 * both ends, where samples change fast. Sample i stands for this part of the square, but for a factor. */
static double part_of(int i, int side)
{
    double s = (i % side + 0.5) / side, t = (i / side + 0.5) / side;
    return s * (1 - s) * t * (1 - t);
}

/* The samples from one direction; the sum of their parts, or 0: there is no such material. */
static double samples_from(const vndf_description *of, const double wi[3], int side, bake_points *p)
{
    vndf_material material;
    vndf_error error;
    double whole = 0;
    if (vndf_material_resolve(of, &material, &error) != VNDF_OK)
        return 0;
    for (int i = 0; i < side * side; i++) {
        double s = (i % side + 0.5) / side, t = (i / side + 0.5) / side;
        p->u[0][i] = (float)(s * s * (3 - 2 * s));
        p->u[1][i] = (float)(t * t * (3 - 2 * t));
        p->u[2][i] = 0.5f;
        whole += part_of(i, side);
    }
    bake_sample(&material, wi, (size_t)(side * side), p);
    return whole;
}

/* The mean weights from one direction. */
bake_sum bake_mean(const vndf_description *of, const double wi[3], int side)
{
    static bake_points p;
    bake_sum sum = {0, 0};
    const double whole = samples_from(of, wi, side, &p);
    for (int i = 0; i < side * side && whole > 0; i++) {
        sum.all += part_of(i, side) / whole * (double)p.weight[0][i];
        sum.grazing += part_of(i, side) / whole * (double)p.weight[1][i];
    }
    return sum;
}

bake_sum bake_direction(const bake_settings *s, float alpha, double cosine)
{
    const vndf_description of = bake_mirror(s, alpha);
    const double wi[3] = {sqrt(fmax(1 - cosine * cosine, 0)), 0, cosine};
    return bake_mean(&of, wi, BAKE_SIDE);
}

/* The mean of weights that masking has no part in, times 1/(1 + Lambda(wi) + Lambda(wo)). */
static double mean_masked_alike(const vndf_description *of, const double wi[3], int side)
{
    static bake_points p;
    const vndf_surface surface = {of->distribution, of->alpha_x, of->alpha_y};
    const vndf_vec3 in = {(float)wi[0], (float)wi[1], (float)wi[2]};
    vndf_description bare = *of;
    bare.effects.masking = VNDF_MASKING_NONE;
    const double whole = samples_from(&bare, wi, side, &p), lambda = 1 + (double)vndf_lambda(&surface, in);
    double sum = 0;
    for (int i = 0; i < side * side && whole > 0; i++) {
        const vndf_vec3 out = {p.wo[0][i], p.wo[1][i], fabsf(p.wo[2][i])};
        if (p.weight[0][i] > 0)
            sum +=
                part_of(i, side) / whole * (double)p.weight[0][i] / (lambda + (double)vndf_lambda(&surface, out));
    }
    return sum;
}

double bake_glass(const bake_settings *s, float alpha, double cosine, double eta)
{
    const double wi[3] = {sqrt(fmax(1 - cosine * cosine, 0)), 0, cosine};
    vndf_description of = bake_mirror(s, alpha);
    of.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    of.eta = (float)eta;
    double sum = bake_mean(&of, wi, BAKE_SIDE_GLASS).all;
    of.effects.lobes = VNDF_LOBES_TRANSMISSION;
    of.effects.transport = VNDF_TRANSPORT_IMPORTANCE; /* the part of the light, without 1/eta^2 of radiance */
    return sum + (s->masks_alike ? mean_masked_alike(&of, wi, BAKE_SIDE_GLASS)
                                 : bake_mean(&of, wi, BAKE_SIDE_GLASS).all);
}

/* Nodes and weights of Gauss's rule on [0, 1], by Newton's method on Legendre's polynomial. */
static void gauss(int n, double *node, double *weight)
{
    for (int i = 0; i < n; i++) {
        double x = cos(3.14159265358979 * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 20; step++) {
            double p0 = 1, p1 = x;
            for (int k = 2; k <= n; k++) {
                double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1);
            x -= p1 / slope;
        }
        node[i] = (1 + x) / 2;
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

double bake_average(const bake_settings *s, float alpha, double eta)
{
    enum { NODES = 8 };
    double node[NODES], weight[NODES], sum = 0;
    gauss(NODES, node, weight);
    for (int i = 0; i < NODES; i++) {
        double e = eta > 0 ? bake_glass(s, alpha, node[i], eta) : bake_direction(s, alpha, node[i]).all;
        sum += 2 * node[i] * weight[i] * e;
    }
    return fmin(sum, 1);
}

/* ---- the same without samples -------------------------------------------------------------------- */

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
    enum { PANELS = 96, NODES = 6, AZIMUTHS = 256 };
    hit h = {s, {s->distribution, alpha, alpha}, {sqrt(1 - cosine * cosine), 0, cosine}, 0, eta};
    const vndf_vec3 up = {0, 0, 1}, in = {(float)h.wi[0], 0, (float)cosine};
    const vndf_view straight = vndf_view_from(&h.surface, up);
    const int is_table = vndf_distribution_info(s->distribution).bytes > 0;
    double node[NODES], weight[NODES], from = 0;
    bake_sum sum = {0, 0};
    h.lambda = (double)vndf_lambda(&h.surface, in);
    gauss(NODES, node, weight);
    for (int k = 1; k <= PANELS; k++) {
        double part = (double)k / PANELS, to = (double)alpha * 2 * part / (1.001 - part);
        if (is_table) {
            const vndf_vec3 wm = vndf_sample(&straight, 0.5f, (float)(1 - pow(1 - part, 3)), NULL);
            to = hypot((double)wm.x, (double)wm.y) / fmax((double)wm.z, 1e-30);
        }
        for (int i = 0; i < NODES; i++) {
            double r = from + (to - from) * node[i], p = (double)vndf_p22(&h.surface, (float)r, 0);
            bake_sum ring = {0, 0};
            for (int a = 0; a < AZIMUTHS; a++) {
                double phi = 3.14159265358979 * (a + 0.5) / AZIMUTHS;
                bake_sum here = scattered(&h, r * cos(phi), r * sin(phi));
                ring.all += here.all;
                ring.grazing += here.grazing;
            }
            double scale = p * r * (to - from) * weight[i] * 2 * 3.14159265358979 / AZIMUTHS;
            sum.all += scale * ring.all;
            sum.grazing += scale * ring.grazing;
        }
        from = to;
    }
    return sum;
}
