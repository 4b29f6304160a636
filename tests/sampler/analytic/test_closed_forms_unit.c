/* The closed forms of GGX and Beckmann solve the unit problem - roughness 1, incident direction (s, 0, c) - for
 * every direction of the sphere and every pair of uniform numbers: area, inversion, normals and inverse.
 *
 * The oracles are sums over the definitions (Simpson's rule in double, over slopes for Beckmann and over the
 * hemisphere for moments) and share nothing with the code but D itself. */
#include "math/erf_quantile.h"
#include "math/half_turn.h"
#include "sampler/analytic/beckmann.h"
#include "sampler/surface.h"
#include "sampler/analytic/ggx.h"
#include "harness/constants.h"
#include "harness/test.h"

typedef struct direction {
    float s, c;
} direction;

typedef struct closed_form {
    const char *name;
    float (*area)(float s, float c);
    double (*ndf)(double alpha_x, double alpha_y, vndf_normal wm);
    vndf_vec3 (*sample)(float s, float c, float u1, float u2);
    void (*invert)(float s, float c, vndf_normal n, float *u1, float *u2);
} closed_form;

static float ggx_area(float s, float c)
{
    return (float)vndf_unit_area(vndf_ggx(), s, c);
}

static float beckmann_area(float s, float c)
{
    return (float)vndf_unit_area(vndf_beckmann(), s, c);
}

static const closed_form forms[] = {
    {"ggx", ggx_area, vndf_ggx_ndf, vndf_ggx_sample, vndf_ggx_invert},
    {"beckmann", beckmann_area, vndf_beckmann_ndf, vndf_beckmann_sample, vndf_beckmann_invert},
};

static direction direction_at(double degrees)
{
    double theta = degrees * PI / 180.0;
    direction w = {(float)sin(theta), (float)cos(theta)};
    return w;
}

/* Samples come at any length. */
static vndf_normal unit(vndf_vec3 n)
{
    double length = sqrt((double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z);
    vndf_normal m = {n.x / length, n.y / length, n.z / length};
    return m;
}

static direction mirror(direction w)
{
    w.c = -w.c;
    return w;
}

typedef double integrand(double t, const void *context);

static double simpson(integrand *f, const void *context, double a, double b, int intervals)
{
    double h = (b - a) / intervals, sum = f(a, context) + f(b, context);
    for (int i = 1; i < intervals; i++)
        sum += (i % 2 ? 4.0 : 2.0) * f(a + i * h, context);
    return sum * h / 3.0;
}

/* ---- Beckmann: the slope and the area -------------------------------------------------------------- */

/* The density of d = K - x times exp(K^2) below the horizon, times 1 above; *context is K. */
static double distance_density(double d, const void *context)
{
    double k = *(const double *)context;
    return d * exp(k < 0.0 ? -d * (d - 2.0 * k) : -(k - d) * (k - d));
}

/* The range of d outside which less than 1e-25 of the mass lies. */
static double largest_distance(double k)
{
    return k < 0.0 ? 60.0 / (sqrt(k * k + 60.0) - k) : k + 8.0;
}

/* P(distance > d), which is the uniform number that stands for it. */
static double distance_cdf(double k, double d)
{
    double least = k > 8.0 ? k - 8.0 : 0.0, most = largest_distance(k);
    double near_end, rest;
    if (d > most)
        return 0.0;
    near_end = d > least ? simpson(distance_density, &k, least, d, 2000) : 0.0;
    rest = simpson(distance_density, &k, d > least ? d : least, most, 2000);
    return rest / (near_end + rest);
}

/* u = 2^-50 .. 1/2, an even grid, then 1 - 2^-7 .. 1 - 2^-24. */
static float uniform_of(int i)
{
    if (i < 50)
        return (float)ldexp(1.0, i - 50);
    return i < 150 ? (float)(i - 50 + 0.5) / 100.0f : 1.0f - (float)ldexp(1.0, 143 - i);
}

/* The error in u1, absolute and relative (down to u1 = 2^-50), from 0.001 to 179.95 degrees. */
static void beckmann_inversion_is_exact_in_u1(void)
{
    double worst = 0.0, worst_relative = 0.0;
    for (double degrees = 0.001; degrees < 179.96; degrees += degrees < 179.0 ? 1.0 : 0.05) {
        direction w = direction_at(degrees);
        for (int i = 0; i < 168; i++) {
            float u = uniform_of(i);
            double got = distance_cdf((double)w.c / w.s, vndf_beckmann_slope_distance(w.s, w.c, u));
            worst = fmax(worst, fabs(got - u));
            worst_relative = fmax(worst_relative, fabs(got / u - 1.0));
        }
    }
    fprintf(stderr, "beckmann: u1 error %.2g absolute, %.2g relative\n", worst, worst_relative);
    TEST(worst < 1e-7);
    TEST(worst_relative < 1e-7);
}

/* At 180 degrees but for rounding, -2 K d has the distribution function exp(-g) (1 + g). */
static void beckmann_has_its_limit_law(void)
{
    static const float sines[] = {1e-4f, 1e-9f, 1e-20f};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 168; j++) {
            double g = 2.0 / sines[i] * vndf_beckmann_slope_distance(sines[i], -1.0f, uniform_of(j));
            TEST_NEAR((1.0 + g) * exp(-g), uniform_of(j), 2e-7);
        }
}

