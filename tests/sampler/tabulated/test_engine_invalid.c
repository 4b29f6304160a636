/* Invalid input has its documented result: an invalid view, of which vndf_sample gives (0, 0, 1) with density 0
 * and every other call 0; uniform numbers outside [0, 1] are clamped and NaN counts as 0; both zeros are the
 * horizon. */
#include <float.h>
#include <string.h>

#include "oracle/oracle.h"
#include "harness/test.h"

static int is_zero(const vndf_surface *surface, vndf_vec3 wi)
{
    float pdf = -1, u1 = -1, u2 = -1;
    vndf_vec3 tilted = {0.6f, 0, 0.8f}, up = {0, 0, 1};
    vndf_view view = vndf_view_from(surface, wi);
    vndf_vec3 wm = vndf_sample(&view, 0.3f, 0.7f, &pdf), again = vndf_sample(&view, 0.3f, 0.7f, NULL);
    vndf_invert(&view, tilted, &u1, &u2);
    return wm.x == 0 && wm.y == 0 && wm.z == 1 && again.z == 1 && pdf == 0 && u1 == 0 && u2 == 0 &&
           vndf_pdf(&view, tilted) == 0 && vndf_visible(&view, tilted) == 0 &&
           vndf_projected_area(surface, wi) == 0 && vndf_lambda(surface, wi) == 0 && vndf_g1(surface, wi) == 0 &&
           vndf_g2(surface, wi, up, VNDF_G2_SEPARABLE) == 0 &&
           vndf_g2(surface, up, wi, VNDF_G2_HEIGHT_CORRELATED) == 0;
}

static void test_surfaces(const vndf_distribution *d)
{
    const float bad[] = {0, -0.0f, -1, NAN, INFINITY, -INFINITY, 2e18f, FLT_MAX};
    vndf_vec3 tilted = {0.6f, 0, 0.8f};
    vndf_surface none = {NULL, 1, 1};
    TEST(is_zero(NULL, tilted) && is_zero(&none, tilted));
    TEST(vndf_ndf(NULL, tilted) == 0 && vndf_ndf(&none, tilted) == 0 && vndf_p22(NULL, 0, 0) == 0);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        vndf_surface x = {d, bad[i], 0.5f}, y = {d, 0.5f, bad[i]};
        if (!(TEST(is_zero(&x, tilted)) & TEST(is_zero(&y, tilted)) & TEST(vndf_ndf(&x, tilted) == 0) &
              TEST(vndf_p22(&y, 0, 0) == 0)))
            fprintf(stderr, "  alpha %g\n", bad[i]);
    }
}

static void test_directions(const vndf_distribution *d)
{
    const float bad[] = {NAN, INFINITY, -INFINITY};
    vndf_surface surface = {d, 0.5f, 0.2f};
    vndf_vec3 zero = {0, -0.0f, 0};
    TEST(is_zero(&surface, zero));
    for (int i = 0; i < 9; i++) {
        float v[3] = {0.6f, 0, 0.8f};
        v[i % 3] = bad[i / 3];
        vndf_vec3 wi = {v[0], v[1], v[2]};
        if (!TEST(is_zero(&surface, wi)))
            fprintf(stderr, "  wi %g %g %g\n", wi.x, wi.y, wi.z);
    }
}

/* Normals that are none: below the surface, NaN. */
static void test_normals(const vndf_distribution *d)
{
    vndf_surface surface = {d, 0.5f, 0.2f};
    vndf_vec3 wi = {0.6f, 0, 0.8f}, below = {0, 0.6f, -0.8f}, nan = {NAN, 0, 1}, away = {-0.8f, 0, 0.6f},
              zero = {0, 0, 0};
    vndf_view view = vndf_view_from(&surface, wi);
    const vndf_vec3 all[] = {below, nan, zero};
    float u1 = -1, u2 = -1;
    away.z = 0.59f;
    TEST(vndf_pdf(&view, away) == 0 && vndf_visible(&view, away) == 0 && vndf_ndf(&surface, away) > 0);
    for (int i = 0; i < 3; i++) {
        if (!(TEST(vndf_pdf(&view, all[i]) == 0) & TEST(vndf_visible(&view, all[i]) == 0) &
              TEST(vndf_ndf(&surface, all[i]) == 0)))
            fprintf(stderr, "  normal %g %g %g\n", all[i].x, all[i].y, all[i].z);
        vndf_invert(&view, all[i], &u1, &u2);
        TEST(u1 == 0 && u2 == 0);
    }
    TEST(vndf_p22(&surface, NAN, 0) == 0 && vndf_p22(&surface, 0, INFINITY) == 0);
}

static int same_sample(const vndf_view *view, float u1, float u2, float v1, float v2)
{
    float p = -1, q = -2;
    vndf_vec3 a = vndf_sample(view, u1, u2, &p), b = vndf_sample(view, v1, v2, &q);
    return a.x == b.x && a.y == b.y && a.z == b.z && p == q;
}

