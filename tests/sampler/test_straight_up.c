/* From straight above all normals are drawn, as vndf.h says: the visible density is D cos, whatever wi's length,
 * that of sampling is the same for closed forms and near it for tables, x takes the place of wi's azimuth, and the
 * numbers are parts of the law of all slopes, in polar (GGX) or Cartesian coordinates (Beckmann). Normals below the
 * surface have the density 0 from everywhere, though wi faces them, by the calls of one and by batches. */
#include "harness/constants.h"
#include "sampler/batch_case.h"
#include "oracle/oracle.h"

enum { COUNT = 1000 };

static const float ALPHAS[][2] = {{1, 1}, {0.3f, 0.05f}, {0.01f, 4}};

static vndf_vec3 any_normal(unsigned long long *state)
{
    double z = test_uniform_double(state), s = sqrt(1 - z * z);
    double phi = 6.283185307179586 * test_uniform_double(state);
    vndf_vec3 w = {(float)(s * cos(phi)), (float)(s * sin(phi)), (float)z};
    return w;
}

/* Of a table the density drawn with is near: three times the certificate's largest weight is far. That is of all but
 * 1e-6 of the mass. */
static void test_density(const vndf_surface *surface, const vndf_view *view, vndf_vec3 wm)
{
    double all = (double)vndf_ndf(surface, wm) * (double)wm.z, visible = (double)vndf_visible(view, wm);
    vndf_info info = vndf_distribution_info(surface->distribution);
    double ratio = visible / (double)vndf_pdf(view, wm);
    double most = info.bytes > 0 ? 3 * (double)info.certificate.max_weight : 1 + 1e-5;
    if (all < 1e-20 || all > 1e20) /* tails: FLT_MIN, floors */
        return;
    TEST_RELATIVE(visible, all, 1e-5);
    float u1, u2;
    vndf_invert(view, wm, &u1, &u2);
    TEST((ratio < most && ratio > 1 / most) || (info.bytes > 0 && u2 > 1 - 1e-6f && ratio > 0));
}

/* Whether numbers and normal agree. */
static void test_place(const vndf_surface *surface, const vndf_view *view, float u1, float u2)
{
    vndf_vec3 wm = vndf_sample(view, u1, u2, NULL);
    vndf_info info = vndf_distribution_info(surface->distribution);
    double scale = info.bytes > 0 ? info.scale : 1;
    double x = (double)wm.x / ((double)surface->alpha_x * scale);
    double y = (double)wm.y / ((double)surface->alpha_y * scale);
    double r2 = (x * x + y * y) / ((double)wm.z * (double)wm.z);
    if (surface->distribution == vndf_beckmann()) {
        TEST_NEAR(0.5 * erfc(x / (double)wm.z), (double)u1, 1e-6);
        TEST_NEAR(0.5 * erfc(y / (double)wm.z), (double)u2, 1e-6);
        return;
    }
    TEST_NEAR(atan2(y, x) / PI, 2 * (double)u1 - 1, 2e-3); /* tables: TV of a uniform azimuth */
    if (surface->distribution == vndf_ggx())
        TEST_NEAR(r2 / (1 + r2), (double)u2, 1e-6);
}

static void test_above(const vndf_distribution *d, unsigned long long *state)
{
    const float lengths[] = {1, 1e-20f, 3e30f};
    for (int i = 0; i < COUNT; i++) {
        vndf_surface surface = {d, ALPHAS[i % 3][0], ALPHAS[i % 3][1]};
        vndf_vec3 up = {0, i % 2 ? -0.0f : 0, lengths[i / 3 % 3]};
        vndf_view view = vndf_view_from(&surface, up);
        float u1 = 0.01f + 0.98f * test_uniform(state), u2 = 0.01f + 0.98f * test_uniform(state);
        test_density(&surface, &view, any_normal(state));
        test_density(&surface, &view, vndf_sample(&view, u1, u2, NULL));
        test_place(&surface, &view, u1, u2);
    }
}

/* Seen by wi. */
static void test_below(const vndf_distribution *d, vndf_instructions limit, unsigned long long *state)
{
    static float wi[3][COUNT], wm[3][COUNT], pdf[COUNT], visible[COUNT], ndf[COUNT];
    float alpha_x = 0.5f, alpha_y = 0.2f;
    vndf_batch b = {d, COUNT, VNDF_SHARED_ALPHA, limit, &alpha_x, &alpha_y, wi[0], wi[1], wi[2]};
    vndf_normals normals = {wm[0], wm[1], wm[2]};
    vndf_surface surface = {d, alpha_x, alpha_y};
    for (int i = 0; i < COUNT; i++) {
        vndf_vec3 n = any_normal(state), w = {0.6f * n.x, 0.6f * n.y, i % 2 ? -n.z : 0.1f * n.z};
        wi[0][i] = w.x, wi[1][i] = w.y, wi[2][i] = w.z;
        wm[0][i] = n.x, wm[1][i] = n.y, wm[2][i] = n.z > 0 ? -0.3f * n.z : -1;
        vndf_vec3 below = {wm[0][i], wm[1][i], wm[2][i]};
        vndf_view view = vndf_view_from(&surface, w);
        TEST(vndf_pdf(&view, below) == 0 && vndf_visible(&view, below) == 0 && vndf_ndf(&surface, below) == 0);
        pdf[i] = visible[i] = ndf[i] = -1;
    }
    vndf_pdf_n(&b, normals, pdf);
    vndf_visible_n(&b, normals, visible);
    vndf_ndf_n(&b, normals, ndf);
    for (int i = 0; i < COUNT; i++)
        TEST(pdf[i] == 0 && visible[i] == 0 && ndf[i] == 0);
}

static void test_distribution(const vndf_distribution *d, const char *name, vndf_instructions only)
{
    unsigned long long state = 3;
    int failures = test_failures;
    if (d && only == VNDF_INSTRUCTIONS_BEST)
        test_above(d, &state);
    for (int limit = VNDF_INSTRUCTIONS_PORTABLE; limit <= VNDF_INSTRUCTIONS_AVX512; limit++)
        test_below(d, (vndf_instructions)limit, &state);
    if (test_failures > failures)
        fprintf(stderr, "  %s\n", name);
}

int main(int arguments, char **argument)
{
    return batch_main(arguments, argument, test_distribution);
}
