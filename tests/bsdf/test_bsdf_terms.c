/* The Fresnel functions have a relative error below 1e-6: against complex arithmetic for random indices, absorptions
 * and cosines, right angles, grazing and Brewster's angle, total reflection and equal indices among them, where the
 * results that are 0 or 1 are exact. All are in [0, 1], take |cos|, and make no NaN. */
#include "harness/test.h"
#include "oracle/oracle_bsdf.h"

static const float COSINES[] = {0, 1e-30f, 1e-6f, 1e-3f, 0.01f, 0.1f, 0.7071068f, 0.999f, 0.99999994f, 1};
static const float INDICES[] = {0.01f, 0.2f, 1 / 1.5f, 0.999f, 1, 1.001f, 1.0000001f, 1.5f, 10, 100};
static const float OTHERS[] = {0,     1e-6f, 0.01f, 0.04f, 0.5f,
                               0.99f, 1,     3.9f,  100,   1000}; /* absorptions; 0 to 1: f0 */

static void check(float got, float other_side, double want, const char *name, float cosine, float eta, float k)
{
    const int is_exact = want == 0 || want == 1 ? (double)got == want : 1;
    if (!(TEST_RELATIVE((double)got, want, 1e-6) & TEST(is_exact && got >= 0 && got <= 1 && got == other_side)))
        fprintf(stderr, "  %s, cos %.9g, eta %.9g, k or f0 %.9g\n", name, (double)cosine, (double)eta, (double)k);
}

int main(void)
{
    unsigned long long state = 8;
    for (int i = 0; i < (test_quick() ? 10000 : 100000); i++) {
        const int which = (int)(test_random_bits(&state) >> 40) % 1000;
        const float eta = i % 2 ? INDICES[which / 10 % 10] : (float)exp(9.2 * test_uniform_double(&state) - 4.6);
        const float k = OTHERS[which / 100], u = test_uniform(&state), brewster = 1 / sqrtf(1 + eta * eta);
        const float c = i % 3 == 0 ? COSINES[which % 10] : i % 5 == 0 ? brewster : i % 3 == 1 ? u : powf(u, 8);
        const double of_metal = (double)oracle_fresnel((long double)c, (long double)eta, (long double)k),
                     of_glass = (double)oracle_fresnel((long double)c, (long double)eta, 0), f0 = (double)k;
        check(vndf_fresnel_conductor(c, eta, k), vndf_fresnel_conductor(-c, eta, k), of_metal, "conductor", c, eta,
              k);
        check(vndf_fresnel_dielectric(c, eta), vndf_fresnel_dielectric(-c, eta), of_glass, "dielectric", c, eta,
              0);
        if (k <= 1)
            check(vndf_fresnel_schlick(c, k), vndf_fresnel_schlick(-c, k), f0 + (1 - f0) * pow(1 - (double)c, 5),
                  "schlick", c, 0, k);
    }
    return test_done();
}