static void areas_are_exact(void)
{
    double worst[2] = {0.0, 0.0};
    for (double degrees = 0.01; degrees < 179.99; degrees += 0.37) {
        direction w = direction_at(degrees);
        double k = (double)w.c / w.s, want = w.s / sqrt(PI), delta = atan2(w.s, -w.c);
        want *= simpson(distance_density, &k, k > 8.0 ? k - 8.0 : 0.0, largest_distance(k), 2000);
        want *= k < 0.0 ? exp(-k * k) : 1.0;
        if (want > 1e-37)
            worst[1] = fmax(worst[1], fabs(beckmann_area(w.s, w.c) / want - 1.0));
        want = sin(0.5 * delta) * sin(0.5 * delta);
        worst[0] = fmax(worst[0], fabs(ggx_area(w.s, w.c) / want - 1.0));
    }
    fprintf(stderr, "area: relative error %.2g ggx, %.2g beckmann\n", worst[0], worst[1]);
    TEST(worst[0] < 4e-7);
    TEST(worst[1] < 2e-7);
}

/* ---- both: moments ------------------------------------------------------------------------------- */

enum { MOMENTS = 5 };

static void moments_of(double x, double y, double z, double weight, double *sum)
{
    double values[MOMENTS] = {x, z, x * x, y * y, x * z};
    for (int i = 0; i < MOMENTS; i++)
        sum[i] += weight * values[i];
}

/* Midpoint sum over the hemisphere, in polar coordinates about z, of max(0, w.m) D(m) / A. */
static void moments_of_density(const closed_form *form, direction w, double *sum)
{
    enum { RINGS = 600, SECTORS = 600 };
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SECTORS; j++) {
            double theta = 0.5 * PI * (i + 0.5) / RINGS, phi = 2.0 * PI * (j + 0.5) / SECTORS;
            double x = sin(theta) * cos(phi), y = sin(theta) * sin(phi), z = cos(theta);
            vndf_normal n = {x, y, z};
            double cosine = w.s * x + w.c * z, cell = sin(theta) * PI * PI / RINGS / SECTORS;
            if (cosine > 0.0)
                moments_of(x, y, z, cosine * form->ndf(1.0, 1.0, n) * cell / form->area(w.s, w.c), sum);
        }
}

static void moments_of_samples(const closed_form *form, direction w, double *sum)
{
    enum { GRID = 500 };
    for (int i = 0; i < GRID * GRID; i++) {
        float u1 = (float)(i % GRID + 0.5) / GRID, u2 = (float)(i / GRID + 0.5) / GRID;
        vndf_normal n = unit(form->sample(w.s, w.c, u1, u2));
        moments_of(n.x, n.y, n.z, 1.0 / GRID / GRID, sum);
    }
}

static void moments_agree(const closed_form *form)
{
    static const double angles[] = {0.0, 30.0, 60.0, 85.0, 90.0, 100.0, 130.0, 155.0};
    for (int i = 0; i < 8; i++) {
        double want[MOMENTS] = {0.0}, got[MOMENTS] = {0.0};
        moments_of_density(form, direction_at(angles[i]), want);
        moments_of_samples(form, direction_at(angles[i]), got);
        for (int j = 0; j < MOMENTS; j++)
            TEST_NEAR(got[j], want[j], 1e-4);
    }
}

/* ---- both: hard directions and numbers ------------------------------------------------------------- */

static const float hard_uniforms[] = {
    0.0f, 1e-45f,      1.17549435e-38f, 1e-20f, 0x1p-24f,        1e-3f,           0.25f, 0.49999997f,
    0.5f, 0.50000006f, 0.75f,           0.999f, 1.0f - 0x1p-23f, 1.0f - 0x1p-24f, 1.0f,
};
enum { HARD_UNIFORMS = sizeof hard_uniforms / sizeof *hard_uniforms, HARD_DIRECTIONS = 48 };

