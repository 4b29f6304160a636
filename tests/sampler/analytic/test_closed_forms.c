/* The closed forms through the public calls: at every angle from 0 to 180 degrees and every roughness the density
 * is right and finite, the inverse leads back, and Lambda is Smith's.
 *
 * The oracles are the textbook formulas in long double with logarithms in place of what underflows. */
#include "harness/test.h"
#include "vndf.h"

static const long double pi = 3.141592653589793238463L;

typedef struct closed_form {
    const char *name;
    const vndf_distribution *distribution;
    long double (*log_ndf)(long double r2, long double z); /* at roughness 1: slope length^2, cosine */
    long double (*log_area)(long double k);                /* of A1/s at k = c/s */
} closed_form;

static long double log_ndf_ggx(long double r2, long double z)
{
    return -logl(pi) - 2.0L * logl(1.0L + r2) - 4.0L * logl(z);
}

static long double log_ndf_beckmann(long double r2, long double z)
{
    return -logl(pi) - r2 - 4.0L * logl(z);
}

/* A1/s = (sqrt(1 + k^2) + k)/2. */
static long double log_area_ggx(long double k)
{
    long double root = sqrtl(1.0L + k * k);
    return k < 0.0L ? -logl(2.0L * (root - k)) : logl(0.5L * (root + k));
}

/* sqrt(pi) exp(z^2) erfc(z) = 1/(z + N): N from its continued fraction for z > 1.5, from erfcl below. */
static long double remainder_of(long double z)
{
    long double tail = z;
    if (z < 1.5L)
        return expl(-z * z) / (sqrtl(pi) * erfcl(z)) - z;
    for (int i = 200; i > 0; i--)
        tail = z + 0.5L * i / tail;
    return tail - z;
}

/* A1/s = exp(-k^2) N/(N + |k|)/(2 sqrt(pi)), and k more above the horizon. */
static long double log_area_beckmann(long double k)
{
    long double z = fabsl(k), n = remainder_of(z), below = logl(n / (n + z) / (2.0L * sqrtl(pi))) - k * k;
    return k > 0.0L ? logl(k + expl(below)) : below;
}

/* log of Dv(wm); wi is what the view keeps. */
static long double log_visible(const closed_form *form, const vndf_view *view, vndf_vec3 wm)
{
    long double ax = view->alpha_x, ay = view->alpha_y, x = view->wi.x, y = view->wi.y, z = view->wi.z;
    long double facing = x * wm.x + y * wm.y + z * wm.z, across = hypotl(ax * x, ay * y);
    long double sx = wm.x / (ax * wm.z), sy = wm.y / (ay * wm.z);
    return logl(facing) + form->log_ndf(sx * sx + sy * sy, wm.z) - logl(ax * ay) - logl(across) -
           form->log_area(z / across);
}

static vndf_vec3 direction_at(double theta, double phi)
{
    vndf_vec3 w = {(float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)), (float)cos(theta)};
    return w;
}

static float power_between(unsigned long long *state, double low, double high)
{
    return (float)pow(10.0, low + (high - low) * test_uniform_double(state));
}

/* Roughness from 1e-3 to 10^high along each axis. */
static vndf_surface random_surface(const closed_form *form, unsigned long long *state, double high)
{
    vndf_surface surface = {form->distribution, power_between(state, -3.0, high), 0.0f};
    surface.alpha_y = power_between(state, -3.0, high);
    return surface;
}

static double random_angle(unsigned long long *state)
{
    return (double)pi * test_uniform_double(state);
}

static double dot(vndf_vec3 a, vndf_vec3 b)
{
    return (double)a.x * b.x + (double)a.y * b.y + (double)a.z * b.z;
}

/* ---- density ---- */

typedef struct findings {
    double worst;   /* difference of logarithms, vndf_pdf */
    int dark, away; /* views where float has no such density; normals that rounding turned away */
} findings;

static void check_density(const closed_form *form, const vndf_view *view, float u1, float u2, findings *found)
{
    float pdf;
    vndf_vec3 wm = vndf_sample(view, u1, u2, &pdf);
    double facing = dot(view->wi, wm);
    TEST(fabs(dot(wm, wm) - 1.0) < 1e-6 && wm.z >= 0.0f && facing > -2e-7);
    TEST(pdf >= 0.0f && isfinite(pdf) && vndf_visible(view, wm) == vndf_pdf(view, wm));
    TEST_RELATIVE((double)pdf, (double)vndf_pdf(view, wm), 6e-6); /* that of the place, where GGX is plain */
    if (!(facing > 0.0) || !(wm.z > 0.0f)) {
        found->away++;
        return;
    }
    double want = (double)log_visible(form, view, wm);
    if (want > -80.0 && want < 88.0)
        found->worst = fmax(found->worst, fabs(log((double)vndf_pdf(view, wm)) - want));
    else
        found->dark++;
}

