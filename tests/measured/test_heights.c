/* Surfaces become laws of slopes. The slopes of a Gaussian height field give Beckmann's distribution with alpha =
 * sqrt 2 times the rms of the slope, a stretched one the same under its matrix, and both say how sure that is; the
 * curve ends where slopes end abruptly; a cut-off halves waves of its length. The same heights come out of every kind
 * of file, and normal maps have the slopes of the heights that they were made of. What has no law of slopes, or is no
 * such file, is refused with the place, and what has a strange one is named. Noticed: differences over one step in
 * the place of two, errors that say too little, rows from the wrong end, a scale in another's place, the wrong byte
 * first. */
#include "measured_case.h"

/* Each of `count` numbers becomes the mean of those around it, without ends, by a Gaussian. */
static void blur(float *line, size_t stride, int count, double sigma)
{
    enum { REACH = 40 };
    float *copy = malloc((size_t)count * sizeof *copy);
    for (int i = 0; i < count; i++) {
        double sum = 0;
        for (int k = -REACH; k <= REACH; k++)
            sum += (double)line[(size_t)((i + k + count) % count) * stride] * exp(-k * k / (2 * sigma * sigma));
        copy[i] = (float)sum;
    }
    for (int i = 0; i < count; i++)
        line[(size_t)i * stride] = copy[i];
    free(copy);
}

/* White noise blurred along x and y, periodic, scaled to a slope along x of that rms: slopes are Gaussian, so that
 * P22 is Beckmann's with alpha = sqrt 2 times the rms of the slope along one axis. */
static height_field gaussian(int side, double sigma_x, double sigma_y, double rms)
{
    height_field made;
    data_file file = {.name = "made"};
    unsigned long long state = 9;
    double square = 0;
    const size_t n = (size_t)side;
    if (!TEST(heights_make(&made, side, side, &file)))
        exit(1);
    for (size_t i = 0; i < n * n; i++)
        made.z[i] = (float)case_normal(&state);
    for (size_t i = 0; i < n; i++)
        blur(made.z + i * n, 1, side, sigma_x);
    for (size_t i = 0; i < n; i++)
        blur(made.z + i, n, side, sigma_y);
    for (size_t i = 0; i < n * n; i++)
        if (i % n > 0 && i % n < n - 1)
            square += pow(((double)made.z[i + 1] - (double)made.z[i - 1]) / 2, 2) / (double)(n * (n - 2));
    for (size_t i = 0; i < n * n; i++)
        made.z[i] = (float)((double)made.z[i] * rms / sqrt(square));
    return made;
}

