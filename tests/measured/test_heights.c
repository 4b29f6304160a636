/* The slopes of a Gaussian height field give Beckmann's distribution with alpha = sqrt 2 times the rms of the slope,
 * a stretched one the same under its matrix, and both say how sure that is; a cut-off halves waves of its length;
 * what has no law of slopes is refused. The curve ends where slopes end
 * abruptly. */
#include "measured/surface_case.h"

static double law_of(const height_field *field, int margin, slope_law *law, notes *said)
{
    slope_set slopes;
    refusal why = {""};
    *said = (notes){"", 0};
    if (!TEST(heights_slopes(field, margin, "made", &slopes, &why)) ||
        !TEST(slopes_law(&slopes, "made", law, said, &why))) {
        fprintf(stderr, "  %s\n", why.message);
        exit(1);
    }
    slopes_free(&slopes);
    return sqrt(2) * law->rms;
}

static void test_gaussian(void)
{
    slope_law law;
    notes said;
    refusal why = {""};
    int side = (int)test_amount(400, 700, 700);
    height_field field = surface_gaussian(side, 3, 3, 0.2);
    double alpha = law_of(&field, 1, &law, &said);
    vndf_source *source = profile_source(&law.rows, "made", &why);
    double off = surface_from_beckmann(source, alpha);
    printf(
        "Gaussian heights %d^2: alpha %.5f (0.28284), %zu rows, TV from Beckmann %.4f, anisotropy %.4f +- %.4f, "
        "residual %.4f, by chance %.4f, Smith at 75 degrees %.4f\n",
        side, alpha, law.rows.count, off, law.anisotropy, law.anisotropy_error, law.residual, law.noise,
        heights_smith(&field, 75 * PI / 180));
    TEST_RELATIVE(alpha, sqrt(2) * 0.2, 0.02);
    TEST(off < 0.015);
    TEST(!law.is_anisotropic && law.matrix[0] == 1 && law.matrix[1] == 0 && law.matrix[2] == 1);
    TEST(law.anisotropy - 1 < 5 * law.anisotropy_error && law.anisotropy_error < 0.02);
    TEST(law.residual < 2 * law.noise && law.noise < 0.05);
    TEST(fabs(law.tilt_x) < 0.01 && fabs(law.tilt_y) < 0.01);
    TEST_HAS(said.text, "\nanisotropy 1.0");
    TEST_HAS(said.text, "\np22_error_99 0.0");
    TEST(strstr(said.text, "matrix") == NULL);
    double smith = heights_smith(&field, 75 * PI / 180);
    TEST(smith > 0.001 && smith < 0.1);
    vndf_source_free(source);
    profile_free(&law.rows);
    heights_free(&field);
}

/* Waves twice as long along y: slopes half as steep there. */
static void test_stretched(void)
{
    slope_law law;
    notes said;
    refusal why = {""};
    height_field field = surface_gaussian((int)test_amount(400, 700, 700), 3, 6, 0.2);
    law_of(&field, 1, &law, &said);
    vndf_source *source = profile_source(&law.rows, "made", &why);
    double alpha = sqrt(2) * 0.2 / sqrt(2); /* the geometric mean of 0.2 and 0.1, times sqrt 2 */
    printf("stretched 2:1: anisotropy %.4f +- %.4f, matrix %.4f %.4f %.4f, TV from Beckmann %.4f\n",
           law.anisotropy, law.anisotropy_error, law.matrix[0], law.matrix[1], law.matrix[2],
           surface_from_beckmann(source, alpha));
    TEST(law.is_anisotropic);
    TEST_NEAR(law.anisotropy, 2, 5 * law.anisotropy_error);
    TEST_NEAR(law.matrix[0] * law.matrix[2] - law.matrix[1] * law.matrix[1], 1, 1e-12);
    TEST_NEAR(law.matrix[0] / law.matrix[2], 2, 0.15);
    TEST_NEAR(law.matrix[1], 0, 0.05);
    TEST(surface_from_beckmann(source, alpha) < 0.04);
    TEST_HAS(said.text, "\nmatrix 1.");
    vndf_source_free(source);
    profile_free(&law.rows);
    heights_free(&field);
}

