/* A mixture is what its sum says: D, P22, area, Lambda, G1 and the visible density equal closed forms of lobes of GGX
 * with random weights, matrices and mean slopes; a sample comes with the density of the whole, lobes are drawn as
 * often as they are seen (a chi-square), and the inverse of the lobe that was drawn leads back; one lobe of any
 * weight gives the bits of the lobe; lobes of weight 0 count for nothing, and one that is hardly seen costs no
 * density; what is invalid has one result. */
#include <float.h>

#include "harness/constants.h"
#include "harness/test.h"
#include "measure/pearson.h"
#include "vndf.h"

static double uniform(unsigned long long *state, double from, double to)
{
    return from + (to - from) * test_uniform_double(state);
}

static vndf_affine random_affine(const vndf_distribution *d, double alpha, double mean, unsigned long long *state)
{
    vndf_affine m = {d,
                     (float)uniform(state, -alpha, alpha),
                     (float)uniform(state, -alpha, alpha),
                     (float)uniform(state, -alpha, alpha),
                     (float)uniform(state, -alpha, alpha),
                     (float)uniform(state, -mean, mean),
                     (float)uniform(state, -mean, mean)};
    return m;
}

static vndf_mixture random_mixture(const vndf_distribution *const *all, size_t kinds, unsigned long long *state)
{
    vndf_mixture m = {.count = 1 + (int)(test_random_bits(state) % VNDF_MIXTURE_LOBES)};
    for (int i = 0; i < m.count; i++) {
        m.lobe[i].surface = random_affine(all[test_random_bits(state) % kinds], i % 2 ? 1 : 0.05, 0.5, state);
        m.lobe[i].weight = (float)exp(uniform(state, -7, 3));
    }
    return m;
}

static vndf_vec3 random_direction(unsigned long long *state)
{
    double z = uniform(state, -1, 1), phi = uniform(state, 0, 2 * PI), s = sqrt(1 - z * z);
    vndf_vec3 w = {(float)(s * cos(phi)), (float)(s * sin(phi)), (float)z};
    return w;
}

/* ---- the truth of lobes of GGX ---- */

typedef struct truth {
    double area, away, up, ndf, p22; /* areas times the length of w */
} truth;

static double area_ggx(double up, double across)
{
    double length = sqrt(up * up + across * across);
    return up >= 0 ? 0.5 * (up + length) : 0.5 * across * across / (length - up);
}

static double p22_ggx(const vndf_affine *m, double x, double y)
{
    double det = (double)m->xx * m->yy - (double)m->xy * m->yx, dx = x - m->mean_x, dy = y - m->mean_y;
    double u = (m->yy * dx - m->xy * dy) / det, v = (m->xx * dy - m->yx * dx) / det, q = 1 + u * u + v * v;
    return 1 / (PI * q * q * fabs(det));
}

static truth truth_of(const vndf_mixture *mixture, vndf_vec3 w, vndf_vec3 wm)
{
    truth t = {0, 0, 0, 0, 0};
    double sum = 0, z = wm.z;
    for (int i = 0; i < mixture->count; i++)
        sum += mixture->lobe[i].weight;
    for (int i = 0; i < mixture->count; i++) {
        const vndf_affine *m = &mixture->lobe[i].surface;
        double x = (double)m->xx * w.x + (double)m->yx * w.y, y = (double)m->xy * w.x + (double)m->yy * w.y;
        double weight = mixture->lobe[i].weight / sum, across = sqrt(x * x + y * y);
        double up = w.z - ((double)w.x * m->mean_x + (double)w.y * m->mean_y);
        t.area += weight * area_ggx(up, across);
        t.away += weight * area_ggx(-up, across);
        t.up += weight * up;
        t.p22 += weight * p22_ggx(m, -wm.x / z, -wm.y / z);
    }
    t.ndf = t.p22 / (z * z * z * z);
    return t;
}