/* Angles from the normal with their mirrors below the horizon, then cosines and sines that no angle gives. */
static direction hard_direction(int i)
{
    static const double angles[] = {0.0, 1e-7, 1e-4, 0.01, 1.0, 30.0, 45.0, 60.0, 85.0, 89.0, 89.9, 89.9999};
    static const direction others[] = {
        {1.0f, 0.0f},   {1.0f, 1e-7f},  {1.0f, 1e-20f}, {1.0f, 1e-40f}, {1.0f, 0x1p-24f}, {1e-7f, 1.0f},
        {1e-20f, 1.0f}, {1e-30f, 1.0f}, {1e-40f, 1.0f}, {0.6f, 0.8f},   {0.8f, 0.6f},     {0.1f, 0.99498744f},
    };
    direction w = i / 2 < 12 ? direction_at(angles[i / 2]) : others[i / 2 - 12];
    return i % 2 ? mirror(w) : w;
}

static int is_visible_normal(direction w, vndf_vec3 n)
{
    vndf_normal m = unit(n); /* NaN if n is zero, infinite or NaN */
    return fabs(m.x * m.x + m.y * m.y + m.z * m.z - 1.0) < 1e-9 && n.z >= 0.0f &&
           (double)w.s * n.x + (double)w.c * n.z >= 0.0 && w.s * n.x + w.c * n.z >= 0.0f;
}

static void check_sample(const closed_form *form, direction w, float u1, float u2)
{
    vndf_vec3 n = form->sample(w.s, w.c, u1, u2);
    float v1 = -1.0f, v2 = -1.0f;
    char text[200];
    snprintf(text, sizeof text, "%s s=%g c=%g u=%.9g,%.9g: normal %.9g %.9g %.9g", form->name, w.s, w.c, u1, u2,
             n.x, n.y, n.z);
    test_report(is_visible_normal(w, n), __FILE__, __LINE__, text);
    form->invert(w.s, w.c, vndf_normal_of(n), &v1, &v2);
    test_report(v1 >= 0.0f && v1 <= 1.0f && v2 >= 0.0f && v2 <= 1.0f, __FILE__, __LINE__, text);
    n = form->sample(w.s, w.c, v1, v2);
    test_report(is_visible_normal(w, n), __FILE__, __LINE__, text);
}

static void hard_samples_are_visible_normals(const closed_form *form)
{
    unsigned long long state = 17;
    for (int i = 0; i < HARD_DIRECTIONS; i++) {
        direction w = hard_direction(i);
        for (int j = 0; j < HARD_UNIFORMS * HARD_UNIFORMS; j++)
            check_sample(form, w, hard_uniforms[j / HARD_UNIFORMS], hard_uniforms[j % HARD_UNIFORMS]);
        for (int j = 0; j < 2000; j++)
            check_sample(form, w, test_uniform(&state), test_uniform(&state));
        TEST(isfinite(form->area(w.s, w.c)) && form->area(w.s, w.c) >= 0.0f);
    }
}

/* Two floats cannot name every normal where the map is steep; here that is less than 1e-5 of the mass. */
static void inverse_leads_back(const closed_form *form)
{
    enum { SAMPLES = 100000 };
    unsigned long long state = 5;
    double worst = 0.0;
    int far = 0;
    for (int i = 0; i < SAMPLES; i++) {
        direction w = direction_at(180.0 * test_uniform_double(&state));
        vndf_normal a = unit(form->sample(w.s, w.c, test_uniform(&state), test_uniform(&state))), b;
        float u1, u2;
        double error;
        form->invert(w.s, w.c, a, &u1, &u2);
        b = unit(form->sample(w.s, w.c, u1, u2));
        error = fmax(fabs(a.x - b.x), fmax(fabs(a.y - b.y), fabs(a.z - b.z)));
        worst = fmax(worst, error);
        far += error > 1e-5;
    }
    fprintf(stderr, "%s: sample(invert(wm)) is off by more than 1e-5 for %g of the mass, at most %.2g\n",
            form->name, (double)far / SAMPLES, worst);
    TEST(far <= 1);
    TEST(worst < 1e-4);
}

/* ---- GGX: the direction mirrored in the normal is uniform on the cap ------------------------------- */

