/* A batch of a BSDF gives the bits of its calls for one - directions, facets, lobes, weights, values and densities -
 * and writes nothing past its end: for every sensible set of effects and shape, walks among them, with all instruction
 * sets and without, for batches of one to several blocks that end anywhere, shared or own directions, surfaces, plain
 * and sheared, and mixtures, wi on either side. Whatever bits go in, no NaN and nothing infinite or negative comes out:
 * directions that are NaN, infinite or zero, at either end, and matrices that are singular, scatter nothing; numbers
 * outside [0, 1] are as good as any. A call that is made for another shape scatters nothing. */
#include <float.h>

#include "bsdf/bsdf_case.h"

enum { COUNT = 600, SPARE = 32, BYTE = 99 }; /* every byte of results before the calls */

typedef struct inputs {
    float wi[3][COUNT], wo[3][COUNT], u[3][COUNT];
    float xx[COUNT], xy[COUNT], yx[COUNT], yy[COUNT], mean_x[COUNT], mean_y[COUNT];
    vndf_mixture mixture[COUNT];
    uint64_t seed[COUNT];
} inputs;

/* Behind the results of a batch are numbers that have to stay. value[1] and pdf[1] are asked for by themselves. */
typedef struct results {
    float wo[3][COUNT + SPARE], wm[3][COUNT + SPARE], weight[VNDF_WAVELENGTHS][COUNT + SPARE];
    float value[2][VNDF_WAVELENGTHS][COUNT + SPARE], density[COUNT + SPARE], pdf[2][COUNT + SPARE];
    uint8_t lobe[COUNT + SPARE];
} results;

/* ---- inputs ---- */

/* One of the hard numbers, or any bits. */
static float hard(unsigned long long *state)
{
    static const float numbers[] = {0,       -0.0f, 1,       -1,       NAN,    INFINITY, -INFINITY, 1e-30f,
                                    FLT_MAX, 2,     FLT_MIN, -FLT_MIN, 1e-45f, -1e-10f,  0.5f,      0.99999994f};
    unsigned bits = (unsigned)(test_random_bits(state) >> 32);
    float any;
    memcpy(&any, &bits, sizeof any);
    return test_random_bits(state) >> 62 ? numbers[test_random_bits(state) >> 60] : any;
}

/* `hostile`: every eighth number is hard; else every 32nd of u. */
static void fill(inputs *in, const bsdf_subject *s, size_t count, int hostile, unsigned long long *state)
{
    float least = 2e-4f + test_uniform(state) * test_uniform(state);
    for (size_t i = 0; i < count; i++) {
        const vndf_vec3 w[2] = {bsdf_direction(state), bsdf_direction(state)};
        float u[3];
        float *const all[] = {&in->wi[0][i], &in->wi[1][i], &in->wi[2][i], &in->wo[0][i], &in->wo[1][i],
                              &in->wo[2][i], &in->xx[i],    &in->yy[i],    &in->xy[i]};
        bsdf_numbers(state, u);
        for (int k = 0; k < 3; k++)
            in->u[k][i] = test_random_bits(state) >> (hostile ? 61 : 59) ? u[k] : hard(state);
        const float x = least * (1 + 9 * test_uniform(state)), y = least * (1 + 9 * test_uniform(state));
        const vndf_surface a =
            i % 3 ? bsdf_sheared(NULL, i % 2 ? 1.0f : 0.0f, state) : vndf_rough(NULL, x, i % 2 ? x : y);
        in->xx[i] = a.xx, in->xy[i] = a.xy, in->yx[i] = a.yx, in->yy[i] = a.yy;
        in->mean_x[i] = a.mean_x, in->mean_y[i] = a.mean_y;
        in->wi[0][i] = w[0].x, in->wi[1][i] = w[0].y, in->wi[2][i] = w[0].z;
        in->wo[0][i] = w[1].x, in->wo[1][i] = w[1].y, in->wo[2][i] = w[1].z;
        in->mixture[i] = s->mixture;
        in->mixture[i].lobe[0].surface = bsdf_sheared(s->is.surface.distribution, 1, state);
        in->mixture[i].lobe[0].weight = i % 5 ? test_uniform(state) : -1.0f;
        in->seed[i] = i;
        for (int k = 0; k < 9 && hostile; k++)
            if (test_random_bits(state) >> 61 == 0)
                *all[k] = hard(state);
    }
}

/* ---- one batch ---- */

static int sound(float x)
{
    return x >= 0 && x <= FLT_MAX;
}