static void test_ggx(unsigned long long *state)
{
    const vndf_distribution *ggx[] = {vndf_ggx()};
    vndf_mixture m = random_mixture(ggx, 1, state);
    vndf_vec3 wi = random_direction(state);
    vndf_mixture_view view = vndf_mixture_view_from(&m, wi);
    int lobe;
    float pdf;
    vndf_vec3 wm = vndf_mixture_sample(&view, test_uniform(state), test_uniform(state), &pdf, &lobe);
    truth t = truth_of(&m, wi, wm);
    double length = sqrt((double)wi.x * wi.x + (double)wi.y * wi.y + (double)wi.z * wi.z);
    double facing = (double)wi.x * wm.x + (double)wi.y * wm.y + (double)wi.z * wm.z;
    TEST(lobe >= 0 && lobe < m.count);
    TEST(facing > 0 && wm.z >= 0);
    TEST_RELATIVE((double)vndf_mixture_projected_area(&m, wi), t.area / length, 1e-6);
    TEST_NEAR((double)vndf_mixture_g1(&m, wi), t.up > 0 ? t.up / t.area : 0, 1e-6);
    double lambda = t.up > 0 ? t.away / t.up : -1 - t.area / -t.up;
    TEST_NEAR((double)vndf_mixture_lambda(&m, wi) / (1 + fabs(lambda)), lambda / (1 + fabs(lambda)), 1e-5);
    if (wm.z > 1e-5f) {
        TEST_RELATIVE((double)vndf_mixture_ndf(&m, wm), t.ndf, 1e-5);
        TEST_RELATIVE((double)vndf_mixture_visible(&view, wm), facing * t.ndf / t.area, 1e-5);
        TEST_RELATIVE((double)pdf, facing * t.ndf / t.area, 1e-5);
        float x = -wm.x / wm.z, y = -wm.y / wm.z;
        TEST_RELATIVE((double)vndf_mixture_p22(&m, x, y), truth_of(&m, wi, (vndf_vec3){-x, -y, 1}).p22, 1e-5);
    }
}

/* ---- samples ---- */

/* How many inverses were asked for, and how many led back to u1: beside places where numbers mean little. */
static size_t inverted, led_back;

static void test_sample(const vndf_distribution *const *all, size_t kinds, unsigned long long *state)
{
    vndf_mixture m = random_mixture(all, kinds, state);
    vndf_mixture_view view = vndf_mixture_view_from(&m, random_direction(state));
    const float hard[] = {0, 1, 1 - 0x1p-24f};
    float u1 = test_random_bits(state) % 4 ? test_uniform(state) : hard[test_random_bits(state) % 3], pdf, v1, v2;
    int lobe;
    vndf_vec3 wm = vndf_mixture_sample(&view, u1, test_uniform(state), &pdf, &lobe);
    TEST_NEAR(sqrt((double)wm.x * wm.x + (double)wm.y * wm.y + (double)wm.z * wm.z), 1, 4 * 0x1p-23);
    TEST(pdf >= FLT_MIN && pdf <= FLT_MAX);
    TEST_RELATIVE((double)pdf, (double)vndf_mixture_pdf(&view, wm), 2e-5);
    TEST(vndf_mixture_invert(&view, wm, lobe, &v1, &v2) == lobe);
    TEST(v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1);
    inverted += u1 > 0 && u1 < 1 - 0x1p-20f;
    led_back += u1 > 0 && u1 < 1 - 0x1p-20f && fabsf(v1 - u1) < 1e-3f;
    int likely = vndf_mixture_invert(&view, wm, -1, &v1, &v2);
    TEST(likely >= 0 && likely < m.count);
}

/* Lobes are drawn as often as they are seen: w_i A_i/A. */
static double lobes_p(const vndf_mixture *m, vndf_vec3 wi, unsigned long long *state)
{
    double expected[VNDF_MIXTURE_LOBES], observed[VNDF_MIXTURE_LOBES] = {0}, sum = 0;
    const int samples = 100000;
    for (int i = 0; i < m->count; i++)
        sum += expected[i] =
            (double)m->lobe[i].weight * (double)vndf_affine_projected_area(&m->lobe[i].surface, wi);
    for (int i = 0; i < m->count; i++)
        expected[i] *= samples / sum;
    vndf_mixture_view view = vndf_mixture_view_from(m, wi);
    for (int i = 0; i < samples; i++) {
        int lobe;
        vndf_mixture_sample(&view, test_uniform(state), test_uniform(state), NULL, &lobe);
        if (lobe >= 0)
            observed[lobe]++;
    }
    return pearson_of(expected, observed, NULL, (size_t)m->count, 5).p;
}

static void test_lobes(unsigned long long *state)
{
    const vndf_mixture m = {3,
                            {{{vndf_ggx(), 0.5f, 0.2f, 0, 0.3f, 0, 0}, 1},
                             {{vndf_beckmann(), 0.01f, 0, 0, 0.01f, 0, 0}, 4},
                             {{vndf_ggx(), 1, 0, 0, 0.3f, 0.5f, 0}, 0.2f}}};
    for (int theta = 10; theta < 180; theta += 40) {
        vndf_vec3 wi = {(float)sin(theta * PI / 180), 0, (float)cos(theta * PI / 180)};
        TEST(lobes_p(&m, wi, state) > 1e-4);
    }
}

/* ---- what is the same ---- */