static void test_uniforms(const vndf_distribution *d)
{
    vndf_surface surface = {d, 0.5f, 0.2f};
    vndf_vec3 wi = {0.6f, 0, 0.8f};
    vndf_view view = vndf_view_from(&surface, wi);
    const float below[] = {-1, -0.0f, -INFINITY, NAN, -FLT_MIN}, above[] = {1.5f, INFINITY, 1 + 0x1p-23f, FLT_MAX};
    for (int i = 0; i < 5; i++)
        TEST(same_sample(&view, below[i], 0.4f, 0, 0.4f) && same_sample(&view, 0.4f, below[i], 0.4f, 0));
    for (int i = 0; i < 4; i++)
        TEST(same_sample(&view, above[i], 0.4f, 1, 0.4f) && same_sample(&view, 0.4f, above[i], 0.4f, 1));
}

/* Far from unit, but a direction: the largest and smallest floats do. */
static void test_lengths(const vndf_distribution *d)
{
    const float lengths[] = {1e-30f, 1e-10f, 1e10f, 1e30f};
    vndf_surface surface = {d, 0.5f, 0.2f};
    vndf_vec3 unit = {0.6f, 0, 0.8f};
    for (int i = 0; i < 4; i++) {
        vndf_vec3 wi = {0.6f * lengths[i], 0, 0.8f * lengths[i]};
        TEST_RELATIVE((double)vndf_projected_area(&surface, wi), (double)vndf_projected_area(&surface, unit),
                      1e-6);
    }
}

/* Straight from below every normal is turned away: horizontal normals with density 0. */
static void test_blind(const vndf_distribution *d)
{
    vndf_surface surface = {d, 0.5f, 0.2f};
    vndf_vec3 down = {0, 0, -1};
    vndf_view view = vndf_view_from(&surface, down);
    unsigned long long state = 5;
    for (int i = 0; i < 100; i++) {
        float pdf = -1, u1 = test_uniform(&state), u2 = test_uniform(&state);
        vndf_vec3 wm = vndf_sample(&view, u1, u2, &pdf);
        if (!(TEST(pdf == 0) & TEST(wm.z == 0) & TEST_NEAR((double)wm.x * wm.x + (double)wm.y * wm.y, 1, 1e-6)))
            fprintf(stderr, "  wm %g %g %g, density %g\n", wm.x, wm.y, wm.z, pdf);
    }
}

/* From the horizon, wi.z of one sign of zero. */
typedef struct horizon {
    vndf_vec3 wm;
    float pdf, again, visible, u1, u2, area, lambda, g1;
} horizon;

static horizon horizon_of(const vndf_surface *surface, float zero, float u1, float u2)
{
    vndf_vec3 wi = {-0.6f, 0.8f, zero};
    vndf_view view = vndf_view_from(surface, wi);
    horizon h = {.area = vndf_projected_area(surface, wi), .lambda = vndf_lambda(surface, wi)};
    h.g1 = vndf_g1(surface, wi);
    h.wm = vndf_sample(&view, u1, u2, &h.pdf);
    h.again = vndf_pdf(&view, h.wm);
    h.visible = vndf_visible(&view, h.wm);
    vndf_invert(&view, h.wm, &h.u1, &h.u2);
    return h;
}

/* -0 is the horizon as 0 is, seen from above: the same bits. */
static void test_horizon(const vndf_distribution *d)
{
    vndf_surface surface = {d, 0.5f, 0.2f};
    for (int i = 0; i < 64; i++) {
        float u1 = (float)(i % 8) / 7, u2 = (float)(i / 8) / 7;
        horizon above = horizon_of(&surface, 0.0f, u1, u2), below = horizon_of(&surface, -0.0f, u1, u2);
        if (!(TEST(memcmp(&above, &below, sizeof above) == 0) & TEST(above.lambda == FLT_MAX)))
            fprintf(stderr, "  u %g %g\n", (double)u1, (double)u2);
    }
}

int main(void)
{
    oracle o = oracle_get(ORACLE_LAPLACE);
    vndf_distribution *table = oracle_build(&o, 2048, NULL);
    const vndf_distribution *all[] = {table, vndf_ggx(), vndf_beckmann()};
    for (int i = 0; TEST(table != NULL) && i < 3; i++) {
        test_surfaces(all[i]);
        test_directions(all[i]);
        test_normals(all[i]);
        test_uniforms(all[i]);
        test_lengths(all[i]);
        test_blind(all[i]);
        test_horizon(all[i]);
    }
    vndf_free(table);
    TEST(vndf_distribution_info(NULL).bytes == 0 && vndf_distribution_info(NULL).source[0] == '\0');
    return test_done();
}