static int is_direction(vndf_vec3 w)
{
    return isfinite(w.x) && isfinite(w.y) && isfinite(w.z) && (w.x != 0 || w.y != 0 || w.z != 0);
}

static void run(const vndf_bsdf_batch *b, const inputs *in, int with_wm, results *r)
{
    const float *const u[3] = {in->u[0], in->u[1], in->u[2]};
    const vndf_normals given = {(float *)in->wo[0], (float *)in->wo[1], (float *)in->wo[2]};
    vndf_scattered_n out = {{r->wo[0], r->wo[1], r->wo[2]}, {0}, r->density, r->lobe, {0}};
    float *value[2][VNDF_WAVELENGTHS];
    for (int k = 0; k < VNDF_WAVELENGTHS; k++) {
        out.weight[k] = r->weight[k];
        value[0][k] = r->value[0][k];
        value[1][k] = r->value[1][k];
    }
    if (with_wm)
        out.wm = (vndf_normals){r->wm[0], r->wm[1], r->wm[2]};
    memset(r, BYTE, sizeof *r);
    vndf_bsdf_sample_n(b, u, out);
    vndf_bsdf_eval_pdf_n(b, given, in->seed, value[0], r->pdf[0]);
    vndf_bsdf_eval_pdf_n(b, given, in->seed, value[1], NULL);
    vndf_bsdf_eval_pdf_n(b, given, NULL, NULL, r->pdf[1]);
}

/* Also calls for another shape, or for none. */
static int hit_at(const vndf_bsdf_batch *b, const inputs *in, size_t i, vndf_bsdf *hit)
{
    const vndf_material *m = b->material;
    size_t at = b->shared & VNDF_SHARED_SURFACE ? 0 : i, from = b->shared & VNDF_SHARED_WI ? 0 : i;
    vndf_vec3 wi = {in->wi[0][from], in->wi[1][from], in->wi[2][from]};
    vndf_surface a = {NULL, in->xx[at], 0, 0, in->yy[at], 0, 0}, singular = {NULL, 1, 2, 2, 4, 0, 0};
    const int mixed = m->is.effects.shape == VNDF_SHAPE_MIXTURE;
    if (b->surface.xy)
        a.xy = in->xy[at], a.yx = in->yx[at], a.mean_x = in->mean_x[at], a.mean_y = in->mean_y[at];
    int seen = mixed ? vndf_bsdf_mixture(hit, m, b->mixture ? &in->mixture[at] : NULL, wi)
                     : vndf_bsdf_on(hit, m, b->surface.xx ? &a : NULL, wi);
    double determinant = (double)a.xx * (double)a.yy - (double)a.xy * (double)a.yx;
    TEST(!seen || is_direction(wi));
    TEST(!seen || mixed || !b->surface.xx || (isfinite(determinant) && determinant != 0));
    vndf_mixture none = in->mixture[at];
    vndf_bsdf other;
    none.count = 0;
    TEST(!mixed || !vndf_bsdf_on(&other, m, &a, wi));
    TEST(mixed || !vndf_bsdf_mixture(&other, m, &in->mixture[at], wi));
    TEST(!vndf_bsdf_on(&other, m, &singular, wi) && !vndf_bsdf_mixture(&other, m, &none, wi));
    return seen;
}

/* What one hit gave. */
static int is_sound(const vndf_bsdf *b, int seen, const vndf_scattered *s, vndf_vec3 wo, const float *f, float pdf)
{
    int nothing = !seen || !is_direction(wo) || (b->material->is.effects.shape == VNDF_SHAPE_LEVEL && wo.z == 0);
    int good =
        TEST((s->lobe == VNDF_LOBE_NONE) == (s->density == 0) && (seen || s->lobe == VNDF_LOBE_NONE)) &
        TEST(sound(s->density) && sound(pdf) && is_direction(s->wo) && (!nothing || pdf == 0) && !isnan(s->wm.x));
    for (int i = 0; i < b->material->is.wavelengths; i++)
        good &= TEST(sound(s->weight[i]) && sound(f[i]) && (s->density > 0 || s->weight[i] == 0) &&
                     (!nothing || f[i] == 0));
    return good;
}

