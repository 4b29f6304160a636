/* The tables of directions: dfg, energy and prefilter. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bake/bake.h"

float bake_alpha(bake_mapping mapping, double roughness)
{
    double alpha = mapping == BAKE_SQUARE ? roughness * roughness
                   : mapping == BAKE_ROOT ? sqrt(roughness)
                                          : roughness;
    return (float)fmax(alpha, 1e-3); /* below that reflection is a mirror's for all that a table shows */
}

size_t baked_size(const baked *b)
{
    size_t size = (size_t)b->channels;
    for (int i = 0; i < b->axes; i++)
        size *= b->count[i];
    return size;
}

baked *baked_add(baked_list *list, const char *name, const char *holds, int axes, const char *const *axis,
                 const size_t *count, int channels)
{
    baked *b = &list->table[list->count];
    *b = (baked){.name = name, .holds = holds, .axes = axes, .channels = channels};
    for (int i = 0; i < axes; i++) {
        b->axis[i] = axis[i];
        b->count[i] = count[i];
    }
    b->value = calloc(baked_size(b), sizeof *b->value);
    list->count += b->value != NULL;
    return b->value ? b : NULL;
}

void baked_free(baked_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->table[i].value);
    list->count = 0;
}

/* ---- one direction ------------------------------------------------------------------------------- */

/* The numbers that samples take: midpoints t of [0, 1] in each, u = t^2 (3 - 2 t), which are dense at both ends, where
 * samples change fast with their numbers. */
enum { SIDE = 96, SIDE_GLASS = 64, POINTS = SIDE * SIDE };

typedef struct points {
    float u[3][POINTS], wo[3][POINTS], density[POINTS], weight[2][POINTS];
    uint8_t lobe[POINTS];
} points;

/* The mean weights of a material's samples from one direction: samples are a continuous function of their numbers. */
static bake_sum mean_weights(const vndf_material *material, double cosine, int side)
{
    static points p;
    const float wi[3] = {(float)sqrt(fmax(1 - cosine * cosine, 0)), 0, (float)cosine};
    const vndf_bsdf_batch batch = {.material = material,
                                   .count = (size_t)(side * side),
                                   .shared = VNDF_SHARED_ALPHA | VNDF_SHARED_WI,
                                   .wi_x = &wi[0],
                                   .wi_y = &wi[1],
                                   .wi_z = &wi[2]};
    const float *const u[3] = {p.u[0], p.u[1], p.u[2]};
    const vndf_scattered_n to = {.wo = {p.wo[0], p.wo[1], p.wo[2]},
                                 .weight = {p.weight[0], p.weight[1]},
                                 .density = p.density,
                                 .lobe = p.lobe};
    bake_sum sum = {0, 0};
    for (int i = 0; i < side * side; i++) {
        double s = (i % side + 0.5) / side, t = (i / side + 0.5) / side;
        p.u[0][i] = (float)(s * s * (3 - 2 * s));
        p.u[1][i] = (float)(t * t * (3 - 2 * t));
        p.u[2][i] = 0.5f;
    }
    double whole = 0;
    vndf_bsdf_sample_n(&batch, u, to);
    for (int i = 0; i < side * side; i++) {
        double s = (i % side + 0.5) / side, t = (i / side + 0.5) / side, part = s * (1 - s) * t * (1 - t);
        whole += part;
        sum.all += part * (double)p.weight[0][i];
        sum.grazing += part * (double)p.weight[1][i];
    }
    sum.all /= whole;
    sum.grazing /= whole;
    return sum;
}

static bake_sum mean_of(const vndf_description *of, double cosine, int side)
{
    vndf_material material;
    vndf_error error;
    const bake_sum none = {0, 0};
    return vndf_material_resolve(of, &material, &error) == VNDF_OK ? mean_weights(&material, cosine, side) : none;
}

static vndf_description mirror(const bake_settings *s, float alpha)
{
    const vndf_description of = {.distribution = s->distribution,
                                 .alpha_x = alpha,
                                 .alpha_y = alpha,
                                 .effects = {.fresnel = VNDF_FRESNEL_SCHLICK, .masking = s->masking},
                                 .wavelengths = 2,
                                 .f0 = {1, 0}};
    return of;
}

bake_sum bake_direction(const bake_settings *s, float alpha, double cosine)
{
    const vndf_description of = mirror(s, alpha);
    return mean_of(&of, cosine, SIDE);
}

