/* The Fresnel functions have a relative error below 1e-6: against complex arithmetic over a grid of indices and over
 * cosines down to 0, right angles, Brewster's angle, total reflection and equal indices among them, where the results
 * that are 0 or 1 are exact. All are in [0, 1], take |cos|, and make no NaN. */
#include "harness/test.h"
#include "oracle/oracle_bsdf.h"

static const float COSINES[] = {0,    1e-30f,     1e-6f, 1e-3f,  0.01f,       0.1f, 0.3f,
                                0.5f, 0.7071068f, 0.9f,  0.999f, 0.99999994f, 1};
static const float INDICES[] = {0.01f,  0.2f,       1 / 2.4f, 1 / 1.5f, 1 / 1.33f, 0.999f, 1,
                                1.001f, 1.0000001f, 1.33f,    1.5f,     2.4f,      10,     100};
static const float ABSORPTIONS[] = {0, 1e-6f, 0.01f, 0.5f, 1, 3.9f, 100, 1000};
enum { COSINE_COUNT = 13, INDEX_COUNT = 14, ABSORPTION_COUNT = 8 };

static void check(float got, float other_side, double want, float cosine, float eta, float k)
{
    int is_exact = want == 0 || want == 1 ? (double)got == want : 1;
    if (!(TEST_RELATIVE((double)got, want, 1e-6) & TEST(is_exact && got >= 0 && got <= 1 && got == other_side)))
        fprintf(stderr, "  cos %.9g, eta or f0 %.9g, k %.9g\n", (double)cosine, (double)eta, (double)k);
}

/* Without absorption by both functions. */
static void check_all(float cosine, float eta)
{
    for (int i = 0; i < ABSORPTION_COUNT; i++) {
        const float k = ABSORPTIONS[i];
        double want = (double)oracle_fresnel((long double)cosine, (long double)eta, (long double)k);
        check(vndf_fresnel_conductor(cosine, eta, k), vndf_fresnel_conductor(-cosine, eta, k), want, cosine, eta,
              k);
        if (k <= 0)
            check(vndf_fresnel_dielectric(cosine, eta), vndf_fresnel_dielectric(-cosine, eta), want, cosine, eta,
                  0);
    }
}

int main(void)
{
    static const float f0[] = {0, 1e-6f, 0.04f, 0.5f, 0.99f, 1};
    unsigned long long state = 8;
    for (int i = 0; i < COSINE_COUNT; i++) {
        for (int j = 0; j < INDEX_COUNT; j++)
            check_all(COSINES[i], INDICES[j]);
        for (int j = 0; j < 6; j++) {
            double f = (double)f0[j], want = f + (1 - f) * pow(1 - (double)COSINES[i], 5);
            check(vndf_fresnel_schlick(COSINES[i], f0[j]), vndf_fresnel_schlick(-COSINES[i], f0[j]), want,
                  COSINES[i], f0[j], 0);
        }
    }
    for (int j = 0; j < INDEX_COUNT; j++) /* Brewster's angle, where r_p is 0 */
        check_all((float)(1 / sqrt(1 + (double)INDICES[j] * INDICES[j])), INDICES[j]);
    for (int i = 0; i < (test_quick() ? 2000 : 20000); i++) {
        float cosine = test_uniform(&state);
        check_all(cosine, (float)exp(4 * test_uniform_double(&state) - 2));
        check_all((float)pow((double)cosine, 8), (float)exp(9.2 * test_uniform_double(&state) - 4.6));
    }
    return test_done();
}
