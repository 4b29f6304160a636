/* An affine surface is what its slopes say: D, P22, area, Lambda, G1, G2 and the visible density equal closed forms
 * of GGX for random matrices (condition up to 1e7, determinants of either sign) and mean slopes up to 2, D of
 * Beckmann its closed form but for the rounding of axes, and integrals over slopes for Beckmann and tables; samples are
 * unit normals that face wi, and come with the density of vndf_affine_pdf, to 1e-5; the inverse leads back; a diagonal
 * matrix without a mean slope gives the bits of vndf_surface, and M R of a rotation R the densities of M; what is
 * invalid has one result. */
#include <float.h>

#include "harness/constants.h"
#include "harness/test.h"
#include "oracle/oracle.h"

static double uniform(unsigned long long *state, double from, double to)
{
    return from + (to - from) * test_uniform_double(state);
}

static double exponential(unsigned long long *state, double from, double to)
{
    return exp(uniform(state, log(from), log(to)));
}

/* Two turns and a stretch in between; a mirror in half of them. */
static vndf_affine random_affine(const vndf_distribution *d, double condition, double mean,
                                 unsigned long long *state)
{
    double most = exponential(state, 1e-3, 3), least = most / exponential(state, 1, condition);
    double a = uniform(state, 0, 2 * PI), b = uniform(state, 0, 2 * PI);
    double mirror = test_uniform(state) < 0.5f ? -1 : 1;
    vndf_affine m = {d,
                     (float)(cos(a) * most * cos(b) - sin(a) * least * sin(b)),
                     (float)(mirror * (-cos(a) * most * sin(b) - sin(a) * least * cos(b))),
                     (float)(sin(a) * most * cos(b) + cos(a) * least * sin(b)),
                     (float)(mirror * (-sin(a) * most * sin(b) + cos(a) * least * cos(b))),
                     (float)uniform(state, -mean, mean),
                     (float)uniform(state, -mean, mean)};
    return m;
}

static vndf_vec3 random_direction(unsigned long long *state)
{
    double z = uniform(state, -1, 1), phi = uniform(state, 0, 2 * PI), s = sqrt(1 - z * z);
    vndf_vec3 w = {(float)(s * cos(phi)), (float)(s * sin(phi)), (float)z};
    return w;
}

static double length_of(vndf_vec3 w)
{
    return sqrt((double)w.x * w.x + (double)w.y * w.y + (double)w.z * w.z);
}

/* ---- the truth of GGX, from the matrix as it is ---- */

static long double determinant(const vndf_affine *m)
{
    return (long double)m->xx * m->yy - (long double)m->xy * m->yx;
}

static double p22_ggx(const vndf_affine *m, long double x, long double y)
{
    long double det = determinant(m), dx = x - m->mean_x, dy = y - m->mean_y;
    long double u = (m->yy * dx - m->xy * dy) / det, v = (m->xx * dy - m->yx * dx) / det, q = 1 + u * u + v * v;
    return (double)(1 / (PI * q * q * fabsl(det)));
}

static double ndf_ggx(const vndf_affine *m, vndf_vec3 wm)
{
    long double z = wm.z;
    return p22_ggx(m, -wm.x / z, -wm.y / z) / (double)(z * z * z * z);
}

/* wi.z - wi.mean, and |M^T wi|. */
static void seen_from(const vndf_affine *m, vndf_vec3 w, double *up, double *across)
{
    double x = (double)m->xx * w.x + (double)m->yx * w.y, y = (double)m->xy * w.x + (double)m->yy * w.y;
    *up = w.z - ((double)w.x * m->mean_x + (double)w.y * m->mean_y);
    *across = sqrt(x * x + y * y);
}

/* (up + |(across, up)|)/2, without a difference. */
static double area_ggx(double up, double across)
{
    double length = sqrt(up * up + across * across);
    return up >= 0 ? 0.5 * (up + length) : 0.5 * across * across / (length - up);
}