/* 1e-6: the roundings of the view. Below the horizon a slope c/s of -1e3 alone puts the area at exp(-1e6). */
static void density_is_right(const closed_form *form)
{
    unsigned long long state = 21;
    findings found = {0.0, 0, 0};
    for (int i = 0; i < 100000; i++) {
        vndf_surface surface = random_surface(form, &state, 0.5);
        double theta = random_angle(&state), phi = 2.0 * random_angle(&state);
        vndf_view view = vndf_view_from(&surface, direction_at(theta, phi));
        check_density(form, &view, test_uniform(&state), test_uniform(&state), &found);
    }
    fprintf(stderr, "%s: density off by %.2g; %d dark\n", form->name, found.worst, found.dark);
    TEST(found.worst < 1e-6);
    TEST(found.dark < 200 && found.away == 0);
}

/* A Beckmann sees a denormal float in the first, 0 in the others. */
static void density_is_right_where_the_area_underflows(const closed_form *form)
{
    static const double views[][4] = {
        {109.17597336184808, 260.50097223434693, 0.0174253341, 0.0372402631},
        {109.17597336184808, 260.50097223434693, 0.00174253341, 0.00372402631},
        {150.0, 10.0, 0.02, 0.01},
        {179.0, 45.0, 1.0, 0.5},
        {179.99, 45.0, 3.0, 5.0},
    };
    unsigned long long state = 4;
    findings found = {0.0, 0, 0};
    for (int i = 0; i < 5 * 1000; i++) {
        const double *v = views[i / 1000];
        vndf_surface surface = {form->distribution, (float)v[2], (float)v[3]};
        vndf_vec3 w = direction_at(v[0] * (double)pi / 180.0, v[1] * (double)pi / 180.0);
        vndf_view view = vndf_view_from(&surface, w);
        check_density(form, &view, test_uniform(&state), test_uniform(&state), &found);
    }
    TEST(found.worst < 1e-6 && found.dark == 0 && found.away == 0);
}

/* ---- everything valid is finite ---- */

static vndf_vec3 hard_direction(unsigned long long *state)
{
    static const float parts[] = {
        0.0f, -0.0f, 1e-45f, 1e-38f, 1e-20f, 1e-7f, 0.5f, 1.0f, -1.0f, -1e-7f, -1e-30f, 1e30f,
    };
    enum { PARTS = sizeof parts / sizeof *parts };
    vndf_vec3 w = {parts[test_random_bits(state) % PARTS], parts[test_random_bits(state) % PARTS],
                   parts[test_random_bits(state) % PARTS]};
    return w;
}

static int is_number(float x, float low, float high)
{
    return x >= low && x <= high; /* false for NaN */
}

static void check_surface(const vndf_surface *surface, vndf_vec3 w, vndf_vec3 wm)
{
    const float most = 3.4028234e38f;
    TEST(is_number(vndf_ndf(surface, wm), 0.0f, most));
    TEST(is_number(vndf_p22(surface, w.x * 1e8f, w.y), 0.0f, most));
    TEST(is_number(vndf_projected_area(surface, w), 0.0f, 1.001e18f));
    TEST(is_number(vndf_lambda(surface, w), -most, most));
    TEST(is_number(vndf_g1(surface, w), 0.0f, 1.0f));
}

static void hard_input_has_finite_results(const closed_form *form)
{
    static const float uniforms[] = {0.0f, 1e-30f, 0x1p-24f, 0.5f, 0.3f, 1.0f - 0x1p-24f, 1.0f};
    unsigned long long state = 8;
    findings found = {0.0, 0, 0};
    for (int i = 0; i < 100000; i++) {
        float alpha_x = power_between(&state, -17.9, 17.9);
        vndf_surface surface = {form->distribution, alpha_x, power_between(&state, -17.9, 17.9)};
        vndf_vec3 w = hard_direction(&state);
        vndf_view view = vndf_view_from(&surface, w);
        float u1 = uniforms[test_random_bits(&state) % 7], u2 = uniforms[test_random_bits(&state) % 7], v1, v2;
        vndf_vec3 wm = vndf_sample(&view, u1, u2, NULL);
        if (view.distribution)
            check_density(form, &view, u1, u2, &found);
        vndf_invert(&view, wm, &v1, &v2);
        TEST(is_number(v1, 0.0f, 1.0f) && is_number(v2, 0.0f, 1.0f));
        check_surface(&surface, w, wm);
    }
}

