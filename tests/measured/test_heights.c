/* The slopes of a Gaussian height field give Beckmann's distribution with alpha = sqrt 2 times the rms of the slope,
 * a stretched one the same under its matrix, and both say how sure that is; the curve ends where slopes end abruptly;
 * a cut-off halves waves of its length; what has no law of slopes is refused, and what has a strange one is named.
 * Noticed: differences over one step in the place of two, errors that say too little. */
#include "measured/measured_case.h"

static void law_of(const height_field *field, data_file *file, profile *rows)
{
    slope_set slopes;
    *file = (data_file){.name = "made"};
    if (!case_read(heights_slopes(field, 1, &slopes, file) && slopes_law(&slopes, file, rows), file))
        exit(1);
    printf("%s\n", file->notes);
    slopes_free(&slopes);
}

static void test_gaussian(void)
{
    data_file file;
    profile rows;
    height_field field = case_gaussian((int)test_amount(400, 700, 700), 3, 3, 0.2);
    law_of(&field, &file, &rows);
    double alpha = sqrt(2) * case_number(&file, "rms_slope "), off = case_from_beckmann(&rows, alpha);
    double error = case_number(&file, "+- ");
    printf("TV from Beckmann %.4f\n", off);
    TEST_RELATIVE(alpha, sqrt(2) * 0.2, 0.02);
    TEST(off < 0.015);
    TEST(case_number(&file, "anisotropy ") - 1 < 5 * error && error < 0.02);
    TEST(case_number(&file, "residual_isotropy ") < 0.05);
    TEST(fabs(case_number(&file, "tilt ")) < 0.01);
    TEST(case_number(&file, "p22_error_99 ") < 0.1);
    TEST(strstr(file.notes, "matrix") == NULL && strstr(file.notes, "implausible") == NULL);
    profile_free(&rows);
    field.step_x = field.step_y = 1e-6; /* heights in micrometres, steps in metres */
    law_of(&field, &file, &rows);
    TEST_HAS(file.notes, "implausible median slope 2.3e+05: are heights and steps in the same unit?");
    profile_free(&rows);
    heights_free(&field);
}

/* Waves twice as long along y: slopes half as steep there. */
static void test_stretched(void)
{
    data_file file;
    profile rows;
    height_field field = case_gaussian((int)test_amount(400, 700, 700), 3, 6, 0.2);
    law_of(&field, &file, &rows);
    double xx = 0, xy = 0, yy = 0,
           alpha = sqrt(2) * 0.2 / sqrt(2); /* the geometric mean of 0.2 and 0.1, times sqrt 2 */
    const char *matrix = strstr(file.notes, "\nmatrix ");
    TEST(matrix && sscanf(matrix, "\nmatrix %lf,%lf,%*f,%lf", &xx, &xy, &yy) == 3);
    TEST_NEAR(case_number(&file, "anisotropy "), 2, 5 * case_number(&file, "+- "));
    TEST_NEAR(xx * yy - xy * xy, 1, 1e-5);
    TEST_NEAR(xx / yy, 2, 0.15);
    TEST_NEAR(xy, 0, 0.05);
    TEST(case_from_beckmann(&rows, alpha) < 0.04);
    profile_free(&rows);
    heights_free(&field);
}

/* ---- ends ---------------------------------------------------------------------------------------- */

typedef double slope_of_part(double u);

static double cut_beckmann(double u)
{
    return 0.3 * sqrt(-log1p(-0.95 * u));
}

static double whole_ggx(double u)
{
    return 0.3 * sqrt(u / (1 - u));
}

static double whole_beckmann(double u)
{
    return 0.3 * sqrt(-log1p(-u));
}

static slope_set drawn(slope_of_part *slope_of, size_t count, data_file *file)
{
    unsigned long long state = 6;
    slope_set slopes;
    *file = (data_file){.name = "made"};
    TEST(slopes_make(&slopes, count, file));
    for (size_t i = 0; i < count; i++) {
        double r = slope_of(test_uniform_double(&state)), phi = 2 * PI * test_uniform_double(&state);
        slopes_add(&slopes, r * cos(phi), r * sin(phi), (int)(i % SLOPE_PARTS));
    }
    return slopes;
}

