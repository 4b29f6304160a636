/* Baked tables hold what quadrature over slopes finds, for closed forms, haze and rings: DFG and energy of mirrors to
 * 3e-4, of glass to 5e-4 from the thinner side and 3e-3 from the denser one; of GGX at alpha 1 also what is known
 * exactly. A fitted cosine lights a rectangle as the BSDF does. Notices a Fresnel term in the wrong channel, axes that
 * are swapped, a matrix that is not the inverse, weights that do not sum to 1, and half floats that are not the
 * nearest. (Files: python_formats.) */
#include "bake/bake.h"
#include "harness/test.h"
#include "oracle/oracle.h"

static progress quiet;

static bake_settings settings(const vndf_distribution *d, size_t size)
{
    quiet = progress_begin("test", 1);
    bake_settings s = {.distribution = d, .size = size, .progress = &quiet};
    return s;
}

/* At alpha 1 f of GGX is 1/(2 pi (cos_i + cos_o)), so E = 1 - mu log((1 + mu)/mu). */
static void test_known(void)
{
    const bake_settings s = settings(vndf_ggx(), 4);
    for (int i = 1; i <= 20; i++) {
        double mu = i / 20.0;
        TEST_NEAR(bake_direction(&s, 1, mu, 0).all, 1 - mu * log((1 + mu) / mu), 5e-4);
    }
    /* 2 integral E mu dmu, by parts */
    TEST_NEAR(bake_average(&s, 1, 0), 1 - 2.0 / 3 * log(2) - 2.0 / 3 * (0.5 - 1 + log(2)), 5e-4);
}

static void test_directions(const vndf_distribution *d)
{
    static const double alphas[] = {0.01, 0.1, 0.4, 0.9}, cosines[] = {0.03, 0.1, 0.5, 0.97};
    for (int masking = 0; masking < 2; masking++) {
        bake_settings s = settings(d, 4);
        s.masking = masking ? VNDF_MASKING_SEPARABLE : VNDF_MASKING_HEIGHT_CORRELATED;
        for (int k = 0; k < (test_quick() ? 4 : 16); k++) {
            float alpha = (float)alphas[k % 4];
            double cosine = cosines[(k + k / 4) % 4];
            bake_sum got = bake_direction(&s, alpha, cosine, 0), want = bake_reference(&s, alpha, cosine, 0);
            TEST_NEAR(got.all, want.all, 3e-4);
            TEST_NEAR(got.grazing, want.grazing, 3e-4);
            TEST_NEAR(bake_direction(&s, alpha, cosine, 1.5).all, bake_reference(&s, alpha, cosine, 1.5).all,
                      5e-4);
            TEST_NEAR(bake_direction(&s, alpha, cosine, 1 / 1.5).all,
                      bake_reference(&s, alpha, cosine, 1 / 1.5).all, 3e-3);
        }
    }
}