/* ---- inverse ---- */

static double distance(vndf_vec3 a, vndf_vec3 b)
{
    return sqrt(((double)a.x - b.x) * ((double)a.x - b.x) + ((double)a.y - b.y) * ((double)a.y - b.y) +
                ((double)a.z - b.z) * ((double)a.z - b.z));
}

/* A step of u2 moves normals of the far tail by more than 1e-5; there the numbers themselves have to come back. */
static int leads_back(const vndf_view *view, float u1, float u2)
{
    float v1, v2;
    vndf_vec3 wm = vndf_sample(view, u1, u2, NULL), back;
    vndf_invert(view, wm, &v1, &v2);
    back = vndf_sample(view, v1, v2, NULL);
    return distance(wm, back) <= 1e-5 ||
           (fabs((double)v1 - u1) <= 4.0 * 0x1p-24 && fabs((double)v2 - u2) <= 4.0 * 0x1p-24);
}

/* Only where the projected area is above 1e-12: below, all normals of a Beckmann lie within the rounding of
 * one. */
static void inverse_leads_back(const closed_form *form)
{
    unsigned long long state = 12;
    int lost = 0;
    for (int i = 0; i < 200000; i++) {
        vndf_surface surface = random_surface(form, &state, 0.0);
        double theta = random_angle(&state), phi = 2.0 * random_angle(&state);
        vndf_vec3 w = direction_at(theta, phi);
        vndf_view view = vndf_view_from(&surface, w);
        float u1 = test_uniform(&state), u2 = test_uniform(&state);
        if (vndf_projected_area(&surface, w) > 1e-12f)
            lost += !leads_back(&view, u1, u2);
    }
    fprintf(stderr, "%s: %d normals do not come back\n", form->name, lost);
    TEST(lost <= 1);
}

static void inverse_leads_back_from_far_tails(const closed_form *form)
{
    vndf_surface first = {form->distribution, 0.0127f, 0.08f};
    vndf_surface second = {form->distribution, 0.00111375877f, 0.0260536484f};
    vndf_view a = vndf_view_from(&first, direction_at(19.89 * (double)pi / 180.0, 89.07 * (double)pi / 180.0));
    vndf_view b = vndf_view_from(&second, direction_at(0.65760495, 3.0089284));
    for (int i = 1; i <= 4096; i++) {
        TEST(leads_back(&a, 0.665098667f, 1.0f - (float)i * 0x1p-24f));
        TEST(leads_back(&b, 0.450793207f, 1.0f - (float)i * 0x1p-20f));
    }
}

/* ---- Lambda ---- */

/* What a relative change of 1 in k does to the logarithm of the area: the roundings of s and c count so often. */
static double condition(const closed_form *form, long double k)
{
    return (double)fabsl((form->log_area(k * 1.0001L) - form->log_area(k)) * 1e4L);
}

/* As long as the area of the mirrored direction is a normal float. */
static void lambda_is_smiths(const closed_form *form)
{
    for (double theta = 0.05; theta < 179.0; theta += 0.13)
        for (float alpha = 0.01f; alpha < 4.0f; alpha *= 3.0f) {
            vndf_surface surface = {form->distribution, alpha, alpha};
            vndf_vec3 w = direction_at(theta * (double)pi / 180.0, 0.7);
            long double across = alpha * hypotl(w.x, w.y), up = fabsl((long double)w.z);
            long double below = form->log_area(-up / across) + logl(across / up);
            double want = (double)expl(below), tolerance = 2.5e-7 * (1.0 + condition(form, -up / across));
            if (below > -80.0L)
                TEST_RELATIVE(vndf_lambda(&surface, w), w.z < 0.0f ? -1.0 - want : want, tolerance);
        }
}

int main(void)
{
    const closed_form forms[] = {
        {"ggx", vndf_ggx(), log_ndf_ggx, log_area_ggx},
        {"beckmann", vndf_beckmann(), log_ndf_beckmann, log_area_beckmann},
    };
    for (int i = 0; i < 2; i++) {
        density_is_right(&forms[i]);
        density_is_right_where_the_area_underflows(&forms[i]);
        hard_input_has_finite_results(&forms[i]);
        inverse_leads_back(&forms[i]);
        inverse_leads_back_from_far_tails(&forms[i]);
        lambda_is_smiths(&forms[i]);
    }
    return test_done();
}
