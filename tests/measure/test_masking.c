/* `vndf masking` measures what it says: its integrals are within 5e-6 of closed forms and 2e-5 of quadrature over
 * the sphere that shares no code with it; Smith and V-cavities are 1 within 1e-5 for every shipped kind of D,
 * implicit, Kelemen and Schlick-Smith are not. */
#include "measure/masking.h"
#include "oracle/oracle.h"
#include "harness/constants.h"
#include "harness/test.h"

/* ---- GGX over the sphere ---- */

typedef struct sphere {
    double ax, ay, x, y, z; /* roughness, wi */
    masking_function function;
    double cosine; /* of theta_m, for the inner integral */
} sphere;

static double ggx_d(const sphere *s, double x, double y, double z)
{
    double q = x * x / (s->ax * s->ax) + y * y / (s->ay * s->ay) + z * z;
    return 1 / (PI * s->ax * s->ay * q * q);
}

/* G1 max(0, wi.wm) D/cos_i at an azimuth from the first angle to the last, in turns. */
static double at_azimuth(const sphere *s, double phi)
{
    double sine = sqrt(1 - s->cosine * s->cosine), x = sine * cos(phi), y = sine * sin(phi), z = s->cosine;
    double f = s->x * x + s->y * y + s->z * z, g1 = s->z / f;
    if (!(f > 0))
        return 0;
    if (s->function == MASKING_V_CAVITIES)
        g1 = fmin(1, 2 * z * s->z / f);
    else if (s->function == MASKING_IMPLICIT)
        g1 = s->z;
    return g1 * f * ggx_d(s, x, y, z) / s->z;
}

/* By the midpoint rule; the jump of Kelemen where normals turn away leaves it an error of 8e-6. */
static double over_sphere(sphere *s)
{
    enum { RINGS = 1500, TURNS = 1500 };
    double sum = 0;
    for (int i = 0; i < RINGS; i++) {
        double v = (i + 0.5) / RINGS; /* 1 - cos = v^3: normals are close to the pole */
        s->cosine = 1 - v * v * v;
        double ring = 0;
        for (int j = 0; j < TURNS; j++)
            ring += at_azimuth(s, 2 * PI * (j + 0.5) / TURNS);
        sum += ring * 3 * v * v / RINGS * (2 * PI / TURNS);
    }
    return sum;
}

static void test_sphere(void)
{
    const masking_function functions[] = {MASKING_V_CAVITIES, MASKING_IMPLICIT, MASKING_KELEMEN};
    const double settings[][4] = {{0.5, 0.5, 40, 0}, {0.3, 0.8, 70, 35}, {1, 1, 85, 120}};
    double worst = 0;
    for (size_t i = 0; i < 3; i++) {
        vndf_surface surface = {vndf_ggx(), (float)settings[i][0], (float)settings[i][1]};
        vndf_vec3 wi = oracle_direction(settings[i][2], settings[i][3]);
        masking_integrals got = masking_integrate(&surface, wi);
        for (size_t j = 0; j < 3; j++) {
            sphere s = {settings[i][0], settings[i][1], (double)wi.x, (double)wi.y, (double)wi.z, functions[j], 0};
            double want = over_sphere(&s);
            TEST_NEAR(got.of[functions[j]], want, 2e-5);
            worst = fmax(worst, fabs(got.of[functions[j]] - want));
        }
    }
    fprintf(stderr, "against quadrature over the sphere: within %.2g\n", worst);
}

/* ---- closed forms ---- */

/* Straight down Kelemen's is the area of the microsurface over that of the surface: 2 for GGX at alpha 1, and e
 * Gamma(3/2, 1) = 1 + e sqrt(pi) erfc(1)/2 for Beckmann. */
