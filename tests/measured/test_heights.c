/* Surfaces become laws of slopes. The slopes of a Gaussian height field give Beckmann's distribution with alpha =
 * sqrt 2 times the rms of the slope, a stretched one the same under its matrix, and both say how sure that is; slopes
 * that are drawn give the law that they were drawn from, also where they end abruptly or have no mean square; a cut-off
 * halves waves of its length. The same heights come out of every kind of file, and normal maps have the slopes of the
 * heights that they were made of. What has no law of slopes, or is no such file, is refused with the place, and what
 * has a strange one is named. Noticed: differences over one step in the place of two, errors that say too little, rows
 * or tails from the wrong end, a scale in another's place, the wrong byte first. */
#include "measured_case.h"

static const double ones[2] = {1, 1};

/* White noise without waves shorter than 16 samples, scaled to a slope along x of rms 0.2. */
static image gaussian(int side)
{
    image made;
    unsigned long long state = 9;
    double square = 0;
    const size_t n = (size_t)side;
    if (!TEST(image_make(&made, side, side)))
        exit(1);
    for (size_t i = 0; i < n * n; i++)
        made.rgb[3 * i] = (float)case_normal(&state);
    TEST(heights_smooth(&made, 16));
    for (size_t i = 0; i < n * n; i++)
        if (i % n > 0 && i % n < n - 1)
            square +=
                pow(((double)made.rgb[3 * i + 3] - (double)made.rgb[3 * i - 3]) / 2, 2) / (double)(n * (n - 2));
    for (size_t i = 0; i < n * n; i++)
        made.rgb[3 * i] = (float)((double)made.rgb[3 * i] * 0.2 / sqrt(square));
    return made;
}

typedef enum known_law { BECKMANN, CUT_BECKMANN, GGX } known_law;

static double known(known_law of, double r, double alpha)
{
    const double beckmann = exp(-r * r / (alpha * alpha)) / (PI * alpha * alpha);
    return of == GGX        ? case_ggx(r, alpha)
           : of == BECKMANN ? beckmann
                            : (r * r < log(20) * alpha * alpha ? beckmann / 0.95 : 0);
}

/* Total variation between the slopes of rows and those of a law. */
static double off_by(const profile *rows, known_law of, double alpha)
{
    data_file file = {.name = "made"};
    vndf_source *source = profile_source(rows, &file);
    double off = 0, mass = 0;
    for (double r = 1e-3 * alpha; r < 1e4 * alpha; r *= 1.001) {
        const double ring = 2 * PI * r * r * 0.001, found = vndf_source_p22(source, r);
        off += fabs(found - known(of, r, alpha)) * ring / 2;
        mass += found * ring;
    }
    printf("off by %.4f, mass %.4f\n", off, mass);
    TEST_NEAR(mass, 1, 0.02);
    vndf_source_free(source);
    return off;
}

/* The rows of slopes, which are freed. */
static profile law_of(slope_set *slopes, data_file *file, int is_there)
{
    profile rows;
    if (!case_read(is_there && slopes_law(slopes, file, &rows), file))
        exit(1);
    printf("%s\n", file->notes);
    slopes_free(slopes);
    return rows;
}

