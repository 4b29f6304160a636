/* GGX and Beckmann in float, above the horizon where all is of plain size: uniform numbers are met within 2e-7 by
 * the slopes of a Beckmann and within 2e-6 by the directions that GGX mirrors, from 1e-5 to 90 degrees, and nearly
 * all samples are drawn so. The oracles are the C library's functions in long double. */
#include "sampler/analytic/beckmann_draw.h"
#include "sampler/analytic/ggx_draw.h"
#include "harness/constants.h"
#include "harness/test.h"

/* ---- exp, log and the error function's kin ---- */

static void elementary_functions_are_accurate(void)
{
    double worst[3] = {0.0, 0.0, 0.0};
    for (int i = -100000; i <= 100000; i++) {
        float x = (float)i * 1.2e-4f, z = fabsf(x) / 3.0f;
        vndf_erfc_ratio e = vndf_erfc_lanes(z);
        double tail = sqrt(PI) * exp((double)z * z) * erfc(z), size = 1.0 + fabs((double)x);
        worst[0] = fmax(worst[0], fabs((double)vndf_exp_lanes(x) / exp(x) - 1.0) / size);
        if (i != 0)
            worst[1] = fmax(worst[1], fabs((double)vndf_exp_less_one_lanes(x) / expm1(x) - 1.0) / size);
        worst[2] = fmax(worst[2], fabs((double)e.above / (double)e.below / tail - 1.0));
    }
    fprintf(stderr, "exp %.2g (1 + x), exp - 1 %.2g (1 + x), E %.2g\n", worst[0], worst[1], worst[2]);
    TEST(worst[0] < 1.5e-7 && worst[1] < 3e-7 && worst[2] < 4e-7);
}

static void log_is_accurate(void)
{
    double worst = 0.0;
    for (int i = 0; i < 200000; i++) {
        float x = (float)exp(-20.0 + i * 2e-4);
        worst = fmax(worst, fabs((double)vndf_log_lanes(x) - log(x)) / (1.0 + fabs(log(x))));
    }
    fprintf(stderr, "log: error %.2g of 1 and itself\n", worst);
    TEST(worst < 3e-7);
}

/* ---- Beckmann ---- */

/* F(x)/F(K): the mass below x, or what is missing of it. */
static long double mass_below(long double x, long double k)
{
    long double root = sqrtl((long double)PI), all = root * k * erfcl(-k) + expl(-k * k);
    return (root * k * erfcl(-x) + expl(-x * x)) / all;
}

static int is_trusted(const vndf_beckmann_incidence *w, const vndf_beckmann_place *at, float u)
{
    return vndf_beckmann_is_trusted(w, at, 0.0f, vndf_beckmann_product(u));
}

/* Through x where that is the smaller, else through d. */
static double error_at(const vndf_beckmann_incidence *w, const vndf_beckmann_place *at, float u)
{
    long double k = w->bound, x = fabsf(at->x) < at->d ? at->x : k - at->d;
    return fabs((double)(mass_below(x, k) - u));
}

/* Every u where that is trusted, from ends far beyond; K = c/s. */
static void beckmann_meets_its_first_number(void)
{
    double worst = 0.0;
    long trusted = 0, all = 0;
    for (double k = 2e-6; k < 1e7; k *= 1.07)
        for (int i = 0; i < 1300; i++) {
            double end = pow(10.0, -0.3 - i % 100 * 0.06);
            float u = (float)(i < 100 ? end : i < 200 ? 1.0 - end : (i - 199.5) / 1100.0);
            vndf_beckmann_incidence w = vndf_beckmann_incidence_from(1.0f, 1.0f, (float)(1.0 / hypot(1.0, k)),
                                                                     0.0f, (float)(k / hypot(1.0, k)));
            vndf_beckmann_place at = vndf_beckmann_step(&w, vndf_beckmann_first(&w, u), u);
            all++;
            if (!is_trusted(&w, &at, u))
                continue;
            trusted++;
            worst = fmax(worst, error_at(&w, &at, u));
        }
    fprintf(stderr, "beckmann: u1 met within %.2g, %ld of %ld trusted\n", worst, trusted, all);
    TEST(worst < 2e-7);
    TEST(trusted > all * 8 / 10);
}

