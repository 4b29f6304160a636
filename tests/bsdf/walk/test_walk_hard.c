/* Whatever comes in, finite numbers come out: directions at the horizon and at z, roughness from 1e-9 to 1e9,
 * uniform numbers at the corners and beyond, index ratios near 1 and far from it. Weights, values and densities
 * are >= 0 and finite, directions unit; the same input gives the same bits; an eval below a mirror is 0. */
#include "bsdf/walk/walk_case.h"

static const double COSINES[] = {1, 0.5, 1e-3, 1e-6, 1e-20, 1e-38};
static const float ALPHAS[] = {1e-9f, 1e-3f, 0.3f, 10, 1e9f};
static const float ETAS[] = {0, 1.5f, 1 / 1.5f, 1.001f, 0.01f, 100};
enum { COSINE_COUNT = 6, ALPHA_COUNT = 5, ETA_COUNT = 6 };

static int is_sane(float value)
{
    return value >= 0.0f && value < HUGE_VALF;
}

static float corner(unsigned long long *state)
{
    static const float corners[] = {0, 1, 0x1p-24f, 1 - 0x1p-24f, 0.5f, -1, 2, NAN};
    unsigned long long bits = test_random_bits(state);
    return bits & 1024 ? test_uniform(state) : corners[bits % 8];
}

static vndf_vec3 target(unsigned long long *state)
{
    double z = COSINES[test_random_bits(state) % COSINE_COUNT] * (test_random_bits(state) & 64 ? 1 : -1);
    z = test_random_bits(state) & 32 ? 2 * test_uniform_double(state) - 1 : z;
    return walk_direction(z, 6 * test_uniform_double(state));
}

static void test_call(const walk_hit *h, unsigned long long *state)
{
    float u[3] = {corner(state), corner(state), corner(state)}, value, density;
    vndf_scattered w, again;
    vndf_bsdf_sample(&h->bsdf, u, &w);
    vndf_bsdf_sample(&h->bsdf, u, &again);
    TEST(memcmp(&w.wo, &again.wo, sizeof w.wo) == 0 && w.weight[0] == again.weight[0] && w.lobe == again.lobe);
    TEST(is_sane(w.weight[0]));
    TEST_NEAR((double)w.wo.x * w.wo.x + (double)w.wo.y * w.wo.y + (double)w.wo.z * w.wo.z, 1.0, 1e-6);
    for (int i = 0; i < 2; i++) {
        vndf_vec3 wo = i ? w.wo : target(state);
        vndf_bsdf_eval_pdf(&h->bsdf, wo, test_random_bits(state), &value, &density);
        int good = TEST(is_sane(value) && is_sane(density));
        good &= TEST(walk_transmits(&h->is) || wo.z > 0.0f || (value == 0.0f && density == 0.0f));
        if (!good) {
            walk_describe(h, "walk");
            fprintf(stderr, "    wo %g %g %g: %g, %g\n", (double)wo.x, (double)wo.y, (double)wo.z, (double)value,
                    (double)density);
        }
    }
}

static void test_subject(int subject)
{
    const vndf_distribution *d = walk_subject(subject);
    unsigned long long state = 17 + (unsigned)subject;
    for (int i = 0; d && i < ALPHA_COUNT * ALPHA_COUNT * COSINE_COUNT * ETA_COUNT; i++) {
        vndf_description is = i % ETA_COUNT ? walk_of_glass(ETAS[i % ETA_COUNT]) : walk_of_mirror();
        walk_hit h;
        walk_hit_at(&h, &is, d, ALPHAS[i / 36 % ALPHA_COUNT], ALPHAS[i / 180],
                    walk_direction(COSINES[i / 6 % 6], 0.7));
        for (size_t j = 0; j < walk_count(40); j++)
            test_call(&h, &state);
    }
    walk_subject_free(d);
}

int main(int arguments, char **argument)
{
    for (int i = 0; i < WALK_FEW; i++)
        if (arguments < 2 || atoi(argument[1]) == i)
            test_subject(i);
    return test_done();
}