/* Samples `step` times as far apart along y have slopes as much less there. */
static void test_gaussian(double step)
{
    data_file file = {.name = "made"};
    slope_set slopes;
    image field = gaussian((int)test_amount(400, 700, 700));
    const double apart[2] = {1, step}, metres[2] = {1e-6, 1e-6};
    profile rows = law_of(&slopes, &file, heights_slopes(&field, apart, 16, &slopes, &file));
    const double error = case_number(&file, "+- "), alpha = 0.2 * sqrt(2 / step);
    double xx = 0, xy = 0, yy = 0;
    const char *matrix = strstr(file.notes, "\nmatrix ");
    TEST_RELATIVE(case_number(&file, "rms_slope "), 0.2 * sqrt((1 + 1 / (step * step)) / 2), 0.02);
    TEST(off_by(&rows, BECKMANN, alpha) < 0.025);
    TEST_NEAR(case_number(&file, "anisotropy "), step, 5 * error);
    TEST(error < 0.04 && case_number(&file, "residual_isotropy ") < 0.05);
    TEST(fabs(case_number(&file, "tilt ")) < 0.01 && case_number(&file, "p22_error_99 ") < 0.15);
    TEST(strstr(file.notes, "implausible") == NULL);
    if (step > 1) {
        TEST(matrix && sscanf(matrix, "\nmatrix %lf,%lf,%*f,%lf", &xx, &xy, &yy) == 3);
        TEST_NEAR(xx * yy - xy * xy, 1, 1e-5);
        TEST_NEAR(xx / yy, step, 0.1);
        TEST_NEAR(xy, 0, 0.05);
    } else
        TEST(matrix == NULL);
    profile_free(&rows);
    file = (data_file){.name = "made"};
    rows = law_of(&slopes, &file, heights_slopes(&field, metres, 1, &slopes, &file));
    TEST_HAS(file.notes, "implausible median slope 2.");
    TEST_HAS(file.notes, "e+05: are heights and steps in the same unit?");
    profile_free(&rows);
    image_free(&field);
}

/* Slopes of alpha 0.3 by their quantile, moved; those of GGX, which have no mean square, with two cliffs. */
static void test_drawn(known_law of)
{
    enum { COUNT = 1 << 17 };
    unsigned long long state = 6;
    double worst = 0;
    data_file file = {.name = "made"};
    slope_set slopes;
    TEST(slopes_make(&slopes, COUNT, &file));
    for (int i = 0; i < COUNT; i++) {
        double u = test_uniform_double(&state), phi = 2 * PI * test_uniform_double(&state);
        double r = 0.3 * sqrt(of == GGX ? u / (1 - u) : -log1p(of == BECKMANN ? -u : -0.95 * u));
        r = of == GGX && i < 2 ? 1e6 : r;
        phi = of == GGX && i < 2 ? i * PI : phi;
        slopes_add(&slopes, r * cos(phi) + 0.1, r * sin(phi) - 0.2, i % SLOPE_PARTS);
    }
    profile rows = law_of(&slopes, &file, 1);
    for (size_t i = 0; of != CUT_BECKMANN && i < rows.count; i++)
        worst = fmax(worst, fabs(rows.value[i] / known(of, rows.x[i], 0.3) - 1));
    printf("rows up to %.3g off by %.3f at most\n", rows.x[rows.count - 1], worst);
    TEST(worst < 0.4 && off_by(&rows, of, 0.3) < 0.015 && strstr(file.notes, "matrix") == NULL);
    TEST_NEAR(case_number(&file, "tilt "), 0.1, of == GGX ? 0.05 : 0.01);
    TEST_RELATIVE(case_number(&file, "p22_error_median "), sqrt(25.0 / COUNT), 0.3); /* a 25th is in a bin */
    profile_free(&rows);
}

/* ---- cut-off, gaps, refusals --------------------------------------------------------------------- */

/* A wave along x: its amplitude is halved at the cut-off, kept where it is long, gone where it is short. */
static void test_cutoff(void)
{
    for (double wave = 8; wave <= 32; wave *= 2) {
        image field;
        double most = 0;
        TEST(image_make(&field, 512, 64));
        for (int k = 0; k < 512 * 64; k++)
            field.rgb[3 * k] = (float)cos(2 * PI * (k % 512) / wave);
        TEST(heights_smooth(&field, 16));
        for (int x = 128; x < 384; x++)
            most = fmax(most, fabs((double)field.rgb[3 * (32 * 512 + x)]));
        TEST_NEAR(most, pow(0.5, 256 / (wave * wave)), 0.003);
        image_free(&field);
    }
}