/* The same by the calls for one; counts the lobes that were met. */
static int run_one_by_one(const vndf_bsdf_batch *b, const inputs *in, int with_wm, results *r, size_t lobes[4])
{
    int good = 1;
    memset(r, BYTE, sizeof *r);
    for (size_t i = 0; i < b->count; i++) {
        const float u[3] = {in->u[0][i], in->u[1][i], in->u[2][i]};
        const vndf_vec3 wo = {in->wo[0][i], in->wo[1][i], in->wo[2][i]};
        float f[VNDF_WAVELENGTHS];
        vndf_scattered s;
        vndf_bsdf hit;
        int seen = hit_at(b, in, i, &hit);
        vndf_bsdf_sample(&hit, u, &s);
        vndf_bsdf_eval_pdf(&hit, wo, in->seed[i], f, &r->pdf[0][i]);
        good &= is_sound(&hit, seen, &s, wo, f, r->pdf[0][i]);
        r->pdf[1][i] = r->pdf[0][i];
        r->density[i] = s.density;
        r->lobe[i] = (uint8_t)s.lobe;
        r->wo[0][i] = s.wo.x, r->wo[1][i] = s.wo.y, r->wo[2][i] = s.wo.z;
        if (with_wm)
            r->wm[0][i] = s.wm.x, r->wm[1][i] = s.wm.y, r->wm[2][i] = s.wm.z;
        for (int k = 0; k < b->material->is.wavelengths; k++) {
            r->weight[k][i] = s.weight[k];
            r->value[0][k][i] = r->value[1][k][i] = f[k];
        }
        lobes[s.lobe]++;
    }
    return good;
}

static void test_material(const oracle_ndf *ndf, const vndf_effects *e, size_t n, unsigned long long *state,
                          size_t lobes[4])
{
    static const float alphas[] = {1e-3f, 0.03f, 0.1f, 0.4f, 0.5f, 1, 3, 30, 1e-15f, 1e15f};
    static const float etas[] = {1, 0.01f, 100, 1.0000001f};
    static const size_t counts[] = {1, 2, 7, 8, 16, 17, 255, 256, 257, 512, 575, 600};
    static const vndf_instructions limits[] = {VNDF_INSTRUCTIONS_BEST, VNDF_INSTRUCTIONS_AVX2,
                                               VNDF_INSTRUCTIONS_PORTABLE};
    static inputs in;
    static results got, want;
    bsdf_subject s;
    vndf_material m;
    int is_slow = e->shape == VNDF_SHAPE_MIXTURE || e->scattering == VNDF_SCATTERING_MULTIPLE, own = n % 3 < 2;
    int hostile = n % 5 > 2;
    bsdf_material(&s, ndf, 1, e, alphas, hostile ? 10 : 7, state);
    s.is.wavelengths = 1 + (int)(n % VNDF_WAVELENGTHS);
    s.is.order_limit = 8;
    if (n % 8 == 3 && e->scattering == VNDF_SCATTERING_SINGLE)
        s.is.eta = bsdf_pick(etas, hostile ? 4 : 1, state);
    vndf_status status = vndf_material_resolve(&s.is, &m, NULL);
    if (!TEST(hostile || status == VNDF_OK) || status != VNDF_OK) /* 1e-15 times the scale of a table */
        return;
    vndf_bsdf_batch b = {.material = &m, .shared = (unsigned)(n / 2 % 4), .limit = limits[n % 3]};
    b.count = counts[test_random_bits(state) % (is_slow ? 6 : 12)];
    fill(&in, &s, b.count, hostile, state);
    b.wi_x = in.wi[0], b.wi_y = in.wi[1], b.wi_z = in.wi[2];
    if (own) {
        b.surface = (vndf_surface_batch){.xx = in.xx, .yy = in.yy};
        if (n % 5 < 4)
            b.surface = (vndf_surface_batch){NULL, in.xx, in.xy, in.yx, in.yy, in.mean_x, in.mean_y};
        b.mixture = in.mixture;
    }
    run(&b, &in, n % 4 > 0, &got);
    if (!(run_one_by_one(&b, &in, n % 4 > 0, &want, lobes) & TEST(memcmp(&got, &want, sizeof got) == 0)))
        bsdf_describe(&s.is, ndf->name, (vndf_vec3){0, 0, 0}, (vndf_vec3){0, 0, 0});
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx", "beckmann", "student-t-2.5-small", "hazy"};
    oracle_ndf ndf;
    for (size_t i = 0; bsdf_next(&i, &ndf, names, 4, arguments, argument); i++) {
        unsigned long long state = 11 + i;
        size_t lobes[4] = {0}, n = i;
        for (size_t k = 0; k < ORACLE_EFFECT_SETS; k++) {
            vndf_effects e = oracle_effects(k);
            if (oracle_effects_sensible(&e) && n++ % test_amount(4, 2, 1) == 0)
                test_material(&ndf, &e, n + k / 7, &state, lobes);
        }
        for (int lobe = 0; lobe <= VNDF_LOBE_STRAIGHT; lobe++)
            TEST(lobes[lobe] > 10);
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