static void test_ggx(unsigned long long *state)
{
    vndf_affine m = random_affine(vndf_ggx(), 1e7, 2, state);
    vndf_vec3 wi = random_direction(state), wo = random_direction(state);
    double up, across, up_o, across_o, length = length_of(wi);
    seen_from(&m, wi, &up, &across);
    seen_from(&m, wo, &up_o, &across_o);
    double area = area_ggx(up, across), below = area_ggx(-fabs(up), across);
    double g1 = up > 0 ? up / area : 0, go = up_o > 0 ? up_o / area_ggx(up_o, across_o) : 0;
    TEST_RELATIVE((double)vndf_affine_projected_area(&m, wi), area / length, 1e-6);
    TEST_NEAR((double)vndf_affine_lambda(&m, wi) / (1 + below / fabs(up)),
              (up > 0 ? below / up : -1 - below / -up) / (1 + below / fabs(up)), 1e-6);
    TEST_NEAR((double)vndf_affine_g1(&m, wi), g1, 1e-6);
    TEST_NEAR((double)vndf_affine_g2(&m, wi, wo, VNDF_G2_SEPARABLE), g1 * go, 2e-6);
    double correlated = g1 > 0 && go > 0 ? 1 / (1 / g1 + 1 / go - 1) : 0;
    TEST_NEAR((double)vndf_affine_g2(&m, wi, wo, VNDF_G2_HEIGHT_CORRELATED), correlated, 2e-6);

    vndf_affine_view view = vndf_affine_view_from(&m, wi);
    float pdf, u1 = test_uniform(state), u2 = test_uniform(state);
    vndf_vec3 wm = vndf_affine_sample(&view, u1, u2, &pdf);
    double facing = (double)wi.x * wm.x + (double)wi.y * wm.y + (double)wi.z * wm.z;
    if (!(wm.z > 1e-6f)) /* slopes of the truth overflow */
        return;
    double d = ndf_ggx(&m, wm), x = -(double)wm.x / wm.z, y = -(double)wm.y / wm.z;
    if (d > 1e-30 && d < 1e30)
        TEST_RELATIVE((double)vndf_affine_ndf(&m, wm), d, 1e-5);
    double slope = p22_ggx(&m, (float)x, (float)y);
    if (slope > 1e-30 && slope < 1e30)
        TEST_RELATIVE((double)vndf_affine_p22(&m, (float)x, (float)y), slope, 1e-5);
    double visible = facing * d / area;
    if (visible > 1e-30 && visible < 1e30) {
        TEST_RELATIVE((double)vndf_affine_visible(&view, wm), visible, 1e-5);
        TEST_RELATIVE((double)pdf, visible, 1e-5);
    }
}

/* ---- the truth of Beckmann ---- */

static long double exponent(const vndf_affine *m, vndf_vec3 wm)
{
    long double det = determinant(m), x = -(long double)wm.x / wm.z, y = -(long double)wm.y / wm.z;
    long double u = (m->yy * x - m->xy * y) / det, v = (m->xx * y - m->yx * x) / det;
    return u * u + v * v;
}

/* The axes are rounded to float, which moves slopes by 2^-24 of themselves and exp(-u^2) by 2^-23 u^2
 * (sampler/affine/principal.h); nothing else is lost, however far out the normal is. */
static void test_beckmann(unsigned long long *state)
{
    vndf_affine m = random_affine(vndf_beckmann(), 100, 0, state);
    double u = sqrt(uniform(state, 0, 80)), phi = uniform(state, 0, 2 * PI), a = u * cos(phi), b = u * sin(phi);
    double x = m.xx * a + m.xy * b, y = m.yx * a + m.yy * b, z = 1 / sqrt(1 + x * x + y * y);
    vndf_vec3 wm = {(float)(-x * z), (float)(-y * z), (float)z};
    long double u2 = exponent(&m, wm), z2 = (long double)wm.z * wm.z;
    double d = (double)(expl(-u2) / ((long double)PI * fabsl(determinant(&m)) * z2 * z2));
    if (d > 1e-35 && d < 1e30)
        TEST_RELATIVE((double)vndf_affine_ndf(&m, wm), d, 3e-7 + 0x1p-23 * (double)u2);
}

/* ---- any distribution: integrals over its slopes ---- */

enum { AZIMUTHS = 256, RADII = 3000 };

/* A(wi) from P22 of the distribution itself, roughness 1: integral of max(0, wi.z - wi.(M u + mean)) over slopes u,
 * even in azimuth and in log R. */