static void ggx_mirrored_direction_has_its_uniforms(void)
{
    unsigned long long state = 3;
    double worst1 = 0.0, worst2 = 0.0;
    for (int i = 0; i < 200000; i++) {
        direction w = direction_at(150.0 * test_uniform_double(&state));
        float u1 = test_uniform(&state), u2 = test_uniform(&state);
        vndf_normal n = unit(vndf_ggx_sample(w.s, w.c, u1, u2));
        double twice = 2.0 * (w.s * n.x + w.c * n.z);
        double x = twice * n.x - w.s, y = twice * n.y, z = twice * n.z - w.c;
        double across = sqrt(x * x + y * y);
        worst2 = fmax(worst2, fabs((1.0 - z) / (1.0 + w.c) - u2) * (1.0 + w.c));
        worst1 = fmax(worst1, fabs(remainder(0.5 + atan2(y, x) / (2.0 * PI) - u1, 1.0)) * across);
    }
    fprintf(stderr, "ggx: mirrored direction off by %.2g in azimuth, %.2g in height\n", 2.0 * PI * worst1, worst2);
    TEST(2.0 * PI * worst1 < 2e-6);
    TEST(worst2 < 2e-6);
}

/* ---- the parts ---------------------------------------------------------------------------------- */

static void half_turn_is_accurate(void)
{
    double worst = 0.0;
    for (int i = 0; i <= 1 << 20; i++) {
        float u = (float)i * 0x1p-20f;
        vndf_turn turn = vndf_half_turn(u);
        worst = fmax(worst, fmax(fabs(turn.sine - sin(PI * u)), fabs(turn.cosine - cos(PI * u))));
    }
    fprintf(stderr, "half turn: error %.2g\n", worst);
    TEST(worst < 2.1e-7);
}

static void quantile_inverts_erf(void)
{
    double worst = 0.0;
    for (int i = 0; i < 6400; i++) {
        double u = ldexp(1.0 + (i % 100) / 100.0, -2 - i / 100 * 62 / 64), y = vndf_erf_quantile(u);
        double slope = exp(-y * y) / sqrt(PI);
        worst = fmax(worst, fabs((0.5 * erfc(-y) - u) / (slope * fmax(fabs(y), 1e-9))));
        TEST(vndf_erf_quantile(1.0 - 0x1p-26 * (i + 1)) == -vndf_erf_quantile(0x1p-26 * (i + 1)));
    }
    fprintf(stderr, "erf quantile: relative error %.2g\n", worst);
    TEST(worst < 6e-9);
}

static void densities_are_finite_and_normalised(void)
{
    vndf_normal rim = {1.0, 0.0, 0.0}, pole = {0.0, 0.0, 1.0};
    TEST(vndf_ggx_p22(1e113) < 1e-220 && vndf_beckmann_p22(1e113) == 0.0);
    TEST_RELATIVE(vndf_ggx_p22(3.0), 1.0 / (16.0 * PI), 1e-14);
    TEST_RELATIVE(vndf_beckmann_p22(3.0), exp(-3.0) / PI, 1e-14);
    for (int i = 0; i < 2; i++) {
        double sum = 0.0;
        for (int j = 0; j < 4000; j++) { /* integral of D cos over sin^2, pi times */
            double q = (j + 0.5) / 4000.0;
            vndf_normal n = {sqrt(q), 0.0, sqrt(1.0 - q)};
            sum += PI * forms[i].ndf(1.0, 1.0, n) / 4000.0;
        }
        TEST_NEAR(sum, 1.0, 1e-5);
        TEST_RELATIVE(forms[i].ndf(1.0, 1.0, pole), 1.0 / PI, 1e-14);
        TEST_RELATIVE(forms[i].ndf(1e-18, 1e-18, pole), 1e36 / PI, 1e-14);
    }
    TEST_RELATIVE(vndf_ggx_ndf(1.0, 1.0, rim), 1.0 / PI, 1e-14);
    TEST(vndf_beckmann_ndf(1.0, 1.0, rim) == 0.0 && vndf_beckmann_ndf(1e18, 1e-18, rim) == 0.0);
}

int main(void)
{
    beckmann_inversion_is_exact_in_u1();
    beckmann_has_its_limit_law();
    areas_are_exact();
    for (int i = 0; i < 2; i++) {
        moments_agree(&forms[i]);
        hard_samples_are_visible_normals(&forms[i]);
        inverse_leads_back(&forms[i]);
    }
    ggx_mirrored_direction_has_its_uniforms();
    half_turn_is_accurate();
    quantile_inverts_erf();
    densities_are_finite_and_normalised();
    return test_done();
}