static void beckmann_meets_its_second_number(void)
{
    double worst = 0.0;
    for (int i = 1; i < 200000; i++) {
        float u = (float)i / 200000.0f;
        if (vndf_beckmann_product(u) > 3.4e-4f)
            worst = fmax(worst, fabs(0.5 * erfc(-(double)vndf_beckmann_second(u)) - (double)u));
    }
    fprintf(stderr, "beckmann: u2 met within %.2g\n", worst);
    TEST(worst < 1.2e-7);
}

/* ---- GGX ---- */

static void half_azimuth_is_accurate(void)
{
    double worst = 0.0;
    for (int i = 0; i <= 1 << 20; i++) {
        float u = (float)i * 0x1p-20f;
        vndf_half_azimuth half = vndf_half_azimuth_at(u);
        worst = fmax(worst, fabs(atan2((double)half.sine, (double)half.cosine) - PI * (double)u));
        TEST_RELATIVE((double)half.square,
                      (double)half.sine * (double)half.sine + (double)half.cosine * (double)half.cosine, 2e-7);
    }
    fprintf(stderr, "half azimuth: error %.2g\n", worst);
    TEST(worst < 2e-7);
}

/* The direction mirrored in the normal is uniform on the cap: azimuth and height. */
static void ggx_meets_its_numbers(void)
{
    unsigned long long state = 11;
    double worst1 = 0.0, worst2 = 0.0;
    for (int i = 0; i < 400000; i++) {
        double part = test_uniform_double(&state), theta = 0.5 * PI * (i % 2 ? part : pow(10.0, -4.0 * part));
        float u1 = test_uniform(&state), u2 = test_uniform(&state), s = (float)sin(theta), c = (float)cos(theta);
        vndf_ggx_incidence w = vndf_ggx_incidence_from(1.0f, 1.0f, s, 0.0f, c);
        lanes_m trusted;
        vndf_drawn n = vndf_ggx_draw(&w, u1, u2, &trusted);
        if (!trusted)
            continue;
        double square = (double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z;
        double twice = 2.0 * ((double)s * n.x + (double)c * n.z) / square;
        double x = twice * n.x - s, y = twice * n.y, z = twice * n.z - c;
        worst2 = fmax(worst2, fabs(1.0 - z - u2 * (1.0 + c)));
        worst1 = fmax(worst1, fabs(remainder(0.5 + atan2(y, x) / (2.0 * PI) - u1, 1.0)) * hypot(x, y));
    }
    fprintf(stderr, "ggx: mirrored direction off by %.2g in azimuth, %.2g in height\n", 2.0 * PI * worst1, worst2);
    TEST(2.0 * PI * worst1 < 2e-6);
    TEST(worst2 < 2e-6);
}

/* ---- both ---- */

/* Directions even over the hemisphere, roughness from 0.05 to 1: below these shares a batch would be slow. */
static void nearly_all_is_trusted(void)
{
    enum { SAMPLES = 200000 };
    unsigned long long state = 29;
    int ggx = 0, beckmann = 0;
    for (int i = 0; i < SAMPLES; i++) {
        float z = test_uniform(&state), s = sqrtf(1.0f - z * z), alpha = 0.05f + 0.95f * test_uniform(&state);
        float u1 = test_uniform(&state), u2 = test_uniform(&state);
        vndf_ggx_incidence g = vndf_ggx_incidence_from(alpha, alpha, s, 0.0f, z);
        vndf_beckmann_incidence b = vndf_beckmann_incidence_from(alpha, alpha, s, 0.0f, z);
        vndf_beckmann_place at = vndf_beckmann_step(&b, vndf_beckmann_first(&b, u1), u1);
        lanes_m trusted;
        vndf_ggx_draw(&g, u1, u2, &trusted);
        ggx += trusted;
        vndf_beckmann_normal(&b, &at, vndf_beckmann_second(u2), vndf_beckmann_middle(u1, u2), &trusted);
        beckmann += trusted;
    }
    fprintf(stderr, "left to double: %.2g of ggx, %.2g of beckmann\n", 1.0 - (double)ggx / SAMPLES,
            1.0 - (double)beckmann / SAMPLES);
    TEST(ggx > SAMPLES * 0.998 && beckmann > SAMPLES * 0.996);
}

int main(void)
{
    elementary_functions_are_accurate();
    log_is_accurate();
    beckmann_meets_its_first_number();
    beckmann_meets_its_second_number();
    half_azimuth_is_accurate();
    ggx_meets_its_numbers();
    nearly_all_is_trusted();
    return test_done();
}
