/* The tables of directions: dfg, energy and prefilter. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bake/bake.h"

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

/* What a host keeps: sizes of the mirror's and of glass's axes; the order of eta, cosine and roughness from the slowest
 * to the fastest; whether places are in the middle of texels; what the places of the index stand for. Hosts mask what
 * passes as what is reflected. */
typedef struct shape {
    size_t mirror, glass;
    const char *order;
    int centred, masks_alike;
    enum { BY_ETA, BY_ROOT, BY_RATIO } index;
    const char *outside, *inside; /* the index in words */
} shape;

static const shape shapes[] = {
    [BAKE_GRID] = {32, 16, "erc", 1, 0, BY_ETA, "eta: 1 + 2 (i + 1/2)/n", "eta: 1 + 2 (i + 1/2)/n"},
    /* scene/shader.tables: a slice for z, a row for the cosine */
    [BAKE_CYCLES] = {32, 16, "ecr", 0, 1, BY_ROOT, "z = i/(n - 1), eta = (1 + z^2)/(1 - z^2)",
                     "z = i/(n - 1), eta = (1 + z^2)/(1 - z^2)"},
    /* MicrofacetAlbedoTables.ispc: the index is that outside over that inside, 1/3 to 1 and 1 to 3 */
    [BAKE_OSPRAY] = {32, 16, "rec", 0, 1, BY_RATIO, "1/eta: 1/3 + 2/3 i/(n - 1)", "eta: 1 + 2 i/(n - 1)"},
};

/* The index for place t; it is held away from where it ends. */
static double eta_of(const shape *h, double t, int inside)
{
    double z2 = fmin(t * t, 0.98), eta = 1 + 2 * t;
    if (h->index == BY_ROOT)
        eta = (1 + z2) / (1 - z2);
    if (h->index == BY_RATIO && !inside)
        eta = 3 / (1 + 2 * t);
    return fmax(eta, 1.002);
}

typedef struct texel {
    float alpha;
    double cosine, eta;
    int is_empty; /* no surface: Cycles' first slice */
} texel;

/* Texel k; the axes, from the slowest to the fastest, are r, c and e. */
static texel texel_at(const bake_settings *s, const shape *h, size_t k, size_t n, const char *axes, int inside)
{
    texel t = {0, 0, 0, 0};
    for (size_t i = strlen(axes); i-- > 0; k /= n) {
        const double at = (double)(k % n), place = h->centred ? (at + 0.5) / (double)n : at / (double)(n - 1);
        if (axes[i] == 'r')
            t.alpha = bake_alpha(s->mapping, place);
        else if (axes[i] == 'c')
            t.cosine = fmax(place, 1e-4);
        else {
            t.eta = eta_of(h, place, inside);
            t.is_empty = h->index == BY_ROOT && place == 0;
        }
    }
    if (inside)
        t.eta = 1 / t.eta;
    return t;
}

static void note_error(baked *b, double got, double want, int count)
{
    double error = fabs(got - want);
    b->worst = fmax(b->worst, error);
    b->mean += error / count;
}

/* Adds a table of n places on each axis: of three channels the split sum with the mean over cosines, of one E, or
 * without the axis c its mean. 16 texels are compared with quadrature. */
static int add_table(const bake_settings *s, const shape *h, baked_list *list, const char *name, const char *holds,
                     size_t n, const char *axes, int inside, int channels)
{
    enum { CHECKED = 16 };
    const int is_mean = !strchr(axes, 'c');
    const size_t count[] = {n, n, n};
    const char *axis[BAKE_AXES];
    double average = 0;
    float average_of = 0; /* the alpha */
    for (int i = 0; axes[i]; i++)
        axis[i] = axes[i] == 'e'   ? (inside ? h->inside : h->outside)
                  : axes[i] == 'r' ? (h->centred ? "roughness: (i + 1/2)/n" : "roughness: i/(n - 1)")
                                   : (h->centred ? "cosine: (i + 1/2)/n" : "cosine: i/(n - 1)");
    baked *b = baked_add(list, name, holds, (int)strlen(axes), axis, count, channels);
    const size_t size = b ? baked_size(b) / (size_t)channels : 0;
    for (size_t k = 0; k < size; k++) {
        const texel t = texel_at(s, h, k, n, axes, inside);
        float *to = b->value + k * (size_t)channels;
        if (is_mean || (channels > 1 && average_of != t.alpha))
            average = bake_average(s, average_of = t.alpha, t.eta);
        const bake_sum sum = is_mean ? (bake_sum){average, 0} : bake_direction(s, t.alpha, t.cosine, t.eta);
        to[0] = t.is_empty ? 1 : (float)(channels == 1 ? fmin(sum.all, 1) : sum.all - sum.grazing);
        if (channels > 1) {
            to[1] = (float)sum.grazing;
            to[2] = (float)average;
        }
        if (progress_show((double)k / (double)size, name, s->progress))
            return 0;
    }
    for (int i = 0; b && !is_mean && i < CHECKED; i++) {
        const size_t k = (size - 1) * (size_t)i / (CHECKED - 1);
        const texel t = texel_at(s, h, k, n, axes, inside);
        const float *got = b->value + k * (size_t)channels;
        if (t.is_empty)
            continue;
        const bake_sum want = bake_reference(s, t.alpha, t.cosine, t.eta);
        b->error = "beside quadrature over slopes, at 16 texels";
        note_error(b, (double)got[0], channels > 1 ? want.all - want.grazing : want.all,
                   CHECKED * (channels > 1 ? 2 : 1));
        if (channels > 1)
            note_error(b, (double)got[1], want.grazing, CHECKED * 2);
    }
    return b != NULL;
}

int bake_dfg(const bake_settings *s, baked_list *list)
{
    return add_table(s, &shapes[BAKE_GRID], list, "dfg",
                     "scale, bias, average: f = f0 scale + f90 bias; 2 integral (scale + bias) mu dmu", s->size,
                     "rc", 0, 3);
}

int bake_energy(const bake_settings *s, baked_list *list)
{
    static const char *const names[] = {"energy",        "energy_average", "glass",
                                        "glass_average", "glass_inside",   "glass_inside_average"};
    static const char *const holds[] = {
        "the part of the light that a mirror reflects",
        "the part of the light that both lobes of a dielectric keep, from the thinner side",
        "the same from the denser side, of index 1/eta"};
    const shape *h = &shapes[s->shape];
    bake_settings host = *s;
    int good = 1;
    host.masks_alike = h->masks_alike && s->masking == VNDF_MASKING_HEIGHT_CORRELATED;
    for (int k = 0; k < 6 && good; k++) {
        char axes[4], *to = axes;
        for (const char *at = h->order; *at; at++)
            if ((k > 1 || *at != 'e') && (k % 2 == 0 || *at != 'c'))
                *to++ = *at;
        *to = '\0';
        good = add_table(&host, h, list, names[k], holds[k / 2], k > 1 ? h->glass : h->mirror, axes, k > 3, 1);
    }
    return good;
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
        const vndf_surface surface = vndf_rough(s->distribution, alpha, alpha);
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