/* Slopes of GGX, which have no mean square, and two cliffs: every row is GGX within its error, the last one too. */
static void test_heavy_tail(void)
{
    enum { COUNT = 1 << 17 };
    const double alpha = 0.3;
    unsigned long long state = 4;
    slope_set slopes;
    slope_law law;
    notes said = {"", 0};
    refusal why = {""};
    TEST(slopes_make(&slopes, COUNT));
    for (int i = 0; i < COUNT; i++) {
        double u = test_uniform_double(&state), phi = 2 * PI * test_uniform_double(&state);
        slopes_add(&slopes, alpha * sqrt(u / (1 - u)) * cos(phi), alpha * sqrt(u / (1 - u)) * sin(phi),
                   i % SLOPE_PARTS);
    }
    slopes.count -= 2; /* two cliffs */
    slopes_add(&slopes, 1e6, 0, 0);
    slopes_add(&slopes, -1e6, 0, 1);
    if (!TEST(slopes_law(&slopes, "made", &law, &said, &why)))
        return;
    double worst = 0;
    for (size_t i = 0; i < law.rows.count; i++) {
        double q = 1 + law.rows.x[i] * law.rows.x[i] / (alpha * alpha);
        worst = fmax(worst, fabs(law.rows.value[i] * PI * alpha * alpha * q * q - 1));
    }
    printf("slopes of GGX: rows up to %.3g off by %.3f at most\n", law.rows.x[law.rows.count - 1], worst);
    TEST(worst < 0.4 && !law.is_anisotropic);
    slopes_free(&slopes);
    profile_free(&law.rows);
}

typedef double slope_of_part(double u);

static double cut_beckmann(double u)
{
    return 0.3 * sqrt(-log1p(-0.95 * u));
}

static double disc(double u)
{
    return 0.5 * sqrt(u);
}

static double clamped_ggx(double u)
{
    return fmin(0.3 * sqrt(u / (1 - u)), 3);
}

static double whole_ggx(double u)
{
    return 0.3 * sqrt(u / (1 - u));
}

static double whole_beckmann(double u)
{
    return 0.3 * sqrt(-log1p(-u));
}

/* Slopes that end abruptly give a curve that ends there; a tail has the mass of few slopes beyond the longest. */
static void ends_at(slope_of_part *slope_of, int has_end, double most, const char *name)
{
    enum { COUNT = 1 << 16 };
    unsigned long long state = 6;
    double longest = 0;
    slope_set slopes;
    slope_law law;
    notes said = {"", 0};
    refusal why = {""};
    TEST(slopes_make(&slopes, COUNT));
    for (int i = 0; i < COUNT; i++) {
        double r = slope_of(test_uniform_double(&state)), phi = 2 * PI * test_uniform_double(&state);
        slopes_add(&slopes, r * cos(phi), r * sin(phi), i % SLOPE_PARTS);
    }
    if (!TEST(slopes_law(&slopes, name, &law, &said, &why))) {
        fprintf(stderr, "  %s\n", why.message);
        exit(1);
    }
    for (int i = 0; i < COUNT; i++)
        longest = fmax(longest, hypot((double)slopes.x[i], (double)slopes.y[i]));
    vndf_source *source = profile_source(&law.rows, name, &why);
    vndf_distribution *table = profile_table(&law.rows, name, &why);
    double end = law.rows.x[law.rows.count - 1], last = law.rows.value[law.rows.count - 1];
    double beyond = profile_mass(source, longest, has_end ? end : INFINITY);
    const char *note_of = strstr(said.text, "\nmass_beyond ");
    printf("%s: longest slope %.4f, last row at %.4f: %.3g, %.2g of the mass is beyond\n", name, longest, end,
           last, beyond);
    TEST(beyond * COUNT < most && table);
    TEST(has_end ? last == 0 && end > longest && end < 1.002 * longest : last > 0);
    if (TEST(note_of != NULL))
        TEST_NEAR(strtod(note_of + 13, NULL), beyond, 0.1 * beyond);
    vndf_free(table);
    vndf_source_free(source);
    slopes_free(&slopes);
    profile_free(&law.rows);
}

