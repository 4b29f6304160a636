/* What is promised of samples and densities holds where the caller has the processor flush denormals to zero and
 * read them as zero, as renderers do, and where it has not: for directions of length 1e-37 to 3e38, roughness from
 * one end of its range to the other, up to 1e-18 beside 9e17, and the borders of the unit square, by the calls of
 * one and by batches of every instruction set; no NaN comes out of any call, those of the BSDF layer among them.
 * With the argument avx2 or avx512 batches of that instruction set alone. */
#include <float.h>

#include "sampler/batch_case.h"
#include "bsdf/bsdf_case.h"
#include "vndf_bsdf.h"

#if defined(__SSE2__)
#  include <xmmintrin.h>

/* Bits of the control register: flush to zero, denormals are zero. */
static void set_flushing(int flushing)
{
    const unsigned both = 0x8040;
    _mm_setcsr(flushing ? _mm_getcsr() | both : _mm_getcsr() & ~both);
}

enum { HAS_FLUSHING = 1 };

#else

static void set_flushing(int flushing)
{
    (void)flushing;
}

enum { HAS_FLUSHING = 0 };

#endif

enum { COUNT = 20000, BSDF_COUNT = 3000, ARRAYS = 18 };
enum { ALPHA_X, ALPHA_Y, WI_X, WI_Y, WI_Z, U1, U2, X, Y, Z, PDF, AGAIN, VISIBLE, NDF, AREA, LAMBDA, G1, V1 };

/* ---- inputs ---- */

/* Between two numbers, evenly by factors. */
static double between(unsigned long long *state, double from, double to)
{
    return from * pow(to / from, test_uniform_double(state));
}

static float hard_uniform(unsigned long long *state)
{
    float which = test_uniform(state);
    if (which < 0.3f)
        return which < 0.15f ? 0.0f : 1.0f;
    if (which < 0.5f)
        return (float)(which < 0.4f ? between(state, 1e-9, 1) : 1 - between(state, 3e-8, 1));
    return test_uniform(state);
}

/* Ordinary, or anything in the range that vndf_view_from states, its ends among that. */
static float hard_alpha(unsigned long long *state, double scale)
{
    float which = test_uniform(state);
    if (which < 0.4f)
        return (float)between(state, 1e-4, 10);
    if (which < 0.6f)
        return (float)((which < 0.5f ? 1.01e-18 : 9e17) / scale);
    return (float)(between(state, 1.01e-18, 9.9e17) / scale);
}

static double hard_cosine(unsigned long long *state)
{
    float which = test_uniform(state);
    double sign = test_uniform(state) < 0.5f ? -1 : 1;
    return which < 0.3f   ? sign * between(state, 1e-37, 1)
           : which < 0.5f ? sign * (1 - between(state, 1e-16, 1))
                          : 2 * test_uniform_double(state) - 1;
}

/* Flushed, a denormal is 0: it is none of ours. */
static float normal_float(double x)
{
    return fabs(x) < (double)FLT_MIN ? 0.0f : (float)x;
}

static vndf_vec3 hard_direction(unsigned long long *state)
{
    double c = hard_cosine(state), s = sqrt(1 - c * c), phi = 6.283185307179586 * test_uniform_double(state);
    double length = test_uniform(state) < 0.5f ? between(state, 1e-16, 1e-4) : between(state, 1e-37, 3e38);
    int axis = (int)(8 * test_uniform(state));
    double x = axis == 0 ? 0 : cos(phi), y = axis == 1 ? 0 : sin(phi);
    vndf_vec3 w = {normal_float(length * s * x), normal_float(length * s * y), normal_float(length * c)};
    return w;
}

static void put(float of[ARRAYS][COUNT], int i, float alpha_x, float alpha_y, vndf_vec3 wi)
{
    of[ALPHA_X][i] = alpha_x;
    of[ALPHA_Y][i] = alpha_y;
    of[WI_X][i] = wi.x;
    of[WI_Y][i] = wi.y;
    of[WI_Z][i] = wi.z;
}

/* A direction so long that its inverse is a denormal, seen along the smooth axis from below the horizon. */
static void put_long(float of[ARRAYS][COUNT], int i, double scale, unsigned long long *state)
{
    vndf_vec3 wi = {(float)between(state, 8.6e37, 3e38), 0, (float)-between(state, 1e5, 1e20)};
    put(of, i, (float)(1.01e-18 / scale), (float)(9e17 / scale), wi);
    of[U1][i] = 1;
}