static double area_by_slopes(const vndf_affine *m, vndf_vec3 wi)
{
    const double from = log(1e-5), step = (log(1e7) - from) / RADII;
    static double r[RADII], weight[RADII];
    vndf_surface unit = {m->distribution, 1, 1};
    double up = wi.z - ((double)wi.x * m->mean_x + (double)wi.y * m->mean_y), sum = 0;
    for (int i = 0; i < RADII; i++) {
        r[i] = exp(from + (i + 0.5) * step);
        weight[i] = (double)vndf_p22(&unit, (float)r[i], 0) * r[i] * r[i] * step;
    }
    double x = (double)m->xx * wi.x + (double)m->yx * wi.y, y = (double)m->xy * wi.x + (double)m->yy * wi.y;
    for (int a = 0; a < AZIMUTHS; a++) {
        double phi = 2 * PI * (a + 0.5) / AZIMUTHS, along = x * cos(phi) + y * sin(phi);
        for (int i = 0; i < RADII; i++)
            sum += fmax(0, up - along * r[i]) * weight[i];
    }
    return sum * 2 * PI / AZIMUTHS;
}

/* Where A(wi) is small beside what cancels in the sum, the sum says little. Floats below FLT_MIN have few digits. */
static void test_areas(const vndf_distribution *d, unsigned long long *state)
{
    vndf_affine m = random_affine(d, 10, 1, state);
    vndf_vec3 wi = random_direction(state);
    double area = area_by_slopes(&m, wi), length = length_of(wi), up, across;
    seen_from(&m, wi, &up, &across);
    TEST_NEAR((double)vndf_affine_projected_area(&m, wi), area / length, 1e-4 * (fabs(up) + across));
    vndf_affine_view view = vndf_affine_view_from(&m, wi);
    for (int i = 0; i < 20; i++) {
        vndf_vec3 wm = vndf_affine_sample(&view, test_uniform(state), test_uniform(state), NULL);
        double facing = (double)wi.x * wm.x + (double)wi.y * wm.y + (double)wi.z * wm.z;
        double d_here = (double)vndf_affine_ndf(&m, wm), a = (double)vndf_affine_projected_area(&m, wi) * length;
        double visible = facing * d_here / a;
        int whole = a > (double)FLT_MIN && d_here > (double)FLT_MIN;
        if (whole && visible > 1e-20 && visible < 1e20 && d_here < 1e30)
            TEST_RELATIVE((double)vndf_affine_visible(&view, wm), visible, 1e-5);
    }
}

/* ---- samples ---- */

static float hostile_number(unsigned long long *state)
{
    const float hard[] = {0, 1, 0x1p-24f, 1 - 0x1p-24f, 0.5f};
    unsigned long long which = test_random_bits(state) % 10;
    return which < 5 ? hard[which] : test_uniform(state);
}

/* How many densities of samples were not evaluated at the rounded normal (sampler/trust.h). */
static size_t sampled, kept;

static void test_sample(const vndf_distribution *d, unsigned long long *state)
{
    int easy = test_random_bits(state) % 2 == 0;
    vndf_affine m = random_affine(d, easy ? 4 : 1e4, easy ? 0.3 : 2, state);
    vndf_vec3 wi = random_direction(state);
    if (test_random_bits(state) % 4 == 0)
        wi.z *= (float)exponential(state, 1e-8, 1);
    vndf_affine_view view = vndf_affine_view_from(&m, wi);
    float pdf, u1 = hostile_number(state), u2 = hostile_number(state);
    vndf_vec3 wm = vndf_affine_sample(&view, u1, u2, &pdf);
    double facing = (double)wi.x * wm.x + (double)wi.y * wm.y + (double)wi.z * wm.z;
    TEST_NEAR(length_of(wm), 1, 4 * 0x1p-23);
    TEST(wm.z >= 0);
    TEST(facing > 0);
    TEST(pdf >= FLT_MIN && pdf <= FLT_MAX);
    TEST_RELATIVE((double)pdf, (double)vndf_affine_pdf(&view, wm), 1e-5);
    sampled++;
    kept += pdf != vndf_affine_pdf(&view, wm);
}

/* Beside the pole, where the mean slope turns a rounding of the normal into a turn of the azimuth: the point at which
 * a density was once off by 1.1e-5, the first line, and points around it. */
static void test_beside_pole(const vndf_distribution *needle, unsigned long long *state)
{
    const vndf_affine m = {needle,       2.59691213e+09f, -470481536.0f, -5.25202534e+09f,
                           -53412084.0f, 1.79497135f,     -0.762197316f};
    const vndf_vec3 wi = {-0.43771717f, 0.377438515f, 0.816053808f};
    vndf_affine_view view = vndf_affine_view_from(&m, wi);
    for (size_t i = 0; i < test_amount(2000, 2000, 100000); i++) {
        float u1 = i == 0 ? 5.96046448e-08f : (float)exponential(state, 1e-8, 1e-6), pdf;
        float u2 = i == 0 ? 4.03215017e-06f : (float)exponential(state, 1e-6, 1e-4);
        vndf_vec3 wm = vndf_affine_sample(&view, u1, u2, &pdf);
        TEST_RELATIVE((double)pdf, (double)vndf_affine_pdf(&view, wm), 1e-5);
    }
}