static void test_ends(void)
{
    ends_at(cut_beckmann, 1, 1, "Beckmann, cut off");
    ends_at(disc, 1, 1, "an even disc");
    ends_at(clamped_ggx, 1, 1, "GGX, clamped");
    ends_at(whole_ggx, 0, 4, "GGX");
    ends_at(whole_beckmann, 0, 4, "Beckmann");
}

/* A wave along x: its amplitude is halved at the cut-off, kept where it is long, gone where it is short. */
static void test_cutoff(void)
{
    static const double part[3] = {0.0625, 0.5, 0.958};
    for (int i = 0; i < 3; i++) {
        height_field field;
        refusal why = {""};
        double length = 8 * (i + 1) / (i == 2 ? 0.75 : 1), most = 0; /* 8, 16 and 32 samples */
        if (!TEST(heights_make(&field, 512, 64, "made", &why)))
            return;
        for (int k = 0; k < 512 * 64; k++)
            field.z[k] = (float)cos(2 * PI * (k % 512) / length);
        TEST(heights_smooth(&field, 16));
        for (int x = 128; x < 384; x++)
            most = fmax(most, fabs((double)field.z[32 * 512 + x]));
        double want = pow(0.5, 256 / (length * length));
        TEST_RELATIVE(want, part[i], 0.13);
        TEST_NEAR(most, want, 0.003);
        heights_free(&field);
    }
}

/* Places without a height take their neighbours' slopes with them, and nothing else. */
static void test_gaps(void)
{
    height_field field = surface_gaussian(200, 3, 3, 0.2);
    slope_set slopes;
    refusal why = {""};
    field.z[50 * 200 + 60] = NAN;
    field.z[50 * 200 + 61] = NAN;
    TEST(heights_slopes(&field, 1, "made", &slopes, &why));
    TEST(slopes.count == 198 * 198 - 8);
    slopes_free(&slopes);
    TEST(heights_smooth(&field, 10));
    TEST(isnan(field.z[50 * 200 + 60]) && isfinite(field.z[50 * 200 + 62]));
    heights_free(&field);
}

static void refused_surface(height_field *field, int margin, const char *message)
{
    slope_set slopes = {NULL, NULL, NULL, 0, 0, 0};
    slope_law law;
    notes said = {"", 0};
    refusal why = {""};
    int good =
        heights_slopes(field, margin, "made", &slopes, &why) && slopes_law(&slopes, "made", &law, &said, &why);
    if (!(TEST(!good) & TEST_HAS(why.message, message)))
        fprintf(stderr, "  %s\n", why.message);
    slopes_free(&slopes);
}

static void test_refusals(void)
{
    height_field field = surface_gaussian(100, 3, 3, 0.2);
    refused_surface(&field, 45, "100 slopes; at least 1000 are needed");
    refused_surface(&field, 50, "nothing is left inside a rim of 50");
    for (int i = 0; i < 10000; i++)
        field.z[i] = (float)(i % 100);
    refused_surface(&field, 1, "9604 of 9604 slopes are the same: this is a plane");
    for (int i = 0; i < 10000; i++)
        field.z[i] = (float)sin(i % 100 * 1.3);
    refused_surface(&field, 1, "the slopes lie on a line");
    for (int i = 0; i < 10000; i++)
        field.z[i] = NAN;
    refused_surface(&field, 1, "0 slopes; at least 1000");
    heights_free(&field);
}

int main(void)
{
    test_gaussian();
    test_stretched();
    test_heavy_tail();
    test_ends();
    test_cutoff();
    test_gaps();
    test_refusals();
    return test_done();
}