/* Slopes that end abruptly give a curve that ends there; a tail has the mass of few slopes beyond the longest. */
static void ends_at(slope_of_part *slope_of, int has_end, double most, const char *name)
{
    enum { COUNT = 1 << 16 };
    double longest = 0;
    data_file file;
    profile rows;
    slope_set slopes = drawn(slope_of, COUNT, &file);
    if (!case_read(slopes_law(&slopes, &file, &rows), &file))
        exit(1);
    for (int i = 0; i < COUNT; i++)
        longest = fmax(longest, hypot((double)slopes.x[i], (double)slopes.y[i]));
    double end = rows.x[rows.count - 1], last = rows.value[rows.count - 1],
           beyond = case_number(&file, "mass_beyond ");
    printf("%s: longest slope %.4f, last row at %.4f: %.3g, %.2g of the mass is beyond\n", name, longest, end,
           last, beyond);
    TEST(beyond * COUNT < most);
    TEST(has_end ? last == 0 && end > longest && end < 1.002 * longest : last > 0);
    vndf_source *source = profile_source(&rows, &file);
    TEST_NEAR(slope_mass(source, longest, has_end ? end : INFINITY), beyond, 0.1 * beyond);
    vndf_source_free(source);
    slopes_free(&slopes);
    profile_free(&rows);
}

/* Slopes of GGX, which have no mean square, and two cliffs: every row is GGX within its error, the last one too. */
static void test_heavy_tail(void)
{
    data_file file;
    profile rows;
    double worst = 0;
    slope_set slopes = drawn(whole_ggx, 1 << 17, &file);
    slopes.count -= 2;
    slopes_add(&slopes, 1e6, 0, 0);
    slopes_add(&slopes, -1e6, 0, 1);
    if (!case_read(slopes_law(&slopes, &file, &rows), &file))
        return;
    for (size_t i = 0; i < rows.count; i++) {
        double q = 1 + rows.x[i] * rows.x[i] / 0.09;
        worst = fmax(worst, fabs(rows.value[i] * PI * 0.09 * q * q - 1));
    }
    printf("slopes of GGX: rows up to %.3g off by %.3f at most\n", rows.x[rows.count - 1], worst);
    TEST(worst < 0.4 && strstr(file.notes, "matrix") == NULL);
    slopes_free(&slopes);
    profile_free(&rows);
}

/* ---- cut-off, gaps, refusals --------------------------------------------------------------------- */

/* A wave along x: its amplitude is halved at the cut-off, kept where it is long, gone where it is short. */
static void test_cutoff(void)
{
    static const double lengths[3] = {8, 16, 32};
    for (int i = 0; i < 3; i++) {
        height_field field;
        data_file file = {.name = "made"};
        double most = 0;
        if (!TEST(heights_make(&field, 512, 64, &file)))
            return;
        for (int k = 0; k < 512 * 64; k++)
            field.z[k] = (float)cos(2 * PI * (k % 512) / lengths[i]);
        TEST(heights_smooth(&field, 16));
        for (int x = 128; x < 384; x++)
            most = fmax(most, fabs((double)field.z[32 * 512 + x]));
        TEST_NEAR(most, pow(0.5, 256 / (lengths[i] * lengths[i])), 0.003);
        heights_free(&field);
    }
}

/* Places without a height take their neighbours' slopes with them, and nothing else. */
static void test_gaps(void)
{
    height_field field = case_gaussian(200, 3, 3, 0.2);
    data_file file = {.name = "made"};
    slope_set slopes;
    field.z[50 * 200 + 60] = NAN;
    field.z[50 * 200 + 61] = NAN;
    TEST(heights_slopes(&field, 1, &slopes, &file));
    TEST(slopes.count == 198 * 198 - 8);
    slopes_free(&slopes);
    TEST(heights_smooth(&field, 10));
    TEST(isnan(field.z[50 * 200 + 60]) && isfinite(field.z[50 * 200 + 62]));
    heights_free(&field);
}

static void refused(const height_field *field, int margin, const char *reason)
{
    slope_set slopes;
    profile rows = {0};
    data_file file = case_file("", 0);
    int good = heights_slopes(field, margin, &slopes, &file) && slopes_law(&slopes, &file, &rows);
    TEST(rows.x == NULL);
    case_refused(good, &file, reason);
    slopes_free(&slopes);
}

static void test_refusals(void)
{
    height_field field = case_gaussian(100, 3, 3, 0.2);
    refused(&field, 45, "100 slopes; at least 1000 are needed");
    refused(&field, 50, "nothing is left inside a rim of 50");
    for (int i = 0; i < 10000; i++)
        field.z[i] = (float)(i % 100);
    refused(&field, 1, "9604 of 9604 slopes are the same: this is a plane");
    for (int i = 0; i < 10000; i++)
        field.z[i] = (float)sin(i % 100 * 1.3);
    refused(&field, 1, "the slopes lie on a line");
    for (int i = 0; i < 10000; i++)
        field.z[i] = NAN;
    refused(&field, 1, "0 slopes; at least 1000");
    heights_free(&field);
}

int main(void)
{
    test_gaussian();
    test_stretched();
    test_heavy_tail();
    ends_at(cut_beckmann, 1, 1, "Beckmann, cut off");
    ends_at(whole_ggx, 0, 4, "GGX");
    ends_at(whole_beckmann, 0, 4, "Beckmann");
    test_cutoff();
    test_gaps();
    test_refusals();
    return test_done();
}