/* Total variation between the slopes of rows and those of Beckmann's distribution, both scaled to mass 1. */
static double from_beckmann(const profile *rows, double alpha)
{
    data_file file = {.name = "made"};
    vndf_source *source = profile_source(rows, &file);
    double mass = slope_mass(source, 0, alpha) + slope_mass(source, alpha, INFINITY), off = 0;
    const double step = alpha / 200;
    for (double r = step / 2; r < 12 * alpha; r += step) {
        double beckmann = exp(-r * r / (alpha * alpha)) / (PI * alpha * alpha);
        off += fabs(vndf_source_p22(source, r) / mass - beckmann) * 2 * PI * r * step / 2;
    }
    printf("TV from Beckmann %.4f\n", off);
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

static profile law_of_field(const height_field *field, data_file *file)
{
    slope_set slopes;
    *file = (data_file){.name = "made"};
    return law_of(&slopes, file, heights_slopes(field, 1, &slopes, file));
}

static void test_gaussian(void)
{
    data_file file;
    height_field field = gaussian((int)test_amount(400, 700, 700), 3, 3, 0.2);
    profile rows = law_of_field(&field, &file);
    double alpha = sqrt(2) * case_number(&file, "rms_slope "), error = case_number(&file, "+- ");
    TEST_RELATIVE(alpha, sqrt(2) * 0.2, 0.02);
    TEST(from_beckmann(&rows, alpha) < 0.015);
    TEST(case_number(&file, "anisotropy ") - 1 < 5 * error && error < 0.02);
    TEST(case_number(&file, "residual_isotropy ") < 0.05);
    TEST(fabs(case_number(&file, "tilt ")) < 0.01);
    TEST(case_number(&file, "p22_error_99 ") < 0.1);
    TEST(strstr(file.notes, "matrix") == NULL && strstr(file.notes, "implausible") == NULL);
    profile_free(&rows);
    field.step_x = field.step_y = 1e-6; /* heights in micrometres, steps in metres */
    rows = law_of_field(&field, &file);
    TEST_HAS(file.notes, "implausible median slope 2.3e+05: are heights and steps in the same unit?");
    profile_free(&rows);
    heights_free(&field);
}

/* Waves twice as long along y: slopes half as steep there. */
static void test_stretched(void)
{
    data_file file;
    height_field field = gaussian((int)test_amount(400, 700, 700), 3, 6, 0.2);
    profile rows = law_of_field(&field, &file);
    double xx = 0, xy = 0, yy = 0;
    const char *matrix = strstr(file.notes, "\nmatrix ");
    TEST(matrix && sscanf(matrix, "\nmatrix %lf,%lf,%*f,%lf", &xx, &xy, &yy) == 3);
    TEST_NEAR(case_number(&file, "anisotropy "), 2, 5 * case_number(&file, "+- "));
    TEST_NEAR(xx * yy - xy * xy, 1, 1e-5);
    TEST_NEAR(xx / yy, 2, 0.15);
    TEST_NEAR(xy, 0, 0.05);
    TEST(from_beckmann(&rows, 0.2) < 0.04); /* the geometric mean of 0.2 and 0.1, times sqrt 2 */
    profile_free(&rows);
    heights_free(&field);
}

/* ---- slopes that are drawn ----------------------------------------------------------------------- */

/* Lengths of slopes of alpha 0.3, by their quantile; beside those of GGX, which have no mean square, two cliffs. */
typedef enum drawn_law { BECKMANN, CUT_BECKMANN, GGX } drawn_law;

/* Slopes that end abruptly give a curve that ends there; a tail has the mass of few slopes beyond the longest; every
 * row of GGX is GGX within its error, the last one too. */
static void test_drawn(drawn_law of)
{
    enum { COUNT = 1 << 17 };
    unsigned long long state = 6;
    double longest = 0, x = 0, y = 0, worst = 0;
    data_file file = {.name = "made"};
    slope_set slopes;
    TEST(slopes_make(&slopes, COUNT, &file));
    for (int i = 0; i < COUNT; i++) {
        double u = test_uniform_double(&state), phi = 2 * PI * test_uniform_double(&state);
        double r = 0.3 * sqrt(of == GGX ? u / (1 - u) : -log1p(of == BECKMANN ? -u : -0.95 * u));
        if (of == GGX && i < 2)
            slopes_add(&slopes, i ? 1e6 : -1e6, 0, i);
        else
            slopes_add(&slopes, r * cos(phi), r * sin(phi), i % SLOPE_PARTS);
        x += (double)slopes.at[i].x / COUNT;
        y += (double)slopes.at[i].y / COUNT;
    }
    for (int i = 0; i < COUNT; i++) /* from the mean, which is taken off */
        longest = fmax(longest, hypot((double)slopes.at[i].x - x, (double)slopes.at[i].y - y));
    profile rows = law_of(&slopes, &file, 1);
    double end = rows.x[rows.count - 1], last = rows.value[rows.count - 1];
    double beyond = case_number(&file, "mass_beyond ");
    TEST(beyond * COUNT < (of == CUT_BECKMANN ? 1 : 4));
    TEST(of == CUT_BECKMANN ? last == 0 && end > longest && end < 1.002 * longest : last > 0);
    vndf_source *source = profile_source(&rows, &file);
    TEST_NEAR(slope_mass(source, longest, of == CUT_BECKMANN ? end : INFINITY), beyond, 0.1 * beyond);
    for (size_t i = 0; of == GGX && i < rows.count; i++)
        worst = fmax(worst, fabs(rows.value[i] / case_ggx(rows.x[i], 0.3) - 1));
    printf("rows up to %.3g off by %.3f at most\n", end, worst);
    TEST(worst < 0.4 && (of != GGX || strstr(file.notes, "matrix") == NULL));
    vndf_source_free(source);
    profile_free(&rows);
}

/* ---- cut-off, gaps, refusals --------------------------------------------------------------------- */

/* A wave along x: its amplitude is halved at the cut-off, kept where it is long, gone where it is short. */
static void test_cutoff(void)
{
    for (double wave = 8; wave <= 32; wave *= 2) {
        height_field field;
        data_file file = {.name = "made"};
        double most = 0;
        TEST(heights_make(&field, 512, 64, &file));
        for (int k = 0; k < 512 * 64; k++)
            field.z[k] = (float)cos(2 * PI * (k % 512) / wave);
        TEST(heights_smooth(&field, 16));
        for (int x = 128; x < 384; x++)
            most = fmax(most, fabs((double)field.z[32 * 512 + x]));
        TEST_NEAR(most, pow(0.5, 256 / (wave * wave)), 0.003);
        heights_free(&field);
    }
}

/* Places without a height take their neighbours' slopes with them, and nothing else. */
static void test_gaps(void)
{
    height_field field = gaussian(200, 3, 3, 0.2);
    data_file file = {.name = "made"};
    slope_set slopes;
    field.z[50 * 200 + 60] = field.z[50 * 200 + 61] = NAN;
    TEST(heights_slopes(&field, 1, &slopes, &file) && slopes.count == 198 * 198 - 8);
    slopes_free(&slopes);
    TEST(heights_smooth(&field, 10));
    TEST(isnan(field.z[50 * 200 + 60]) && isfinite(field.z[50 * 200 + 62]));
    heights_free(&field);
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
        height_field field = gaussian(100, 3, 3, 0.2);
        slope_set slopes;
        profile rows = {0};
        data_file file = case_file("", 0);
        for (int k = 0; k < 10000 && cases[i].kind != GAUSSIAN; k++)
            field.z[k] = cases[i].kind == GAPS    ? NAN
                         : cases[i].kind == PLANE ? (float)(k % 100)
                                                  : (float)sin(k % 100 * 1.3);
        int good = heights_slopes(&field, cases[i].margin, &slopes, &file) && slopes_law(&slopes, &file, &rows);
        TEST(rows.x == NULL);
        case_refused(good, &file, cases[i].reason);
        slopes_free(&slopes);
        heights_free(&field);
    }
}