/* Texels are where the axes say: one of each table by itself. */
static void test_places(void)
{
    bake_settings s = settings(vndf_ggx(), 8);
    baked_list list = {.count = 0};
    s.shape = BAKE_CYCLES;
    TEST(bake_dfg(&s, &list) && bake_energy(&s, &list) && bake_prefilter(&s, &list) && list.count == 8);
    const float *dfg = list.table[0].value + 3 * (5 * 8 + 2), *prefilter = list.table[7].value;
    bake_sum want = bake_direction(&s, bake_alpha(BAKE_SQUARE, 5.5 / 8), 2.5 / 8, 0);
    TEST_NEAR((double)dfg[0], want.all - want.grazing, 1e-6);
    TEST_NEAR((double)dfg[1], want.grazing, 1e-6);
    TEST(list.table[0].worst < 1e-3 && list.table[0].worst > 0);
    TEST_NEAR((double)list.table[1].value[9 * 32 + 20],
              bake_direction(&s, bake_alpha(BAKE_SQUARE, 20 / 31.0), 9 / 31.0, 0).all, 1e-6);
    double z = 6 / 15.0, eta = (1 + z * z) / (1 - z * z);
    s.masks_alike = 1; /* as Cycles does */
    TEST_NEAR((double)list.table[3].value[(6 * 16 + 9) * 16 + 4],
              bake_direction(&s, bake_alpha(BAKE_SQUARE, 4 / 15.0), 9 / 15.0, eta).all, 1e-6);
    TEST_NEAR((double)list.table[5].value[(6 * 16 + 9) * 16 + 4],
              bake_direction(&s, bake_alpha(BAKE_SQUARE, 4 / 15.0), 9 / 15.0, 1 / eta).all, 1e-6);
    /* What Cycles ships as table_ggx_glass_E, by the same places. */
    TEST_NEAR((double)list.table[3].value[(1 * 16 + 1) * 16 + 15], 0.5586, 1e-4);
    TEST_NEAR((double)list.table[3].value[(4 * 16 + 2) * 16 + 15], 0.6657, 1e-4);
    TEST_NEAR((double)list.table[3].value[(1 * 16 + 0) * 16 + 15], 0.9600, 1e-4);
    TEST_NEAR((double)list.table[3].value[(0 * 16 + 3) * 16 + 9], 1, 1e-7);
    TEST_NEAR((double)list.table[2].value[31], 0.409137, 1e-4);
    TEST_NEAR((double)list.table[2].value[20], 0.761345, 1e-4);
    double sum = 0;
    for (int k = 0; k < 32; k++)
        sum += (double)prefilter[4 * (32 * 7 + k) + 2];
    TEST_NEAR(sum, 1, 1e-5);
    TEST_NEAR((double)prefilter[4 * 32 * 7 + 3], 0.5 * log2(6 / 32.0), 1e-4); /* D is 1/pi */
    baked_free(&list);
    s.shape = BAKE_OSPRAY;
    TEST(bake_energy(&s, &list) && list.count == 6);
    for (int inside = 0; inside < 2; inside++) {
        eta = inside ? 1 / (1 + 2 * 6 / 15.0) : 1 / (1 / 3.0 + 2 * 6 / 45.0);
        want = bake_direction(&s, bake_alpha(BAKE_SQUARE, 4 / 15.0), 9 / 15.0, eta);
        TEST_NEAR((double)list.table[2 + 2 * inside].value[(4 * 16 + 6) * 16 + 9], want.all, 1e-6);
    }
    baked_free(&list);
}

/* ---- light from a rectangle ---- */

/* For light from cosine and azimuth on a surface: the integrals over five squares of 2 x 2 at height 1, one above the
 * point, of f cos and of E times the cosine; their squared difference and the square of the first are added to sum. */
static void light(const vndf_distribution *d, float alpha_x, float alpha_y, double cosine, double azimuth,
                  const bake_cosine *c, float all, double sum[2])
{
    enum { SIDE = 96 };
    const vndf_description of = {.surface = vndf_rough(d, alpha_x, alpha_y)};
    const double r = sqrt(1 - cosine * cosine);
    const vndf_vec3 wi = {(float)(r * cos(azimuth)), (float)(r * sin(azimuth)), (float)cosine};
    vndf_material material;
    vndf_error error;
    vndf_bsdf hit;
    TEST(vndf_material_resolve(&of, &material, &error) == VNDF_OK && vndf_bsdf_at(&hit, &material, wi));
    for (int along = -3; along <= 1; along++) {
        double true_light = 0, cosine_light = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            double x = along + (i % SIDE + 0.5) * 2 / SIDE - 1, y = (i / SIDE + 0.5) * 2.0 / SIDE - 1;
            double length = sqrt(x * x + y * y + 1), solid = 4.0 / (SIDE * SIDE) / (length * length * length);
            const double wo[3] = {x / length, y / length, 1 / length};
            const vndf_vec3 out = {(float)wo[0], (float)wo[1], (float)wo[2]};
            float f[VNDF_WAVELENGTHS];
            vndf_bsdf_eval(&hit, out, 0, f);
            true_light += (double)f[0] * wo[2] * solid;
            cosine_light += (double)all * bake_cosine_density(c, wo) * solid;
        }
        sum[0] += (true_light - cosine_light) * (true_light - cosine_light);
        sum[1] += true_light * true_light;
    }
}