static void test_one(const vndf_distribution *d, unsigned long long *state)
{
    vndf_affine own = random_affine(d, 0.5, 0.5, state);
    vndf_mixture m = {.count = 2, .lobe = {{own, 0}, {own, (float)exp(uniform(state, -5, 5))}}};
    m.lobe[0].surface.distribution = NULL; /* of weight 0: not looked at */
    vndf_vec3 wi = random_direction(state);
    vndf_affine_view view = vndf_affine_view_from(&own, wi);
    vndf_mixture_view same = vndf_mixture_view_from(&m, wi);
    float u1 = test_uniform(state), u2 = test_uniform(state), p, q, v1, v2, w1, w2;
    int lobe;
    vndf_vec3 a = vndf_affine_sample(&view, u1, u2, &p), b = vndf_mixture_sample(&same, u1, u2, &q, &lobe);
    TEST(memcmp(&a, &b, sizeof a) == 0 && p == q && lobe == 1);
    TEST(vndf_affine_pdf(&view, a) == vndf_mixture_pdf(&same, a));
    TEST(vndf_affine_visible(&view, a) == vndf_mixture_visible(&same, a));
    vndf_affine_invert(&view, a, &v1, &v2);
    TEST(vndf_mixture_invert(&same, a, -1, &w1, &w2) == 1 && v1 == w1 && v2 == w2);
    TEST(vndf_mixture_invert(&same, a, 0, &w1, &w2) == -1 && w1 == 0 && w2 == 0);
    TEST_RELATIVE((double)vndf_mixture_projected_area(&m, wi), (double)vndf_affine_projected_area(&own, wi), 2e-7);
    TEST_NEAR((double)vndf_mixture_g1(&m, wi), (double)vndf_affine_g1(&own, wi), 2e-7);
    TEST_RELATIVE((double)vndf_mixture_ndf(&m, a), (double)vndf_affine_ndf(&own, a), 2e-7);
}

/* A lobe of next to no weight, and one that is hardly seen, are still drawn, and lose no density. */
static void test_hardly_seen(void)
{
    const vndf_mixture m = {
        2, {{{vndf_ggx(), 0.3f, 0, 0, 0.3f, 0, 0}, 1}, {{vndf_beckmann(), 0.01f, 0, 0, 0.01f, 0, 0}, 1e-20f}}};
    vndf_vec3 below = {0.8f, 0, -0.6f};
    vndf_mixture_view view = vndf_mixture_view_from(&m, below);
    int lobe;
    float pdf;
    for (int i = 0; i <= 16; i++) {
        vndf_mixture_sample(&view, (float)i / 16, 0.3f, &pdf, &lobe);
        TEST(lobe == 0 && pdf > 0);
    }
}

/* ---- invalid ---- */

static void test_invalid_mixture(const vndf_mixture *m)
{
    const vndf_vec3 wi = {0.6f, 0, 0.8f};
    vndf_mixture_view view = vndf_mixture_view_from(m, wi);
    float pdf = 1, u1 = 1, u2 = 1;
    int lobe = 5;
    vndf_vec3 n = vndf_mixture_sample(&view, 0.5f, 0.5f, &pdf, &lobe);
    TEST(n.x == 0 && n.y == 0 && n.z == 1 && pdf == 0 && lobe == -1);
    TEST(vndf_mixture_pdf(&view, wi) == 0 && vndf_mixture_visible(&view, wi) == 0);
    TEST(vndf_mixture_invert(&view, wi, -1, &u1, &u2) == -1 && u1 == 0 && u2 == 0);
    TEST(vndf_mixture_lambda(m, wi) == 0 && vndf_mixture_g1(m, wi) == 0 &&
         vndf_mixture_projected_area(m, wi) == 0);
}

static void test_invalid(void)
{
    const vndf_mixture_lobe good = {{vndf_ggx(), 0.3f, 0, 0, 0.3f, 0, 0}, 1};
    const vndf_mixture_lobe singular = {{vndf_ggx(), 0.3f, 0.3f, 0.3f, 0.3f, 0, 0}, 1};
    vndf_mixture m = {0, {good}};
    const float weights[] = {-1, (float)NAN, HUGE_VALF, 0};
    test_invalid_mixture(NULL);
    test_invalid_mixture(&m);
    m.count = VNDF_MIXTURE_LOBES + 1;
    test_invalid_mixture(&m);
    m.count = 1;
    for (int i = 0; i < 4; i++) {
        m.lobe[0].weight = weights[i];
        test_invalid_mixture(&m);
    }
    m = (vndf_mixture){2, {good, singular}};
    test_invalid_mixture(&m);
    m.lobe[1].weight = 0;
    TEST(vndf_mixture_view_from(&m, (vndf_vec3){0, 0, 1}).count == 1);
}

int main(void)
{
    unsigned long long state = 20261122;
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    const vndf_distribution *all[] = {vndf_ggx(), vndf_beckmann(), table};
    size_t many = test_amount(1000, 10000, 100000);
    if (!TEST(table != NULL))
        return test_done();
    for (size_t i = 0; i < many; i++) {
        test_ggx(&state);
        test_sample(all, 3, &state);
        test_one(all[i % 3], &state);
    }
    TEST((double)led_back > 0.97 * (double)inverted);
    test_lobes(&state);
    test_hardly_seen();
    test_invalid();
    vndf_free(table);
    return test_done();
}