/* Places without a height take their neighbours' slopes with them, and nothing else. */
static void test_gaps(void)
{
    image field = gaussian(200);
    data_file file = {.name = "made"};
    slope_set slopes;
    *image_pixel(&field, 60, 50) = *image_pixel(&field, 61, 50) = NAN;
    TEST(heights_slopes(&field, ones, 1, &slopes, &file) && slopes.count == 198 * 198 - 8);
    slopes_free(&slopes);
    TEST(heights_smooth(&field, 10));
    TEST(isnan(*image_pixel(&field, 60, 50)) && isfinite(*image_pixel(&field, 62, 50)));
    image_free(&field);
}

static void test_refusals(void)
{
    enum { GAUSSIAN, PLANE, WAVE, GAPS };
    static const struct {
        int kind, margin;
        const char *reason;
    } cases[] = {
        {GAUSSIAN, 45, "100 slopes; at least 1000 are needed"},
        {GAUSSIAN, 50, "nothing is left inside a rim of 50"},
        {PLANE, 1, "9604 of 9604 slopes are the same: this is a plane"},
        {WAVE, 1, "the slopes lie on a line"},
        {GAPS, 1, "0 slopes; at least 1000"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        image field = gaussian(100);
        slope_set slopes;
        profile rows = {0};
        data_file file = case_file("", 0);
        for (int k = 0; k < 10000 && cases[i].kind != GAUSSIAN; k++)
            field.rgb[3 * k] = cases[i].kind == GAPS    ? NAN
                               : cases[i].kind == PLANE ? (float)(k % 100)
                                                        : (float)sin(k % 100 * 1.3);
        int good =
            heights_slopes(&field, ones, cases[i].margin, &slopes, &file) && slopes_law(&slopes, &file, &rows);
        TEST(rows.x == NULL);
        case_refused(good, &file, cases[i].reason);
        slopes_free(&slopes);
        image_free(&field);
    }
}

/* ---- files --------------------------------------------------------------------------------------- */

#define BYTES(literal) literal, sizeof literal - 1

/* 0 to 8 in three rows, times a scale, but where nan says that there is none (images: render_command). */
static void test_kinds(void)
{
    static const struct {
        const char *bytes;
        size_t size;
        double scale;
    } cases[] = {
        {BYTES("\xEF\xBB\xBF# heights\r\n\n0 1\t 2\r\n3 nan 5  # end\n6 7 8e0"), 1},
        {BYTES("P5\n# a map\n3 3 # sides\n8\n\0\1\2\3\4\5\6\7\10"), 1.0 / 8},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        image field;
        data_file file = case_file(cases[i].bytes, cases[i].size);
        if (!case_read(heights_read(&file, &field), &file))
            continue;
        TEST(field.width == 3 && field.height == 3);
        for (int k = 0; k < 9; k++)
            TEST(i == 0 && k == 4 ? isnan(field.rgb[3 * k]) : field.rgb[3 * k] == (float)(k * cases[i].scale));
        image_free(&field);
        case_free(&file);
    }
}

/* Heights of a Gaussian surface as normals, of bytes or floats, none along the rim: slopes are those of the heights. */
static void test_normals(void)
{
    enum { SIDE = 64 };
    static char text[SIDE * SIDE * 12 + 64];
    static const char *const said_of[3] = {"n/2 + 1/2, whole numbers", "n, floats", "n/2 + 1/2, floats"};
    image field = gaussian(SIDE);
    for (int kind = 0; kind < 3; kind++) {
        size_t at = (size_t)sprintf(text, "%s\n%d %d\n%s\n", kind ? "PF" : "P6", SIDE, SIDE, kind ? "-1" : "255");
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int x = i % SIDE, y = kind ? SIDE - 1 - i / SIDE : i / SIDE;
            const float *z = image_pixel(&field, x, y);
            double n[3] = {0, 0, 0}, length = 1;
            if (x > 0 && y > 0 && x < SIDE - 1 && y < SIDE - 1) {
                n[0] = (double)*(z - 3) - (double)z[3], n[1] = (double)*(z - 3 * SIDE) - (double)z[3 * SIDE],
                n[2] = 2;
                length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            }
            for (int k = 0; k < 3; k++) {
                double value = kind == 1 ? n[k] / length : n[k] / length / 2 + 0.5;
                float as_float = (float)value;
                uint32_t bits = (uint32_t)floor(value * 255 + 0.5);
                if (kind)
                    memcpy(&bits, &as_float, sizeof bits);
                for (int byte = 0; byte < (kind ? 4 : 1); byte++)
                    text[at++] = (char)(bits >> 8 * byte & 255);
            }
        }
        slope_set found, want;
        data_file file = case_file(text, at);
        double worst = 0;
        case_read(normals_slopes(&file, &found) && heights_slopes(&field, ones, 1, &want, &file), &file);
        TEST_HAS(file.notes, said_of[kind]);
        TEST(case_number(&file, "left_out ") == 4 * SIDE - 4 && found.count == want.count);
        for (size_t i = 0; i < want.count && found.count == want.count; i++)
            worst =
                fmax(worst, hypot((double)(found.at[i].x - want.at[i].x), (double)(found.at[i].y - want.at[i].y)));
        TEST(worst < (kind ? 1e-6 : 0.015) && found.at[99].part == want.at[99].part);
        slopes_free(&found);
        slopes_free(&want);
        case_free(&file);
    }
    image_free(&field);
}

