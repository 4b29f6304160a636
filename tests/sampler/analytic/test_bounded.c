/* Bounded visible normals: none of any sample, at any roughness and direction, reflects wi to below the horizon;
 * and the density that comes with it is that of vndf_pdf_bounded and that of vndf_pdf over what is kept, to 1e-5.
 *
 * What is kept is that: its mean over samples is the part of vndf_sample's that reflect upwards (5 sigma).
 * Estimators of the albedo have less variance than with visible normals. Samples move steadily with u1 and u2. */
#include <float.h>

#include "oracle/oracle.h"
#include "oracle/oracle_validate.h"
#include "sampler/bounded/bounded.h"
#include "harness/test.h"

static const float ALPHA[][2] = {{1e-6f, 1e-6f}, {1e-6f, 1e-2f}, {0.01f, 0.01f}, {0.2f, 0.2f},
                                 {0.5f, 0.5f},   {1, 1},         {1, 0.1f},      {2, 2},
                                 {3, 0.3f},      {10, 10},       {10, 1e-3f},    {1e-3f, 10}};
static const double COSINE[] = {1, 0.999999999998, 0.866, 0.5, 0.0871557, 1.7e-3, 1e-7};

static double reflected_z(vndf_vec3 wi, vndf_vec3 wm)
{
    double facing = (double)wi.x * wm.x + (double)wi.y * wm.y + (double)wi.z * wm.z;
    return 2 * facing * wm.z - wi.z;
}

/* One view, its samples so far and the sums of what they kept. */
typedef struct subject {
    const char *name;
    vndf_view view;
    vndf_bounds bounds;
    double kept, kept2;
    long plain;
} subject;

static int is_normal(const subject *s, vndf_bounded b)
{
    double length2 = (double)b.wm.x * b.wm.x + (double)b.wm.y * b.wm.y + (double)b.wm.z * b.wm.z;
    double facing = (double)s->view.wi.x * b.wm.x + (double)s->view.wi.y * b.wm.y + (double)s->view.wi.z * b.wm.z;
    return fabs(length2 - 1) < 1e-6 && b.wm.z > 0 && facing > 0 && reflected_z(s->view.wi, b.wm) > 0;
}

/* Densities that float can hold, of chords that are more than rounding. */
static int has_its_density(const subject *s, vndf_bounded b)
{
    double pdf = vndf_pdf_bounded(&s->view, &s->bounds, vndf_normal_of(b.wm));
    int in_range = pdf > 2e-38 && pdf < 3e38 && b.inside_mass > 1e-30f,
        held = b.density > 0 && b.density <= FLT_MAX;
    if (!in_range)
        return held && b.inside_mass > 0 && b.inside_mass < 1.000001f;
    double visible = vndf_pdf(&s->view, b.wm);
    return held && b.inside_mass < 1.000001f && fabs(b.density - pdf) <= 1e-5 * pdf &&
           (visible < 2e-38 || visible > 3e38 ||
            fabs(b.density * (double)b.inside_mass - visible) <= 1e-5 * visible);
}

static int draw(subject *s, float u1, float u2)
{
    vndf_bounded b = vndf_sample_bounded(&s->view, &s->bounds, u1, u2);
    s->kept += b.inside_mass;
    s->kept2 += (double)b.inside_mass * b.inside_mass;
    s->plain += reflected_z(s->view.wi, vndf_sample(&s->view, u1, u2, NULL)) > 0;
    if (TEST(is_normal(s, b)) & TEST(has_its_density(s, b)))
        return 1;
    fprintf(stderr,
            "  %s, alpha %g %g, wi %.9g %.9g %.9g, u %.9g %.9g: wm %.9g %.9g %.9g density %.9g kept %.9g\n",
            s->name, s->view.alpha_x, s->view.alpha_y, s->view.wi.x, s->view.wi.y, s->view.wi.z, u1, u2, b.wm.x,
            b.wm.y, b.wm.z, b.density, b.inside_mass);
    return 0;
}

static subject subject_of(const char *name, const vndf_distribution *d, const float alpha[2], double cosine)
{
    vndf_surface surface = {d, alpha[0], alpha[1]};
    double sine = sqrt((1 - cosine) * (1 + cosine));
    vndf_vec3 wi = {(float)(0.76 * sine), (float)(0.65 * sine), (float)cosine};
    subject s = {.name = name, .view = vndf_view_from(&surface, wi)};
    vndf_bounds_of(&s.view, &s.bounds);
    return s;
}