/* The root of the mean square of the difference over that of the light itself. */
static double light_error(const vndf_distribution *d)
{
    bake_settings s = settings(d, 8);
    baked_list list = {.count = 0};
    double sum[2] = {0, 0};
    TEST(bake_ltc(&s, &list) && list.count == 2);
    for (int k = 0; k < 12 && list.count == 2; k++) {
        const int rough = 3 + k % 4, at = k / 4 * 2;
        const float *m = list.table[0].value + 4 * (at * 8 + rough), a = bake_alpha(BAKE_SQUARE, rough / 7.0);
        const bake_cosine c = {{{(double)m[0], 0, (double)m[2]}, {0, 1, 0}, {(double)m[1], 0, (double)m[3]}}};
        light(d, a, a, 1 - at * at / 49.0, 0, &c, list.table[1].value[3 * (at * 8 + rough)], sum);
    }
    baked_free(&list);
    return sqrt(sum[0] / sum[1]);
}

/* The same of two roughnesses, at 24 texels: alpha_y a half of alpha_x and less, light from all azimuths. */
static double anisotropic_error(const vndf_distribution *d)
{
    enum { N = 4 };
    bake_settings s = settings(d, N);
    baked_list list = {.count = 0};
    double sum[2] = {0, 0};
    TEST(bake_anisotropic(&s, &list) && list.count == 3);
    fprintf(stderr, "fits of two roughnesses: %.4f in the mean\n", list.table[0].mean);
    TEST(list.table[0].mean < 0.1905);
    for (int k = 0; k < 24 && list.count == 3; k++) {
        const int rough = 2 + k % 2, ratio = k / 2 % 2, theta = k / 4 % 3, phi = k % N,
                  at = 4 * (((rough * N + ratio) * N + theta) * N + phi);
        const float a = bake_alpha(BAKE_SQUARE, rough / (N - 1.0));
        bake_cosine c;
        for (int i = 0; i < 9; i++)
            c.inverse[i / 3][i % 3] = (double)list.table[i / 3].value[at + i % 3];
        light(d, a, a * (float)(ratio + 1) / N, 1 - theta * theta / 9.0, 1.5707963267949 * phi / (N - 1), &c,
              list.table[0].value[at + 3], sum);
    }
    baked_free(&list);
    return sqrt(sum[0] / sum[1]);
}

/* ---- half floats ---- */

/* By its digits. */
static double half_value(unsigned half)
{
    int exponent = (int)(half >> 10 & 31);
    double part = half & 1023, size = exponent ? ldexp(1024 + part, exponent - 25) : ldexp(part, -24);
    return half & 0x8000 ? -size : size;
}

static void test_halves(void)
{
    for (unsigned half = 0; half < 0x7c00; half++) {
        double x = half_value(half), next = half + 1 < 0x7c00 ? half_value(half + 1) : 65536;
        unsigned even = half & 1 ? half + 1 : half;
        TEST(bake_half((float)x) == half && bake_half((float)-x) == (half | 0x8000) &&
             bake_half((float)(0.51 * x + 0.49 * next)) == half &&
             bake_half((float)(0.5 * x + 0.5 * next)) == even);
    }
    TEST(bake_half(1e10f) == 0x7c00 && bake_half(-1e-10f) == 0x8000);
}

int main(void)
{
    vndf_error error;
    vndf_distribution *haze = oracle_shipped("hazy"), *ring = oracle_build("exp(-20*(r-1)^2)", 0, NULL, &error);
    if (!haze || !ring)
        return 1;
    const vndf_distribution *const all[] = {vndf_ggx(), vndf_beckmann(), haze, ring};
    test_known();
    for (int i = 0; i < 4; i += test_quick() ? 2 : 1)
        test_directions(all[i]);
    if (!test_quick())
        test_places();
    test_halves();
    double errors[4];
    for (int i = 0; i < 4; i++)
        fprintf(stderr, "light of distribution %d: %.4f\n", i, errors[i] = light_error(all[i]));
    TEST(errors[0] < 0.03 && errors[1] < 0.11 && errors[2] < 0.06 && errors[3] < 0.3);
    double anisotropic = anisotropic_error(haze);
    fprintf(stderr, "light of two roughnesses: %.4f\n", anisotropic);
    TEST(anisotropic < 0.1);
    vndf_free(haze);
    vndf_free(ring);
    return test_done();
}
