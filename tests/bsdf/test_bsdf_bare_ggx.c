/* Bare reflection of GGX is drawn by a routine of its own, which gives the bits of the one for any distribution
 * (that batches use) for roughness from 1e-6 to 100, directions up to the horizon and uniform numbers to the
 * border. */
#include "harness/test.h"
#include "vndf_bsdf.h"

enum { COUNT = 4096, ROUNDS = 60 };

typedef struct inputs {
    float wi[3][COUNT], u[3][COUNT], alpha[2][COUNT];
} inputs;

/* Every eighth uniform number is at or beside the border, every eighth direction near the horizon or the axis. */
static float uniform(unsigned long long *state)
{
    static const float hard[] = {0.0f, 1.0f, 0x1p-24f, 1.0f - 0x1p-24f, 1e-30f, 0.5f, -1.0f, 2.0f};
    float u = test_uniform(state);
    return test_random_bits(state) >> 61 ? u : hard[test_random_bits(state) >> 61];
}

static void fill(inputs *in, unsigned long long *state)
{
    for (size_t i = 0; i < COUNT; i++) {
        double z = 1.0 - (double)test_uniform(state), phi = 6.2831853 * (double)test_uniform(state);
        if (test_random_bits(state) >> 61 == 0)
            z = test_random_bits(state) >> 63 ? 1e-6 * z : 1.0 - 1e-10 * z;
        double s = sqrt(1.0 - z * z);
        in->wi[0][i] = (float)(s * cos(phi));
        in->wi[1][i] = (float)(s * sin(phi));
        in->wi[2][i] = (float)z;
        for (int k = 0; k < 3; k++)
            in->u[k][i] = uniform(state);
        for (int k = 0; k < 2; k++)
            in->alpha[k][i] = (float)pow(10, -6 + 8 * (double)test_uniform(state));
    }
}

/* How many of a round's samples were not lost; *differing counts those with other bits. */
static size_t compare(const vndf_material *m, const inputs *in, size_t *differing)
{
    static float x[COUNT], y[COUNT], z[COUNT], weight[3][COUNT], density[COUNT];
    static uint8_t lobe[COUNT];
    const vndf_bsdf_batch batch = {.material = m,
                                   .count = COUNT,
                                   .alpha_x = in->alpha[0],
                                   .alpha_y = in->alpha[1],
                                   .wi_x = in->wi[0],
                                   .wi_y = in->wi[1],
                                   .wi_z = in->wi[2]};
    const float *const u[3] = {in->u[0], in->u[1], in->u[2]};
    vndf_scattered_n out = {{x, y, z}, {weight[0], weight[1], weight[2]}, density, lobe, {0}};
    size_t kept = 0;
    vndf_bsdf_sample_n(&batch, u, out);
    for (size_t i = 0; i < COUNT; i++) {
        vndf_bsdf hit;
        vndf_scattered s;
        vndf_roughness r = {in->alpha[0][i], in->alpha[1][i], 1.0f, 0.0f};
        const float one[3] = {in->u[0][i], in->u[1][i], in->u[2][i]};
        vndf_bsdf_rough(&hit, m, &r, (vndf_vec3){in->wi[0][i], in->wi[1][i], in->wi[2][i]});
        vndf_bsdf_sample(&hit, one, &s);
        *differing += s.wo.x != x[i] || s.wo.y != y[i] || s.wo.z != z[i] || s.density != density[i] ||
                      s.weight[0] != weight[0][i] || s.weight[2] != weight[2][i] || s.lobe != (vndf_lobe)lobe[i];
        kept += s.lobe == VNDF_LOBE_REFLECTION;
    }
    return kept;
}

int main(void)
{
    static inputs in;
    unsigned long long state = 17;
    vndf_description is = {.distribution = vndf_ggx(), .alpha_x = 0.5f, .alpha_y = 0.5f};
    vndf_material m;
    size_t kept = 0, differing = 0;
    TEST(vndf_material_resolve(&is, &m, NULL) == VNDF_OK);
    for (int round = 0; round < ROUNDS; round++) {
        fill(&in, &state);
        kept += compare(&m, &in, &differing);
    }
    TEST(differing == 0);
    TEST(kept > ROUNDS * COUNT / 3);
    return test_done();
}