/* A corner of the unit square below the horizon of a smooth surface, where normals just face wi. */
static void put_corner(float of[ARRAYS][COUNT], int i, unsigned long long *state)
{
    double z = between(state, 1e-30, 1e-2), s = sqrt(1 - z * z);
    double phi = 6.283185307179586 * test_uniform_double(state);
    vndf_vec3 wi = {(float)(s * cos(phi)), (float)(s * sin(phi)), (float)-z};
    put(of, i, (float)between(state, 1e-8, 1e-2), (float)between(state, 1e-8, 1e-2), wi);
    of[U1][i] = (float)(i % 2);
    of[U2][i] = 1;
}

static void fill(float of[ARRAYS][COUNT], double scale, unsigned long long *state)
{
    for (int i = 0; i < COUNT; i++) {
        float alpha = hard_alpha(state, scale);
        put(of, i, alpha, i % 3 ? hard_alpha(state, scale) : alpha, hard_direction(state));
        of[U1][i] = hard_uniform(state);
        of[U2][i] = hard_uniform(state);
        if (i % 16 == 1)
            put_long(of, i, scale, state);
        else if (i % 4 == 2)
            put_corner(of, i, state);
    }
}

/* ---- the calls of one ---- */

static int is_unit(vndf_vec3 w)
{
    double square = (double)w.x * (double)w.x + (double)w.y * (double)w.y + (double)w.z * (double)w.z;
    return fabs(sqrt(square) - 1) <= 4 * 0x1p-23 && w.z >= 0;
}

static int is_facing(vndf_vec3 wi, vndf_vec3 wm)
{
    double x = (double)wi.x * (double)wm.x, y = (double)wi.y * (double)wm.y, z = (double)wi.z * (double)wm.z;
    return x + y + z >= -2 * 0x1p-24 * (fabs(x) + fabs(y) + fabs(z));
}

static int is_invalid_sample(vndf_vec3 wm, float pdf, float again)
{
    return wm.x == 0 && wm.y == 0 && wm.z == 1 && pdf == 0 && again == 0;
}

/* Straight from below nothing is seen. */
static int is_density(vndf_vec3 wi, float pdf, float again)
{
    if (wi.x == 0 && wi.y == 0 && wi.z < 0)
        return pdf == 0;
    return pdf >= FLT_MIN && pdf <= FLT_MAX && fabs((double)again / (double)pdf - 1) <= 1e-5;
}