static void test_samples(const char *name, const vndf_distribution *d, unsigned long long seed)
{
    const float border[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f, 1};
    int count = test_quick() ? 400 : 4000;
    for (size_t a = 0; a < sizeof ALPHA / sizeof *ALPHA; a++)
        for (size_t c = 0; c < sizeof COSINE / sizeof *COSINE; c++) {
            subject s = subject_of(name, d, ALPHA[a], COSINE[c]);
            for (int i = 0; i < 49; i++)
                draw(&s, border[i / 7], border[i % 7]);
            s.kept = s.kept2 = 0;
            s.plain = 0;
            for (int i = 0; i < count; i++)
                draw(&s, test_uniform(&seed), test_uniform(&seed));
            double mean = s.kept / count, part = (double)s.plain / count, spread = s.kept2 / count - mean * mean;
            double error2 = (mean * (1 - mean) + (spread > 0 ? spread : 0)) / count + 1e-10;
            if (!TEST(fabs(mean - part) <= 5 * sqrt(error2) + 1.0 / count))
                fprintf(stderr, "  %s, alpha %g %g, cos %g: kept %g, upwards %g\n", name, ALPHA[a][0], ALPHA[a][1],
                        COSINE[c], mean, part);
        }
}

/* ---- variance ---- */

/* Of the albedo without a Fresnel term: kept G2/G1 of bounded normals, G2/G1 or 0 of visible ones. */
static void test_variance(const char *name, const vndf_distribution *d, float alpha, double cosine)
{
    const float both[2] = {alpha, alpha};
    subject s = subject_of(name, d, both, cosine);
    vndf_surface surface = {d, alpha, alpha};
    double sum[2] = {0}, square[2] = {0};
    unsigned long long seed = 4242;
    int count = 20000;
    for (int i = 0; i < 2 * count; i++) {
        float u1 = test_uniform(&seed), u2 = test_uniform(&seed);
        vndf_bounded b = {vndf_sample(&s.view, u1, u2, NULL), 0, 1, 0};
        b = i % 2 ? vndf_sample_bounded(&s.view, &s.bounds, u1, u2) : b;
        vndf_vec3 wi = s.view.wi, wm = b.wm;
        float twice = 2 * (wi.x * wm.x + wi.y * wm.y + wi.z * wm.z);
        vndf_vec3 wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
        double weight =
            b.inside_mass * vndf_g2(&surface, wi, wo, VNDF_G2_HEIGHT_CORRELATED) / vndf_g1(&surface, wi);
        sum[i % 2] += weight / count;
        square[i % 2] += weight * weight / count;
    }
    double plain = square[0] - sum[0] * sum[0], bounded = square[1] - sum[1] * sum[1];
    if (!(TEST(bounded < 0.95 * plain) & TEST_NEAR(sum[1], sum[0], 5 * sqrt((plain + bounded) / count))))
        fprintf(stderr, "  %s, alpha %g, cos %g: albedo %g %g, variance %g %g\n", name, alpha, cosine, sum[0],
                sum[1], plain, bounded);
}

/* ---- steadiness ---- */