/* ---- files --------------------------------------------------------------------------------------- */

#define BYTES(literal) literal, sizeof literal - 1

/* 0 to 8 in three rows, times a scale, but where nan says that there is none. */
static void test_kinds(void)
{
    static const struct {
        const char *bytes;
        size_t size;
        double scale;
    } cases[] = {
        {BYTES("\xEF\xBB\xBF# heights\r\n\n0 1\t 2\r\n3 nan 5  # end\n6 7 8e0"), 1},
        {BYTES("P5\n# a map\n3 3 # sides\n8\n\0\1\2\3\4\5\6\7\10"), 1.0 / 8},
        {BYTES("P5\n3 3\n2048\n\0\0\1\0\2\0\3\0\4\0\5\0\6\0\7\0\10\0"), 1.0 / 8},
        {BYTES("Pf\n3 3\n1\n\x40\xc0\0\0\x40\xe0\0\0\x41\0\0\0\x40\x40\0\0\x40\x80\0\0\x40\xa0\0\0"
               "\0\0\0\0\x3f\x80\0\0\x40\0\0\0"),
         1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        height_field field;
        data_file file = case_file(cases[i].bytes, cases[i].size);
        if (!case_read(heights_read(&file, &field), &file))
            continue;
        TEST(field.width == 3 && field.height == 3 && field.step_x == 1 && field.step_y == 1);
        for (int k = 0; k < 9; k++)
            TEST(i == 0 && k == 4 ? isnan(field.z[k]) : field.z[k] == (float)(k * cases[i].scale));
        heights_free(&field);
        case_free(&file);
    }
}

/* Heights of a Gaussian surface as normals, of bytes or floats; the law is that of the heights. */
static void test_normals(void)
{
    enum { SIDE = 256 };
    static char text[SIDE * SIDE * 12 + 64];
    static const char *const said_of[3] = {"n/2 + 1/2, whole numbers", "n, floats", "n/2 + 1/2, floats"};
    height_field field = gaussian(SIDE, 3, 3, 0.2);
    for (int kind = 0; kind < 3; kind++) {
        size_t at = (size_t)sprintf(text, "%s\n%d %d\n%s\n", kind ? "PF" : "P6", SIDE, SIDE, kind ? "-1" : "255");
        for (int i = 0; i < SIDE * SIDE; i++) {
            int x = i % SIDE, y = kind ? SIDE - 1 - i / SIDE : i / SIDE, left = (x + SIDE - 1) % SIDE;
            int above = (y + SIDE - 1) % SIDE, below = (y + 1) % SIDE;
            double n[3] = {(double)field.z[y * SIDE + left] - (double)field.z[y * SIDE + (x + 1) % SIDE],
                           (double)field.z[above * SIDE + x] - (double)field.z[below * SIDE + x], 2};
            double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
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
        slope_set slopes;
        data_file file = case_file(text, at);
        int is_there = normals_slopes(&file, &slopes);
        profile rows = law_of(&slopes, &file, is_there);
        TEST_HAS(file.notes, said_of[kind]);
        TEST_HAS(file.notes, "left_out 0\n");
        double rms = case_number(&file, "rms_slope ");
        TEST_RELATIVE(rms, 0.2, 0.02);
        TEST(from_beckmann(&rows, sqrt(2) * rms) < (kind ? 0.015 : 0.04)); /* bytes are coarse */
        profile_free(&rows);
        case_free(&file);
    }
    heights_free(&field);
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
        {BYTES("P2\n3 3\n255\n"), 0, "it would begin with PF, Pf, P5 or P6"},
        {BYTES("P6\n1 1\n255\n123"), 0, "a PPM has colours"},
        {BYTES(""), 1, "it would begin with PF, Pf, P5 or P6"},
        {BYTES("P5\n1 1\n255\n1"), 1, "an image of one channel"},
        {BYTES("P6\n1 2\n255\n\0\0\0\0\0\0"), 1, "2 of 2 pixels are no normals"},
        {BYTES("P6\n1 2\n255\n\x7f\x7f\0\x7f\x7f\1"), 1, "2 of 2 pixels are no normals with z above 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        height_field field = {0};
        slope_set slopes = {0};
        data_file file = case_file(cases[i].bytes, cases[i].size);
        int good = cases[i].is_map ? normals_slopes(&file, &slopes) : heights_read(&file, &field);
        TEST(field.z == NULL && slopes.at == NULL);
        case_refused(good, &file, cases[i].reason);
    }
}

int main(void)
{
    test_gaussian();
    test_stretched();
    for (int of = BECKMANN; of <= GGX; of++)
        test_drawn((drawn_law)of);
    test_cutoff();
    test_gaps();
    test_refusals();
    test_kinds();
    test_normals();
    test_refused_files();
    return test_done();
}
