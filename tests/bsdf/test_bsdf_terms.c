/* The Fresnel functions have a relative error below 1e-6: against complex arithmetic over a grid of indices and
 * over cosines down to 0, with what is known in closed form - right angles, Brewster's angle, total reflection,
 * equal indices, Schlick's ends. All are in [0, 1], take |cos|, and make no NaN. */
#include "harness/test.h"
#include "oracle/oracle_bsdf.h"

static const float COSINES[] = {0,    1e-30f,     1e-6f, 1e-3f,  0.01f,       0.1f, 0.3f,
                                0.5f, 0.7071068f, 0.9f,  0.999f, 0.99999994f, 1};
static const float INDICES[] = {0.01f,  0.2f,       1 / 2.4f, 1 / 1.5f, 1 / 1.33f, 0.999f, 1,
                                1.001f, 1.0000001f, 1.33f,    1.5f,     2.4f,      10,     100};
static const float ABSORPTIONS[] = {0, 1e-6f, 0.01f, 0.5f, 1, 3.9f, 100, 1000};
enum { COSINE_COUNT = 13, INDEX_COUNT = 14, ABSORPTION_COUNT = 8 };

static void check_one(float cosine, float eta)
{
    double want = (double)oracle_fresnel((long double)cosine, (long double)eta, 0);
    float got = vndf_fresnel_dielectric(cosine, eta);
    if (!(TEST_RELATIVE((double)got, want, 1e-6) & TEST(got >= 0 && got <= 1)))
        fprintf(stderr, "  dielectric, cos %.9g, eta %.9g\n", (double)cosine, (double)eta);
    TEST(vndf_fresnel_dielectric(-cosine, eta) == got);
    for (int i = 0; i < ABSORPTION_COUNT; i++) {
        float k = ABSORPTIONS[i], metal = vndf_fresnel_conductor(cosine, eta, k);
        want = (double)oracle_fresnel((long double)cosine, (long double)eta, (long double)k);
        if (!(TEST_RELATIVE((double)metal, want, 1e-6) & TEST(metal >= 0 && metal <= 1)))
            fprintf(stderr, "  conductor, cos %.9g, eta %.9g, k %.9g\n", (double)cosine, (double)eta, (double)k);
        TEST(vndf_fresnel_conductor(-cosine, eta, k) == metal);
    }
}

static void test_fresnel(void)
{
    unsigned long long state = 8;
    for (int i = 0; i < COSINE_COUNT; i++)
        for (int j = 0; j < INDEX_COUNT; j++)
            check_one(COSINES[i], INDICES[j]);
    for (int i = 0; i < (test_quick() ? 2000 : 20000); i++) {
        float cosine = test_uniform(&state);
        check_one(cosine, (float)exp(4 * test_uniform_double(&state) - 2));
        check_one((float)pow((double)cosine, 8), (float)exp(9.2 * test_uniform_double(&state) - 4.6));
    }
}

static void test_known(void)
{
    for (int j = 0; j < INDEX_COUNT; j++) {
        double eta = (double)INDICES[j], straight = (eta - 1) / (eta + 1), s = (1 - eta * eta) / (1 + eta * eta);
        double brewster = 1 / sqrt(1 + eta * eta); /* r_p = 0, r_s = (1 - eta^2)/(1 + eta^2) */
        TEST_RELATIVE((double)vndf_fresnel_dielectric(1, INDICES[j]), straight * straight, 1e-6);
        TEST_RELATIVE((double)vndf_fresnel_conductor(1, INDICES[j], 0), straight * straight, 1e-6);
        if (fabs(s) > 0.2 && eta > 0.1) /* else the rounding of its cosine shows */
            TEST_RELATIVE((double)vndf_fresnel_dielectric((float)brewster, INDICES[j]), s * s / 2, 2e-6);
        if (eta < 1) {
            double critical = sqrt(1 - eta * eta);
            TEST(vndf_fresnel_dielectric((float)(critical * (1 - 1e-6)), INDICES[j]) == 1);
            TEST(vndf_fresnel_conductor((float)(critical * (1 - 1e-6)), INDICES[j], 0) == 1);
            TEST(vndf_fresnel_dielectric((float)fmin(critical * (1 + 1e-5), 1), INDICES[j]) < 1);
        }
        if (eta != 1)
            TEST(vndf_fresnel_dielectric(0, INDICES[j]) == 1);
    }
    for (int i = 1; i < COSINE_COUNT; i++)
        TEST(vndf_fresnel_dielectric(COSINES[i], 1) == 0);
}

static void test_schlick(void)
{
    static const float f0[] = {0, 1e-6f, 0.04f, 0.5f, 0.99f, 1};
    for (int i = 0; i < 6; i++) {
        TEST(vndf_fresnel_schlick(1, f0[i]) == f0[i]);
        TEST(vndf_fresnel_schlick(0, f0[i]) == 1);
        for (int j = 0; j < COSINE_COUNT; j++) {
            double rest = 1 - (double)COSINES[j], f = (double)f0[i], want = f + (1 - f) * pow(rest, 5);
            TEST_RELATIVE((double)vndf_fresnel_schlick(COSINES[j], f0[i]), want, 1e-6);
            TEST(vndf_fresnel_schlick(-COSINES[j], f0[i]) == vndf_fresnel_schlick(COSINES[j], f0[i]));
        }
    }
}

int main(void)
{
    test_fresnel();
    test_known();
    test_schlick();
    return test_done();
}