static double apart(vndf_vec3 a, vndf_vec3 b)
{
    return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

/* What the second number moves: the slope length of a table, the angle to the stretched wi of GGX, Beckmann's
 * stretched slope across wi. */
static double moved_by_second(const subject *s, vndf_vec3 wm)
{
    double x = wm.x / s->view.alpha_x, y = wm.y / s->view.alpha_y, length = sqrt(x * x + y * y + wm.z * wm.z);
    double wx = s->view.wi.x * s->view.alpha_x, wy = s->view.wi.y * s->view.alpha_y;
    double across = sqrt(wx * wx + wy * wy);
    double all = sqrt(across * across + s->view.wi.z * s->view.wi.z);
    if (s->view.distribution == vndf_ggx())
        return -(wx * x + wy * y + s->view.wi.z * wm.z) / (all * length);
    if (s->view.distribution == vndf_beckmann())
        return across > 0 ? (x * wy - y * wx) / (across * wm.z) : -y / wm.z;
    return sqrt(x * x + y * y) / wm.z;
}

/* How far the samples of the two ends of an interval of u are apart, of u1 or of u2. */
static double gap(const subject *s, int second, float fixed, float from, float to)
{
    vndf_vec3 a = vndf_sample_bounded(&s->view, &s->bounds, second ? fixed : from, second ? from : fixed).wm;
    vndf_vec3 b = vndf_sample_bounded(&s->view, &s->bounds, second ? fixed : to, second ? to : fixed).wm;
    return apart(a, b);
}

/* The largest step of a line, halved until what is left of it would be a jump; but for the ends, where tails are.
 * */
static double largest_jump(const subject *s, int second, float fixed)
{
    enum { STEPS = 500, HALVES = 14 };
    float width = 1.0f / STEPS, from = width;
    for (int i = 2; i < STEPS - 1; i++) {
        float at = (float)i / STEPS;
        from = gap(s, second, fixed, at, at + width) > gap(s, second, fixed, from, from + width) ? at : from;
    }
    for (int i = 0; i < HALVES; i++) {
        width /= 2;
        from = gap(s, second, fixed, from + width, from + 2 * width) > gap(s, second, fixed, from, from + width)
                   ? from + width
                   : from;
    }
    return gap(s, second, fixed, from, from + width);
}

static void test_steady(const char *name, const vndf_distribution *d, const float alpha[2], double cosine)
{
    enum { STEPS = 2000 };
    subject s = subject_of(name, d, alpha, cosine);
    for (int line = 1; line < 8; line++) {
        float fixed = (float)line / 8;
        double least = -1e30;
        double first = largest_jump(&s, 0, fixed), second = largest_jump(&s, 1, fixed);
        if (!(TEST(first < 0.01) & TEST(second < 0.01)))
            fprintf(stderr, "  %s, alpha %g %g, cos %g: jumps %g %g with the other at %g\n", name, alpha[0],
                    alpha[1], cosine, first, second, fixed);
        for (int i = 0; i <= STEPS; i++) {
            vndf_bounded b = vndf_sample_bounded(&s.view, &s.bounds, fixed, (float)i / STEPS);
            double moved = moved_by_second(&s, b.wm);
            if (!TEST(moved > least - 2e-6 * (fabs(moved) + 1)))
                fprintf(stderr, "  %s, alpha %g %g, cos %g, u1 %g, step %d: %.9g after %.9g\n", name, alpha[0],
                        alpha[1], cosine, fixed, i, moved, least);
            least = moved > least ? moved : least;
        }
    }
}

/* ---- what is not drawn ---- */

static void test_nothing(const vndf_distribution *d)
{
    const float alpha[2] = {0.5f, 0.5f}, wrong[2] = {-1, 1};
    subject below = subject_of("below", d, alpha, -0.1), invalid = subject_of("invalid", d, wrong, 0.5);
    subject good = subject_of("good", d, alpha, 0.5);
    vndf_bounded b = vndf_sample_bounded(&below.view, &below.bounds, 0.5f, 0.5f);
    vndf_bounded i = vndf_sample_bounded(&invalid.view, &invalid.bounds, 0.5f, 0.5f);
    vndf_bounded nan = vndf_sample_bounded(&good.view, &good.bounds, NAN, 2);
    vndf_bounded corner = vndf_sample_bounded(&good.view, &good.bounds, 0, 1);
    vndf_normal up = {0, 0, 1}, away = {0.8, 0, 0.6};
    TEST(b.wm.z == 1 && b.density == 0 && b.inside_mass == 0);
    TEST(i.wm.z == 1 && i.density == 0 && i.inside_mass == 0);
    TEST(vndf_pdf_bounded(&below.view, &below.bounds, up) == 0);
    TEST(vndf_pdf_bounded(&invalid.view, &invalid.bounds, up) == 0);
    TEST(vndf_pdf_bounded(&good.view, &good.bounds, up) > 0);
    away.x = -away.x; /* seen, but wo is below the horizon */
    TEST(vndf_pdf_bounded(&good.view, &good.bounds, away) == 0);
    TEST(memcmp(&nan, &corner, sizeof nan) == 0);
}

static void test_subject(const char *name, const vndf_distribution *d, unsigned long long seed)
{
    const float even[2] = {0.5f, 0.5f}, stretched[2] = {3, 0.4f};
    test_samples(name, d, seed);
    for (double cosine = 0.1; cosine <= 1; cosine += 0.3) {
        test_variance(name, d, 0.5f, cosine);
        test_variance(name, d, 1, cosine);
        test_steady(name, d, even, cosine);
        test_steady(name, d, stretched, cosine);
    }
    test_nothing(d);
}

int main(int arguments, char **argument)
{
    vndf_error error;
    vndf_distribution *table = vndf_load(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", &error);
    if (oracle_wanted(arguments, argument, 0, "ggx"))
        test_subject("ggx", vndf_ggx(), 11);
    if (oracle_wanted(arguments, argument, 1, "beckmann"))
        test_subject("beckmann", vndf_beckmann(), 22);
    if (oracle_wanted(arguments, argument, 2, "table") && TEST(table != NULL))
        test_subject("table", table, 33);
    vndf_free(table);
    return test_done();
}