/* A normal comes back within a thousandth of the width of the lobe, about, and some roundings of wm. */
static void test_inverse(const vndf_distribution *d, unsigned long long *state)
{
    vndf_affine m = random_affine(d, 30, 1, state);
    vndf_affine_view view = vndf_affine_view_from(&m, random_direction(state));
    float u1 = (float)uniform(state, 0.05, 0.95), u2 = (float)uniform(state, 0.05, 0.95), v1, v2, pdf;
    vndf_vec3 wm = vndf_affine_sample(&view, u1, u2, &pdf);
    vndf_affine_invert(&view, wm, &v1, &v2);
    vndf_vec3 back = vndf_affine_sample(&view, v1, v2, NULL);
    double x = (double)back.x - wm.x, y = (double)back.y - wm.y, z = (double)back.z - wm.z;
    TEST(v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1);
    TEST(sqrt(x * x + y * y + z * z) < 1e-3 / sqrt((double)pdf) + 5e-7);
}

/* ---- what is the same ---- */

static void test_diagonal(const vndf_distribution *d, unsigned long long *state)
{
    float ax = (float)exponential(state, 1e-3, 3), ay = (float)exponential(state, 1e-3, 3), p, q;
    vndf_surface plain = {d, ax, ay};
    vndf_affine m = {d, ax, 0, 0, test_uniform(state) < 0.5f ? ay : -ay, 0, 0};
    vndf_vec3 wi = random_direction(state), wo = random_direction(state);
    vndf_view view = vndf_view_from(&plain, wi);
    vndf_affine_view same = vndf_affine_view_from(&m, wi);
    float u1 = test_uniform(state), u2 = test_uniform(state), v1, v2, w1, w2;
    vndf_vec3 a = vndf_sample(&view, u1, u2, &p), b = vndf_affine_sample(&same, u1, u2, &q);
    TEST(memcmp(&a, &b, sizeof a) == 0 && p == q);
    TEST(vndf_pdf(&view, a) == vndf_affine_pdf(&same, a));
    TEST(vndf_visible(&view, a) == vndf_affine_visible(&same, a));
    vndf_invert(&view, a, &v1, &v2);
    vndf_affine_invert(&same, a, &w1, &w2);
    TEST(v1 == w1 && v2 == w2);
    TEST(vndf_lambda(&plain, wi) == vndf_affine_lambda(&m, wi));
    TEST(vndf_g1(&plain, wi) == vndf_affine_g1(&m, wi));
    TEST(vndf_g2(&plain, wi, wo, VNDF_G2_HEIGHT_CORRELATED) ==
         vndf_affine_g2(&m, wi, wo, VNDF_G2_HEIGHT_CORRELATED));
    TEST_RELATIVE((double)vndf_affine_projected_area(&m, wi), (double)vndf_projected_area(&plain, wi), 2e-7);
    TEST_RELATIVE((double)vndf_affine_ndf(&m, a), (double)vndf_ndf(&plain, a), 1e-6);
}

/* A turn before the matrix changes nothing but roundings of the matrix. */
static void test_turned_first(const vndf_distribution *d, unsigned long long *state)
{
    vndf_affine m = random_affine(d, 3, 1, state), n = m;
    double c = cos(1), s = sin(1);
    n.xx = (float)(m.xx * c + m.xy * s);
    n.xy = (float)(m.xy * c - m.xx * s);
    n.yx = (float)(m.yx * c + m.yy * s);
    n.yy = (float)(m.yy * c - m.yx * s);
    vndf_vec3 wi = random_direction(state);
    vndf_affine_view a = vndf_affine_view_from(&m, wi), b = vndf_affine_view_from(&n, wi);
    float pdf;
    vndf_vec3 wm = vndf_affine_sample(&a, test_uniform(state), test_uniform(state), &pdf);
    TEST_NEAR((double)vndf_affine_ndf(&n, wm), (double)vndf_affine_ndf(&m, wm),
              1e-4 * (double)vndf_affine_ndf(&m, wm) + 1e-40);
    if (pdf > 1e-20f && d == vndf_ggx())
        TEST_RELATIVE((double)vndf_affine_pdf(&b, wm), (double)pdf, 1e-4);
}