/* As heights, or as a normal map. */
static void test_refused_files(void)
{
    static const struct {
        const char *bytes;
        size_t size;
        int is_map;
        const char *reason;
    } cases[] = {
        {BYTES(""), 0, "0 x 0 heights; both sides must be from 3"},
        {BYTES("1 2 3\n4 5 6\n"), 0, "3 x 2 heights; both sides must be from 3"},
        {BYTES("1 2 3\n4 5\n"), 0, "line 2: 2 numbers, and 3 in the lines before"},
        {BYTES("1 2 3\n\n# no\n4 5 x6\n"), 0, "line 4: 'x6' is no height"},
        {BYTES("1 2 3\n4 5 inf\n"), 0, "line 2: 'inf' is no height"},
        {BYTES("1,2,3\n"), 0, "line 1: '1,2,3' is no height; numbers between blanks"},
        {BYTES("1 2 1e31\n"), 0, "line 1: '1e31' is no height"},
        {BYTES("P2\n3 3\n255\n"), 0, "begins with PF, Pf, P5 or P6"},
        {BYTES("P6\n1 1\n255\n123"), 0, "a PPM has colours"},
        {BYTES(""), 1, "begins with PF, Pf, P5 or P6"},
        {BYTES("P5\n1 1\n255\n1"), 1, "an image of one channel"},
        {BYTES("P6\n1 2\n255\n\0\0\0\0\0\0"), 1, "2 of 2 pixels are no normals"},
        {BYTES("P6\n1 2\n255\n\x7f\x7f\0\x7f\x7f\1"), 1, "2 of 2 pixels are no normals with z above 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        image field = {0};
        slope_set slopes = {0};
        data_file file = case_file(cases[i].bytes, cases[i].size);
        int good = cases[i].is_map ? normals_slopes(&file, &slopes) : heights_read(&file, &field);
        TEST(field.rgb == NULL && slopes.at == NULL);
        case_refused(good, &file, cases[i].reason);
    }
}

int main(void)
{
    test_gaussian(1);
    test_gaussian(2);
    for (int of = BECKMANN; of <= GGX; of++)
        test_drawn((known_law)of);
    test_cutoff();
    test_gaps();
    test_refusals();
    test_kinds();
    test_normals();
    test_refused_files();
    return test_done();
}