double bake_glass(const bake_settings *s, float alpha, double cosine, double eta)
{
    vndf_description of = mirror(s, alpha);
    of.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    of.eta = (float)eta;
    double sum = mean_of(&of, cosine, SIDE_GLASS).all;
    of.effects.lobes = VNDF_LOBES_TRANSMISSION;
    of.effects.transport = VNDF_TRANSPORT_IMPORTANCE; /* the part of the light, without 1/eta^2 of radiance */
    return sum + mean_of(&of, cosine, SIDE_GLASS).all;
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

/* G2 where the light goes on along wo, on this side or, with the Beta function (Heitz et al. 2016), the other. */
static double g2(const hit *h, const double wo[3])
{
    const vndf_vec3 out = {(float)wo[0], (float)wo[1], (float)fabs(wo[2])};
    double i = 1 + h->lambda, o = 1 + (double)vndf_lambda(&h->surface, out);
    if (h->s->masking == VNDF_MASKING_SEPARABLE)
        return 1 / (i * o);
    return wo[2] > 0 ? 1 / (i + o - 1) : exp(lgamma(i) + lgamma(o) - lgamma(i + o));
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

/* ---- tables -------------------------------------------------------------------------------------- */

static const char roughness_centres[] = "roughness: (i + 1/2)/n", cosine_centres[] = "cosine: (i + 1/2)/n";

static void note_error(baked *b, double got, double want, int count)
{
    double error = fabs(got - want);
    b->worst = fmax(b->worst, error);
    b->mean += error / count;
}

/* The k-th of so many places that are spread over n. */
static size_t spread(int k, int places, size_t n)
{
    return (n - 1) * (size_t)k / (size_t)(places - 1);
}

int bake_dfg(const bake_settings *s, baked_list *list)
{
    enum { CHECKED = 4 };
    const char *const axis[] = {roughness_centres, cosine_centres};
    const size_t n = s->size, count[] = {n, n};
    baked *b =
        baked_add(list, "dfg", "scale, bias, average: f = f0 scale + f90 bias; 2 integral (scale + bias) mu dmu",
                  2, axis, count, 3);
    if (!b)
        return 0;
    for (size_t i = 0; i < n; i++) {
        float alpha = bake_alpha(s->mapping, ((double)i + 0.5) / (double)n);
        double average = bake_average(s, alpha, 0);
        if (progress_show((double)i / (double)n, "dfg", s->progress))
            return 0;
        for (size_t j = 0; j < n; j++) {
            bake_sum sum = bake_direction(s, alpha, ((double)j + 0.5) / (double)n);
            float *to = b->value + 3 * (i * n + j);
            to[0] = (float)(sum.all - sum.grazing);
            to[1] = (float)sum.grazing;
            to[2] = (float)average;
        }
    }
    b->error = "scale and bias beside quadrature over slopes, at 16 texels";
    for (int k = 0; k < CHECKED * CHECKED; k++) {
        const size_t i = spread(k / CHECKED, CHECKED, n), j = spread(k % CHECKED, CHECKED, n);
        float alpha = bake_alpha(s->mapping, ((double)i + 0.5) / (double)n);
        bake_sum want = bake_reference(s, alpha, ((double)j + 0.5) / (double)n, 0);
        const float *got = b->value + 3 * (i * n + j);
        note_error(b, (double)got[0], want.all - want.grazing, 2 * CHECKED * CHECKED);
        note_error(b, (double)got[1], want.grazing, 2 * CHECKED * CHECKED);
    }
    return 1;
}

/* What a host keeps: sizes of the mirror's and of glass's axes, which of roughness and cosine runs faster, where the
 * places are, and what stands for the index: z with eta = (1 + z^2)/(1 - z^2), or eta itself from 1 to 3. */
typedef struct shape {
    size_t mirror, glass;
    int roughness_first, centred;
    int by_root;
} shape;

const char *const bake_shape_names[] = {"grid", "cycles", "ospray", NULL};
static const shape shapes[] = {{32, 16, 0, 1, 0}, {32, 16, 1, 0, 1}, {32, 16, 0, 0, 0}};

static double place_of(const shape *h, size_t i, size_t n)
{
    return h->centred ? ((double)i + 0.5) / (double)n : (double)i / (double)(n - 1);
}

/* The index for place t; that of a mirror's neighbour and of what is no surface are held away from where they end. */
static double eta_of(const shape *h, double t)
{
    double z2 = fmin(t * t, 0.98);
    return fmax(h->by_root ? (1 + z2) / (1 - z2) : 1 + 2 * t, 1.002);
}

/* Number k of a table of E, or with 0 cosines of E_avg, over roughness and cosine, and for glass the index. */
typedef struct texel {
    float alpha;
    double cosine, eta;
} texel;

static texel texel_at(const bake_settings *s, const shape *h, size_t k, size_t n, size_t cosines, size_t indices,
                      int inside)
{
    const size_t inner = cosines ? n * cosines : n, i = k % inner;
    const size_t rough = !cosines ? i : h->roughness_first ? i % n : i / cosines;
    const size_t at = !cosines ? 0 : h->roughness_first ? i / n : i % cosines;
    texel t = {bake_alpha(s->mapping, place_of(h, rough, n)), 0, 0};
    if (cosines)
        t.cosine = fmax(place_of(h, at, cosines), 1e-4);
    if (indices > 1)
        t.eta = eta_of(h, place_of(h, k / inner, indices));
    if (inside)
        t.eta = 1 / t.eta;
    return t;
}

static int fill_energy(const bake_settings *s, const shape *h, baked *b, size_t n, size_t cosines, size_t indices,
                       int inside)
{
    enum { CHECKED = 16 };
    const size_t size = baked_size(b);
    for (size_t k = 0; k < size; k++) {
        texel t = texel_at(s, h, k, n, cosines, indices, inside);
        double e = !cosines    ? bake_average(s, t.alpha, t.eta)
                   : t.eta > 0 ? bake_glass(s, t.alpha, t.cosine, t.eta)
                               : bake_direction(s, t.alpha, t.cosine).all;
        b->value[k] = (float)fmin(e, 1);
        if (progress_show((double)k / (double)size, b->name, s->progress))
            return 0;
    }
    if (!cosines)
        return 1;
    b->error = "beside quadrature over slopes, at 16 texels";
    for (int c = 0; c < CHECKED; c++) {
        const size_t k = spread(c, CHECKED, size);
        texel t = texel_at(s, h, k, n, cosines, indices, inside);
        note_error(b, (double)b->value[k], bake_reference(s, t.alpha, t.cosine, t.eta).all, CHECKED);
    }
    return 1;
}

int bake_energy(const bake_settings *s, const char *name, baked_list *list)
{
    static const char *const names[] = {"energy",        "energy_average", "glass",
                                        "glass_average", "glass_inside",   "glass_inside_average"};
    size_t which = 0;
    while (name && strcmp(bake_shape_names[which], name) != 0)
        which++;
    const shape *h = &shapes[which];
    const char *rough = h->centred ? roughness_centres : "roughness: i/(n - 1)";
    const char *cosine = h->centred ? cosine_centres : "cosine: i/(n - 1)";
    const char *index = h->by_root   ? "z = i/(n - 1), eta = (1 + z^2)/(1 - z^2)"
                        : h->centred ? "eta: 1 + 2 (i + 1/2)/n"
                                     : "eta: 1 + 2 i/(n - 1)";
    for (int k = 0; k < 6; k++) {
        const int glass = k > 1, average = k % 2;
        const size_t n = glass ? h->glass : h->mirror, count[] = {n, n, n};
        const char *axis[3] = {index, h->roughness_first ? cosine : rough, h->roughness_first ? rough : cosine};
        if (average)
            axis[1] = rough;
        baked *b = baked_add(list, names[k],
                             !glass  ? "the part of the light that a mirror reflects"
                             : k < 4 ? "what both lobes of a dielectric keep, from the thinner side"
                                     : "the same from the denser side, of index 1/eta",
                             1 + !average + glass, axis + !glass, count, 1);
        if (!b || !fill_energy(s, h, b, n, average ? 0 : n, glass ? n : 1, k > 3))
            return 0;
    }
    return 1;
}

/* Normals that wi = (0, 0, 1) sees are all normals. Their azimuths turn by the golden ratio, lengths are stratified. */
int bake_prefilter(const bake_settings *s, baked_list *list)
{
    enum { LEVELS = 8, TAPS = 32 };
    const char *const axis[] = {"roughness: (i + 1)/8", "tap"};
    const size_t count[] = {LEVELS, TAPS};
    const vndf_vec3 up = {0, 0, 1};
    baked *b = baked_add(
        list, "prefilter",
        "x and y of the direction l; its weight, n.l over their sum; and what log2(n) is added to for "
        "the mip level of a cube map of 6 n^2 texels: half the log2 of the tap's solid angle over 4 pi/6",
        2, axis, count, 4);
    if (!b)
        return 0;
    for (size_t i = 0; i < LEVELS; i++) {
        float alpha = bake_alpha(s->mapping, (double)(i + 1) / LEVELS);
        const vndf_surface surface = {s->distribution, alpha, alpha};
        const vndf_view view = vndf_view_from(&surface, up);
        double sum = 0;
        for (size_t k = 0; k < TAPS; k++) {
            float *to = b->value + (i * TAPS + k) * 4, pdf;
            double turn = 0.618033988749895 * (double)k;
            const vndf_vec3 h = vndf_sample(&view, (float)(turn - floor(turn)), ((float)k + 0.5f) / TAPS, &pdf);
            double z = 2 * (double)h.z * (double)h.z - 1, area = 4 * (double)h.z / ((double)pdf * TAPS);
            to[0] = 2 * h.z * h.x;
            to[1] = 2 * h.z * h.y;
            to[2] = (float)fmax(z, 0);
            to[3] = (float)(0.5 * log2(area / (4 * 3.14159265358979 / 6)));
            sum += fmax(z, 0);
        }
        for (size_t k = 0; k < TAPS; k++)
            b->value[(i * TAPS + k) * 4 + 2] /= (float)sum;
    }
    return !progress_show(1, "prefilter", s->progress);
}