static void test_closed_forms(void)
{
    const vndf_vec3 up = {0, 0, 1};
    vndf_surface ggx = {vndf_ggx(), 1, 1}, beckmann = {vndf_beckmann(), 1, 1};
    TEST_NEAR(masking_integrate(&ggx, up).of[MASKING_KELEMEN], 2, 5e-6);
    TEST_NEAR(masking_integrate(&beckmann, up).of[MASKING_KELEMEN], 1 + exp(1) * sqrt(PI) * erfc(1) / 2, 5e-6);
    for (int theta = 0; theta < 90; theta += 10) {
        vndf_vec3 wi = oracle_direction(theta, 0);
        double c = (double)wi.z, t = sqrt(1 - c * c) / c, a = t > 0 ? 1 / t : HUGE_VAL;
        /* implicit: the projected area, (1 + c)/2 for GGX at alpha 1; Schlick-Smith is Smith there */
        masking_integrals of_ggx = masking_integrate(&ggx, wi), of_beckmann = masking_integrate(&beckmann, wi);
        TEST_NEAR(of_ggx.of[MASKING_IMPLICIT], (1 + c) / 2, 5e-6);
        TEST_NEAR(of_ggx.of[MASKING_SCHLICK_SMITH], 1, 5e-6);
        double area = t > 0 ? c * (1 + erf(a) + exp(-a * a) / (a * sqrt(PI))) / 2 : 1, k = sqrt(2 / PI);
        TEST_NEAR(of_beckmann.of[MASKING_IMPLICIT], area, 5e-6);
        TEST_NEAR(of_beckmann.of[MASKING_SCHLICK_SMITH], area / (c * (1 - k) + k), 5e-6);
    }
}

/* Roughness along wi, bounded. */
static void test_schlick_k(void)
{
    vndf_surface ggx = {vndf_ggx(), 0.2f, 0.6f}, rough = {vndf_ggx(), 5, 5},
                 beckmann = {vndf_beckmann(), 0.2f, 0.6f};
    TEST_NEAR(masking_schlick_k(&ggx, oracle_direction(30, 0)), 0.1, 1e-7);
    TEST_NEAR(masking_schlick_k(&ggx, oracle_direction(30, 90)), 0.3, 1e-7);
    TEST_NEAR(masking_schlick_k(&beckmann, oracle_direction(70, 90)), 0.6 * sqrt(2 / PI), 1e-7);
    TEST(masking_schlick_k(&rough, oracle_direction(30, 90)) == 1);
}

/* ---- verdicts ---- */

/* Where D jumps the quadrature, which does not know its knots, is off by `least`. */
static void test_verdicts(const vndf_distribution *d, const char *name, double least)
{
    const float alphas[][2] = {{0.5f, 0.5f}, {0.05f, 0.05f}, {0.1f, 0.9f}, {3, 3}};
    double worst = 0, far[MASKING_COUNT] = {0};
    for (size_t i = 0; TEST(d != NULL) && i < 4; i++)
        for (int theta = 0; theta <= 89; theta += theta < 80 ? 20 : 9) {
            vndf_surface surface = {d, alphas[i][0], alphas[i][1]};
            masking_integrals got = masking_integrate(&surface, oracle_direction(theta, 50));
            TEST_NEAR(got.normals, 1, least);
            for (int j = 0; j < MASKING_COUNT; j++)
                far[j] = fmax(far[j], fabs(got.of[j] - 1));
            worst = fmax(worst, fabs(got.normals - 1));
        }
    fprintf(stderr, "%s: D cos within %.2g, smith %.2g, v-cavities %.2g; others off by %.2g %.2g %.2g\n", name,
            worst, far[MASKING_SMITH], far[MASKING_V_CAVITIES], far[MASKING_IMPLICIT], far[MASKING_KELEMEN],
            far[MASKING_SCHLICK_SMITH]);
    TEST(far[MASKING_SMITH] < 2 * least && far[MASKING_V_CAVITIES] < 2 * least);
    TEST(far[MASKING_IMPLICIT] > 0.01 && far[MASKING_KELEMEN] > 0.01 && far[MASKING_SCHLICK_SMITH] > 0.01);
}

static void test_table(const char *name)
{
    vndf_distribution *d = oracle_shipped(name);
    test_verdicts(d, name, 1e-5);
    vndf_free(d);
}

static void test_disc(void)
{
    oracle o = oracle_get(ORACLE_DISC);
    vndf_distribution *d = oracle_build(&o, 0, NULL);
    test_verdicts(d, "disc", 2e-3);
    vndf_free(d);
}

int main(void)
{
    test_sphere();
    test_closed_forms();
    test_schlick_k();
    test_verdicts(vndf_ggx(), "ggx", 1e-5);
    test_verdicts(vndf_beckmann(), "beckmann", 1e-5);
    test_table("student-t-1.8");
    test_table("hazy");
    test_table("sgd-nickel-g");
    test_disc();
    return test_done();
}