/* ---- invalid ---- */

static void test_invalid_surface(const vndf_affine *m, vndf_vec3 wi)
{
    float pdf = 1, u1 = 1, u2 = 1;
    vndf_vec3 wm = {0, 0.6f, 0.8f};
    vndf_affine_view view = vndf_affine_view_from(m, wi);
    vndf_vec3 n = vndf_affine_sample(&view, 0.5f, 0.5f, &pdf);
    TEST(n.x == 0 && n.y == 0 && n.z == 1 && pdf == 0);
    TEST(vndf_affine_pdf(&view, wm) == 0 && vndf_affine_visible(&view, wm) == 0);
    vndf_affine_invert(&view, wm, &u1, &u2);
    TEST(u1 == 0 && u2 == 0);
    TEST(vndf_affine_projected_area(m, wi) == 0 && vndf_affine_lambda(m, wi) == 0 && vndf_affine_g1(m, wi) == 0);
}

static void test_invalid(void)
{
    const vndf_vec3 wi = {0.6f, 0, 0.8f}, wm = {0, 0.6f, 0.8f};
    const vndf_affine good = {vndf_ggx(), 0.5f, 0.1f, 0.2f, 0.4f, 0.1f, 0};
    const float nan = (float)NAN;
    const vndf_affine bad[] = {{NULL, 0.5f, 0.1f, 0.2f, 0.4f, 0, 0},
                               {vndf_ggx(), 0.5f, 1, 0.25f, 0.5f, 0, 0},
                               {vndf_ggx(), 0, 0, 0, 0, 0, 0},
                               {vndf_ggx(), 0.5f, 0, 0, 0, 0, 0},
                               {vndf_ggx(), nan, 0.1f, 0.2f, 0.4f, 0, 0},
                               {vndf_ggx(), 0.5f, nan, 0.2f, 0.4f, 0, 0},
                               {vndf_ggx(), 0.5f, 0.1f, 0.2f, 0.4f, nan, 0},
                               {vndf_ggx(), 0.5f, 0.1f, 0.2f, 0.4f, 0, 2e6f},
                               {vndf_ggx(), HUGE_VALF, 0.1f, 0.2f, 0.4f, 0, 0}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        test_invalid_surface(&bad[i], wi);
        TEST(vndf_affine_ndf(&bad[i], wm) == 0 && vndf_affine_p22(&bad[i], 0, 0) == 0);
    }
    test_invalid_surface(NULL, wi);
    test_invalid_surface(&good, (vndf_vec3){0, 0, 0});
    test_invalid_surface(&good, (vndf_vec3){nan, 0, 1});
    vndf_affine_view view = vndf_affine_view_from(&good, wi);
    TEST(vndf_affine_pdf(&view, (vndf_vec3){0, 0.6f, -0.8f}) == 0);
    TEST(vndf_affine_pdf(&view, (vndf_vec3){nan, 0.6f, 0.8f}) == 0);
}

int main(void)
{
    unsigned long long state = 20261122;
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", NULL);
    vndf_distribution *steep = vndf_load(VNDF_SOURCE_DIR "/tables/abc-two-layer-gold.vndf", NULL);
    vndf_distribution *needle = oracle_build_of("exp(-1e9*r)", 4096, NULL, NULL);
    const vndf_distribution *all[] = {vndf_ggx(), vndf_beckmann(), table, steep};
    size_t many = test_amount(2000, 20000, 200000);
    if (!TEST(table && steep && needle))
        return test_done();
    for (size_t i = 0; i < many; i++)
        test_ggx(&state);
    for (size_t i = 0; i < many; i++)
        test_beckmann(&state);
    for (size_t i = 0; i < test_amount(4000, 100000, 6000000); i++)
        test_sample(all[i % 4], &state);
    TEST(kept > sampled / 30); /* or nothing was tested */
    test_beside_pole(needle, &state);
    for (size_t i = 0; i < many / 4; i++) {
        test_diagonal(all[i % 4], &state);
        test_turned_first(all[i % 3], &state);
        test_inverse(all[i % 3], &state);
    }
    for (size_t i = 0; i < test_amount(6, 60, 600); i++)
        test_areas(all[i % 3], &state);
    test_invalid();
    vndf_free(table);
    vndf_free(steep);
    vndf_free(needle);
    return test_done();
}