static void test_one(const vndf_distribution *d, const float of[ARRAYS][COUNT], int i)
{
    vndf_surface surface = {d, of[ALPHA_X][i], of[ALPHA_Y][i]};
    vndf_vec3 wi = {of[WI_X][i], of[WI_Y][i], of[WI_Z][i]};
    vndf_view view = vndf_view_from(&surface, wi);
    float pdf = -1;
    vndf_vec3 wm = vndf_sample(&view, of[U1][i], of[U2][i], &pdf);
    float again = vndf_pdf(&view, wm);
    int good = view.distribution ? TEST(is_unit(wm)) & TEST(is_facing(wi, wm)) & TEST(is_density(wi, pdf, again))
                                 : TEST(is_invalid_sample(wm, pdf, again));
    good &= TEST(wm.x == of[X][i] && wm.y == of[Y][i] && wm.z == of[Z][i] && pdf == of[PDF][i]);
    good &= TEST(again == of[AGAIN][i]);
    for (int n = VISIBLE; n < ARRAYS; n++)
        good &= TEST(of[n][i] >= -FLT_MAX && of[n][i] <= FLT_MAX);
    if (!good && test_failures < 20)
        fprintf(stderr, "  alpha %.9g %.9g wi %.9g %.9g %.9g u %.9g %.9g: %.9g %.9g %.9g density %.9g, pdf %.9g\n",
                (double)surface.alpha_x, (double)surface.alpha_y, (double)wi.x, (double)wi.y, (double)wi.z,
                (double)of[U1][i], (double)of[U2][i], (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf,
                (double)again);
}

/* ---- batches ---- */

static void run_batch(const vndf_distribution *d, float of[ARRAYS][COUNT], vndf_instructions limit)
{
    static float v2[COUNT];
    vndf_batch b = {d, COUNT, 0, limit, of[ALPHA_X], of[ALPHA_Y], of[WI_X], of[WI_Y], of[WI_Z]};
    vndf_normals wm = {of[X], of[Y], of[Z]};
    vndf_sample_n(&b, of[U1], of[U2], wm, of[PDF]);
    vndf_pdf_n(&b, wm, of[AGAIN]);
    vndf_visible_n(&b, wm, of[VISIBLE]);
    vndf_ndf_n(&b, wm, of[NDF]);
    vndf_projected_area_n(&b, of[AREA]);
    vndf_lambda_n(&b, of[LAMBDA]);
    vndf_g1_n(&b, of[G1]);
    vndf_invert_n(&b, wm, of[V1], v2);
    for (int i = 0; i < COUNT; i++)
        TEST(of[V1][i] >= 0 && of[V1][i] <= 1 && v2[i] >= 0 && v2[i] <= 1);
}

static void test_calls(const vndf_distribution *d, vndf_instructions limit, unsigned long long *state)
{
    static float of[ARRAYS][COUNT];
    double scale = d ? vndf_distribution_info(d).scale : 1;
    if (vndf_instructions_used(limit) != limit)
        return;
    fill(of, scale, state);
    run_batch(d, of, limit);
    for (int i = 0; i < COUNT; i++)
        test_one(d, (const float(*)[COUNT])of, i);
}

/* ---- BSDFs ---- */

static int is_number(float x)
{
    return x >= 0 && x <= FLT_MAX;
}

static void test_bsdf(const vndf_distribution *d, unsigned long long *state)
{
    const oracle_ndf ndf = {.distribution = d};
    static const float alphas[] = {1e-18f, 1e-10f, 1e-4f, 0.03f, 0.5f, 10, 1e10f, 9e17f};
    for (unsigned i = 0; i < BSDF_COUNT; i++) {
        vndf_effects e = {(vndf_lobes)(i % 3),
                          (vndf_fresnel)(i / 3 % 4),
                          (vndf_masking)(i / 12 % 4),
                          (vndf_normals_drawn)(i / 48 % 4),
                          (vndf_scattering)(i / 192 % 2),
                          VNDF_TRANSPORT_RADIANCE,
                          (vndf_shape)(i / 384 % 2),
                          VNDF_REFLECTION_SPECULAR};
        vndf_description is = bsdf_material(&ndf, &e, alphas, 8, state);
        vndf_material material;
        vndf_bsdf bsdf;
        vndf_scattered s;
        float f[VNDF_WAVELENGTHS], u[3] = {hard_uniform(state), hard_uniform(state), hard_uniform(state)};
        vndf_vec3 wi = i % 4 ? bsdf_direction(state) : hard_direction(state);
        if (vndf_material_resolve(&is, &material, NULL) != VNDF_OK)
            continue;
        vndf_bsdf_at(&bsdf, &material, wi);
        vndf_bsdf_sample(&bsdf, u, &s);
        vndf_bsdf_eval(&bsdf, s.wo, i, f);
        int good = TEST(isfinite(s.wo.x) && isfinite(s.wo.y) && isfinite(s.wo.z) && is_number(s.density));
        good &= TEST(is_number(s.weight[0]) && is_number(s.weight[1]) && is_number(s.weight[2]));
        good &= TEST(is_number(f[0]) && is_number(f[1]) && is_number(f[2]));
        if (!(good & TEST(is_number(vndf_bsdf_pdf(&bsdf, s.wo)))))
            bsdf_describe(&is, "", wi, s.wo);
    }
}

static void test_distribution(const vndf_distribution *d, const char *name, vndf_instructions only)
{
    int failures = test_failures;
    for (int flushing = 0; flushing <= HAS_FLUSHING; flushing++) {
        unsigned long long state = 17;
        set_flushing(flushing);
        for (int limit = VNDF_INSTRUCTIONS_PORTABLE; limit <= VNDF_INSTRUCTIONS_AVX512; limit++)
            if (only == VNDF_INSTRUCTIONS_BEST || limit == (int)only)
                test_calls(d, (vndf_instructions)limit, &state);
        if (d && only == VNDF_INSTRUCTIONS_BEST)
            test_bsdf(d, &state);
        set_flushing(0);
        if (test_failures > failures)
            fprintf(stderr, "  %s, denormals %s\n", name, flushing ? "flushed" : "kept");
    }
}

int main(int arguments, char **argument)
{
    if (!HAS_FLUSHING) {
        printf("SKIPPED: no way to flush denormals is known here\n");
        return 0;
    }
    return batch_main(arguments, argument, test_distribution);
}
